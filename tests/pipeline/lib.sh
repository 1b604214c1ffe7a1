# SPDX-License-Identifier: GPL-3.0-or-later
# Helpers of the pipeline tests; sourced. Needs SOURCE and BUILD (absolute), sets up a folder with an awkward name and a small scan.
set -u
unset MAKEFLAGS MFLAGS MAKELEVEL SCAN WORK CONFIG JOBS UP UNIT STATIONS TRUTH QUIET

ALL=$(sed -n 's/^\([a-z][a-z_]*\) .*/\1/p' "$SOURCE/stages/pipeline.table" | tr '\n' ' ')
ALL=${ALL% }

# maker_of FILE: the run that writes it; pictures are the report's.
maker_of() {
  case $1 in pictures/*) echo report && return ;; esac
  "$BUILD/bin/artefact" rules | awk -F, -v file="$1" '{ n = split($4, files, " "); for (i = 1; i <= n; ++i) if (files[i] == file) print $2 }'
}
passed=0
failed=0
place=$(mktemp -d "${TMPDIR:-/tmp}/roomcut büro XXXXXX") || exit 1
trap 'rm -rf "$place"' EXIT
scan="$place/räume 1.ply"
work="$place/w o r k"
config="$place/my pipeline.yaml"
output="$place/output"

ok() { passed=$((passed + 1)); echo "ok      $1"; }
not_ok() {
  failed=$((failed + 1))
  echo "NOT OK  $1"
  [ -z "${2:-}" ] || printf '%s\n' "$2" | sed 's/^/        /'
}
check() { # check NAME COMMAND …
  local name=$1
  shift
  if "$@"; then ok "$name"; else not_ok "$name" "$(tail -5 "$output")"; fi
}
finish() {
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ]
}

make_scan() { # make_scan SEED FILE
  sed "s/\"seed\": *[0-9]*/\"seed\": $1/" "$SOURCE/tests/data/scenes/one_room.json" > "$place/scene.json"
  "$BUILD/bin/synthesize" --scene "$place/scene.json" --scan-out "$2" --truth-out "$place/truth.off" \
    --truth-json "$place/truth.json" -q
}

mk() { # mk ARGUMENT …: make on the work folder; what it prints goes to $output
  make -C "$SOURCE" ${jobs:-} "$@" SCAN="$scan" WORK="$work" BUILD="$BUILD" CONFIG="$config" > "$output" 2>&1
}

# A stage that runs leaves a new stamp, a file of its own. Times say nothing: some tests set them.
stamp_state() { stat -c '%n %i %y' "$work/stamps/"* 2> /dev/null | sed "s|^$work/stamps/||"; }
mark() { stamp_state > "$place/marked"; }
ran() { # names of the stages that ran since mark, in the order of the pipeline, on one line
  local name text= now
  now=$(stamp_state)
  for name in $ALL; do
    if [ -f "$work/stamps/$name" ] && ! grep -qxF "$(grep "^$name " <<< "$now")" "$place/marked"; then text="$text $name"; fi
  done
  echo "${text# }"
}
since() { # since STAGE: it and all that follow
  echo "$ALL" | tr -s ' ' '\n' | sed -n "/^$1\$/,\$p" | tr '\n' ' ' | sed 's/ $//'
}
ran_exactly() {
  local got
  got=$(ran)
  [ "$got" = "$1" ] && return
  echo "ran: '$got', wanted: '$1'" >> "$output"
  return 1
}
starts_with() { # ran first word … and nothing that is not in the list
  local got first
  got=$(ran)
  first=${got%% *}
  [ "$first" = "$1" ] && return
  echo "ran: '$got', wanted first: '$1'" >> "$output"
  return 1
}
digests() { # of all results, for comparing two runs; logs, stamps and params hold times
  (cd "$1" && find . -type f \( -name '*.h5' -o -name '*.geojson' -o -path './model.*' -o -name summary.json \) \
    -not -path './edits/*' -exec sha256sum {} + | sort -k 2
    # The page shows the times of the stages, in a line of their own.
    [ ! -f report.html ] || echo "$(sed '/id="block-logs"/d' report.html | sha256sum) report.html")
}
no_left_overs() { [ -z "$(find "$work" -name '.*.tmp' -o -name '*.new')" ]; }
