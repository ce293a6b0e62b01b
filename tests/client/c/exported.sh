#!/usr/bin/env bash
# exported.sh LIBRARY HEADER: the library exports what the header declares and nothing else, under
# its version, and needs no gRPC.
set -euo pipefail

declared=$(grep -E '^TRC_API ' "$2" | sed -E 's/.*[ *](trc_[a-z_]+)\(.*/\1@@TRC_0/' | sort)
exported=$(nm -D --defined-only "$1" | awk '$2 != "A" { print $3 }' | sort)
diff <(echo "$declared") <(echo "$exported") || { echo "exported is not what is declared" >&2; exit 1; }
readelf -d "$1" >"${TMPDIR:-/tmp}/exported.$$"
trap 'rm -f "${TMPDIR:-/tmp}/exported.$$"' EXIT
grep -qF 'soname: [libtrc.so.0]' "${TMPDIR:-/tmp}/exported.$$" || { echo "another soname" >&2; exit 1; }
if grep -F NEEDED "${TMPDIR:-/tmp}/exported.$$" | grep -E 'grpc|absl|gpr|ssl'; then
  echo "the library needs gRPC" >&2
  exit 1
fi
