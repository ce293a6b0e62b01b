#!/usr/bin/env bash
# The image for arm64, cross compiled, and its programs run under user-mode emulation.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/engine.sh

trc=$bin/trc
arm=localhost/trcd:arm64
load_image arm64 $arm
[ "$(podman inspect --format '{{.Architecture}}' $arm)" = arm64 ] || fail "the image is for another machine"
root=$(podman image mount $arm)
at_exit podman image unmount $arm
for file in "$root"/usr/bin/tr* "$root"/usr/lib/aarch64-linux-gnu/*; do
  readelf -h "$file" | grep 'Machine: *AArch64' >/dev/null || fail "$file is not for arm64"
done
python3 tests/deploy/sbom.py "$root" "$($trc --version | cut -d' ' -f2)" || fail "the bill of materials"

emulated() { program=$1; shift; qemu-aarch64-static -L "$root" "$root/usr/bin/$program" "$@"; }
for sample in client/samples/*.nc; do
  "$trc" compensate "$sample" -o "$work/here" || fail "$sample is refused"
  emulated trc compensate "$sample" -o "$work/there" || fail "$sample is refused on arm64"
  cmp "$work/here" "$work/there" || fail "$sample differs on arm64"
done

qemu-aarch64-static -L "$root" "$root/usr/bin/trcd" --listen 127.0.0.1:0 >"$work/log" 2>&1 &
server=$!
at_exit kill $server
wait_until 60 grep -q '"started"' "$work/log" || fail "trcd does not start: $(cat "$work/log")"
service=127.0.0.1:$(sed -n 's/.*"ports":"\([0-9]*\)".*/\1/p' "$work/log")
"$trc" health --server "$service" --timeout-s 30 >/dev/null || fail "trcd does not serve"
"$trc" compensate client/samples/bracket.nc -o "$work/here" || fail "bracket.nc is refused"
"$trc" compensate client/samples/bracket.nc --server "$service" -o "$work/there" || fail "no answer"
cmp "$work/here" "$work/there" || fail "the answer of the server differs"
kill $server
wait $server || fail "trcd ended with $?"
say "arm64 under emulation: same bytes as here, served to a client of amd64, ended with 0"
