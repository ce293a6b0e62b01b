#!/usr/bin/env bash
# What further servers bring: blocks a second through one, two and three servers, by each way to reach
# them, and what a block costs servers, balancer and clients. Writes Markdown.
#
#   scale_out_bench.sh [SHARE [SECONDS [LAYOUT]]]
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
layout=${3:-columns}
ip link set lo up
mount -t tmpfs tmpfs /run
mkdir /run/trcd
export PATH=$bin:$PATH
# One cgroup a server, of version 1 or 2.
groups=/sys/fs/cgroup/${work##*/}
[ ! -d /sys/fs/cgroup/cpu ] || groups=/sys/fs/cgroup/cpu/${work##*/}
at_exit "rmdir $groups.[0-9]"
at_exit 'kill -9 $(jobs -p); wait'
hold_to_share() { # number, process
  local group=$groups.$1 period=20000
  mkdir "$group"
  if [ -e "$group/cpu.max" ]; then
    echo "$((share * period / 100)) $period" >"$group/cpu.max"
  else
    echo $period >"$group/cpu.cfs_period_us"
    echo $((share * period / 100)) >"$group/cpu.cfs_quota_us"
  fi
  echo "$2" >"$group/cgroup.procs"
}

pids=()
start() { # servers way
  local number
  pids=()
  for number in $(seq "$1"); do
    trcd --listen "127.0.0.1:$((50050 + number))" --health-listen "127.0.0.1:$((50150 + number))" \
      --resume-key-file /run/trcd/key >/dev/null &
    pids+=($!)
    [ "$share" = 0 ] || hold_to_share "$number" $!
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
  [ "$share" = 0 ] || wait_until 5 rmdir "$groups".[0-9]
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

of_report() { sed -n "s/.*\"$1\":\([0-9.]*\).*/\1/p" "$work/report"; }

measure() { # servers way
  local servers_ms balancer_ms
  start "$@"
  servers_ms=$(used "${pids[@]}") balancer_ms=$(used $balancer)
  trc load --server "$address" --layout "$layout" --batch 1024 --blocks 20000 --shape gear \
    --streams 12 --connections 12 --verify 0.2 --duration "$seconds" --json >"$work/report"
  servers_ms=$(($(used "${pids[@]}") - servers_ms)) balancer_ms=$(($(used $balancer) - balancer_ms))
  stop
  grep -q '"errors":{}.*"differing":0,' "$work/report" || { cat "$work/report"; fail "$2: not all is well"; }
  awk -v way="$2" -v n="$1" -v blocks="$(of_report blocksIn)" -v s="$seconds" -v t="$servers_ms" \
    -v b="$balancer_ms" -v own="$(of_report ownNsPerBlock)" 'BEGIN {
      printf "| %s | %d | %.0f | %.0f | %.0f | %.0f |\n", way, n, blocks / s,
        t * 1e6 / blocks, b * 1e6 / blocks, own }'
}

echo "| way | servers | blocks/s | ns CPU a block: servers | balancer | clients |"
echo "|---|---|---|---|---|---|"
for way in ${TRC_WAYS:-in_turn h2 tcp}; do
  for servers in 1 2 3; do measure "$servers" "$way"; done
done
