#!/usr/bin/env bash
# Runs tests with all assertions, CGAL's expensive ones and the standard library's: tools/assertions.sh [CTEST OPTION...]
#
# Builds in build-assertions/ what the options name (`-R REGEX`), else all tests but those that triangulate many points:
# there CGAL checks the whole triangulation again for each point, which takes hours, as it does the whole mesh for each
# edge that it collapses. So no real scans are used, either.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in -h | --help) sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
build=${CRUDE_REGISTRATION_BUILD:-build-assertions}
launcher=$(command -v ccache || true)
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=None \
  -DCMAKE_CXX_FLAGS="-O2 -D_GLIBCXX_ASSERTIONS -DCGAL_CHECK_EXACTNESS -DCGAL_CHECK_EXPENSIVE" \
  ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON} \
  -DCRUDE_REGISTRATION_TEST_TIMEOUT=1500 -DCRUDE_REGISTRATION_DATA= \
  -DCRUDE_REGISTRATION_TESTS_TOGETHER=OFF -DCRUDE_REGISTRATION_WITH_BENCHMARKS=OFF \
  -DCRUDE_REGISTRATION_WITH_APPS=OFF -DCRUDE_REGISTRATION_WITH_EXAMPLES=OFF \
  -DCRUDE_REGISTRATION_WITH_PYTHON=OFF
. tools/test_programs.sh
[ $# -gt 0 ] || not_programs="$not_programs|^(degenerate_input|degenerate_shapes|properties|register_scans|triangulate_points)$"
cd "$build"
build_test_programs "$@"
run_test_programs --output-on-failure "$@"
