#!/usr/bin/env bash
# The tables of options and diagnostics in proto/README.md are those the service answers with.
#   reference_tables.sh TRC [--fix]      TRC: the built command-line client
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

trc=${1:?usage: reference_tables.sh TRC [--fix]}
expected=$(mktemp)
trap 'rm -f "$expected"' EXIT

while IFS= read -r line; do
  if [[ $line =~ ^'<!-- table: '([a-z]+)' -->'$ ]]; then
    printf '%s\n\n' "$line"
    "$trc" info --markdown "${BASH_REMATCH[1]}"
    printf '\n'
    inside=yes
  elif [ "$line" = '<!-- end -->' ]; then
    inside=
  fi
  [ -n "${inside:-}" ] || printf '%s\n' "$line"
done <proto/README.md >"$expected"

if [ "${2:-}" = --fix ]; then
  cp "$expected" proto/README.md
else
  diff -u proto/README.md "$expected" || {
    echo "proto/README.md is out of date: tests/habits/reference_tables.sh TRC --fix" >&2
    exit 1
  }
fi
