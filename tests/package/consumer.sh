#!/bin/sh
# A project outside our tree that links glcast::reconstruct and glcast::pipeline out of an installed prefix.
# Usage: consumer.sh PREFIX SOURCE_FOLDER WORK_FOLDER CAPTURE
set -eu
cp -r "$2/tests/package/consumer" "$3" # outside: nothing of the source tree is found by chance
cmake -G Ninja -S "$3" -B "$3/build" -DCMAKE_PREFIX_PATH="$1" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF >"$3/log" 2>&1 || { cat "$3/log"; exit 1; }
grep -q "glcast_DIR:PATH=$1/" "$3/build/CMakeCache.txt" || { echo "another glcast was found"; exit 1; }
cmake --build "$3/build" >"$3/log" 2>&1 || { cat "$3/log"; exit 1; }
timeout 60 "$3/build/consumer"
timeout 60 "$3/build/levels" "$4" "$3/levels.glb"
