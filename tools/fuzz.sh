#!/usr/bin/env bash
# Fuzzes the readers and registration: tools/fuzz.sh SECONDS [TARGET...]
#
# Builds the targets of test/fuzz (clang++ with libFuzzer, AddressSanitizer, UndefinedBehaviorSanitizer) in build-fuzz/
# and runs each for SECONDS, or until it finds something. Findings are in build-fuzz/fuzz/findings/; the next run goes on
# from what this one has learnt. Two hours each: tools/fuzz.sh 7200
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in '' | *[!0-9]*) sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 1 ;; esac
build=${CRUDE_REGISTRATION_BUILD:-build-fuzz}
launcher=$(command -v ccache || true)
for_seconds=OFF
[ "$1" -ge 60 ] || for_seconds=ON
cmake -S . -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$(command -v clang++-14 || command -v clang++)" \
  ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER="$launcher"} -DCRUDE_REGISTRATION_WITH_FUZZERS=ON -DCRUDE_REGISTRATION_FUZZ_SECONDS=$for_seconds \
  -DCRUDE_REGISTRATION_WITH_TESTS=OFF -DCRUDE_REGISTRATION_WITH_BENCHMARKS=OFF -DCRUDE_REGISTRATION_WITH_APPS=OFF \
  -DCRUDE_REGISTRATION_WITH_EXAMPLES=OFF -DCRUDE_REGISTRATION_WITH_DOC=OFF
ninja -C "$build" fuzz_seeds fuzz_read_range_image fuzz_read_scan fuzz_register_meshes
"$build/fuzz/fuzz_seeds" "$build/fuzz/seeds"
exec test/fuzz/fuzz.sh "$build/fuzz" "$build/fuzz/seeds" "$@"
