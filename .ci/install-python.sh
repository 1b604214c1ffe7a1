#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: install-python.sh BUILD
# Makes BUILD/python, the Python environment by which E57, LAS and LAZ are read, as .ci/python-packages.txt pins it; does nothing when it
# is there. Without the package registry all else works: this says so and is no failure.
set -eu
build=$1
packages=$(cd "$(dirname "$0")" && pwd)/python-packages.txt
environment=$build/python
if cmp -s "$packages" "$environment/packages.txt"; then exit 0; fi

# Debian's own Python: others may have no module venv, or lie where the build may not look tomorrow.
python=/usr/bin/python3
[ -x $python ] || python=python3
mkdir -p "$build"
rm -rf "$environment" "$environment.new"
echo "setting up $environment: the readers of E57, LAS and LAZ"
if $python -m venv "$environment.new" > "$build/python.log" 2>&1 &&
  "$environment.new/bin/python3" -m pip install --quiet --disable-pip-version-check --retries 1 --timeout 20 --no-deps --only-binary :all: \
    --require-hashes -r "$packages" >> "$build/python.log" 2>&1; then
  cp "$packages" "$environment.new/packages.txt"
  mv "$environment.new" "$environment"
  rm -f "$build/python.log"
else
  rm -rf "$environment.new"
  echo "note: E57, LAS and LAZ cannot be read: their packages could not be installed ($build/python.log); make deps tries again" >&2
fi
