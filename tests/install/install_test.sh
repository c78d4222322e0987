#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs a build into a folder of its own, builds the examples against it with find_package, and runs them.
# install_test.sh CMAKE SOURCE BUILD COMPILER [SANITIZERS]
set -euo pipefail
cmake=$1 source=$2 build=$3 compiler=$4 sanitize=${5:-}

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
flags=""
if [ -n "$sanitize" ]; then flags="-fsanitize=$sanitize"; fi

"$cmake" --install "$build" --prefix "$folder/prefix" >/dev/null
"$folder/prefix/bin/unseen" --version
LD_DEBUG=files "$folder/prefix/bin/unseen" synth cuboids -o "$folder/frame" --quiet 2>"$folder/loaded.txt"
grep -q "calling init: $folder/prefix/.*/unseen_codecs.so" "$folder/loaded.txt"

"$cmake" -S "$source/examples" -B "$folder/examples" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_PREFIX_PATH="$folder/prefix"
"$cmake" --build "$folder/examples"
readelf -d "$folder/examples/01_planes" | grep -q "RUNPATH.*$folder/prefix/.*/unseen"

"$folder/examples/01_planes" | tee "$folder/planes.txt"
[ "$(grep -c normal "$folder/planes.txt")" -eq 3 ]
[ "$(grep -c 'at 90 degrees' "$folder/planes.txt")" -eq 3 ]

"$folder/prefix/bin/unseen" synth planes --scene floorplan --points 5000 -o "$folder/plan" --quiet
"$folder/examples/02_report" "$folder/plan/cloud.ply" "$folder/page.html"
grep -q '<html' "$folder/page.html"

"$folder/prefix/bin/unseen" synth interactions --seconds 12 --seed 5 -o "$folder/take" --quiet
"$folder/examples/03_interactions" "$folder/take/take.json" "$folder/scene.glb" | tee "$folder/interactions.txt"
grep -q 'person 0: 120 frames' "$folder/interactions.txt"
head -c 4 "$folder/scene.glb" | grep -q glTF
