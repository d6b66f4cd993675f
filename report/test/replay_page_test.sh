#!/bin/sh
# replay_page_test.sh SAMPLE_PROGRAM OUTPUT_FOLDER: the replay page in headless Chromium.
# Exit 77 = skipped, something is missing (a failure when SPF_REQUIRE_TOOLS is 1).
# SPF_NODE_MODULES names a node_modules folder, SPF_CHROMIUM a browser.
here=$(cd "$(dirname "$0")" && pwd)
modules=${SPF_NODE_MODULES:-$here/node_modules}
browser=${SPF_CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome)}

missing() {
  echo "replay_page skipped: $1"
  [ "${SPF_REQUIRE_TOOLS:-0}" = 1 ] && exit 1
  exit 77
}
command -v node >/dev/null 2>&1 || missing "node is not installed (Debian: nodejs)"
[ -x "$browser" ] || missing "no Chromium (Debian: chromium; or set SPF_CHROMIUM)"
[ -d "$modules/playwright-core" ] || missing "no playwright-core in $modules (npm ci --prefix report/test)"

mkdir -p "$2" || exit 1
"$1" "$2/sample.html" || exit 1
exec node "$here/replay_page_test.mjs" "$modules" "$browser" "$2"
