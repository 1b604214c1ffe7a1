#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: same_bytes.sh SOURCE BUILD: the result does not depend on threads, on make's -j, on the folder or on who calls the stages.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
. "$(dirname "$0")/lib.sh"

printf 'graphcut:\n  mu_m: 0.3\n' > "$config"
make_scan 1 "$scan" || exit 1
mk run JOBS=1 || { cat "$output"; exit 1; }
digests "$work" > "$place/first"
for threads in 2 8; do
  rm -rf "$work"
  mk run JOBS=$threads
  digests "$work" > "$place/now"
  if cmp -s "$place/first" "$place/now"; then ok "$threads threads give the bytes of one"; else not_ok "$threads threads" "$(diff "$place/first" "$place/now")"; fi
done
rm -rf "$work"
jobs=-j4
mk run
digests "$work" > "$place/now"
check "make -j4 gives the same bytes" cmp "$place/first" "$place/now"
jobs=

# By hand, one at a time, in another folder, with the options that the README names.
hand="$place/by hand"
mkdir "$hand"
cd "$hand" || exit 1
bin=$BUILD/bin
step() {
  local stage=$1
  shift
  "$bin/$stage" -q --config "$config" "$@" > "$output" 2>&1 || not_ok "$stage by hand" "$(cat "$output")"
}
step ingest --scan "$scan"
"$bin/artefact" rules | tr -d ')' > "$place/rules"
while IFS=, read -r _ name program _ _ options; do
  # shellcheck disable=SC2086  # one word each
  case $name in ingest | report) ;; *) step "$program" $options ;; esac
done < "$place/rules"
digests "$hand" > "$place/now"
grep -v report.html "$place/first" > "$place/without_report"
if cmp -s "$place/without_report" "$place/now"; then
  ok "the stages by hand, one at a time, give the bytes of make run"
else
  not_ok "the stages by hand" "$(diff "$place/without_report" "$place/now")"
fi
cd / || exit 1

# Nothing of this machine in an artefact.
host=$(uname -n)
[ ${#host} -gt 5 ] || host=$place  # a host called "vm" stands in any megabyte by chance
found=$(cd "$work" && grep -lF -e "$place" -e "$host" -e "räume 1" -r --include='*.h5' --include='*.geojson' --include='*.ply' --include='*.obj' --include=summary.json . |
  grep -v 10_ingest || true)
if [ -z "$found" ]; then ok "no path and no host in any artefact"; else not_ok "a path or host in an artefact" "$found"; fi
finish
