# shellcheck shell=bash
# Sourced by tools/assertions.sh, cgal_6.sh, coverage.sh and sanitize.sh, in the root of the project: for tests that are run
# by a tool, in the folder of their build.

root=$PWD
# The checks of the sources, of the manual and of other projects have no program that a tool could look into.
not_programs='^(headers_alone|programs_compile|peers_compile|check_.*|manual_.*|consumers?_.*|layers|install_.*|python_.*|short_fuzzing)$'

build_test_programs() { # [CTEST OPTION...]; sets `programs`
  local name
  programs=()
  for name in $(ctest --show-only -E "$not_programs" "$@" | sed -n 's/^ *Test *#[0-9]*: //p'); do
    name=${name%_of_real_scans}
    [ ! -e "$root/test/Crude_registration/$name.cpp" ] || programs+=("test_$name")
  done
  [ ${#programs[@]} -gt 0 ] || { echo "no program of a test is meant by: $*" >&2; exit 1; }
  ninja "${programs[@]}"
}

run_test_programs() { # [CTEST OPTION...]
  ctest -E "$not_programs" "$@"
}
