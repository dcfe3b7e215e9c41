#!/usr/bin/env bash
# Registers two range scans: ./quickstart.sh [--python] [SOURCE TARGET [OPTION...]]
#
# Installs the Debian packages that are missing, builds the program crude_register, and registers SOURCE to TARGET, or,
# without arguments, two scans of one object that the scanner simulation makes. Options go to `crude_register register`.
# The aligned meshes are written to build/quickstart/. The exit code is that of the program.
# With --python before them: builds the Python module, and registers the scans by the first of examples/python/.
set -euo pipefail
start=$PWD
cd "$(dirname "$0")"
root=$PWD
source tools/prepare.sh

case "${1:-}" in -h | --help) sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
python=no
if [ "${1:-}" = --python ]; then
  python=yes
  shift
fi
if [ $# -eq 1 ]; then
  echo "quickstart.sh: give two scans, or none" >&2
  exit 1
fi

if [ $python = yes ]; then
  install_missing_packages tools/debian_packages_python.txt
  configure -D CRUDE_REGISTRATION_WITH_PYTHON=ON
  build_targets crude_register crude_registration_python
else
  install_missing_packages
  configure
  build_targets crude_register
fi

program=$root/build/bin/crude_register
output=$root/build/quickstart
if [ $# -eq 0 ]; then
  say "Simulating two scans of one object"
  "$program" simulate --output "$output"
  set -- "$output/scan_0.ply" "$output/scan_1.ply" --poses "$output/poses.txt"
fi
say "Registering $1 to $2"
cd "$start"
if [ $python = yes ]; then
  say "In Python: export PYTHONPATH=$root/build/python, or pip install . (see README.md)"
  PYTHONPATH=$root/build/python exec "$(sed -n 's/^CRUDE_REGISTRATION_PYTHON:.*=//p' "$root/build/CMakeCache.txt")" \
    "$root/examples/python/1_register_files.py" "$1" "$2"
fi
exec "$program" register "$@" --output "$output"
