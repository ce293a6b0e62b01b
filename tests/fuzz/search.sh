#!/usr/bin/env bash
# Searches for an input that breaks a fuzz target.
# Usage: search.sh <fuzz target> <scratch folder> <corpus folder>…
#
# Inputs worth keeping, and what broke the target, stay in the scratch folder; the corpus in the
# source tree is only read. The seed is printed by libFuzzer.
set -euo pipefail
target=$1 scratch=$2
shift 2
mkdir -p "$scratch/found" "$scratch/broken"
exec "$target" -max_total_time="${TRC_FUZZ_SECONDS:-60}" -max_len=4096 -timeout=20 \
  -artifact_prefix="$scratch/broken/" "$scratch/found" "$@"
