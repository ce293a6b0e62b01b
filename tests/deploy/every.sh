#!/usr/bin/env bash
# Runs the tests of the deployment one after the other: every tests/deploy/*_test.sh, or those named
# (every.sh container compose). Fails when one of them fails or takes longer than TRC_DEPLOY_SECONDS.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")"

tests=()
for name in "$@"; do
  [ -x "${name}_test.sh" ] || { echo "error: there is no tests/deploy/${name}_test.sh" >&2; exit 2; }
  tests+=("${name}_test.sh")
done
[ $# -gt 0 ] || tests=(*_test.sh)

# `timeout` makes a process group of its own, which no ^C reaches.
running=
stop() {
  trap - INT TERM
  [ -z "$running" ] || { kill "$running"; wait "$running" || true; }
  exit 1
}
trap stop INT TERM

failed=()
for test in "${tests[@]}"; do
  echo "== $test"
  start=$SECONDS
  timeout --kill-after=60 "${TRC_DEPLOY_SECONDS:-3600}" "./$test" </dev/null &
  running=$!
  if wait "$running"; then
    echo "== $test passed, $((SECONDS - start)) s"
  else
    echo "== $test FAILED, $((SECONDS - start)) s"
    failed+=("$test")
  fi
done

if [ ${#failed[@]} -gt 0 ]; then
  echo "Deployment: ${#failed[@]} of ${#tests[@]} tests failed: ${failed[*]}" >&2
  exit 1
fi
echo "Deployment: all ${#tests[@]} tests passed"
