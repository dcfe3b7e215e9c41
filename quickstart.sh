#!/usr/bin/env bash
# Registers two range scans: ./quickstart.sh [SOURCE TARGET [OPTION...]]
#
# Installs the Debian packages that are missing, builds the program crude_register, and registers SOURCE to TARGET, or,
# without arguments, two scans of one object that the scanner simulation makes. Options go to `crude_register register`.
set -euo pipefail
start=$PWD
cd "$(dirname "$0")"
root=$PWD
source tools/prepare.sh

case "${1:-}" in -h | --help) sed -n '2,5s/^# \{0,1\}//p' "$0"; exit 0 ;; esac
if [ $# -eq 1 ]; then echo "quickstart.sh: give two scans, or none" >&2; exit 1; fi

install_missing_packages
configure
build_targets crude_register

output=$root/build/quickstart
mkdir -p "$output"
if [ $# -ge 2 ]; then
  cd "$start"
  scans=("$1" "$2")
  shift 2
else
  say "Simulating two scans of one object"
  "$root"/build/bin/crude_register simulate --output "$output"
  scans=("$output"/scan_0.ply "$output"/scan_1.ply)
fi
say "Registering ${scans[0]} to ${scans[1]}"
exec "$root"/build/bin/crude_register register "${scans[@]}" --output "$output" "$@"
