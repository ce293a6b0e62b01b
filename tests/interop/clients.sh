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

# It is read before the server has begun it, perhaps.
: >"$work/log"
"$build/bin/trcd" --listen 127.0.0.1:0 >"$work/log" &
server=$!
for _ in $(seq 100); do
  address=$(sed -n 's/.*"event":"started".*"ports":"\([0-9]*\)".*/127.0.0.1:\1/p' "$work/log")
  [ -z "$address" ] || break
  sleep 0.1
done
[ -n "$address" ] || { echo "trcd did not start" >&2; exit 1; }

# The one that the build needs as well; make is not there on a bare machine.
export CMAKE_GENERATOR=Ninja
modules=$top/.ci/node/node_modules
# Where npm is missing these are skipped, but never in CI.
without_modules() {
  echo "$1 is not installed; ./test installs it where there is npm"
  [ "${CI:-}" = true ] && exit 1 || exit 77
}

# example LANGUAGE: what README.md says in it, with the server that is here.
example() {
  awk -v mark="\`\`\`$1" '$0 == mark {inside=1; next} /^```$/ {if (inside) exit} inside' README.md |
    sed "s/box:50051/$address/"
}
cp client/samples/bracket.nc "$work/part.nc"

case $kind in
  library)
    cmake --install "$build" --component client --prefix "$work/prefix" >"$work/install.log"
    cp -r client/examples/cpp "$work/outside"
    {
      printf '#include <%s>\n' iostream string
      echo '#include "core/session/program_session.h"'
      echo 'int main() { const std::string text = "N10 G01 X10 F100\n";'
      example cpp
      echo 'return done ? 0 : 1; }'
    } >"$work/outside/readme.cpp"
    cat >>"$work/outside/CMakeLists.txt" <<'LIST'
add_executable(readme readme.cpp)
target_link_libraries(readme PRIVATE trc::core)
LIST
    cmake -S "$work/outside" -B "$work/outside/build" "-DCMAKE_PREFIX_PATH=$work/prefix" \
      >"$work/configure.log" || { cat "$work/configure.log" >&2; exit 1; }
    cmake --build "$work/outside/build" >"$work/build.log" || { cat "$work/build.log" >&2; exit 1; }
    [ "$("$work/outside/build/readme")" = "N10 G01 X10 F100" ]
    # Nothing in it refers to the tree it came from.
    if grep -rlF "$top" "$work/prefix" --include='*.cmake'; then
      echo "the installed package names the source tree" >&2
      exit 1
    fi
    client=("$work/outside/build/compensate") ;;
  python)
    # The package from its wheel and from its sdist, in environments that have nothing of it.
    cp -r client/python "$work/python" && mkdir "$work/proto" && cp -r proto/trc "$work/proto/"
    mkdir -p "$work/client" && mv "$work/python" "$work/client/python"
    (cd "$work/client/python" && /usr/bin/python3 -m build --no-isolation --outdir "$work/dist" .) \
      >"$work/build.log" 2>&1 || { cat "$work/build.log" >&2; exit 1; }
    /usr/bin/python3 -m venv --system-site-packages "$work/venv"
    "$work/venv/bin/pip" install --no-index --no-deps -q "$work"/dist/*.whl
    /usr/bin/python3 -m venv --system-site-packages "$work/other"
    "$work/other/bin/pip" install --no-index --no-deps --no-build-isolation -q "$work"/dist/*.tar.gz
    diff -r -x __pycache__ "$work"/{venv,other}/lib/python3*/site-packages/trc
    "$work/other/bin/python" client/python/tests/test_first_batch.py
    for test in client first_batch hostile; do
      TRC_PYTHON_README=$top/client/python/README.md TRC_TRCD=$build/bin/trcd TRC_CLI=$build/bin/trc \
        "$work/venv/bin/python" client/python/tests/test_$test.py
    done
    { echo 'import trc'; example python; } >"$work/readme.py"
    (cd "$work" && venv/bin/python readme.py) | grep M30 >/dev/null
    client=("$work/venv/bin/python" client/examples/python/compensate.py) ;;
  node)
    # The package from its tarball, beside the modules it needs.
    [ -d "$modules/@grpc/grpc-js" ] || without_modules "@grpc/grpc-js"
    mkdir -p "$work/client" "$work/project/node_modules"
    cp -r client/node "$work/client/" && cp -r proto "$work/"
    (cd "$work/client/node" && npm pack --silent --pack-destination "$work") >"$work/pack.log" 2>&1 ||
      { cat "$work/pack.log" >&2; exit 1; }
    for module in "$modules"/*; do ln -s "$module" "$work/project/node_modules/"; done
    mkdir "$work/project/node_modules/trc-client"
    tar -C "$work/project/node_modules/trc-client" --strip-components=1 -xzf "$work"/trc-client-*.tgz
    cp client/node/test/*.test.js client/examples/node/compensate.mjs "$work/project/"
    TRC_NODE_README=$top/client/node/README.md TRC_TRCD=$build/bin/trcd TRC_CLI=$build/bin/trc \
      TRC_TEST_PORT=${address##*:} node --test "$work"/project/*.test.js >"$work/tests.log" ||
      { cat "$work/tests.log" >&2; exit 1; }
    {
      echo 'import { readFileSync } from "node:fs"; import { compensate } from "trc-client";'
      echo 'const text = readFileSync("../part.nc");'
      example js
    } >"$work/project/readme.mjs"
    (cd "$work/project" && node readme.mjs) | grep M30 >/dev/null
    client=(node "$work/project/compensate.mjs") ;;
  buf)
    buf=$modules/@bufbuild/buf-linux-$(uname -m | sed 's/x86_64/x64/')/bin/buf
    [ -x "$buf" ] || without_modules buf
    curl=("$buf" curl --protocol grpc --http2-prior-knowledge)
    # By reflection: no file is given.
    "${curl[@]}" "http://$address/trc.v1.TrcService/GetServerInfo" | grep '"maxMessageBytes"' >/dev/null
    "${curl[@]}" -d '{"service":"trc.v1.TrcService"}' \
      "http://$address/grpc.health.v1.Health/Check" | grep '"SERVING"' >/dev/null
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
grep -qE '^line 2: (error )?900002' "$work/bad.err" || { cat "$work/bad.err" >&2; exit 1; }
