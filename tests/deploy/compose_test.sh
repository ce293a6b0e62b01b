#!/usr/bin/env bash
# The edge box of deploy/compose: balancing, loss and drain of servers, metrics and alerts.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/engine.sh

service=127.0.0.1:50051
trc=$bin/trc
sample=client/samples/bracket.nc
compose() { podman-compose -f deploy/compose/compose.yaml "$@"; }
container() { podman ps --all --quiet --filter "name=_$1_"; }
address() { podman inspect --format '{{range .NetworkSettings.Networks}}{{.IPAddress}}{{end}}' "$(container "$1")"; }
# The value of a metric at an address; labels as part of the name.
value() { curl -sf "http://$1/metrics" | awk -v name="$2" '$1 == name { print int($2) }'; }
streams_of() { value "$(address "$1"):9464" trc_streams_active; }
in_use() { value 127.0.0.1:8404 'haproxy_backend_active_servers{proxy="trcd"}'; }
servers_in_use() { [ "$(in_use)" = "$1" ]; }

load_base
load_image
at_exit compose down
logs() {
  local name
  podman ps --all
  for name in trcd-1 trcd-2 haproxy prometheus; do podman logs --tail 5 "$(container $name)" 2>&1; done
}
mapfile -t commands < <(readme_commands Compose)
last=$((${#commands[@]} - 1))
# All but the last one, which takes the box down.
timeout 300 bash -euo pipefail -c "$(printf '%s\n' "${commands[@]:0:last}")" >"$work/shown" 2>"$work/said" ||
  fail "the commands of the page: $(cat "$work/shown" "$work/said" | tail -n 20; logs)"
grep -q '^N40 G01 X30 Y30' "$work/shown" || fail "the page's example shows no program"
wait_until 30 servers_in_use 2 || fail "HAProxy uses $(in_use) servers of 2"
say "the commands of the page; both servers pass the balancer's gRPC check"

for name in trcd-1 trcd-2 haproxy prometheus; do
  pid=$(podman inspect --format '{{.State.Pid}}' "$(container $name)")
  [ "$(awk '/^CapBnd/ { print $2 }' "/proc/$pid/status")" = 0000000000000000 ] || fail "$name has capabilities"
  [ "$(awk '/^Uid/ { print $2 }' "/proc/$pid/status")" != 0 ] || fail "$name runs as root"
  awk '$5 == "/" { exit $6 !~ /(^|,)ro(,|$)/ }' "/proc/$pid/mountinfo" || fail "the root of $name can be written to"
done
first_pid=$(podman inspect --format '{{.State.Pid}}' "$(container trcd-1)")
[ "$(memory_of "$first_pid" limit)" = $((1 << 30)) ] || fail "trcd-1 has no memory limit"

# A program that is sent half, and its other half later.
"$trc" compensate "$sample" -o "$work/expected" || fail "$sample is refused"
half=200
begin_slow() { # name
  mkfifo "$work/$1.nc"
  "$trc" compensate "$work/$1.nc" --server "$service" -o "$work/$1.out" 2>"$work/$1.err" &
  slow=$!
  exec 9>"$work/$1.nc"
  head -c $half "$sample" >&9
  serving=
  one_serves() { for serving in trcd-1 trcd-2; do [ "$(streams_of $serving)" = 1 ] && return; done; return 1; }
  wait_until 20 one_serves || fail "$1: no server has the stream"
  one_serves
}
end_slow() { # name
  tail -c +$((half + 1)) "$sample" >&9
  exec 9>&-
  wait $slow || fail "$1: $(cat "$work/$1.err")"
  cmp -s "$work/$1.out" "$work/expected" || fail "$1: the answer differs"
}
work_goes_on() { # how many programs
  local number
  for number in $(seq "$1"); do
    "$trc" compensate "$sample" --server "$service" -o "$work/other" 2>"$work/other.err" ||
      fail "program $number: $(cat "$work/other.err")"
    cmp -s "$work/other" "$work/expected" || fail "program $number differs"
  done
}

begin_slow two_streams
first=$serving
"$trc" compensate "$sample" --server "$service" -o "$work/other" || fail "no second stream"
[ "$(value "$(address trcd-1):9464" 'grpc_server_started_total{grpc_method="CompensateProgram",grpc_service="trc.v1.TrcService",grpc_type="bidi_stream"}')" -ge 1 ] &&
  [ "$(value "$(address trcd-2):9464" 'grpc_server_started_total{grpc_method="CompensateProgram",grpc_service="trc.v1.TrcService",grpc_type="bidi_stream"}')" -ge 1 ] ||
  fail "one server got all streams"
end_slow two_streams
say "streams go to the server with the fewest"

begin_slow drained
podman kill --signal TERM "$(container "$serving")" >/dev/null
wait_until 15 servers_in_use 1 || fail "a server that drains stays in use"
work_goes_on 20
end_slow drained
wait_until 60 servers_in_use 2 || fail "the server did not come back: $(podman ps --all)"
say "drain: out of use at once, 20 of 20 programs elsewhere, the open stream finished, back afterwards"

begin_slow killed
# Not through the engine, which would take that for the wish of its user and leave it dead.
kill -KILL "$(podman inspect --format '{{.State.Pid}}' "$(container "$serving")")"
work_goes_on 20
end_slow killed
wait_until 60 servers_in_use 2 || fail "the server did not come back: $(podman ps --all)"
say "kill -9: 20 of 20 programs elsewhere, the stream of the lost server resumed, nothing differs"

! "$trc" compensate tests/programs/bad/t17_line_reversed.nc --server "$service" -o "$work/other" 2>/dev/null ||
  fail "a damaged contour is not refused"
python3 tests/deploy/prometheus.py http://127.0.0.1:9090 deploy/monitoring/grafana-trcd.json deploy/monitoring/alerts.yml ||
  fail "Prometheus"
podman stop --time 35 "$(container "$first")" >/dev/null 2>&1
alert_waits() { curl -sf http://127.0.0.1:9090/api/v1/alerts | grep '"alertname":"TrcdDown"' >/dev/null; }
wait_until 30 alert_waits || fail "no alert although $first is down"
work_goes_on 5
say "Prometheus: all targets up, every expression of the dashboard has values, a lost server raises an alert"

bash -euo pipefail -c "${commands[last]}" >/dev/null 2>&1 || fail "the last command of the page: ${commands[last]}"
[ -z "$(podman ps --all --quiet)" ] || fail "containers are left: $(podman ps --all)"
