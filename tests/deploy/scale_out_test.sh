#!/usr/bin/env bash
# Several servers behind HAProxy, by stream (h2) and by connection (tcp), and with clients that take
# them in turn: under load one is killed, one drained, one added. No program is lost, and each gives
# what it gives without a server.
if [ -z "${TRC_SCALE_OUT_INSIDE:-}" ]; then
  # Ports, processes and /run of its own: nothing is left when it ends.
  TRC_SCALE_OUT_INSIDE=yes exec unshare --net --mount --pid --fork --kill-child --mount-proc "$0"
fi
. "$(dirname "$(readlink -f "$0")")/lib.sh"
# Who still writes into $work goes before it does.
at_exit 'kill -9 $(jobs -p); wait'
ip link set lo up
mount -t tmpfs tmpfs /run
export PATH=$bin:$PATH

# What the page says, with three servers and both ways to reach them.
readme_commands "Scale-out" >"$work/readme"
. "$work/readme"
trc compensate client/samples/bracket.nc -o "$work/expected.nc"
for way in 127.0.0.1:50050 127.0.0.1:50051,127.0.0.1:50052,127.0.0.1:50053; do
  trc compensate client/samples/bracket.nc --server "$way" -o "$work/actual.nc"
  cmp "$work/expected.nc" "$work/actual.nc" || fail "another path by way of $way"
done
say "three servers, as the page says"

pid_at() { ss -ltnpH "sport = :$1" | sed -n 's/.*pid=\([0-9]*\),.*/\1/p' | head -n 1; }
# The file is there before its content.
signal_balancer() {
  wait_until 10 test -s /run/trcd/haproxy.pid && kill "-$1" "$(cat /run/trcd/haproxy.pid)"
}
ended() { ! kill -0 "$1"; }
gone() { [ -z "$(pid_at "$1")" ]; }
stop_all() {
  local port pid
  [ ! -e /run/trcd/haproxy.pid ] || signal_balancer TERM
  for port in 50050 50051 50052 50053; do
    pid=$(pid_at "$port")
    # It may end by itself meanwhile.
    [ -z "$pid" ] || kill -9 "$pid" || true
    wait_until 10 gone "$port" || fail "port $port is still taken"
  done
  rm -f /run/trcd/haproxy.pid
}

server() { # number
  local port=$((50050 + $1))
  trcd --listen "127.0.0.1:$port" --health-listen "127.0.0.1:$((port + 100))" \
    --admin-listen "127.0.0.1:$((port + 10000))" --resume-key-file /run/trcd/resume.key >>"$work/trcd-$1.log" &
}
streams_at() { # number: open streams
  { exec 3<>"/dev/tcp/127.0.0.1/$((60050 + $1))"; } 2>/dev/null || { echo 0; return; }
  printf 'GET /metrics HTTP/1.0\r\n\r\n' >&3
  sed -n 's/^trc_streams_active \([0-9]*\).*/\1/p' <&3
  exec 3>&-
}
busy() { [ "$(streams_at "$1")" -gt 0 ]; }

# Programs of three seconds each: resumed by a token, held back as a whole, with arcs; and short ones.
trc generate --shape gear --blocks 12000 >"$work/gear.nc"
{ echo G141; trc generate --shape wave --blocks 12000; } >"$work/held.nc"
trc generate --shape random --seed 7 --blocks 12000 >"$work/random.nc"
cp client/samples/bracket.nc "$work/short.nc"
kinds=(gear held random gear held random short short)
for kind in gear held random; do
  mkdir "$work/$kind"
  split -n l/12 "$work/$kind.nc" "$work/$kind/"
done
for kind in gear held random short; do
  trc compensate "$work/$kind.nc" -o "$work/$kind.expected" 2>/dev/null
done

slowly() { # kind
  local part
  [ -d "$work/$1" ] || { cat "$work/$1.nc"; sleep 0.1; return; }
  for part in "$work/$1"/*; do
    cat "$part"
    sleep 0.25
  done
}
# One client after another until the load ends; a line for each.
client() { # number kind address
  local result=$work/result-$1
  while [ ! -e "$work/enough" ]; do
    if ! trc compensate <(slowly "$2") --server "$3" -o "$result" 2>"$result.err"; then
      echo "lost: $2: $(tail -n 1 "$result.err")"
    elif cmp -s "$work/$2.expected" "$result"; then
      echo "$2"
    else
      echo "changed: $2"
    fi
  done >>"$work/passages"
}

balancer() { # way, number of servers
  local file=$work/$1.cfg
  awk -v most="$2" '$1 != "server" || ++seen <= most' "deploy/haproxy/$1.cfg" >"$file"
  if [ -e /run/trcd/haproxy.pid ]; then
    signal_balancer USR2
  else
    haproxy -W -D -p /run/trcd/haproxy.pid -f deploy/haproxy/defaults.cfg -f "$file"
  fi
}

under_load() { # way
  local way=$1 address=127.0.0.1:50050 clients=() number on_dead drained
  stop_all
  rm -f "$work"/enough "$work"/passages "$work"/trcd-*.log
  server 1
  server 2
  if [ "$way" = in_turn ]; then
    address=127.0.0.1:50051,127.0.0.1:50052,127.0.0.1:50053
  else
    balancer "$way" 2
  fi
  wait_until 20 trc health --server "$address" || fail "$way: nobody serves"
  for number in "${!kinds[@]}"; do
    client "$number" "${kinds[number]}" "$address" &
    clients+=($!)
  done

  wait_until 20 busy 1 && wait_until 20 busy 2 || fail "$way: not both servers are used"
  sleep 2
  wait_until 20 busy 1
  on_dead=$(streams_at 1)
  kill -9 "$(pid_at 50051)"
  sleep 3
  server 1
  wait_until 30 busy 1 || fail "$way: the killed server is not used again"
  say "$way: killed with $on_dead streams, and back"

  wait_until 20 busy 2
  drained=$(pid_at 50052)
  kill -TERM "$drained"
  # Its last word comes after it has closed its port.
  wait_until 45 ended "$drained" || fail "$way: does not end"
  grep '"event":"draining"' "$work/trcd-2.log" | grep -v '"streams":0' >/dev/null ||
    fail "$way: drained without a stream"
  grep '"event":"stopped"' "$work/trcd-2.log" | grep '"streams_cut_off":0' >/dev/null ||
    { tail -n 3 "$work/trcd-2.log"; fail "$way: streams were cut off"; }
  server 2
  wait_until 30 busy 2 || fail "$way: the drained server is not used again"
  say "$way: drained, and back"

  server 3
  [ "$way" = in_turn ] || balancer "$way" 3
  wait_until 30 busy 3 || fail "$way: the added server is not used"
  sleep 3
  touch "$work/enough"
  wait "${clients[@]}"
  say "$way: added a third"

  ! grep -E '^(lost|changed)' "$work/passages" || fail "$way: not every program came out right"
  for number in "${kinds[@]}"; do
    grep -qx "$number" "$work/passages" || fail "$way: no $number program was done"
  done
  [ "$on_dead" -gt 0 ] || fail "$way: the server had nothing to do when it was killed"
  say "$way: $(wc -l <"$work/passages") programs, none lost, none changed"
}

for way in h2 tcp in_turn; do under_load "$way"; done
stop_all
