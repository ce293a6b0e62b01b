#!/usr/bin/env bash
# install.sh BUILD_FOLDER TRC: what `cmake --install` puts below a prefix is enough for a program in C.
set -euo pipefail

prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
for component in library development; do
  cmake --install "$1" --component $component --prefix "$prefix" >/dev/null
done
tests/client/c/installed.sh "$prefix" "$2"
