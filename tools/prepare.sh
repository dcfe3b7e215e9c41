# shellcheck shell=bash
# Sourced by quickstart.sh and run_tests.sh, in the root of the project: installs what is missing and configures build/.

say() { printf '\n== %s\n' "$*"; }

packages_in() { grep -v '^#' "$1" | tr '\n' ' '; }

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

install_missing_packages() { # [FILE]: of packages that are wanted, too, where there are such
  local wanted missing=() wished=()
  wanted=$(packages_in tools/debian_packages.txt)
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    say "No apt-get on this system: nothing is installed"
    cat <<TXT
Needed are a C++17 compiler, CMake (3.22 or later), CGAL (5.5.1 or later, with GMP and MPFR), Eigen (3.3 or later),
Boost (1.74 or later, with Program_options and the Unit Test Framework) and nlohmann-json (3.9 or later); Ninja, TBB and
OpenMesh are optional.
  Debian, Ubuntu: $wanted
  Fedora:         gcc-c++ cmake ninja-build CGAL-devel eigen3-devel boost-devel tbb-devel json-devel
  Arch:           gcc cmake ninja cgal eigen boost onetbb nlohmann-json
  macOS (brew):   cmake ninja cgal eigen boost tbb nlohmann-json
TXT
    command -v cmake >/dev/null || exit 1
    return
  fi
  for package in $wanted; do
    is_installed "$package" || missing+=("$package")
  done
  [ $# -eq 0 ] || for package in $(packages_in "$1"); do
    is_installed "$package" || wished+=("$package")
  done
  [ $((${#missing[@]} + ${#wished[@]})) -gt 0 ] || return 0

  local as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      [ ${#missing[@]} -gt 0 ] || { echo "Not installed, so that some checks are left out: ${wished[*]}"; return 0; }
      echo "This needs root, and there is no sudo. As root: apt-get install ${missing[*]}" >&2
      exit 1
    fi
    as_root=sudo
  fi
  $as_root apt-get update -q
  for package in ${wished[@]+"${wished[@]}"}; do
    if apt-cache show "$package" >/dev/null 2>&1; then missing+=("$package")
    else echo "There is no package $package here: the checks that need it are left out"; fi
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  say "Installing ${missing[*]}"
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}

configure() { # [OPTION...]
  say "Configuring build/"
  local options=()
  if [ ! -f build/CMakeCache.txt ]; then
    command -v ninja >/dev/null && options+=(-G Ninja)
    command -v ccache >/dev/null && options+=(-D CMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  local log
  log=$(cmake -S . -B build -D CMAKE_BUILD_TYPE=Release ${options[@]+"${options[@]}"} "$@" 2>&1) || { echo "$log" >&2; exit 1; }
}

processors() { getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1; }

build_targets() { # [TARGET...]
  say "Building ${*:-everything} in build/ on $(processors) processors"
  cmake --build build --parallel "$(processors)" ${1:+--target} "$@"
}
