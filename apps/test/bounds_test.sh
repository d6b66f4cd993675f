#!/bin/sh
# bounds_test.sh SPF OUTPUT_FOLDER: a scenario of 2000 equal robots (68 KB), each in the way of all others, is refused within
# 1 s of computing time and 100 MB of address space.
mkdir -p "$2" || exit 1
{
  printf 'family: explicit\nrobots:\n'
  yes '  - {start: [0, 0], goal: [2, 0]}' | head -n 2000
} >"$2/equal_robots.yaml"
(ulimit -t 1 && ulimit -v 102400 && exec "$1" check "$2/equal_robots.yaml") 2>"$2/refused.txt"
status=$?
tail -n 1 "$2/refused.txt"
[ $status -eq 2 ] || { echo "ended with $status instead of 2" && exit 1; }
[ "$(tail -n 1 "$2/refused.txt")" = '(and 3898 more)' ]
