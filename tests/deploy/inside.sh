# What a machine of machine.sh runs when it has started: /check/script, with these words.
set -euo pipefail

fail() {
  echo "error: $*" >&2
  exit 1
}

ended() {
  [ -e /check/done ] || journalctl --no-pager --lines=30 --unit=trcd.service
}
trap ended EXIT

say() { printf '       %s\n' "$*"; }

wait_until() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    [ "$SECONDS" -lt "$end" ] || return 1
    sleep 0.2
  done
}

socket=unix:/run/trcd/trcd.sock
is_serving() { trc health --server "$socket"; }
of_unit() { systemctl show --value --property="$1" trcd.service; }
pid() { of_unit MainPID; }
is_another() { [ "$(pid)" != "$1" ] && [ "$(pid)" != 0 ] && is_serving; }
journal() { journalctl --no-pager --output=cat --unit=trcd.service; }

# slow_program SECONDS: a program on standard output that takes so long to arrive.
slow_program() {
  printf '%s\n' 'N10 G00 X0 Y-20' 'N20 V.G.WZ_AKT.R=1' 'N30 G41 G01 X0 Y0 F1000'
  for second in $(seq "$1"); do
    for block in $(seq 500); do echo "G01 X$((second * 5000 + block * 10)) Y$((block % 2 * 5))"; done
    [ -z "${slowly:-}" ] || sleep 1
  done
  printf '%s\n' 'G40 G01 X100000 Y-30' M30
}

cd /src
. /check/script
touch /check/done
