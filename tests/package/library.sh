#!/bin/sh
# The library as `cmake --install` puts it: public headers alone, and what is built against them.
# Usage: library.sh BUILD_FOLDER SOURCE_FOLDER
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$1" --prefix "$work/usr" --component development >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
ls "$work/usr/include/glcast" >"$work/headers"
diff "$2/tests/package/headers" "$work/headers" || { echo "other headers are installed than tests/package/headers says"; exit 1; }
if grep -rn '#include "' "$work/usr/include"; then echo "a header includes what is not installed"; exit 1; fi
timeout 100 "$1/tools/run/glcast-run" -n 32 -o "$work/a.exr" --headless --quit --timeout 90 -- "$1/fixtures/fixture-glx" --shape teapot
sh "$2/tests/package/consumer.sh" "$work/usr" "$2" "$work/consumer" "$work/a.exr"
