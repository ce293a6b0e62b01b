#!/usr/bin/env bash
# Searches for an input that breaks a fuzz target.
# Usage: search.sh <fuzz target> <scratch folder> <corpus folder>…
#
# Inputs worth keeping, and what broke the target, stay in the scratch folder; the corpus in the
# source tree is only read. The seed is printed by libFuzzer. What was found goes into the archive of
# the target, as few and as small files as cover the same, by
#   tests/fuzz/keep.sh <fuzz target> <name of the archive> <scratch folder>/found
set -euo pipefail
target=$1 scratch=$2
shift 2
mkdir -p "$scratch/found" "$scratch/broken"

# The words of the messages: fields as JSON has them, and the values of enums.
proto=$(dirname "$(readlink -f "$0")")/../../proto/trc/v1
grep -ohE '\b[a-zA-Z_0-9]+ = [0-9]+;' "$proto"/*.proto | sed 's/ = .*//' |
  sed -E '/^[a-z]/{s/_([a-z0-9])/\U\1/g;s/$/":/};s/^/"/;/[A-Z]$/s/$/"/;s/"/\\"/g;s/.*/"&"/' |
  sort -u >"$scratch/words"

# Keeping count of rare features would take three quarters of the time.
exec "$target" -max_total_time="${TRC_FUZZ_SECONDS:-60}" -max_len=4096 -timeout=20 -entropic=0 \
  -rss_limit_mb=1024 -malloc_limit_mb=256 -dict="$scratch/words" \
  -artifact_prefix="$scratch/broken/" "$scratch/found" "$@"
