#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# usage: bundle.sh BUILD_FOLDER PAGE: installs the locked npm packages into BUILD_FOLDER (only when the lock changed) and bundles
# the page. Without node or npm's registry it says so and leaves no PAGE: all else of roomcut works without.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$1
page=$2

give_up() {
  rm -f "$page"
  echo "warning: report.html will be written without its page: $1"
  echo "hint: $2; then make build"
  exit 0
}

command -v node > /dev/null && command -v npm > /dev/null || give_up "node or npm is missing" "install Debian's nodejs and npm"
mkdir -p "$folder"
if ! cmp -s "$here/package-lock.json" "$folder/installed-lock.json" || [ ! -f "$folder/node_modules/esbuild/package.json" ]; then
  rm -f "$folder/installed-lock.json"
  cp "$here/package.json" "$here/package-lock.json" "$folder/"
  # No package's own scripts: none is needed, and none should run on the user's machine.
  (cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error > npm.log 2>&1) ||
    give_up "npm could not fetch the packages ($(grep -m 1 -i 'err' "$folder/npm.log" || tail -n 1 "$folder/npm.log"))" \
      "make npm's registry reachable (npm ping), see $folder/npm.log"
  cp "$here/package-lock.json" "$folder/installed-lock.json"
fi
node "$here/bundle.js" "$folder" "$page"
