#!/usr/bin/env bash
# Runs the tests of the deployment one after the other: every tests/deploy/*_test.sh, or those named
# (every.sh container compose). Fails when one of them fails or takes longer than TRC_DEPLOY_SECONDS, in
# continuous integration (CI=true) also when one cannot run.
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

failed=() skipped=()
for test in "${tests[@]}"; do
  echo "== $test"
  start=$SECONDS
  timeout --kill-after=60 "${TRC_DEPLOY_SECONDS:-3600}" "./$test" </dev/null &
  running=$!
  status=0
  wait "$running" || status=$?
  case $status in
    0) result=passed ;;
    77) result="not run" && skipped+=("$test") ;;
    *) result=FAILED && failed+=("$test") ;;
  esac
  running=
  echo "== $test $result, $((SECONDS - start)) s"
done

[ "${CI:-}" != true ] || failed+=("${skipped[@]}")
if [ ${#failed[@]} -gt 0 ]; then
  echo "Deployment: ${#failed[@]} of ${#tests[@]} tests failed: ${failed[*]}" >&2
  exit 1
fi
[ ${#skipped[@]} -eq 0 ] || echo "Deployment: not run on this machine: ${skipped[*]}"
echo "Deployment: $((${#tests[@]} - ${#skipped[@]})) of ${#tests[@]} tests passed"
