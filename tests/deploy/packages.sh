#!/usr/bin/env bash
# packages.sh BUILD_FOLDER OUT: what is handed to others, from a whole build: the Debian packages, and
# the C++ client, below OUT/client.
set -euo pipefail

mkdir -p "$2"
out=$(readlink -f "$2")
(cd "$1" && cpack -B "$out")
rm -rf "$out/_CPack_Packages"
cmake --install "$1" --component client --prefix "$out/client"
