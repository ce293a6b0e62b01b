#!/usr/bin/env bash
# The systemd unit on a machine of its own: installed as deploy/README.md says, sandboxed, watched
# over, restarted, drained.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/machine.sh

tests/deploy/unit.sh "$bin/trcd" || fail "the unit has a fault"
make_machine
readme_commands systemd >"$work/readme"
# The first line builds, here; packages come through the network, so before the machine starts.
head -n 1 "$work/readme" | grep -qxF './run --build' || fail "the first line does not build"
./run --build >/dev/null
sed -n 2p "$work/readme" | grep -q '^apt-get install ' || fail "the second line installs no packages"
in_machine "$(sed -n 2p "$work/readme")"
say "packages of the machine installed"
{
  echo "readme() {"
  tail -n +3 "$work/readme"
  echo "}"
  cat tests/deploy/systemd_inside.sh
} >"$work/script"
boot 300 "$work/script"
say "systemd: installed, confined, restarted, watched, reloaded and drained"
