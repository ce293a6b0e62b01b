#!/usr/bin/env bash
# The alert rules and the dashboard: rules by promtool's unit tests, and every expression against the
# names and labels a server really exports.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/tls.sh

rules=deploy/monitoring/alerts.yml
dashboard=deploy/monitoring/grafana-trcd.json

promtool check rules --lint-fatal "$rules" >/dev/null || fail "promtool does not accept $rules"
bash -euo pipefail -c "$(readme_commands Monitoring)" >"$work/said" 2>&1 ||
  fail "alerts do not come as they must: $(cat "$work/said")"
for alert in $(sed -n 's/^ *- alert: //p' "$rules"); do
  tested=$(grep -A1 "alertname: $alert\$" deploy/monitoring/alerts_test.yml)
  comes=$(grep -c exp_alerts <<<"$tested" || true)
  [ "$comes" -ge 1 ] || fail "no test in which $alert comes"
  [ "$(grep -c alertname <<<"$tested")" -gt "$comes" ] || fail "no test in which $alert does not come"
done
say "alert rules: $(grep -c 'alert:' "$rules"), each seen to come and not to come"

mkdir "$work/prometheus"
cp deploy/compose/prometheus.yml "$rules" "$work/prometheus/"
promtool check config "$work/prometheus/prometheus.yml" >/dev/null || fail "prometheus.yml"

# A server that has done a bit of everything.
make_certificates "$work/tls"
"$bin/trcd" --listen 127.0.0.1:0 --admin-listen 127.0.0.1:0 --tls-cert-file "$work/tls/server.pem" \
  --tls-key-file "$work/tls/server.key" >"$work/log" &
server=$!
at_exit "kill $server"
port_of() { sed -n "s/.*\"started\".*\"$1\":\"\\?\\([0-9]*\\).*/\\1/p" "$work/log"; }
wait_until 20 grep -q '"started"' "$work/log" || fail "trcd does not start"
service=127.0.0.1:$(port_of ports)
tls=(--server "$service" --tls-ca "$work/tls/ca.pem")
"$bin/trc" compensate client/samples/g239_demo.nc "${tls[@]}" -o "$work/demo.nc" ||
  fail "no answer with TLS"
! "$bin/trc" compensate tests/programs/bad/t17_line_reversed.nc "${tls[@]}" -o "$work/bad.nc" \
  2>"$work/refused" || fail "a damaged contour is not refused"
make_certificates "$work/tls"
kill -HUP "$server"
wait_until 20 grep -q certificate_taken "$work/log" || fail "the new certificate is not taken"
wait_until 20 curl -sf "http://127.0.0.1:$(port_of admin_port)/metrics" -o "$work/metrics" ||
  fail "no metrics"
promtool check metrics <"$work/metrics" || fail "promtool finds fault with the metrics"

python3 tests/deploy/expressions.py "$rules" "$dashboard" "$work/metrics" "$work/expressions.yml" ||
  fail "the dashboard or the rules name what is not exported"
promtool check rules "$work/expressions.yml" >/dev/null || fail "an expression of the dashboard"
say "expressions checked: $(grep -c 'record:' "$work/expressions.yml")"
