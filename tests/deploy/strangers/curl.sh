# has: curl
apt-get -q install -y --no-install-recommends /packages/trcd_*.deb
trcd --http-listen 127.0.0.1:8080 &
until curl -sSf http://127.0.0.1:8080/v1/info -o /dev/null; do sleep 0.2; done
curl -sSf --data-binary @part.nc -H 'Content-Type: text/plain' \
  'http://127.0.0.1:8080/v1/programs:compensate?tool_radius=5' -o part_g40.nc
