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
  -DCRUDE_REGISTRATION_SANITIZE="$kind" -DCRUDE_REGISTRATION_TEST_TIMEOUT=1500 \
  -DCRUDE_REGISTRATION_TESTS_TOGETHER=OFF -DCRUDE_REGISTRATION_WITH_BENCHMARKS=OFF \
  -DCRUDE_REGISTRATION_WITH_APPS=OFF -DCRUDE_REGISTRATION_WITH_EXAMPLES=OFF \
  -DCRUDE_REGISTRATION_WITH_PYTHON=OFF
. tools/test_programs.sh
cd "$build"
build_test_programs "$@"
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS="suppressions=$root/tools/thread_sanitizer.supp"
run_test_programs --output-on-failure "$@"
