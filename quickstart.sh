#!/usr/bin/env bash
# Registers two range scans: ./quickstart.sh [SOURCE TARGET [OPTION...]]
#
# Installs the Debian packages that are missing, builds the program crude_register, and registers SOURCE to TARGET, or,
# without arguments, two scans of one object that the scanner simulation makes. Options go to `crude_register register`.
# The aligned meshes are written to build/quickstart/. The exit code is that of the program.
set -euo pipefail
start=$PWD
cd "$(dirname "$0")"
root=$PWD
source tools/prepare.sh

case "${1:-}" in -h | --help) sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
if [ $# -eq 1 ]; then
  echo "quickstart.sh: give two scans, or none" >&2
  exit 1
fi

install_missing_packages
configure
build_targets crude_register

program=$root/build/bin/crude_register
output=$root/build/quickstart
if [ $# -eq 0 ]; then
  say "Simulating two scans of one object"
  "$program" simulate --output "$output"
  set -- "$output/scan_0.ply" "$output/scan_1.ply" --poses "$output/poses.txt"
fi
say "Registering $1 to $2"
cd "$start"
exec "$program" register "$@" --output "$output"
