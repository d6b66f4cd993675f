#!/bin/sh
# read_recording.sh RECORDING FOUND: reads an MCAP file by MCAP's own reader; what it found is in the file FOUND.
# Exit 77 = skipped, something is missing (a failure when SPF_REQUIRE_TOOLS is 1). SPF_NODE_MODULES names a node_modules folder.
here=$(cd "$(dirname "$0")" && pwd)
modules=${SPF_NODE_MODULES:-$here/node_modules}

missing() {
  echo "recording not read: $1"
  [ "${SPF_REQUIRE_TOOLS:-0}" = 1 ] && exit 1
  exit 77
}
command -v node >/dev/null 2>&1 || missing "node is not installed (Debian: nodejs)"
[ -d "$modules/@mcap/core" ] || missing "no @mcap/core in $modules (npm ci --prefix mcap/test)"
exec node "$here/read_recording.mjs" "$modules" "$1" >"$2"
