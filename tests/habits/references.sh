#!/usr/bin/env bash
# Every "rule n.m" and every D-nn that is cited has its place in core/doc, every decision is named
# in the code that depends on it, and nothing cites a specification that is not here.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."

cited() {  # cited PATTERN: what of it stands in the files on standard input
  xargs -0 grep -ohE "$1" | sort -u
}
everything() {
  find core proto server client tests deploy README.md \
    \( -name '*.h' -o -name '*.cpp' -o -name '*.proto' -o -name '*.md' -o -name '*.txt' -o \
       -name '*.expected' \) \
    -not -path '*/node_modules/*' -not -path '*/corpus/*' -print0
}
code() {
  find core proto server client \( -name '*.h' -o -name '*.cpp' -o -name '*.proto' \) -print0
}
missing=0
expect() {  # expect SET OF SET WHAT
  local left
  left=$(comm -23 "$1" "$2")
  [ -z "$left" ] || { echo "$3:" $left >&2; missing=1; }
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
{
  sed -nE 's/^([0-9]+\.[0-9]+) .*/\1/p' core/doc/rules.md
  sed -nE 's/^## ([0-9]+) .*/\1/p' core/doc/rules.md
} | sort -u >"$scratch/rules"
sed -nE 's/^(\| |\* \*\*)(D-[0-9]{2,}) .*/\2/p' core/doc/decisions.md | sort -u >"$scratch/decisions"

everything | cited '\brules? [0-9]+(\.[0-9]+)?' | sed -E 's/rules? //' | sort -u >"$scratch/rules_cited"
everything | cited '\bD-[0-9]{2,}\b' >"$scratch/decisions_cited"
code | cited '\bD-[0-9]{2,}\b' >"$scratch/decisions_coded"

expect "$scratch/rules_cited" "$scratch/rules" 'cited, but not in core/doc/rules.md'
expect "$scratch/decisions_cited" "$scratch/decisions" 'cited, but not in core/doc/decisions.md'
expect "$scratch/decisions" "$scratch/decisions_coded" 'in core/doc/decisions.md, but named by no code'
if everything | xargs -0 grep -niE '\bspec(ification)?\.? (section )?[0-9]|\bsection [0-9]' >&2; then
  echo 'a section of a specification is cited: rules are those of core/doc/rules.md' >&2
  missing=1
fi
[ "$missing" -eq 0 ]
