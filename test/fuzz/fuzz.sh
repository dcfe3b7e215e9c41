#!/usr/bin/env bash
# Fuzzes for a time: fuzz.sh PROGRAMS SEEDS SECONDS [TARGET...]
#
# PROGRAMS is the folder of the programs fuzz_TARGET, SEEDS that of what fuzz_seeds wrote, SECONDS the time of each
# target. What is found is written to PROGRAMS/findings/TARGET-..., what is learnt to PROGRAMS/corpus/TARGET, from where
# the next run goes on. A finding is run again by PROGRAMS/fuzz_TARGET FILE.
set -euo pipefail
programs=$1 seeds=$2 seconds=$3
shift 3
[ $# -gt 0 ] || set -- read_range_image read_scan register_meshes
export UBSAN_OPTIONS=print_stacktrace=1
mkdir -p "$programs/findings"
for target in "$@"; do
  mkdir -p "$programs/corpus/$target"
  case $target in register_meshes) longest=2000 slowest=30 ;; *) longest=4000 slowest=5 ;; esac
  echo "fuzz_$target for $seconds seconds"
  "$programs/fuzz_$target" -max_total_time="$seconds" -max_len=$longest -timeout=$slowest -rss_limit_mb=2048 \
    -print_final_stats=1 -verbosity=0 -seed=1 -artifact_prefix="$programs/findings/$target-" \
    "$programs/corpus/$target" "$seeds/$target"
done
