#!/usr/bin/env bash
# Compiles and runs the tests against the CGAL of Debian 13 (6.0): tools/cgal_6.sh [CTEST OPTION...]
#
# On Debian: the package is fetched from the mirror that apt uses, checked by apt, and unpacked in build-cgal6/; nothing
# is installed. Builds there what the options name (`-R REGEX`), else all tests. Another suite: SUITE=sid.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in -h | --help) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
suite=${SUITE:-trixie}
build=${CRUDE_REGISTRATION_BUILD:-$PWD/build-cgal6}
apt=$build/apt-$suite
unpacked=$build/cgal-$suite

if [ ! -d "$unpacked" ]; then
  mkdir -p "$apt/lists/partial" "$apt/archives/partial"
  mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | sed 1q)
  echo "deb $mirror $suite main" > "$apt/sources.list"
  options=(-o Dir::Etc::SourceList="$apt/sources.list" -o Dir::Etc::SourceParts=/dev/null -o Dir::State::Lists="$apt/lists"
    -o Dir::Cache="$apt" -o APT::Sandbox::User=root)
  apt-get "${options[@]}" -q update
  (cd "$apt" && apt-get "${options[@]}" -q download libcgal-dev)
  dpkg-deb -x "$apt"/libcgal-dev_*.deb "$unpacked"
fi
config=$(find "$unpacked" -name CGALConfig.cmake)
grep -h '#define CGAL_VERSION ' -r "$unpacked/usr/include/CGAL/version.h"

launcher=$(command -v ccache || true)
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCGAL_DIR="$(dirname "$config")" \
  ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON} \
  -DCRUDE_REGISTRATION_TESTS_TOGETHER=OFF -DCRUDE_REGISTRATION_WITH_BENCHMARKS=OFF \
  -DCRUDE_REGISTRATION_WITH_APPS=OFF -DCRUDE_REGISTRATION_WITH_EXAMPLES=OFF \
  -DCRUDE_REGISTRATION_WITH_PYTHON=OFF
. tools/test_programs.sh
cd "$build"
build_test_programs "$@"
run_test_programs --output-on-failure "$@"
