#!/usr/bin/env bash
# Documents have lines of at most 100 characters, but for tables and what is shown as it stands;
# README.md has at most 150 lines. What comes later in a program or in time comes after, not behind,
# and a contour has a start, no begin. Run from the top of the source tree.
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

word='([GM][0-9]+|RL|RR|R0|RND|APPR|line [0-9{"+]|the (approach|end of the program)|a call)'
if find README.md client core deploy proto server tests -type f \
  -regex '.*\.\(md\|cpp\|h\|proto\|js\|ts\|py\|sh\|mjs\|1\|8\)' \
  -not -path '*/node_modules/*' -not -path tests/habits/prose.sh -print0 |
  xargs -0 grep -nE \
    "\\b([Bb]ehind|[Ii]n front of) $word|\\b([Tt]he|[Ii]ts|[Tt]heir|intended) begin( |[.,:;]|\$)" >&2; then
  echo 'write after, before or start' >&2
  failed=1
fi
[ "$failed" -eq 0 ]
