#!/bin/sh
# recording_test.sh SPF OUTPUT_FOLDER SCENARIO: what `spf run --mcap` records, as MCAP's own reader finds it.
# Exit 77 = skipped, as read_recording.sh.
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$2" && mkdir -p "$2" || exit 1
"$1" run "$3" --quiet --mcap "$2/trial.mcap" >/dev/null || exit 1
sh "$here/read_recording.sh" "$2/trial.mcap" "$2/found.json" || exit
exec node "$here/recording_test.mjs" "$2/found.json"
