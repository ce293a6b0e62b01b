#!/usr/bin/env bash
# Documents have lines of at most 100 characters, but for tables and what is shown as it stands;
# README.md has at most 150 lines. Run from the top of the source tree.
set -euo pipefail
export LC_ALL=C.UTF-8

failed=0
while IFS= read -r -d '' document; do
  if sed '/^ *```/,/^ *```/s/.*//; /^|/s/.*//' "$document" |
    grep -nE '^.{101}' | sed "s|^|$document:|" | cut -c1-100 | grep . >&2; then
    failed=1
  fi
done < <(find README.md client core deploy proto server tests -name '*.md' -not -path '*/node_modules/*' -print0)
[ "$failed" -eq 0 ] || echo 'longer than 100 characters' >&2

if [ "$(wc -l <README.md)" -gt 150 ]; then
  echo 'README.md has more than 150 lines' >&2
  failed=1
fi
[ "$failed" -eq 0 ]
