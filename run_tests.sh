#!/usr/bin/env bash
# Runs the tests: ./run_tests.sh [CTEST OPTION...]
#
# Installs the Debian packages that are missing, builds everything in build/ (Release), and runs ctest there with the
# given options, for example `-R simplify_scan`. Real scans are used where CMake finds them (CRUDE_REGISTRATION_DATA).
set -euo pipefail
cd "$(dirname "$0")"
source tools/prepare.sh

case "${1:-}" in -h | --help) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit 0 ;; esac

install_missing_packages tools/debian_packages_tests.txt
configure
build_targets
say "Testing"
cd build
exec ctest --output-on-failure --parallel "$(processors)" "$@"
