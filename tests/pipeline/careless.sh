#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: careless.sh SOURCE BUILD: names, values and folders that nobody should give, and what must not come of them.
SOURCE=$(realpath "$1")
BUILD=$(realpath "$2")
. "$(dirname "$0")/lib.sh"

says() { # says NAME PATTERN: a line of the output matches
  if grep -Eq -- "$2" "$output"; then ok "$1"; else not_ok "$1" "$(cat "$output")"; fi
}
run_make() { make -C "$SOURCE" BUILD="$BUILD" "$@" > "$output" 2>&1; }
refused() { # refused NAME CODE EXIT COMMAND …: it ends with this code, a remedy and this exit code
  local name=$1 code=$2 exit=$3
  shift 3
  if "$@"; then not_ok "$name: refused"; return; fi
  if grep -q "^error\[$code\]" "$output" && grep -q '^hint: .' "$output" && grep -q "Error $exit\$" "$output"; then ok "$name: $code, exit $exit"; else
    not_ok "$name: $code, exit $exit" "$(cat "$output")"
  fi
}

printf 'graphcut:\n  mu_m: 0.3\n' > "$config"
make_scan 1 "$scan" || exit 1

# Nothing that is given reaches a shell or Make as anything but a value.
pwn=$place/pwn
for jobs_text in "1;>'$pwn';" "\$(shell touch '$pwn')1" '`touch '"$pwn"'`' 0 01 4097 99999 -1 1.5 'a b'; do
  refused "JOBS=$jobs_text" U01 2 run_make run SCAN="$scan" WORK="$work" JOBS="$jobs_text"
  JOBS=$jobs_text refused "… from the environment" U01 2 run_make run SCAN="$scan" WORK="$work"
done
check "… and nothing of it was run" test ! -e "$pwn" -a ! -e "$work"
for variable in WORK CONFIG UP UNIT STATIONS TRUTH QUIET; do
  run_make status SCAN="$scan" WORK="$work" "$variable=\$(shell touch '$pwn')x"
  (export "$variable=\$(shell touch '$pwn')x;touch '$pwn'" && run_make status SCAN="$scan")
done
check "… nor of any other variable" test ! -e "$pwn"
cp "$scan" "$place/cost\$5 \$(x).ply"
check "a dollar in a file name, on the command line" run_make ingest SCAN="$place/cost\$5 \$(x).ply" WORK="$place/dollar\$1"
check "… is one" test -s "$place/dollar\$1/10_ingest/cloud.h5"
check "… from the environment" env SCAN="$place/cost\$5 \$(x).ply" WORK="$place/dollar\$2" make -C "$SOURCE" BUILD="$BUILD" ingest
check "… too" test -s "$place/dollar\$2/10_ingest/cloud.h5"

# Names that give no folder; scans that are none. Nothing is left behind.
listing() { find "$SOURCE/work" -maxdepth 1 2> /dev/null | sort; ls -A "$SOURCE"; }
listing > "$place/before"
for name in ...ply ..ply .ply; do
  cp "$scan" "$place/$name"
  refused "a scan called $name" U01 2 run_make run SCAN="$place/$name"
done
mkdir "$place/folder.ply"
refused "SCAN=folder" C01 3 run_make run SCAN="$place/folder.ply"
says "… says what it is" 'is a folder'
refused "a missing scan" C01 3 run_make run SCAN="$place/nowhere.ply"
refused "an address" C01 3 run_make run SCAN=https://example.org/scan.ply
says "… says to download it" 'hint: download'
refused "a missing scan and a folder for it" C01 3 run_make run SCAN="$place/nowhere.ply" WORK="$work"
listing > "$place/after"
check "… nothing is left behind" cmp "$place/before" "$place/after"
check "… nor there" test ! -e "$work"

# Two first runs at once.
for try in 1 2 3; do
  rm -rf "$work"
  for twin in a b; do
    (make -C "$SOURCE" run SCAN="$scan" WORK="$work" BUILD="$BUILD" CONFIG="$config" > "$place/twin $twin" 2>&1; echo $? > "$place/exit $twin") &
  done
  wait
  if [ "$(cat "$place/exit a" "$place/exit b")" = "$(printf '0\n0')" ] && [ -s "$work/model.ply" ]; then ok "two first runs at once: both succeed ($try)"; else
    not_ok "two first runs at once ($try)" "$(tail -5 "$place/twin a" "$place/twin b")"
  fi
done
digests "$work" > "$place/first"

# What was refused is forgotten.
for bad in UNIT=parsec UP=w; do
  refused "$bad" U01 2 mk run "$bad"
  mark
  check "… and forgotten" mk run
  check "… nothing runs" ran_exactly ""
done
head -c 3000 /bin/ls > "$place/positions.txt"
if mk run STATIONS="$place/positions.txt"; then not_ok "STATIONS=program is refused"; else says "STATIONS=program is refused" '^error\[C0'; fi
says "… said to be forgotten" '^note: .* is forgotten'
mark
check "… and forgotten" mk run
check "… nothing runs" ran_exactly ""
digests "$work" > "$place/now"
check "… the result is the one of before" cmp "$place/first" "$place/now"
printf '2.5 2.0 1.6\n' > "$place/good.txt"
mk ingest STATIONS="$place/good.txt"
mk ingest STATIONS="$place/positions.txt" && not_ok "a refused file of positions"
mk ingest
check "the positions accepted before hold" test "$(cat "$work/inputs/stations.txt")" = "$(cat "$place/good.txt")"
mk run STATIONS=none
first_work=$work
work="$place/first with a bad file"
mk run STATIONS="$place/positions.txt" && not_ok "positions refused in the first run"
check "… are forgotten as well" run_make ingest WORK="$work"
mkdir -p "$place/killed" && work="$place/killed"
setsid make -C "$SOURCE" ingest SCAN="$scan" WORK="$work" BUILD="$BUILD" UP=y > "$output" 2>&1 &
for _ in $(seq 2000); do
  if [ -f "$work/inputs/scan.options" ]; then break; fi
  sleep 0.005
done
kill -KILL -- "-$!" 2> /dev/null
wait 2> /dev/null
mk ingest
check "what a killed run was told holds" test "$(head -1 "$work/inputs/scan.options")" = y
work=$first_work

# CONFIG= is remembered, named, taken back.
mine="$place/mine \$x.yaml"
printf 'graphcut:\n  mu_m: 0.31\n' > "$mine"
remembering() { run_make "$@" WORK="$work"; }
check "CONFIG=" remembering run CONFIG="$mine"
mark
check "… holds when it is not said again" remembering run
check "… nothing runs" ran_exactly ""
remembering status
says "… status names it" "config  .*/mine \\\$x\\.yaml "
printf 'graphcut:\n  mu_m: 0.32\n' > "$mine"
mark
remembering run
check "… a change in it counts" starts_with graphcut
refused "a missing CONFIG" U02 2 remembering run CONFIG="$place/none.yaml"
refused "CONFIG=folder" U02 2 remembering run CONFIG="$place/folder.ply"
says "… says what it is" 'is a folder'
printf 'graphcut:\n  mu_mm: 1\n' > "$place/wrong.yaml"
refused "a wrong CONFIG" U03 2 remembering run CONFIG="$place/wrong.yaml"
mark
check "… is forgotten" remembering run
check "… nothing runs" ran_exactly ""
rm "$mine"
mark
check "a CONFIG that is gone" remembering run
check "… goes on to hold" ran_exactly ""
says "… with a note" '^note: .* is gone; what it said holds'
mark
check "CONFIG=none" remembering run CONFIG=none
check "… goes back to pipeline.yaml" starts_with graphcut
remembering status
says "… which status names" "config  $SOURCE/pipeline.yaml\$"
digests "$work" > "$place/now"
check "… and its result" cmp "$place/first" "$place/now"

# Two scans of one name.
mkdir -p "$place/a" "$place/b"
cp "$scan" "$place/a/same name.ply"
make_scan 2 "$place/b/same name.ply"
same="$SOURCE/work/same name"
if [ -e "$same" ]; then echo "skipped: there is a work/same name already"; else
  check "a scan in the folder of its name" run_make ingest SCAN="$place/a/same name.ply"
  refused "another scan of that name" U01 2 run_make ingest SCAN="$place/b/same name.ply"
  refused "… also for clean" U01 2 run_make clean-ingest SCAN="$place/b/same name.ply"
  check "… the first is untouched" run_make verify SCAN="$place/a/same name.ply"
  check "… with WORK= it is meant" run_make ingest SCAN="$place/b/same name.ply" WORK="$same"
  says "… and said" '^note: .* was made from .*/a/same name.ply, now from .*/b/same name.ply'
  rm "$place/b/same name.ply"
  check "a scan that was moved" run_make ingest SCAN="$place/a/same name.ply"
  rm -rf "$same"
fi

# A folder from somebody else deletes and overwrites nothing.
rm -rf "$place/foreign" && cp -a "$work" "$place/foreign"
echo keep > "$place/precious.txt"
for stamp in "$place"/foreign/stamps/*; do echo "out 1 1 ../precious.txt" >> "$stamp"; echo "x 1 1 ../precious.txt" >> "$stamp"; cp "$stamp" "$stamp.before"; done
ln -sf "$place/precious.txt" "$place/foreign/stamps/.lock"
mkdir "$place/elsewhere" && echo keep > "$place/elsewhere/cells.h5"
rm -r "$place/foreign/50_partition" && ln -s "$place/elsewhere" "$place/foreign/50_partition"
for stage in $ALL; do run_make clean-$stage WORK="$place/foreign"; done
check "clean deletes nothing that a stamp makes up" test -s "$place/precious.txt"
check "… nor through a link" test -s "$place/elsewhere/cells.h5"
check "… but what the table names" test ! -e "$place/foreign/20_slice/slices.h5" -a ! -e "$place/foreign/model.ply"

# A folder that cannot be written: status and verify answer, everything else is O01.
archive="$place/archive"
cp -a "$work" "$archive"
cat > "$place/in_archive.sh" << 'S'
# Root may write anywhere but on a file system that is mounted to be read.
archive=$1 && shift
if [ "$(id -u)" -eq 0 ]; then mount --bind "$archive" "$archive" && mount -o remount,ro,bind "$archive"; else chmod -R a-w "$archive"; fi || exit 77
exec "$@"
S
in_archive() {
  local into="sh"
  if [ "$(id -u)" -eq 0 ]; then into="unshare -m sh"; fi
  $into "$place/in_archive.sh" "$archive" make -C "$SOURCE" BUILD="$BUILD" WORK="$archive" "$@" > "$output" 2>&1
}
if unshare -m true 2> /dev/null || [ "$(id -u)" -ne 0 ]; then
  find "$archive" -exec stat -c '%n %i %y %z' {} + | sort > "$place/before"
  check "status of an archive" in_archive status
  says "… answers" '^Everything is up to date'
  check "verify of an archive" in_archive verify
  says "… answers" '^ok  model.ply'
  refused "run in an archive" O01 5 in_archive run
  find "$archive" -exec stat -c '%n %i %y %z' {} + | sort > "$place/after"
  check "… and nothing there has changed" cmp "$place/before" "$place/after"
  [ "$(id -u)" -eq 0 ] || chmod -R u+w "$archive"
  refused "compare into an archive" O01 5 in_archive compare A="$work" B="$archive"
  [ "$(id -u)" -eq 0 ] || chmod -R u+w "$archive"
else
  echo "skipped: no file system can be mounted read-only here"
fi
echo > "$place/a file"
refused "WORK below a file" O01 5 run_make run SCAN="$scan" WORK="$place/a file/work"
says "… says why" 'Not a directory'
refused "verify of a folder that is not there" U01 2 run_make verify SCAN="$scan" WORK="$place/nowhere"
rm -rf "$work/params" && echo > "$work/params"
refused "params/ that is no folder" O01 5 mk run
finish
