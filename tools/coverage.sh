#!/usr/bin/env bash
# Prints how many lines of each header the tests run, and which they do not: tools/coverage.sh [CTEST OPTION...]
#
# Needs clang++-14 and llvm-14. Builds in build-coverage/ what the options name (`-R REGEX`), else all tests. The lines
# that no test runs are in build-coverage/uncovered.txt.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in -h | --help) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
build=${CRUDE_REGISTRATION_BUILD:-build-coverage}
launcher=$(command -v ccache || true)
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER=clang++-14 \
  -DCMAKE_CXX_FLAGS="-O1 -DNDEBUG -fprofile-instr-generate -fcoverage-mapping" \
  ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON} \
  -DCRUDE_REGISTRATION_TEST_TIMEOUT=1500 \
  -DCRUDE_REGISTRATION_TESTS_TOGETHER=OFF -DCRUDE_REGISTRATION_WITH_BENCHMARKS=OFF \
  -DCRUDE_REGISTRATION_WITH_APPS=OFF -DCRUDE_REGISTRATION_WITH_EXAMPLES=OFF \
  -DCRUDE_REGISTRATION_WITH_PYTHON=OFF
. tools/test_programs.sh
cd "$build"
build_test_programs "$@"
rm -rf profiles && mkdir profiles
export LLVM_PROFILE_FILE=$PWD/profiles/%p.profraw
run_test_programs "$@" || true
llvm-profdata-14 merge -sparse profiles/*.profraw -o all.profdata
objects=(test/"${programs[0]}")
for program in "${programs[@]:1}"; do objects+=(-object "test/$program"); done
llvm-cov-14 export -format=lcov -instr-profile=all.profdata "${objects[@]}" > all.lcov
# A line counts as run if any instance of a template runs it.
awk -F'[:,]' -v root="$root/include/" '
  /^SF:/ { is_ours = index($0, "SF:" root) == 1; file = substr($0, 4 + length(root)) }
  is_ours && /^DA:/ { key = file ":" $2; if (!(key in runs) || $3 > runs[key]) runs[key] = $3 }
  END {
    for (key in runs) {
      split(key, part, ":")
      ++lines[part[1]]; ++total
      if (runs[key] > 0) { ++covered[part[1]]; ++total_covered } else print part[1] ":" part[2] > "uncovered.unsorted"
    }
    for (f in lines) printf "%6.1f %% of %4d  %s\n", 100 * covered[f] / lines[f], lines[f], f
    printf "%6.1f %% of %4d  all\n", 100 * total_covered / total, total
  }' all.lcov | sort -n
touch uncovered.unsorted
sort -t: -k1,1 -k2,2n uncovered.unsorted > uncovered.txt && rm uncovered.unsorted
echo "The lines that no test runs: $build/uncovered.txt"
