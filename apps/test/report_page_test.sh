#!/bin/sh
# report_page_test.sh SPF OUTPUT_FOLDER: a campaign's report in headless Chromium.
# Exit 77 = skipped, something is missing (a failure when SPF_REQUIRE_TOOLS is 1).
# SPF_NODE_MODULES names a node_modules folder, SPF_CHROMIUM a browser.
here=$(cd "$(dirname "$0")" && pwd)
modules=${SPF_NODE_MODULES:-$here/../../report/test/node_modules}
browser=${SPF_CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome)}

missing() {
  echo "report_page skipped: $1"
  [ "${SPF_REQUIRE_TOOLS:-0}" = 1 ] && exit 1
  exit 77
}
command -v node >/dev/null 2>&1 || missing "node is not installed (Debian: nodejs)"
[ -x "$browser" ] || missing "no Chromium (Debian: chromium; or set SPF_CHROMIUM)"
[ -d "$modules/playwright-core" ] || missing "no playwright-core in $modules (npm ci --prefix report/test)"

rm -rf "$2" && mkdir -p "$2" || exit 1
cd "$2" || exit 1
"$1" experiment table2 --trials 2 --first 10000 --level 0.25,1 --noise walk --quiet --out table2 >/dev/null || exit 1
"$1" experiment scenes --trials 1 --first 10000 --method space_time --set robots=4 --quiet --out scenes >/dev/null || exit 1
"$1" report table2 scenes --out report.html --replays 1 --quiet >/dev/null || exit 1
exec node "$here/report_page_test.mjs" "$modules" "$browser" "$2"
