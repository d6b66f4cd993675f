#!/bin/sh
# playground_test.sh SPF_PROGRAM BUILD_FOLDER: the engine under node beside the native program, and the page in headless Chromium.
# Requires script/playground, and script/setup test.
# SPF_NODE_MODULES names a node_modules folder, SPF_CHROMIUM a browser.
here=$(cd "$(dirname "$0")" && pwd)
modules=${SPF_NODE_MODULES:-$here/../../report/test/node_modules}
browser=${SPF_CHROMIUM:-$(command -v chromium || command -v chromium-browser || command -v google-chrome)}

node "$here/engine_test.mjs" "$2/spf_engine.js" "$2/spf_engine.wasm" "$1" "$2/test" || exit 1
exec node "$here/page_test.mjs" "$modules" "$browser" "$2"
