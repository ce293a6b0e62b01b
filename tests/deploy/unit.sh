#!/usr/bin/env bash
# The systemd unit and its configuration, as far as they can be judged without starting them: known
# keys, the sandbox, settings the server takes, and limits that go together.
#
#   unit.sh TRCD
set -euo pipefail

trcd=$1
unit=deploy/systemd/trcd.service
configuration=deploy/systemd/trcd.toml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "error: $*" >&2
  exit 1
}

# A key nobody knows is an error only when it is asked for, so that is tried first.
verify() { systemd-analyze verify --man=no --recursive-errors=no "$1"; }
sed "s,^ExecStart=/usr/bin/trcd,ExecStart=$(readlink -f "$trcd")," "$unit" >"$work/trcd.service"
mkdir "$work/misspelt"
sed 's/^PrivateTmp=/PrivateTemp=/' "$work/trcd.service" >"$work/misspelt/trcd.service"
! verify "$work/misspelt/trcd.service" 2>/dev/null || fail "a misspelt key is not noticed"
verify "$work/trcd.service" || fail "the unit has a fault"

# Exposure 1.9 and more is refused; the scale goes to 10.
systemd-analyze security --offline=true --threshold=19 "$unit" >"$work/exposure" ||
  { cat "$work/exposure"; fail "the sandbox is too wide"; }
grep 'Overall exposure' "$work/exposure"

"$trcd" --config "$configuration" --print-config >"$work/settings" || fail "trcd refuses $configuration"
of_unit() { sed -n "s/^$1=\([0-9]*\).*/\1/p" "$unit"; }
of_server() { sed -n "s/^$1=\"\?\([0-9]*\)\"\?$/\1/p" "$work/settings"; }
drain=$(of_server drain-timeout-s) stop=$(of_unit TimeoutStopSec)
[ "$stop" -gt "$drain" ] || fail "systemd kills after $stop s who may drain for $drain s"
memory=$((3 * $(of_server max-session-memory-mib) + $(of_server max-grpc-buffer-mib) + 64))
[ "$(of_unit MemoryMax)" -ge "$memory" ] || fail "MemoryMax is below the $memory MiB of the limits"
