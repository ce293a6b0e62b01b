#!/usr/bin/env bash
# libraries.sh BUILD_FOLDER TRC TRCD: the packages libtrc0, libtrc-dev and python3-trc hold what they
# are for and nothing else, lintian is content, and what they unpack is enough for a program in C
# and for one in Python. Needs no root and installs nothing.
set -euo pipefail

for tool in dpkg-deb dpkg-shlibdeps; do
  command -v $tool >/dev/null || { echo "$tool is not installed; .ci/install deploy does"; exit 77; }
done
build=$1
trc=$2
trcd=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "error: $*" >&2; exit 1; }

(cd "$build" && cpack -B "$work/packages" -D "CPACK_COMPONENTS_ALL=library;development;python") \
  >"$work/log" 2>&1 || fail "not built: $(cat "$work/log")"
architecture=$(dpkg --print-architecture)
library=$work/packages/libtrc0_0.1.0-1_$architecture.deb
development=$work/packages/libtrc-dev_0.1.0-1_$architecture.deb
python=$work/packages/python3-trc_0.1.0-1_all.deb
if command -v lintian >/dev/null; then
  lintian --fail-on error,warning --tag-display-limit 0 --allow-root \
    "$library" "$development" "$python" || fail "lintian refuses a package"
fi

# contents PACKAGE: rights, owner and name of each file, with the target of links.
contents() {
  dpkg-deb --contents "$1" | awk '$6 !~ /\/$/ {print $1, $2, $6 ($7 == "->" ? " -> " $8 : "")}' |
    sort -k 3
}
folder=./usr/lib/$(cc -print-multiarch)
diff - <(contents "$library") <<LIST || fail "libtrc0 holds other files"
lrwxrwxrwx root/root $folder/libtrc.so.0 -> libtrc.so.0.1.0
-rw-r--r-- root/root $folder/libtrc.so.0.1.0
-rw-r--r-- root/root ./usr/share/doc/libtrc0/changelog.Debian.gz
-rw-r--r-- root/root ./usr/share/doc/libtrc0/copyright
-rw-r--r-- root/root ./usr/share/lintian/overrides/libtrc0
LIST
diff - <(contents "$development") <<LIST || fail "libtrc-dev holds other files"
-rw-r--r-- root/root ./usr/include/trc.h
-rw-r--r-- root/root $folder/cmake/libtrc/libtrcConfig.cmake
-rw-r--r-- root/root $folder/cmake/libtrc/libtrcConfigVersion.cmake
lrwxrwxrwx root/root $folder/libtrc.so -> libtrc.so.0
-rw-r--r-- root/root $folder/pkgconfig/trc.pc
-rw-r--r-- root/root ./usr/share/doc/libtrc-dev/changelog.Debian.gz
-rw-r--r-- root/root ./usr/share/doc/libtrc-dev/copyright
-rw-r--r-- root/root ./usr/share/lintian/overrides/libtrc-dev
LIST
# All modules of the source tree, and those of every message.
{
  (cd client/python/src/trc && printf '%s\n' *.py py.typed API.md)
  for proto in proto/trc/v1/*.proto; do
    name=v1/$(basename "$proto" .proto)_pb2
    printf '%s\n' "$name.py" "$name.pyi" "${name}_grpc.py"
  done
  echo v1/__init__.py
} | sort >"$work/modules"
contents "$python" | sed -n 's|.*/dist-packages/trc/||p' | sort | diff "$work/modules" - ||
  fail "python3-trc holds other modules"

depends() { dpkg-deb --field "$1" Depends; }
depends "$library" | grep -F libprotobuf32 >/dev/null || fail "libtrc0 does not depend on libprotobuf32"
! depends "$library" | grep -F grpc || fail "libtrc0 depends on gRPC"
[ "$(depends "$development")" = 'libtrc0 (= 0.1.0-1)' ] || fail "libtrc-dev: $(depends "$development")"
dpkg-deb --ctrl-tarfile "$library" | tar -xO ./shlibs | grep -x 'libtrc 0 libtrc0 (>= 0.1.0-1)' >/dev/null ||
  fail "what is linked with libtrc0 would not depend on it"
dpkg-deb --ctrl-tarfile "$library" | tar -xO ./triggers | grep -x 'activate-noawait ldconfig' >/dev/null ||
  fail "the loader would not find libtrc0"

for package in "$library" "$development" "$python"; do dpkg-deb --extract "$package" "$work/root"; done
tests/client/c/installed.sh "$work/root/usr" "$trc"

"$trc" compensate client/samples/bracket.nc --server "" >"$work/expected" 2>"$work/messages"
PYTHONPATH=$work/root/usr/lib/python3/dist-packages TRC_TRCD=$trcd PYTHONDONTWRITEBYTECODE=1 \
  /usr/bin/python3 -c 'import sys, trc
sys.stdout.write(trc.compensate(open("client/samples/bracket.nc").read()).text)' >"$work/actual"
cmp "$work/expected" "$work/actual"
