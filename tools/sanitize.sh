#!/usr/bin/env bash
# Runs the tests under a sanitizer: tools/sanitize.sh address|thread [CTEST OPTION...]
#
# address: AddressSanitizer and UndefinedBehaviorSanitizer, all tests. thread: ThreadSanitizer, the tests of what runs
# in parallel. Builds in build-address/ or build-thread/ what the options name (`-R REGEX`), else all tests.
set -euo pipefail
cd "$(dirname "$0")/.."
kind=${1:-}
case "$kind" in address | thread) shift ;; *) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit 1 ;; esac
[ "$kind" = address ] || [ $# -gt 0 ] || set -- -R '^(refine_motion|register_scans|match_trihedra)$'
build=${CRUDE_REGISTRATION_BUILD:-build-$kind}

compiler=$(command -v clang++-14 || command -v clang++ || command -v c++)
launcher=$(command -v ccache || true)
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON} \
  -DCRUDE_REGISTRATION_SANITIZE="$kind" -DCRUDE_REGISTRATION_WITH_BENCHMARKS=OFF -DCRUDE_REGISTRATION_WITH_EXAMPLES=OFF
root=$PWD
cd "$build"
# Only the programs of the tests that are asked for; the checks of the sources are not for a sanitizer.
excluded='^(headers_alone|check_format|manual_.*|consumer_.*|install_.*)$'
programs=()
for name in $(ctest --show-only -E "$excluded" "$@" | sed -n 's/^ *Test *#[0-9]*: //p'); do
  [ ! -e "$root/test/Crude_registration/$name.cpp" ] || programs+=("test_$name")
done
[ ${#programs[@]} -gt 0 ] || { echo "no program of a test is meant by: $*" >&2; exit 1; }
ninja "${programs[@]}"
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS="suppressions=$root/tools/thread_sanitizer.supp"
exec ctest --output-on-failure --timeout 1500 -E "$excluded" "$@"
