#!/usr/bin/env bash
# Clients of other languages and other people's programs against the built server: each gives what
# the command line gives.
#
#   clients.sh library|python|node|buf BUILD_FOLDER
set -euo pipefail

kind=$1
build=$2
top=$PWD
work=$(mktemp -d)
server=
cleanup() {
  [ -z "$server" ] || { kill "$server" 2>/dev/null && wait "$server" || true; }
  rm -rf "$work"
}
trap cleanup EXIT

"$build/bin/trcd" --listen 127.0.0.1:0 >"$work/log" &
server=$!
for _ in $(seq 100); do
  address=$(sed -n 's/.*"event":"started".*"ports":"\([0-9]*\)".*/127.0.0.1:\1/p' "$work/log")
  [ -z "$address" ] || break
  sleep 0.1
done
[ -n "$address" ] || { echo "trcd did not start" >&2; exit 1; }

modules=$top/.ci/node/node_modules
# Where npm is missing these are skipped, but never in CI.
without_modules() {
  echo "$1 is not installed; ./test installs it where there is npm"
  [ "${CI:-}" = true ] && exit 1 || exit 77
}

case $kind in
  library)
    cmake --install "$build" --component client --prefix "$work/prefix" >"$work/install.log"
    cp -r client/examples/cpp "$work/outside"
    cmake -S "$work/outside" -B "$work/outside/build" "-DCMAKE_PREFIX_PATH=$work/prefix" \
      >"$work/configure.log" || { cat "$work/configure.log" >&2; exit 1; }
    cmake --build "$work/outside/build" >"$work/build.log" || { cat "$work/build.log" >&2; exit 1; }
    # Nothing in it refers to the tree it came from.
    if grep -rlF "$top" "$work/prefix" --include='*.cmake'; then
      echo "the installed package names the source tree" >&2
      exit 1
    fi
    client=("$work/outside/build/compensate") ;;
  python)
    protoc -I proto --python_out="$work" --grpc_python_out="$work" \
      --plugin=protoc-gen-grpc_python="$(command -v grpc_python_plugin)" proto/trc/v1/*.proto
    export PYTHONPATH=$work
    client=(/usr/bin/python3 client/examples/python/compensate.py) ;;
  node)
    [ -d "$modules/@grpc/grpc-js" ] || without_modules "@grpc/grpc-js"
    export NODE_PATH=$modules
    client=(node client/examples/node/compensate.js) ;;
  buf)
    buf=$modules/@bufbuild/buf-linux-$(uname -m | sed 's/x86_64/x64/')/bin/buf
    [ -x "$buf" ] || without_modules buf
    curl=("$buf" curl --protocol grpc --http2-prior-knowledge)
    # By reflection: no file is given.
    "${curl[@]}" "http://$address/trc.v1.TrcService/GetServerInfo" | grep -q '"maxMessageBytes"'
    "${curl[@]}" -d '{"service":"trc.v1.TrcService"}' \
      "http://$address/grpc.health.v1.Health/Check" | grep -q '"SERVING"'
    "${curl[@]}" --list-methods "http://$address" | sort >"$work/methods"
    grep -qx 'grpc.health.v1.Health/Watch' "$work/methods"
    grep -qx 'trc.v1.TrcService/CompensatePath' "$work/methods"
    "${curl[@]}" -d '{"setup":{"toolRadius":5}} {"batch":{"final":true,"blocks":[
      {"command":{"side":"COMPENSATION_SIDE_LEFT"}},
      {"linear":{"end":{"x":10,"y":0}}}, {"linear":{"end":{"x":50}}},
      {"command":{"side":"COMPENSATION_SIDE_OFF"}}, {"linear":{"end":{"x":60,"y":-20}}}]}}' \
      "http://$address/trc.v1.TrcService/CompensatePath" >"$work/path"
    grep -q '"ORIGIN_APPROACH"\|"APPROACH"' "$work/path"
    grep -q '"summary"' "$work/path"
    exit 0 ;;
esac

# A program that is compensated, in more than one piece, and one that is refused.
good=$work/good.nc
{
  cat tests/programs/good/d24_hundred_passive_blocks.nc | grep -v '^; setup' | sed '/^M30/d'
  for i in $(seq 6000); do echo "G1 X$i Y$((i % 7)) (some text)"; done
  echo M30
} >"$good"
"$build/bin/trc" compensate "$good" -o "$work/expected"
"${client[@]}" "$address" "$good" >"$work/actual"
cmp "$work/expected" "$work/actual"
[ -s "$work/actual" ]

printf 'N10 G1 X10 F100\nN20 G999\n' >"$work/bad.nc"
code=0
"${client[@]}" "$address" "$work/bad.nc" >"$work/bad.out" 2>"$work/bad.err" || code=$?
[ "$code" = 1 ] || { echo "exit code $code for a refused program" >&2; exit 1; }
grep -q '^line 2: 900002' "$work/bad.err" || { cat "$work/bad.err" >&2; exit 1; }
