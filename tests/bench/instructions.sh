#!/usr/bin/env bash
# Counts the instructions a block takes in the hot loops, under callgrind, and compares them with
# those of the last time: unlike times they are the same on a busy machine. Counted are the timed
# parts of trc_bench alone, over some rounds of 1000 blocks, the first ones included.
#
#   instructions.sh            prints both; fails where there are more than 3 % more
#   instructions.sh --update   writes instructions.txt
#
# They depend on the compiler and on its target: the reference is that of Debian 12 on amd64.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
reference=tests/bench/instructions.txt
rounds=20
loops=(
  "core: blocks to blocks"
  "core: blocks through all passes"
  "nc: reading"
  "nc: reading, heidenhain"
  "nc: writing"
  "nc: text to text"
  "wire: read request columns"
  "wire: write response columns"
  "wire: served columns"
  "wire: served blocks"
)

count() {
  TRC_BENCH_ROUNDS=$rounds valgrind --tool=callgrind --collect-atstart=no \
    --callgrind-out-file=/dev/null build/bench/bin/trc_bench --benchmark_filter="^$1/" 2>&1 |
    awk -v blocks=$((rounds * 1000)) '/Collected *:/ { printf "%.1f", $NF / blocks; found = 1 }
      END { exit !found }'
}

was() {
  [ ! -f "$reference" ] || awk -F '\t' -v name="$1" '$1 == name { print $2 }' "$reference"
}

lines=()
more=0
for loop in "${loops[@]}"; do
  now=$(count "$loop") || { echo "error: \"$loop\" gave no count" >&2; exit 2; }
  before=$(was "$loop")
  lines+=("$loop"$'\t'"$now")
  printf '%-31s %8s instructions a block, was %s\n' "$loop" "$now" "${before:-unknown}"
  awk -v now="$now" -v before="${before:-$now}" 'BEGIN { exit !(now > 1.03 * before) }' && more=1
done

if [ "${1:-}" = --update ]; then
  printf '%s\n' "${lines[@]}" >"$reference"
  exit 0
fi
exit $more
