#!/usr/bin/env bash
# The promise "two commands on a bare Debian 12", tried: a minimal root file system is made for the
# purpose, the committed source is copied in without its history, and inside
#   - as root: ./run, again ./run without a network, ./test
#   - as a user with sudo: ./run, again ./run without a network
# Usage: fresh_machine.sh [--run-only]     (leaves ./test out)
#
# Needs root, git, mmdebstrap, about 6 GB, and this machine's package sources, which the root file
# system inherits. Everything it makes lies in one temporary folder and goes when it ends.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

run_only=
[ "${1:-}" != --run-only ] || run_only=yes
[ "$(id -u)" -eq 0 ] || { echo "error: a root file system is made by root only" >&2; exit 1; }

work=$(mktemp -d "${TMPDIR:-/tmp}/fresh_machine.XXXXXX")
trap 'rm -rf --one-file-system "$work"' EXIT

fail() {
  echo "error: $*" >&2
  exit 1
}

# In a mount namespace of its own, so that an interrupted run leaves nothing mounted.
make_root() {
  local sources
  mapfile -t sources < <(grep -lsE '^(deb |Suites:).*[[:space:]]bookworm([[:space:]]|$)' \
    /etc/apt/sources.list /etc/apt/sources.list.d/*)
  apt-config dump | grep -E '^Acquire::(http|https|Check|Retries)' >"$work/apt.conf" || true
  timeout 600 unshare --mount mmdebstrap --quiet --variant=minbase --aptopt="$work/apt.conf" \
    bookworm "$work/bare" "${sources[@]}" </dev/null
}

# in_root ROOT SECONDS COMMAND: mounts live in a namespace of their own and end with the command,
# like every process it leaves behind.
in_root() {
  local root=$1 seconds=$2 command=$3
  timeout --kill-after=30 "$seconds" unshare --mount --pid --fork --kill-child ${isolate:-} bash -c '
    mount -t proc proc "$1/proc" && mkdir -p "$1/dev/shm" && mount -t tmpfs tmpfs "$1/dev/shm" &&
      exec chroot "$1" /usr/bin/env -i HOME=/root TERM=dumb LANG=C.UTF-8 \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        ${http_proxy:+"http_proxy=$http_proxy"} bash -c "$2"' in_root "$root" "$command" </dev/null
}

# machine NAME HOME: a copy of the bare root with the source in HOME/trc.
machine() {
  local root=$work/$1
  cp -a "$work/bare" "$root"
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
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
  [ "$took" -le 20 ] || fail "the second ./run took $took s"
}

# run_twice NAME HOME SHELL: the second time without a network.
run_twice() {
  local name=$1 home=$2 shell=$3 root=$work/$1
  step "$name: first ./run" in_root "$root" 2400 "$shell 'cd $home/trc && ./run'"
  check_first_run "$root$home"
  isolate=--net step "$name: second ./run" in_root "$root" 300 "$shell 'cd $home/trc && ./run'"
  check_second_run
}

step "bare Debian 12" make_root

machine root /root
run_twice root /root "bash -c"
[ -n "$run_only" ] || step "root: ./test" in_root "$work/root" 3600 "cd /root/trc && ./test"
rm -rf --one-file-system "$work/root"

machine user /home/turner
in_root "$work/user" 300 "apt-get -q update && apt-get -q -y install --no-install-recommends sudo &&
  useradd --shell /bin/bash turner && chown -R turner: /home/turner &&
  echo 'turner ALL=(ALL) NOPASSWD: ALL' >/etc/sudoers.d/turner" >"$work/user.log" 2>&1 ||
  { cat "$work/user.log"; fail "no user with sudo"; }
run_twice user /home/turner "su - turner -c"

echo "Fresh machine: all steps passed"
