#!/usr/bin/env bash
# Tests of crude_register_mpi: mpi.sh PROGRAM MPI_PROGRAM MPIEXEC FOLDER, the program of one process, that of several,
# what starts several, and a folder of its own to work in.
set -u
program=$1
mpi_program=$2
mpiexec=$3
folder=$4
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder" || exit 1
failures=0

fail()
{
  echo "FAILED: $1"
  failures=$((failures + 1))
}

# More processes than processors, as root too, where Open MPI would refuse.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
# Without a network.
export OMPI_MCA_btl=self,vader OMPI_MCA_plm_rsh_agent=

# run N ARGUMENT...: crude_register_mpi by N processes.
run()
{
  local n=$1
  shift
  "$mpiexec" -n "$n" "$mpi_program" "$@"
}

"$program" simulate --output scans --samples 150 --scans 7 --angle 40 > /dev/null || fail "no scans"
"$program" simulate --output other --samples 150 --scans 1 --seed 5 > /dev/null || fail "no other scan"
scans="$(echo scans/scan_*.ply) other/scan_0.ply"

# The same bytes by any number of processes.
"$program" assemble $scans --poses one.txt --json > one.json || fail "one process"
for n in 1 2 4; do
  run $n assemble $scans --poses poses_$n.txt --json > out_$n.json 2> err_$n.txt || fail "$n processes: $(cat err_$n.txt)"
  cmp -s one.txt poses_$n.txt || fail "other poses by $n processes: $(diff one.txt poses_$n.txt)"
  cmp -s one.json out_$n.json || fail "other JSON by $n processes"
done

# Errors end all processes and are said once.
for n in 1 3; do
  run $n assemble $scans missing.ply > out.txt 2> err.txt && fail "a missing file is no error by $n processes"
  [ "$(grep -c 'crude_register_mpi: missing.ply' err.txt)" -eq 1 ] || fail "the missing file is not named: $(cat err.txt)"
  run $n assemble > out.txt 2> err.txt && fail "no scan is no error by $n processes"
  [ "$(grep -c 'no SCAN is given' err.txt)" -eq 1 ] || fail "it is not said that no scan is given: $(cat err.txt)"
  run $n register $scans > out.txt 2> err.txt && fail "another command is no error by $n processes"
done

# kept: the files of the store that are whole, each with what tells that it was written once: inode and time.
kept()
{
  find store -name '*.pair' -printf '%f %i %T@\n' -o -name '*.scan' -printf '%f %i %T@\n' | sort
}

# One process is killed once some pairs are done: the run ends with an error, and the next does none of them again.
"$mpiexec" -n 3 "$mpi_program" assemble $scans --poses killed.txt --store store > out.txt 2> err.txt &
mpi=$!
victim=
while kill -0 $mpi 2> /dev/null && [ -z "$victim" ]; do victim=$(pgrep -P $mpi -f "$(basename "$mpi_program")" | tail -n 1); done
shopt -s nullglob
pairs=()
while kill -0 $mpi 2> /dev/null && [ "${#pairs[@]}" -lt 3 ]; do pairs=(store/*.pair); done # no other program: it is soon over
kill -9 "$victim"
wait $mpi && fail "the run in which a process was killed ends without an error"
grep -qi 'killed\|signal 9' err.txt || fail "it is not said that a process was killed: $(cat err.txt)"
[ -e killed.txt ] && fail "poses are written by a run in which a process was killed"
kept > before.txt
done=$(grep -c '\.pair ' before.txt)
run 3 assemble $scans --poses again.txt --store store --json > again.json 2> err.txt || fail "again: $(cat err.txt)"
kept > after.txt
again=$(comm -23 before.txt after.txt | wc -l)
[ "$again" -eq 0 ] || fail "$again finished tasks are done again"
[ "$(grep -c '\.scan ' after.txt)" -eq 8 ] || fail "not eight prepared scans are kept: $(cat after.txt)"
edges=$(grep -c '"registration"' again.json)
[ "$(grep -c '\.pair ' after.txt)" -ge "$edges" ] || fail "not all $edges pairs are kept"
cmp -s one.txt again.txt || fail "other poses after a process was killed: $(diff one.txt again.txt)"
echo "$done of $edges pairs were done when a process was killed; $again were done again"

# One process and several share the store.
"$program" assemble $scans --poses shared.txt --store store > /dev/null || fail "one process with the store of several"
kept | cmp -s - after.txt || fail "the store of several processes is not that of one"
cmp -s one.txt shared.txt || fail "other poses with the store of several processes"

[ "$failures" -eq 0 ] && echo "all passed"
exit "$((failures > 0))"
