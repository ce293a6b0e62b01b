#!/usr/bin/env bash
# haproxy.cfg of the edge box with the line for TLS in force, on this machine: clients need a
# certificate, and the balancer's health check tells a server that drains from one that serves.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/tls.sh

trc=$bin/trc
port=$((20000 + $$ % 10000))
make_certificates "$work/tls"
cat "$work/tls/server.pem" "$work/tls/server.key" >"$work/tls/both.pem"

"$bin/trcd" --listen 127.0.0.1:0 --health-listen 127.0.0.1:0 --trusted-proxies 127.0.0.1 >"$work/log" &
server=$!
at_exit kill $server
wait_until 20 grep -q '"started"' "$work/log" || fail "trcd does not start"
backend=127.0.0.1:$(sed -n 's/.*"ports":"\([0-9]*\)".*/\1/p' "$work/log")
health=$(sed -n 's/.*"health_port":\([0-9]*\).*/\1/p' "$work/log")

sed -e 's/^  bind :50051 proto h2/  # &/' -e 's/^  # \(bind :50051 ssl\)/  \1/' \
  -e "s#:50051 ssl#127.0.0.1:$port ssl#; s#bind :8404#bind 127.0.0.1:$((port + 1))#" \
  -e "s#/etc/haproxy/tls/server.pem#$work/tls/both.pem#; s#/etc/haproxy/tls/clients.pem#$work/tls/ca.pem#" \
  -e "s#default-server port 50052#default-server port $health#" \
  -e "s#^  server trcd-1 .*#  server trcd-1 $backend#; /^  server trcd-2/d" \
  deploy/compose/haproxy.cfg >"$work/haproxy.cfg"
grep -q "^  bind 127.0.0.1:$port ssl" "$work/haproxy.cfg" || fail "there is no line for TLS in haproxy.cfg"
files=(-f deploy/haproxy/defaults.cfg -f "$work/haproxy.cfg")
haproxy -c "${files[@]}" >"$work/said" 2>&1 || fail "haproxy.cfg: $(cat "$work/said")"
haproxy -W -db "${files[@]}" >"$work/haproxy.log" 2>&1 &
balancer=$!
at_exit kill $balancer
in_use() { curl -sf "http://127.0.0.1:$((port + 1))/metrics" | grep -x "haproxy_backend_active_servers{proxy=\"trcd\"} $1" >/dev/null; }
wait_until 20 in_use 1 || fail "the server does not pass the health check: $(tail -n 3 "$work/haproxy.log")"

certificate=(--tls-cert "$work/tls/client.pem" --tls-key "$work/tls/client.key")
service=(--server "localhost:$port" --tls-ca "$work/tls/ca.pem")
"$trc" compensate client/samples/bracket.nc -o "$work/expected" || fail "bracket.nc is refused"
"$trc" compensate client/samples/bracket.nc "${service[@]}" "${certificate[@]}" -o "$work/out" || fail "no answer over TLS"
cmp "$work/out" "$work/expected" || fail "the answer differs"
grep -q '"peer":"127.0.0.1 behind ipv4:127.0.0.1:' "$work/log" || fail "the server does not know the client"
! "$trc" health "${service[@]}" 2>/dev/null || fail "a client without a certificate is let in"
! "$trc" health --server "localhost:$port" 2>/dev/null || fail "plain text is let in"

# A stream that is open keeps the server draining.
mkfifo "$work/slow.nc"
"$trc" compensate "$work/slow.nc" "${service[@]}" "${certificate[@]}" -o "$work/slow.out" 2>"$work/slow.err" &
slow=$!
exec 9>"$work/slow.nc"
head -c 200 client/samples/bracket.nc >&9
sleep 2
kill $server
wait_until 10 in_use 0 || fail "a server that drains stays in use"
kill -0 $server 2>/dev/null || fail "the server had ended already: nothing was drained"
tail -c +201 client/samples/bracket.nc >&9
exec 9>&-
wait $slow || fail "the open stream was cut off: $(cat "$work/slow.err")"
cmp "$work/slow.out" "$work/expected" || fail "the answer of the open stream differs"
wait $server || fail "trcd ended with $?"
say "HAProxy: TLS with client certificates; a server that drains is out of use and finishes its stream"
