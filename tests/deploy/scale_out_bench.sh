#!/usr/bin/env bash
# What further servers bring: blocks of NC text a second through one, two and three servers, by each
# way to reach them, and what a block costs the servers and the balancer. Writes Markdown.
#
#   scale_out_bench.sh [SHARE [SECONDS]]
#
# SHARE is the part of a core each server may use, in per cent (10): so few that this machine has
# enough for three servers, their balancer and the clients, and more servers can bring more. 0: as
# much as there is; then the cores of this machine are the limit from the first server on.
if [ -z "${TRC_SCALE_OUT_INSIDE:-}" ]; then
  TRC_SCALE_OUT_INSIDE=yes exec unshare --net --mount --pid --fork --kill-child --mount-proc "$0" "$@"
fi
. "$(dirname "$(readlink -f "$0")")/lib.sh"
share=${1:-10}
seconds=${2:-10}
streams=6
ip link set lo up
mount -t tmpfs tmpfs /run
mkdir /run/trcd
export PATH=$bin:$PATH
groups=/sys/fs/cgroup/cpu/trc_scale_out_$$
[ "$share" = 0 ] || mkdir "$groups"
at_exit "rmdir $groups/* $groups"

blocks=5000
trc generate --shape gear --blocks "$blocks" >"$work/part.nc"
trc compensate "$work/part.nc" -o "$work/expected.nc"

pids=()
start() { # servers way
  local number
  pids=()
  for number in $(seq "$1"); do
    trcd --listen "127.0.0.1:$((50050 + number))" --resume-key-file /run/trcd/key >/dev/null &
    pids+=($!)
    [ "$share" = 0 ] || {
      mkdir "$groups/$number"
      echo 20000 >"$groups/$number/cpu.cfs_period_us"
      echo $((share * 200)) >"$groups/$number/cpu.cfs_quota_us"
      echo $! >"$groups/$number/cgroup.procs"
    }
  done
  balancer=
  case $2 in
    in_turn) address=$(seq -s, -f '127.0.0.1:5005%.0f' "$1") ;;
    *)
      address=127.0.0.1:50050
      awk -v most="$1" '$1 != "server" || ++seen <= most' "deploy/haproxy/$2.cfg" >"$work/$2.cfg"
      haproxy -db -f deploy/haproxy/defaults.cfg -f "$work/$2.cfg" 2>/dev/null &
      balancer=$! ;;
  esac
  wait_until 20 trc health --server "$address" || fail "$2: nobody serves"
  sleep 1
}
stop() {
  kill -9 "${pids[@]}" $balancer
  wait "${pids[@]}" $balancer 2>/dev/null || true
  [ "$share" = 0 ] || rmdir "$groups"/*
}

# CPU time of processes so far, in ms.
used() {
  local pid sum=0 ticks
  for pid in "$@"; do
    ticks=$(awk '{sub(/.*\) /, ""); print $12 + $13}' "/proc/$pid/stat")
    sum=$((sum + ticks * 10))
  done
  echo "$sum"
}

client() {
  while [ ! -e "$work/enough" ]; do
    trc compensate "$work/part.nc" --server "$address" -o "$work/out-$1.nc"
    cmp -s "$work/expected.nc" "$work/out-$1.nc" && echo done >>"$work/done" || echo wrong >>"$work/done"
  done
}

measure() { # servers way
  local number clients=() before servers_ms balancer_ms programs
  start "$@"
  rm -f "$work/enough"
  : >"$work/done"
  for number in $(seq $streams); do
    client "$number" &
    clients+=($!)
  done
  sleep 2
  before=$(wc -l <"$work/done")
  servers_ms=$(used "${pids[@]}") balancer_ms=$(used $balancer)
  sleep "$seconds"
  programs=$(($(wc -l <"$work/done") - before))
  servers_ms=$(($(used "${pids[@]}") - servers_ms)) balancer_ms=$(($(used $balancer) - balancer_ms))
  touch "$work/enough"
  wait "${clients[@]}"
  ! grep -q wrong "$work/done" || fail "$2: a path was another one"
  awk -v way="$2" -v n="$1" -v blocks=$((programs * blocks)) -v s="$seconds" -v t="$servers_ms" \
    -v b="$balancer_ms" 'BEGIN {
      if (blocks == 0) exit 1
      printf "| %s | %d | %.0f | %.2f | %.2f |\n", way, n, blocks / s, t * 1e3 / blocks, b * 1e3 / blocks }'
  stop
}

echo "| way | servers | blocks/s | servers, us CPU a block | balancer, us CPU a block |"
echo "|---|---|---|---|---|"
for way in in_turn h2 tcp; do
  for servers in 1 2 3; do measure "$servers" "$way"; done
done
