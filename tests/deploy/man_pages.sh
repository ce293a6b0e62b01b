#!/usr/bin/env bash
# The manual pages name every option the programs have, and no other; of trcd the defaults too.
#
#   man_pages.sh TRC TRCD
set -euo pipefail

trc=$1
trcd=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for page in trc.1 trcd.8; do
  sed 's/\\-/-/g; s/\\f[BIR]//g' "deploy/debian/$page" >"$work/$page"
done
options() { grep -oE -- '--[a-z][a-z-]*[a-z]' | sort -u; }
compare() { # page, what the program has
  options <"$work/$1" >"$work/page"
  grep -vxF -e --help -e --version "$2" >"$work/has" || true
  grep -vxF -e --help -e --version "$work/page" | diff - "$work/has" >"$work/difference" ||
    { echo "deploy/debian/$1 (<) and the program (>) differ:"; cat "$work/difference"; exit 1; }
}

"$trcd" --help >"$work/trcd.help"
options <"$work/trcd.help" >"$work/trcd"
compare trcd.8 "$work/trcd"
# "--max-passive-blocks UINT:UINT in [1 - 1000000]=100 (Env:…" against "--max-passive-blocks N [100]".
sed -nE 's/^ *(--[a-z-]+) .*=([^ =]+) \(Env:.*/\1 \2/p' "$work/trcd.help" |
  grep -vE ' (\[\]|false)$' >"$work/defaults"
[ -s "$work/defaults" ]
while read -r option default; do
  grep -qE -- "^$option( .*)? \[$default\]$" "$work/trcd.8" ||
    { echo "deploy/debian/trcd.8 does not say $option [$default]"; exit 1; }
done <"$work/defaults"

"$trc" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p' >"$work/commands"
[ -s "$work/commands" ]
while read -r command; do
  grep -qxF ".B trc $command" "$work/trc.1" ||
    { echo "deploy/debian/trc.1 does not name trc $command"; exit 1; }
  # What follows the options is prose.
  "$trc" "$command" --help | sed -n '/^Options:/,/^$/p' | options
done <"$work/commands" | sort -u >"$work/trc" || { cat "$work/trc"; exit 1; }
# Options as they are declared: "Needs: --server" names one that is declared too.
compare trc.1 "$work/trc"
