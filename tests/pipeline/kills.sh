#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: kills.sh SOURCE BUILD [MOMENTS]: SIGKILL of every stage at random moments; full disks.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
moments=${3:-20}
. "$(dirname "$0")/lib.sh"
RANDOM=7

printf 'graphcut:\n  mu_m: 0.3\n' > "$config"
make_scan 1 "$scan" || exit 1
mk run || { cat "$output"; exit 1; }
digests "$work" > "$place/first"

# Every file under a final name must be a whole one: the old bytes or, for a stage in the middle of its outputs, the new ones, which
# are the same here.
whole_files() {
  local sum file
  while read -r sum file; do
    [ ! -e "$work/$file" ] || [ "$(sha256sum < "$work/$file")" = "$sum  -" ] || { echo "half: $file" >> "$output"; return 1; }
  done < "$place/first"
}

for stage in $ALL; do
  begin=$(date +%s%N)
  mk rerun-$stage
  length=$((($(date +%s%N) - begin) / 1000))
  bad=
  cp "$work/stamps/$stage" "$place/stamp"
  for moment in $(seq "$moments"); do
    rm -f "$work/stamps/$stage"
    # Half of the moments with the files gone, so that a half-written one would be seen.
    if [ $((moment % 2)) -eq 0 ]; then (cd "$work" && sed -n 's/^out [^ ]* [^ ]* //p' "$place/stamp" | while read -r f; do rm -f "$f"; done); fi
    setsid make -C "$SOURCE" "$stage" SCAN="$scan" WORK="$work" BUILD="$BUILD" CONFIG="$config" > "$output" 2>&1 &
    group=$!
    sleep "$(printf '0.%06d' $((RANDOM * 33 % length % 999999)))"
    kill -KILL -- "-$group" 2> /dev/null
    wait "$group" 2> /dev/null
    whole_files || { bad="$bad half-file@$moment"; }
  done
  [ -z "$bad" ] && ok "$stage killed $moments times: no half file under a final name" || not_ok "$stage killed: $bad" "$(tail -3 "$output")"
  mk run || bad="$bad resume"
  digests "$work" > "$place/now"
  if cmp -s "$place/first" "$place/now" && no_left_overs; then ok "… the next make resumes and ends as before"; else not_ok "… the next make resumes" "$(tail -5 "$output"; find "$work" -name '.*.tmp'; diff "$place/first" "$place/now")"; fi
done

# A full disk. ulimit -f makes every write beyond the limit fail, as ENOSPC does, for root too.
for limit in 1 4 16 64; do
  rm -rf "$work"
  (ulimit -f $limit; mk run) && status=0 || status=$?
  if [ $status -ne 0 ]; then
    grep -q 'error\[O01\]' "$output" && grep -q 'Error 5' "$output" && ok "a disk full after $limit KiB a file is an error O01, exit 5" ||
      not_ok "a disk full after $limit KiB a file" "$(tail -5 "$output")"
  else
    echo "        $limit KiB a file are enough"
  fi
  whole_files && no_left_overs && ok "… and leaves no half file" || not_ok "… and leaves no half file" "$(find "$work" -name '.*')"
done
mk run
digests "$work" > "$place/now"
check "with room again the run ends as ever" cmp "$place/first" "$place/now"

if [ "$(id -u)" -eq 0 ] && mkdir "$place/tiny" && mount -t tmpfs -o size=300k none "$place/tiny" 2> /dev/null; then
  work_before=$work
  work=$place/tiny/work
  mk run && not_ok "a full file system stops the run" || ok "a full file system stops the run"
  grep -q 'No space left\|error\[O01\]' "$output" && ok "… saying so" || not_ok "… saying so" "$(tail -5 "$output")"
  work=$work_before
  umount "$place/tiny"
else
  echo "skipped: no small file system can be mounted here"
fi
finish
