#!/usr/bin/env bash
# The promise "two commands on a bare Debian 12", tried: a minimal root file system is made for the
# purpose, the committed source is copied in without its history, and inside
#   - as root: ./run, again ./run without a network, ./test
#   - strangers.sh: the first contour in each language, with the packages made there
#   - as a user with sudo: ./run, again ./run without a network
# Usage: fresh_machine.sh [--run-only]     (leaves ./test out)
#
# Needs root, git, mmdebstrap, about 6 GB, and this machine's package sources, which the root file
# system inherits. Everything it makes lies in one temporary folder and goes when it ends.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

run_only=
[ "${1:-}" != --run-only ] || run_only=yes
. tests/deploy/root.sh
[ "$(id -u)" -eq 0 ] || { echo "error: a root file system is made by root only" >&2; exit 1; }

work=$(mktemp -d "${TMPDIR:-/tmp}/fresh_machine.XXXXXX")
trap 'rm -rf --one-file-system "$work"' EXIT

fail() {
  echo "error: $*" >&2
  exit 1
}

# machine NAME HOME: a copy of the bare root with the source in HOME/trc.
machine() {
  local root=$work/$1
  copy_root "$work/bare" "$root"
  mkdir -p "$root/$2/trc"
  git archive HEAD | tar -x -C "$root/$2/trc"
}

# step NAME COMMAND…: the time in `took`, what was on the screen in $screen.
screen=$work/screen
step() {
  local name=$1 start=$SECONDS
  shift
  echo "== $name"
  "$@" 2>&1 | tee "$screen" || fail "$name, after $((SECONDS - start)) s"
  took=$((SECONDS - start))
  echo "== $name: $took s"
}

# The path of the demo on the screen (its last point is the retract to X150 Y0), and the files.
check_first_run() {
  local home=$1
  grep -q 'approach' "$screen" && grep -qE '120\.0+[ ,]+30\.0+' "$screen" ||
    fail "./run did not show the path of the demo"
  grep -q '<svg' "$home/trc/build/out/g239_demo.svg" || fail "./run left no picture"
  [ -s "$home/trc/build/out/g239_demo.nc" ] || fail "./run left no program"
}

check_second_run() {
  ! grep -qE '^Installing:|Building CXX' "$screen" || fail "the second ./run installed or built"
  [ "$took" -le "$(allowed 20)" ] || fail "the second ./run took $took s"
}

# run_twice NAME HOME SHELL: the second time without a network.
run_twice() {
  local name=$1 home=$2 shell=$3 root=$work/$1
  step "$name: first ./run" in_root "$root" 2400 "$shell 'cd $home/trc && ./run'"
  check_first_run "$root$home"
  isolate=--net step "$name: second ./run" in_root "$root" 300 "$shell 'cd $home/trc && ./run'"
  check_second_run
}

step "bare Debian 12" make_root "$work/bare" "$work/apt.conf"

machine root /root
run_twice root /root "bash -c"
[ -n "$run_only" ] || step "root: ./test" in_root "$work/root" 3600 "cd /root/trc && ./test"
step "root: packages" in_root "$work/root" 2400 "cd /root/trc && cmake --build --preset release &&
  apt-get -q -y install --no-install-recommends dpkg-dev file &&
  tests/deploy/packages.sh build/release /root/packages"
step "strangers" tests/deploy/strangers.sh "$work/bare" "$work/root/root/packages"
rm -rf --one-file-system "$work/root"

machine user /home/turner
in_root "$work/user" 300 "apt-get -q update && apt-get -q -y install --no-install-recommends sudo &&
  useradd --shell /bin/bash turner && chown -R turner: /home/turner &&
  echo 'turner ALL=(ALL) NOPASSWD: ALL' >/etc/sudoers.d/turner" >"$work/user.log" 2>&1 ||
  { cat "$work/user.log"; fail "no user with sudo"; }
run_twice user /home/turner "su - turner -c"

echo "Fresh machine: all steps passed"
