#!/usr/bin/env bash
# Tests of the command line program: command_line.sh PROGRAM FOLDER JSON_AT, a folder of its own to work in and the
# program json_at, which reads JSON.
set -u
program=$1
folder=$2
json_at=$3
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder" || exit 1
failures=0

fail()
{
  echo "FAILED: $1"
  failures=$((failures + 1))
}

# expect CODE ARGUMENT...: runs the program; its output is left in out.txt and err.txt.
expect()
{
  local expected=$1 code=0
  shift
  "$program" "$@" > out.txt 2> err.txt || code=$?
  if [ "$code" -ne "$expected" ]; then
    fail "exit code $code instead of $expected: crude_register $*"
    cat out.txt err.txt
  fi
}

# rejects TEXT ARGUMENT...: exit code 1, nothing on the output, one line with TEXT as the error.
rejects()
{
  local text=$1
  shift
  expect 1 "$@"
  grep -qF -- "$text" err.txt || fail "'$text' is not in the error of crude_register $*: $(cat err.txt)"
  [ "$(wc -l < err.txt)" -eq 1 ] || fail "the error is not one line: crude_register $*"
  [ -s out.txt ] && fail "there is output beside the error: crude_register $*"
}

# says TEXT: the last output has it.
says()
{
  grep -qF -- "$1" out.txt || fail "'$1' is not in the output: $(cat out.txt)"
}

# holds POINTER VALUE: the last output is JSON, with this value at the place that the pointer names.
holds()
{
  local value
  value=$("$json_at" "$1" < out.txt) || fail "no JSON with $1: $(cat out.txt)"
  [ "$value" = "$2" ] || fail "$1 is $value instead of $2"
}

# Help.
for command in "" register judge assemble info convert simulate; do
  expect 0 $command --help
  says usage:
  head -n 1 out.txt | grep -q "^  crude_register [a-z]* " || fail "the help of '$command' does not begin with an example"
done

# What is made of the same texts: the man page and the completions.
expect 0 --man
for option in apply motion graph camera pedestal; do says "\\-\\-$option"; done
if command -v groff > /dev/null; then
  [ -z "$(groff -man -Tutf8 -ww -z out.txt 2>&1)" ] || fail "groff complains: $(groff -man -Tutf8 -ww -z out.txt 2>&1 | head -3)"
fi
expect 0 --bash-completion
cp out.txt completion.bash
completes() # EXPECTED WORD...
{
  local expected=$1 got
  shift
  got=$(bash -c '. ./completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _crude_register; echo "${COMPREPLY[*]}"' \
    bash crude_register "$@")
  [ "$got" = "$expected" ] || fail "bash completes '$*' to '$got', not to '$expected'"
}
completes "register" reg
completes "--apply" register a.ply --ap
completes "--time-budget --times" assemble --time
completes "--times" register --times
completes "pairs trihedra" register a.ply --method ""
completes "mm m" judge --source-unit m
completes "" info ""
expect 0 --zsh-completion
if command -v zsh > /dev/null; then
  zsh -n out.txt 2> err.txt || fail "zsh does not read its completion: $(cat err.txt)"
fi
expect 0 --version

# Wrong use.
rejects "no command"
rejects frobnicate frobnicate
rejects SOURCE register
rejects TARGET register a.ply
rejects "--bogus" register a.ply b.ply --bogus
rejects "a.ply: " register a.ply b.ply
rejects "--output" simulate
rejects "--scans" simulate --output scans --scans 0
rejects "resolution" simulate --output scans --resolution 3
rejects "noise" simulate --output scans --noise -1

# Simulation, and the registration of what it makes.
expect 0 simulate --output scans --samples 150 --scans 2
for file in scan_0.ply scan_1.ply poses.txt; do [ -s "scans/$file" ] || fail "$file is not written"; done
cp scans/scan_0.ply first.ply
expect 0 simulate --output scans --samples 150 --scans 2
cmp -s first.ply scans/scan_0.ply || fail "the same simulation gives another scan"

pair="scans/scan_0.ply scans/scan_1.ply"
expect 0 register $pair --output moved --poses scans/poses.txt
says "status:     registered"
awk '/^error:/ { found = 1; if ($2 > 1) exit 1 } END { exit !found }' out.txt ||
  fail "the rotation is wrong: $(grep error: out.txt)"
for file in source_moved.ply target.ply motion.txt; do [ -s "moved/$file" ] || fail "$file is not written"; done
awk 'NF != 4 { exit 1 } END { exit NR != 4 }' moved/motion.txt || fail "motion.txt is not a 4 x 4 matrix"

# The moved source lies where its target is: it does not move any more.
expect 0 register moved/source_moved.ply moved/target.ply --output again
awk '{ for (i = 1; i <= 4; ++i) { d = $i - (i == NR); if (d < -0.01 || d > 0.01) exit 1 } }' again/motion.txt ||
  fail "the aligned scans are moved again: $(cat again/motion.txt)"

expect 0 register $pair --json
cp out.txt all_threads.json
holds /source '"scans/scan_0.ply"'
holds /target '"scans/scan_1.ply"'
holds /status '"registered"'
holds /reason '""'
holds /written '[]'
for matrix in target_from_source:3:4 crude_target_from_source:3:4 covariance:6:6; do
  IFS=: read -r name rows columns <<< "$matrix"
  for ((row = 0; row < rows; ++row)); do
    "$json_at" "/$name/$row" < out.txt | awk -F, -v n="$columns" 'NF != n { exit 1 } END { exit NR != 1 }' ||
      fail "row $row of $name has not $columns numbers"
  done
done
# Two points of a pair, each with the one that it was matched with.
for point in 0/0 0/1 1/0 1/1; do
  "$json_at" "/correspondence/$point" < out.txt | awk -F, 'NF != 3 { exit 1 } END { exit NR != 1 }' ||
    fail "point $point of correspondence has not 3 numbers"
done
# The motion is the one that is written, to the last bit.
for row in 0 1 2; do
  json_row=$("$json_at" "/target_from_source/$row" < out.txt | tr -d '[]' | tr , ' ')
  awk -v row=$row -v numbers="$json_row" '
    NR == row + 1 { split(numbers, x, " "); for (i = 1; i <= 4; ++i) if (x[i] + 0 != $i + 0) exit 1 }
  ' moved/motion.txt || fail "the JSON has another motion than motion.txt"
done
holds /statistics/0/stage '"reduce"'
grep -q seconds out.txt && fail "there are times in the JSON"
expect 0 register $pair --json --threads 1
cmp -s out.txt all_threads.json || fail "the number of threads changes the answer"
expect 0 register $pair --json --times --poses scans/poses.txt --output timed
for pointer in /statistics/0/seconds /preparation_seconds /search_seconds /error/rms_displacement; do
  "$json_at" "$pointer" < out.txt | awk '!($1 >= 0) { exit 1 }' || fail "no number at $pointer"
done
"$json_at" /error/rotation_in_degrees < out.txt | awk '!($1 < 1) { exit 1 }' || fail "the error in the JSON is wrong"
holds /written/2 '"timed/motion.txt"'

expect 0 register $pair --method pairs --json
cmp -s out.txt all_threads.json || fail "pairs is not the default method"
expect 0 register $pair --f1 0 --f2 0.3 --json
cmp -s out.txt all_threads.json || fail "0 and 0.3 are not the defaults of --f1 and --f2"

# The method of the paper, on scans without lost samples: the simplification keeps what is at the border of a hole.
expect 0 simulate --output whole --samples 150 --drop-out 0 --grazing-drop-out 0
whole="whole/scan_0.ply whole/scan_1.ply"
expect 0 register $whole --method trihedra --json --poses whole/poses.txt
cp out.txt trihedra.json
holds /status '"registered"'
"$json_at" /error/rotation_in_degrees < out.txt | awk '!($1 < 1) { exit 1 }' ||
  fail "the rotation by trihedra is wrong: $("$json_at" /error < out.txt)"
holds /statistics/2/stage '"propose: trihedra"'
expect 0 register $whole --method trihedra --f2 0.3 --json --poses whole/poses.txt
cmp -s out.txt trihedra.json || fail "0.3 is not the default of --f2 with --method trihedra"
rejects "--method" register $pair --method magic
rejects "--f1" register $pair --method trihedra --f1 0.5 --f2 0.3
rejects "--f1" register $pair --f1 0.3

rejects "--f1" register $pair --f1 0.5 --f2 0.3
rejects "--f1" register $pair --f1 nan
rejects "--f1" register $pair --f1 x
rejects "--threads" register $pair --threads 0
rejects "--viewpoint" register $pair --viewpoint 1,2
rejects "--viewpoint" register $pair --viewpoint 1,2,3,4
for side in source target; do
  rejects "--$side-viewpoint" register $pair --$side-viewpoint 1,x,2
  rejects "--$side-viewpoint" register $pair --$side-viewpoint 1,2,3 --viewpoint 1,2,3
  rejects "--no-viewpoint" register $pair --$side-viewpoint 1,2,3 --no-viewpoint
done
rejects "--no-viewpoint" register $pair --viewpoint 1,2,3 --no-viewpoint
rejects "nowhere.txt" register $pair --poses nowhere.txt
echo "scan_0.ply 1 0 0 0 0 1 0 0 0 0 1" > short.txt
rejects "short.txt:1: " register $pair --poses short.txt
rejects "motion.txt" register $pair --output moved/motion.txt

# Two bodies: not registered, and nothing is written.
expect 0 simulate --output other --samples 150 --scans 1 --seed 5
expect 3 register scans/scan_0.ply other/scan_0.ply --output nothing
says "status:     not_registered"
says "reason:"
[ -e nothing ] && fail "something is written although the scans are not registered"

# Many scans: four of one body and one of another.
expect 0 simulate --output many --samples 150 --scans 4
cp other/scan_0.ply many/other.ply
many="many/scan_2.ply many/other.ply many/scan_0.ply many/scan_3.ply many/scan_1.ply"
expect 0 assemble $many --poses poses.txt --graph graph.dot --table table.txt --output model.ply
says "component 1"
says "other.ply, alone: "
[ "$(grep -c '^# component' poses.txt)" -eq 2 ] || fail "not two components: $(cat poses.txt)"
sed -n 2p poses.txt | grep -q '^scan_2.ply 1 0 0 0 0 1 0 0 0 0 1 0$' || fail "the first scan does not fix the frame"
[ "$(tail -n 1 poses.txt | cut -d ' ' -f 1)" = other.ply ] || fail "the foreign scan is not last: $(cat poses.txt)"
grep -q '"scan_0.ply" -- "scan_1.ply"\|"scan_1.ply" -- "scan_0.ply"' graph.dot || fail "no edge in $(cat graph.dot)"
grep -q '^overlap: ' table.txt || fail "no table of overlaps"
head -c 400 model.ply | grep -aq '^property int scan$' || fail "no numbers of scans in the model"
# The mesh of the model, by each method: a scan lies on it as in the model.
for surface in advancing-front scale-space poisson; do
  expect 0 assemble $many --mesh mesh.ply --surface $surface
  cp mesh.ply once.ply
  expect 0 register many/scan_2.ply mesh.ply --json
  holds /status '"registered"'
  "$json_at" /target_from_source < out.txt > motion.json
  tr -d '[] \n' < motion.json | awk -F, '{ exit !($1 > 0.999 && $6 > 0.999 && $11 > 0.999 && $4^2 + $8^2 + $12^2 < 0.01) }' ||
    fail "a scan does not lie on the mesh by $surface: $(cat motion.json)"
done
expect 0 assemble $many --mesh mesh.ply --surface poisson
cmp -s mesh.ply once.ply || fail "the mesh is not the same every time"
rejects "--surface takes" assemble $many --mesh mesh.ply --surface marching
expect 0 assemble $many --json --poses model.conf
cp out.txt several.json
[ "$(grep -c '^bmesh scan_' model.conf)" -eq 4 ] || fail "not four scans in model.conf"
holds /components 2
holds /scans/1/component 1
holds /scans/1/pose/0/0 1.0
expect 0 assemble $many --json --threads 1 --poses model.aln
cmp -s out.txt several.json || fail "the assembly depends on the number of threads"
[ "$(head -n 1 model.aln)" = 4 ] || fail "not four scans in model.aln"
expect 3 assemble many/scan_0.ply other/scan_0.ply
expect 3 assemble $many --time-budget 1e-9
# What is known beforehand: fixed poses come back as they were, a wrong hint is dropped and named.
grep -v '^# component 1\|^other.ply\|^scan_1.ply' poses.txt > known.txt
expect 0 assemble $many --known known.txt --fix --reference scan_1.ply --poses again.txt
grep '^scan_[023].ply' known.txt | sort > fixed.txt
grep '^scan_[023].ply' again.txt | sort | cmp -s - fixed.txt || fail "fixed poses are changed: $(cat fixed.txt again.txt)"
expect 0 assemble $many --reference scan_1.ply --poses again.txt
grep -q '^scan_1.ply 1 0 0 0 0 1 0 0 0 0 1 0$' again.txt || fail "the reference does not fix the frame"
sed 's/^scan_0.ply .*/scan_0.ply 1 0 0 0 0 -1 0 0 0 0 -1 0/' known.txt > wrong.txt
expect 0 assemble $many --known wrong.txt
says "its known pose was dropped: it contradicts the pairs"
[ "$(grep -c 'its known pose was dropped' out.txt)" -eq 1 ] || fail "not one known pose is dropped: $(cat out.txt)"
expect 0 assemble $many --known wrong.txt --json
grep -q '"lost_hint"' out.txt || fail "no dropped hint in the JSON"
rejects "--fix needs --known" assemble $many --fix
rejects "--reference names no scan: none.ply" assemble $many --reference none.ply
echo "scan_0.ply 1 0 0" > short_known.txt
rejects "short_known.txt" assemble $many --known short_known.txt
rejects "missing_known.txt" assemble $many --known missing_known.txt
rejects "no SCAN is given" assemble --poses poses.txt
rejects "missing.ply" assemble many/scan_0.ply missing.ply

# No time, not even to prepare the scans.
expect 3 register $pair --time-budget 1e-9 --output nothing
says "status:     not_registered"
says "reason:     interrupted: the preparation of scans/scan_"
[ -e nothing ] && fail "something is written although the scans are not registered"
expect 0 register $pair --time-budget 1000
rejects "--time-budget" register $pair --time-budget 0

# Less memory than is needed: an error like any other.
awk 'BEGIN { for (i = 0; i < 1000; ++i) for (j = 0; j < 600; ++j) print i, j, (i * j) % 7 }' > large.xyz
cat > limited.sh <<EOF
#!/bin/sh
ulimit -v 100000 && exec "$program" "\$@"
EOF
chmod +x limited.sh
unlimited=$program
program=./limited.sh
rejects "out of memory" register large.xyz large.xyz --output nothing --threads 1
[ -e nothing ] && fail "something is written although memory ran out"
program=$unlimited

# Points in two frames: the viewpoint of a side is in that side's frame, and only there.
for i in 0 1; do
  awk -v i=$i 'body && NF == 3 { if (i == 1) { print -$2 + 500, $1 - 300, $3 + 40 } else print } /^end_header/ { body = 1 }' \
    scans/scan_$i.ply > points_$i.xyz
  awk -v i=$i '/viewing_direction/ { x = -4000 * $3; y = -4000 * $4; z = -4000 * $5
      if (i == 1) print -y + 500 "," x - 300 "," z + 40; else print x "," y "," z; exit }' scans/scan_$i.ply > sensor_$i.txt
done
source_sensor=$(cat sensor_0.txt) target_sensor=$(cat sensor_1.txt)
expect 0 register points_0.xyz points_1.xyz --source-viewpoint "$source_sensor" --target-viewpoint "$target_sensor" --json
cp out.txt two_viewpoints.json
expect 0 register points_0.xyz points_1.xyz --source-viewpoint "$source_sensor" --target-viewpoint "$target_sensor" \
  --threads 1 --json
cmp -s out.txt two_viewpoints.json || fail "the number of threads changes the answer with two viewpoints"
expect 0 register points_0.xyz points_0.xyz --viewpoint "$source_sensor" --json
cp out.txt both.json
expect 0 register points_0.xyz points_0.xyz --source-viewpoint "$source_sensor" --target-viewpoint "$source_sensor" --json
cmp -s out.txt both.json || fail "--viewpoint is not the viewpoint of both sides"

# Far from the origin, as in a map's coordinates: the same answer.
for i in 0 1; do
  awk '{ printf "%.12f %.12f %.12f\n", $1 + 500000, $2 + 5000000, $3 + 100 }' points_$i.xyz > far_$i.xyz
done
far_source=$(awk -F, '{ printf "%.9f,%.9f,%.9f", $1 + 500000, $2 + 5000000, $3 + 100 }' sensor_0.txt)
far_target=$(awk -F, '{ printf "%.9f,%.9f,%.9f", $1 + 500000, $2 + 5000000, $3 + 100 }' sensor_1.txt)
expect 0 register points_0.xyz points_1.xyz --source-viewpoint "$source_sensor" --target-viewpoint "$target_sensor" \
  --output near
expect 0 register far_0.xyz far_1.xyz --source-viewpoint "$far_source" --target-viewpoint "$far_target" --output far
# What the motions do to the first point differs by less than a thousandth of a sampling distance.
first=$(head -1 points_0.xyz)
awk -v p="$first" 'BEGIN { split(p, x, " "); o[1] = 500000; o[2] = 5000000; o[3] = 100 }
  { near = FILENAME ~ /near/; y = $4; for (j = 1; j <= 3; ++j) y += $j * (x[j] + (near ? 0 : o[j]))
    if (near) a[FNR] = y; else b[FNR] = y - o[FNR] }
  END { for (i = 1; i <= 3; ++i) { d = a[i] - b[i]; if (d > 1e-3 || d < -1e-3) { print a[i], b[i]; exit 1 } } }' \
  near/motion.txt far/motion.txt || fail "scans far from the origin get another motion"

# The scan itself, moved: what else is in its file stays, and what is written lies on the target.
awk '{ print "n" NR, $0, NR % 256, "#" NR }' points_0.xyz > named_0.txt
sed -i '1i name x y z red remark' named_0.txt
apply="--source-viewpoint $source_sensor --target-viewpoint $target_sensor --apply"
expect 0 register named_0.txt points_1.xyz $apply moved_0.txt
says "written:    moved_0.txt"
diff <(cut -d ' ' -f 1,5- named_0.txt) <(cut -d ' ' -f 1,5- moved_0.txt) > /dev/null || fail "--apply changes other columns"
# near/motion.txt is the motion of the same scans.
awk 'FILENAME ~ /motion/ { for (j = 1; j <= 4; ++j) m[FNR, j] = $j; next }
  FILENAME ~ /named/ { for (j = 1; j <= 3; ++j) p[FNR, j] = $(j + 1); next }
  FNR > 1 { for (i = 1; i <= 3; ++i) { d = m[i, 4] - $(i + 1); for (j = 1; j <= 3; ++j) d += m[i, j] * p[FNR, j]
      if (d < -1e-9 || d > 1e-9) exit 1 } } END { exit FNR < 1000 }' near/motion.txt named_0.txt moved_0.txt ||
  fail "--apply does not move the points by the motion"
mkdir -p applied
expect 0 register named_0.txt points_1.xyz $apply applied --json
holds /written/0 '"applied/named_0.txt"'
cmp -s applied/named_0.txt moved_0.txt || fail "--apply writes another file into a folder"
expect 0 register $pair --json
cp out.txt answer.json
expect 0 judge $pair --motion answer.json --apply judged.ply
says "written:      judged.ply"
grep -q '^obj_info viewing_direction' judged.ply || fail "--apply loses the sensor"
[ "$(wc -l < judged.ply)" -eq "$(wc -l < scans/scan_0.ply)" ] || fail "--apply changes the number of lines"
expect 0 assemble $many --apply applied_many
[ "$(ls applied_many | tr '\n' ' ')" = "scan_0.ply scan_1.ply scan_2.ply scan_3.ply " ] ||
  fail "--apply of assemble has written $(ls applied_many)"
cmp -s applied_many/scan_2.ply many/scan_2.ply || fail "--apply changes the scan that fixes the frame"
expect 0 assemble applied_many/*.ply --poses poses.txt
awk '!/^#/ { for (i = 0; i < 3; ++i) for (j = 0; j < 4; ++j) { d = $(2 + 4 * i + j) - (i == j); if (d < -0.01 || d > 0.01) exit 1 } }' \
  poses.txt || fail "what --apply of assemble wrote does not lie together: $(cat poses.txt)"
expect 3 register scans/scan_0.ply other/scan_0.ply --apply nothing.ply
[ -e nothing.ply ] && fail "--apply writes although the scans are not registered"
printf 'LASF' > some.las
rejects "cannot be written moved" register some.las absent.ply --apply moved.las
rejects "in .ply" register scans/scan_0.ply absent.ply --apply moved.obj
rejects "does not write over" register scans/scan_0.ply absent.ply --apply ./scans/../scans/scan_0.ply
rejects "there is no folder nowhere" register scans/scan_0.ply absent.ply --apply nowhere/moved.ply
rejects "two scans of this name" assemble scans/scan_0.ply other/scan_0.ply --apply applied_two
[ -e applied_two ] && fail "--apply makes a folder before it is sure"

# Units: the same scans, one in another unit, are told from each other and registered.
awk '{ printf "%.9g %.9g %.9g\n", $1 / 1000, $2 / 1000, $3 / 1000 }' points_0.xyz > metres_0.xyz
metres_sensor=$(awk -F, '{ printf "%.9g,%.9g,%.9g", $1 / 1000, $2 / 1000, $3 / 1000 }' sensor_0.txt)
"$program" register metres_0.xyz points_1.xyz --source-viewpoint "$metres_sensor" --target-viewpoint "$target_sensor" \
  > out.txt && fail "scans in different units are registered"
says "hint:       the target is "
says "--target-unit mm --source-unit m"
expect 0 register metres_0.xyz points_1.xyz --source-viewpoint "$metres_sensor" --target-viewpoint "$target_sensor" \
  --target-unit mm --source-unit m --apply millimetres_0.xyz
awk 'NR == FNR { for (j = 1; j <= 3; ++j) a[FNR, j] = $j; n = FNR; next }
  FNR > 1 && FNR <= n { s = 0; t = 0; for (j = 1; j <= 3; ++j) { s += (a[FNR, j] - a[1, j]) ^ 2; t += ($j - p0[j]) ^ 2 }
    if (t < 1e6 * s * 0.9999 || t > 1e6 * s * 1.0001) exit 1 }
  FNR == 1 { for (j = 1; j <= 3; ++j) p0[j] = $j }' metres_0.xyz millimetres_0.xyz ||
  fail "--apply does not write the unit of the target"
# The same without a word of the units: the factor is found, and told; what is applied is scaled by it.
expect 0 register metres_0.xyz points_1.xyz --source-viewpoint "$metres_sensor" --target-viewpoint "$target_sensor" \
  --estimate-scale --apply estimated_0.xyz --output estimated --report estimated.html
grep -q "^scale:      \(1000\|999\.[5-9][0-9]*\|1000\.[0-4][0-9]*\), estimated: " out.txt || fail "no scale of 1000: $(cat out.txt)"
paste millimetres_0.xyz estimated_0.xyz | awk '{ for (j = 1; j <= 3; ++j) if (($j - $(j + 3)) ^ 2 > 4e-4) exit 1 }' ||
  fail "--apply does not write the estimated scale"
expect 0 register $pair --estimate-scale --json
holds /estimated_scale 1.0
expect 0 register $pair --json
grep -q estimated_scale out.txt && fail "a scale is told of that was not estimated"
rejects "--estimate-scale" register $pair --estimate-scale --source-unit m --target-unit mm
rejects "--source-unit" register $pair --source-unit yard --target-unit m
rejects "given together" register $pair --source-unit m
rejects "--camera" register a.png b.png --camera 1,2,3
rejects "camera.json: the file cannot be opened" register a.png b.png --camera camera.json
echo '{"intrinsic_matrix": [1, 2]}' > camera.json
rejects "not 9" register a.png b.png --camera camera.json
echo '{"intrinsic_matrix"' > camera.json
rejects "not a camera as Open3D writes it" register a.png b.png --camera camera.json,1000

# Two pieces of a plane: ambiguous.
awk 'BEGIN { for (i = 0; i < 40; ++i) for (j = 0; j < 30; ++j) print i, j, 0 }' > plane_0.xyz
awk 'BEGIN { for (i = 0; i < 30; ++i) for (j = 0; j < 40; ++j) print i, j, 0 }' > plane_1.xyz
expect 2 register plane_0.xyz plane_1.xyz
says "status:     ambiguous"

# Pictures: a PNG file, of a registered pair, of one that is not, and of an assembly; a bad name is told before the work.
is_png()
{
  [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "$1 is no PNG file"
}
expect 0 register $pair --picture pair.png
says "written:    pair.png"
is_png pair.png
cp pair.png first.png
expect 0 register $pair --picture pair.png --threads 1
cmp -s pair.png first.png || fail "the number of threads changes the picture"
expect 2 register plane_0.xyz plane_1.xyz --picture planes.png
is_png planes.png
expect 0 assemble $pair --picture model.png
is_png model.png
rejects "there is no folder nowhere" register absent.ply absent.ply --picture nowhere/pair.png
rejects "it is a folder" register absent.ply absent.ply --picture scans
for option in picture report poses output table graph; do
  rejects "there is no folder nowhere" assemble absent.ply absent.ply --$option nowhere/file
done

# Folders and patterns where scans are expected.
expect 0 assemble many/*.ply --json
grep -v '"file"' out.txt > by_name.json
expect 0 assemble many --json
grep -v '"file"' out.txt | cmp -s - by_name.json || fail "a folder does not stand for its scans"
expect 0 assemble './many/*.ply' --json
grep -v '"file"' out.txt | cmp -s - by_name.json || fail "a pattern does not stand for the files that it fits"
mkdir -p empty
rejects "there is no scan in the folder" assemble empty
rejects "nothing_*.ply: " assemble scans/scan_0.ply 'nothing_*.ply'
rejects "one scan is expected, but this stands for 2" register scans scans/scan_1.ply
expect 0 info 'scans/*_0.ply'

# Conversion: what is read back is the same.
for format in ply off obj stl pcd npy xyz txt asc csv; do
  expect 0 convert scans/scan_0.ply converted.$format
  says "written: converted.$format"
  expect 0 info converted.$format --viewpoint 0,0,9 --json
  cp out.txt converted.json
  case $format in
    ply) expected='"range image"' ;;
    off | obj | stl) expected='"mesh"' ;;
    *) expected='"points"' ;;
  esac
  case $format in pcd | npy) expected='"range image"' ;; esac
  holds /kind "$expected"
done
expect 0 convert converted.npy again.ply
diff <(awk 'body && NF == 3' body=1 scans/scan_0.ply | grep -v '[a-z]') <(awk 'body && NF == 3' body=1 again.ply | grep -v '[a-z]') > /dev/null ||
  fail "a range image that was converted twice has other samples"
expect 0 convert converted.csv again.xyz
cmp -s again.xyz converted.xyz || fail "points that were converted twice are others"
expect 0 convert plane_0.xyz plane.off --viewpoint 20,15,100
rejects "has to end in" convert scans/scan_0.ply converted.docx
rejects "there is no folder nowhere" convert scans/scan_0.ply nowhere/converted.ply
rejects "absent.ply" convert absent.ply converted.ply
rejects "OUTPUT" convert scans/scan_0.ply
# Colours stay with their points, another one for each: in what is written of a pair, of an assembly, by a conversion.
for i in 0 1; do
  awk -v first=$((i * 5000)) '/^property double z/ { print; print "property uchar red\nproperty uchar green\nproperty uchar blue"; next }
    !body { print; body = /^end_header/; next }
    NF == 3 { n = first + ++points; print $0, int(n / 256) % 256, n % 256, 9; next }
    { print }' scans/scan_$i.ply > coloured_$i.ply
  expect 0 convert coloured_$i.ply coloured_$i.pcd
  grep -q '^FIELDS x y z rgb$' coloured_$i.pcd || fail "a range image in PCD has no colours"
  expect 0 convert coloured_$i.pcd again.pcd
  cmp -s coloured_$i.pcd again.pcd || fail "colours that were converted twice are others"
done
# (A surface has some of its vertices twice, as it is a manifold.)
points_of() { awk 'body && $1 != "nan"; /^DATA/ { body = 1 }' "$1" | sort -u; }
colours_of() { points_of "$1" | awk '{ print $NF }' | sort -u; }
expect 0 register coloured_0.ply coloured_1.ply --output coloured
for file in coloured/target.ply coloured/source_moved.ply; do expect 0 convert $file ${file%.ply}.pcd; done
[ -z "$(comm -23 <(points_of coloured/target.pcd) <(points_of coloured_1.pcd))" ] ||
  fail "the points of a written target have not the colours of its file"
[ -z "$(comm -23 <(colours_of coloured/source_moved.pcd) <(colours_of coloured_0.pcd))" ] ||
  fail "the moved source has colours that its file has not"
[ "$(colours_of coloured/source_moved.pcd | wc -l)" -gt 3000 ] || fail "the moved source has lost its colours"
expect 0 convert coloured_0.ply coloured.off
head -c 4 coloured.off | grep -q COFF || fail "a mesh in OFF has no colours"
expect 0 convert coloured.off coloured_mesh.ply
expect 0 register coloured_mesh.ply coloured_1.ply --output coloured_mesh
expect 0 convert coloured_mesh/source_moved.ply moved.pcd
cmp -s <(colours_of moved.pcd) <(colours_of coloured/source_moved.pcd) || fail "a mesh has not kept its colours"
expect 0 assemble coloured_0.ply scans/scan_1.ply --output coloured_model.ply
expect 0 convert coloured_model.ply coloured_model.pcd
printf 'ply\nformat ascii 1.0\nelement vertex 1\n%s1 2 3 255 255 255\n' "$(printf 'property float %s\n' x y z
  printf 'property uchar %s\n' red green blue
  printf 'end_header\n ')" | sed 's/^ *//' > white.ply
expect 0 convert white.ply white.pcd
white=$(colours_of white.pcd)
cmp -s <(colours_of coloured_model.pcd | grep -vx -- "$white") <(colours_of coloured_0.pcd) ||
  fail "the points of a model have not the colours of their scans"
expect 0 assemble $pair --output plain_model.ply
grep -aq 'property uchar red' plain_model.ply && fail "points without colours were given some"

# Reports: one page that names no other file, the same bytes with any number of threads; a bad name is told before the work.
is_page()
{
  head -c 15 "$1" | grep -q "<!DOCTYPE html>" || fail "$1 is no page"
  tail -n 1 "$1" | grep -q "</html>" || fail "$1 ends early"
  grep -qE "(src|href)=\"?(https?|file|/)" "$1" && fail "$1 names another file"
  grep -qF "$2" "$1" || fail "'$2' is not in $1"
}
expect 0 register $pair --report pair.html
says "written:    pair.html"
is_page pair.html "<h2 id=\"verdict_headline\">Registered</h2>"
cp pair.html first.html
expect 0 register $pair --report pair.html --threads 1
cmp -s pair.html first.html || fail "the number of threads changes the report"
expect 2 register plane_0.xyz plane_1.xyz --report planes.html
is_page planes.html "<h2 id=\"verdict_headline\">Ambiguous</h2>"
expect 0 assemble $pair --report model.html
is_page model.html "<h2 id=\"verdict_headline\">All scans are connected</h2>"
# A time budget that ends before there is a scan: a page without motions.
expect 3 register $pair --report early.html --time-budget 1e-9
is_page early.html "<h2 id=\"verdict_headline\">Not registered</h2>"
# A name that would end what it stands in.
cp plane_0.xyz '<b>&"@TITLE@.xyz'
expect 2 register '<b>&"@TITLE@.xyz' plane_1.xyz --report named.html
is_page named.html "<title>&lt;b&gt;&amp;&quot;@TITLE@.xyz to plane_1.xyz</title>"
rejects "there is no folder nowhere" register absent.ply absent.ply --report nowhere/page.html
rejects "there is no folder nowhere" judge absent.ply absent.ply --motion absent.txt --report nowhere/page.html
expect 0 judge $pair --motion moved/motion.txt --report judged.html
is_page judged.html "<h2 id=\"verdict_headline\">The motion is right</h2>"

# Information.
expect 0 info scans/scan_0.ply
says "range image"
says "150 x 150"
expect 0 info scans/scan_0.ply --json
holds /scan '"scans/scan_0.ply"'
holds /kind '"range image"'
holds /columns 150
holds /rows 150
holds /sensor '"orthographic"'
expect 0 info moved/target.ply
says mesh
expect 0 info plane_0.xyz --viewpoint -20,15,100
says points
(echo nan nan nan nan nan nan; awk '{ print $0, 0, 0, (NR % 4 ? 1 : -1) }' plane_0.xyz) > plane_0_normals.xyz
expect 0 info plane_0_normals.xyz --viewpoint -20,15,100 --json
holds /missing 1
holds /samples 1200
holds /normals 1200
holds /normals_towards_sensor 900
expect 0 info plane_0_normals.xyz
says "missing:    1 more"
says "normals:    1200 in the file"
says "note:       Three columns behind"

# Files that do not parse, with the line where it has one; no surface; coordinates that are no numbers.
printf 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2\n' \
  > broken.ply
rejects "broken.ply:" info broken.ply
rejects "broken.ply:" register broken.ply scans/scan_0.ply
printf '0 0 0\n1 x 0\n0 1 0\n' > no_number.xyz
rejects "no_number.xyz:2: " info no_number.xyz
: > empty.xyz
rejects "empty.xyz" register scans/scan_0.ply empty.xyz
printf '0 0 0\n1 0 0\n2 0 0\n3 0 0\n' > line.xyz
rejects "line.xyz" info line.xyz
rejects "line.xyz" register line.xyz scans/scan_0.ply

[ "$failures" -eq 0 ] && echo "all passed"
exit $((failures > 0))
