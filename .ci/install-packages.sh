#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: install-packages.sh [LIST …]
# Installs the Debian packages of the lists that are missing, and does nothing when none is. Without apt it prints them.
set -eu
cd "$(dirname "$0")"
[ $# -gt 0 ] || set -- debian-packages.txt
wanted=$(sed 's/#.*//' "$@" | tr -s ' \t\n' '   ')

if ! command -v apt-get > /dev/null 2>&1; then
  echo "This is no Debian; the build needs what these packages of Debian 12 hold:"
  printf ' %s' $wanted
  echo
  exit 0
fi
# A package counts as there, too, when another one of the list provides it: nodejs from elsewhere than Debian brings npm along.
# shellcheck disable=SC2086
installed=" $(dpkg-query -W -f '${db:Status-Status} ${Package}, ${Provides}\n' $wanted 2> /dev/null |
  sed -n 's/^installed //p' | tr ',\n' '  ') "
missing=
for package in $wanted; do
  case $installed in
    *" $package "*) ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0

become=
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null 2>&1; then
    echo "error[U01] packages are missing, and only root may install them:$missing" >&2
    echo "hint: as root: apt-get install$missing" >&2
    exit 2
  fi
  become=sudo
fi
echo "installing:$missing"
$become env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 update
$become env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 install --no-install-recommends $missing
