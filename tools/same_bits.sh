#!/usr/bin/env bash
# Checks that the answers are the same bytes whatever the compiler and the number of threads: tools/same_bits.sh
#
# Builds crude_register in build-bits/ with g++ (Release, and Debug from the headers alone) and clang++-14. Each program
# simulates scans, and registers those of the first, a mesh, points, and real scans if CRUDE_REGISTRATION_DATA is their
# folder: with one thread, and with eight. Prints a table, and exits with 1 where a byte differs; the files are in
# build-bits/answers/. Takes some minutes, most of them for building.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 0 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0"; exit 1; }
build=${CRUDE_REGISTRATION_BUILD:-$PWD/build-bits}
answers=$build/answers
launcher=$(command -v ccache || true)

build_program() { # NAME COMPILER BUILD_TYPE [OPTION...]
  cmake -S . -B "$build/$1" -G Ninja -DCMAKE_CXX_COMPILER="$2" -DCMAKE_BUILD_TYPE="$3" \
    ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON} \
    -DCRUDE_REGISTRATION_WITH_TESTS=OFF -DCRUDE_REGISTRATION_WITH_BENCHMARKS=OFF -DCRUDE_REGISTRATION_WITH_DOC=OFF \
    "${@:4}"
  ninja -C "$build/$1" crude_register
}
build_program release g++ Release
build_program debug g++ Debug -DCRUDE_REGISTRATION_WITH_COMPILED=OFF # from the headers alone
build_program clang clang++-14 Release
run() { "$build/$1/bin/crude_register" "${@:2}"; } # NAME ARGUMENT...

differences=0
begin_row() { printf '%-70s %-15s' "$1" "$2"; }
compare() { # FILE FILE: the next cell of the table
  if cmp -s "$1" "$2"; then printf ' %-10s' same
  else differences=$((differences + 1)) && printf ' %-10s' DIFFERENT; fi
}
printf '\n%-60s %-15s %-10s %-10s %-10s\n' "with g++, one thread:" "" threads debug clang++

rm -rf "$answers"
simulate() { # FOLDER OPTION...
  local name file
  for name in release debug clang; do
    run $name simulate --resolution 48 --output "$answers/$name/$1" "${@:2}" > "$answers.log"
  done
  for file in "$answers/release/$1"/*; do
    begin_row "simulate $1/${file##*/}" "" && printf ' %-10s' ""
    for name in debug clang; do compare "$file" "$answers/$name/$1/${file##*/}"; done
    echo
  done
}
simulate parallel --samples 150 --scans 3
simulate perspective --samples 120 --perspective --seed 1
simulate noisy --samples 150 --noise 1 --angle 30 --seed 2

register() { # SOURCE TARGET
  local names=(one_thread threads debug clang) programs=(release release debug clang) threads=(1 8 8 8) i code pair
  pair=$(basename "$(dirname "$1")")-$(basename "$1")-$(basename "$2")
  for i in 0 1 2 3; do
    code=0
    run "${programs[i]}" register "$1" "$2" --json --threads "${threads[i]}" > "$answers/$pair.${names[i]}" || code=$?
    [ $code -ne 1 ] || exit 1 # 2 and 3 are answers
  done
  begin_row "register $pair" "$(sed -n 's/^  "status": "\(.*\)",/\1/p' "$answers/$pair.one_thread")"
  for i in 1 2 3; do compare "$answers/$pair.one_thread" "$answers/$pair.${names[i]}"; done
  echo
}
scans=$answers/release
register "$scans"/parallel/scan_{0,1}.ply
register "$scans"/parallel/scan_{1,2}.ply
register "$scans"/perspective/scan_{0,1}.ply
register "$scans"/noisy/scan_{0,1}.ply
register "$scans"/parallel/scan_0.ply "$scans"/perspective/scan_0.ply
run release register "$scans"/parallel/scan_{0,1}.ply --output "$scans/mesh" > "$answers.log"
register "$scans"/mesh/{source_moved,target}.ply
for i in 0 1; do # points without faces
  awk 'found && NF == 3 { print } /^end_header/ { found = 1 }' "$scans/noisy/scan_$i.ply" > "$scans/noisy/points_$i.xyz"
done
register "$scans"/noisy/points_{0,1}.xyz
if [ -n "${CRUDE_REGISTRATION_DATA:-}" ]; then
  for target in 045 090 180; do register "$CRUDE_REGISTRATION_DATA"/bunny/bun{000,$target}.ply; done
  for target in 24 72 120; do register "$CRUDE_REGISTRATION_DATA"/dragon_stand/dragonStandRight_{0,$target}.ply; done
else
  echo "no real scans: CRUDE_REGISTRATION_DATA is not set"
fi
[ $differences -eq 0 ] || { echo "$differences differences"; exit 1; }
echo "no difference"
