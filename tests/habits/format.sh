#!/usr/bin/env bash
# Fails at the first line that clang-format would write differently; `--fix` rewrites the files.
# Run from the top of the source tree.
set -euo pipefail

mode=(--dry-run --Werror --ferror-limit=1)
[ "${1:-}" != --fix ] || mode=(-i)

find core proto server client tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 -r -n 20 -P "$(nproc)" clang-format-14 "${mode[@]}"
