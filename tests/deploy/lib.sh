# Sourced by the tests of the deployment. Each of them
#   - runs from the top of the source tree, as root, with the programs of `./run --build` (or those in
#     TRC_DEPLOY_BIN),
#   - keeps all it makes in $work, or takes it away in a function given to `at_exit`,
#   - ends with 0 only if everything it says has been seen to hold, and with 77 if this machine cannot
#     show it.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
[ "$(id -u)" -eq 0 ] || { echo "error: the deployment is tested as root" >&2; exit 1; }

bin=${TRC_DEPLOY_BIN:-$PWD/build/release/bin}
work=$(mktemp -d "${TMPDIR:-/tmp}/trc_deploy.XXXXXX")

# at_exit COMMAND…: runs when the test ends, however it ends; the last one given runs first.
clean_up=("rm -rf --one-file-system $work")
at_exit() { clean_up=("$*" "${clean_up[@]}"); }
run_clean_up() {
  local status=$? command
  trap - EXIT
  for command in "${clean_up[@]}"; do eval "$command" >/dev/null 2>&1 </dev/null || true; done
  exit "$status"
}
trap run_clean_up EXIT
trap 'exit 1' INT TERM

fail() {
  echo "error: $*" >&2
  exit 1
}

skip() {
  echo "not run: $*" >&2
  exit 77
}

say() { printf '%4d s  %s\n' "$SECONDS" "$*"; }

# wait_until SECONDS COMMAND…: false when it has not come true by then.
wait_until() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    [ "$SECONDS" -lt "$end" ] || return 1
    sleep 0.2
  done
}

# readme_commands SECTION [N]: the N-th block of shell commands (the first) under the heading
# "## SECTION" of deploy/README.md. Fails without one, or when it has ten lines or more.
readme_commands() {
  local commands
  commands=$(awk -v heading="## $1" -v wanted="${2:-1}" '
    /^## / { inside = ($0 == heading); next }
    inside && /^```sh$/ { shown = (++block == wanted); next }
    /^```$/ { shown = 0 }
    shown' deploy/README.md)
  [ -n "$commands" ] || fail "deploy/README.md has no commands under '$1'"
  [ "$(wc -l <<<"$commands")" -lt 10 ] || fail "ten or more lines of commands under '$1'"
  printf '%s\n' "$commands"
}
