#!/usr/bin/env bash
# strangers.sh BARE PACKAGES [NAME …]: somebody who has never seen this, once for each language: from an
# empty folder on a Debian 12 to the first compensated contour, in less than five minutes with all that is
# installed on the way. BARE is a bare root file system, which stays as it is; PACKAGES is what
# packages.sh has made. Without names all of strangers/*.sh.
#
# Needs root and the network. Each script of strangers runs in /root/empty, which holds part.nc, with
# the packages in /packages and the source tree in /trc, and writes part_g40.nc. What its first line
# names is what somebody who works in that language has already.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
. tests/deploy/root.sh

bare=$1
packages=$2
shift 2
names=("$@")
[ ${#names[@]} -gt 0 ] ||
  mapfile -t names < <(cd tests/deploy/strangers && printf '%s\n' *.sh | sed 's/\.sh$//')
most_seconds=300

work=$(mktemp -d "${TMPDIR:-/tmp}/strangers.XXXXXX")
trap 'rm -rf --one-file-system "$work"' EXIT
fail() {
  echo "error: $*" >&2
  exit 1
}

cat >"$work/part.nc" <<'NC'
G17 G90 G71 G26
G0 X-20 Y-20
G41 G1 X0 Y0 F500
Y40
X60
Y0
X0
G40 X-20 Y-20
M30
NC
# What the rules say: one tool radius beside the contour, around its corners.
cat >"$work/expected" <<'NC'
G17 G90 G71
G0 X-20 Y-20
G01 X-5 Y0 F500
G01 X-5 Y40
G02 X0 Y45 I5 J0
G01 X60 Y45
G02 X65 Y40 I0 J-5
G01 X65 Y0
G02 X60 Y-5 I-5 J0
G01 X0 Y-5
G01 X-20 Y-20
M30
NC

# inside SECONDS COMMAND: in the root of the one whose turn it is; what it says where it fails.
inside() {
  in_root "$root" "$1" "export DEBIAN_FRONTEND=noninteractive && $2" >"$work/log" 2>&1 ||
    { tail -n 50 "$work/log" && false; }
}

for name in "${names[@]}"; do
  root=$work/$name
  copy_root "$bare" "$root"
  mkdir -p "$root/packages" "$root/trc" "$root/root/empty"
  cp -r "$packages/." "$root/packages/"
  git archive HEAD | tar -x -C "$root/trc"
  cp "$work/part.nc" "$root/root/empty/"
  # A registry behind a proxy may have a certificate that this machine alone knows.
  cp /etc/ssl/certs/ca-certificates.crt "$root/certificates.pem"
  has=$(sed -n '1s/^# has: //p' "tests/deploy/strangers/$name.sh")
  inside 900 "apt-get -q update && apt-get -q install -y --no-install-recommends $has" ||
    fail "$name: $has cannot be installed"
  start=$SECONDS
  inside $most_seconds "cd /root/empty && bash -euo pipefail /trc/tests/deploy/strangers/$name.sh" ||
    fail "$name has no contour after $((SECONDS - start)) s"
  took=$((SECONDS - start))
  diff "$work/expected" "$root/root/empty/part_g40.nc" || fail "$name: another contour"
  echo "$name: the first contour after $took s"
  rm -rf --one-file-system "$root"
done
