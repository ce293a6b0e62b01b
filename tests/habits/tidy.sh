#!/usr/bin/env bash
# clang-tidy over the sources of core, proto/wire, server and client: over all of them with
# TRC_TEST_LONG, else over those that differ from the last commit, and those of headers that do.
# Usage, from the top of the source tree: tidy.sh <scratch folder>
#
# The scratch folder keeps a build description of its own (one command for each file, no
# precompiled headers) and a mark for each source found clean, named by all that the verdict
# depends on: a second run checks only what has changed.
set -euo pipefail
work=$1

cmake -G Ninja -S . -B "$work" -D TRC_TESTS=OFF \
  -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON -D CMAKE_UNITY_BUILD=OFF >"$work.log" 2>&1 || { cat "$work.log"; exit 1; }

# The sources include generated headers.
ninja -C "$work" -t targets all | sed -n 's/^\(.*\.pb\.h\): .*/\1/p' |
  xargs -r ninja -C "$work" >"$work.log" 2>&1 || { cat "$work.log"; exit 1; }

mkdir -p "$work/clean"
common=$({
  cat .clang-tidy "$work/compile_commands.json"
  find core proto server client \( -name '*.h' -o -name '*.proto' \) -print0 | sort -z |
    xargs -0 sha256sum
} | sha256sum)

check() {
  local source=$1 work=$2 common=$3 mark
  mark="$work/clean/$( (echo "$common"; sha256sum "$source") | sha256sum | cut -c1-32)"
  [ ! -f "$mark" ] || return 0
  clang-tidy-14 --quiet -p "$work" "$source" 2>"$mark.err" && touch "$mark" ||
    { grep -v 'warnings generated' "$mark.err"; rm -f "$mark.err"; return 1; }
  rm -f "$mark.err"
}
export -f check

# Sources to check, of those on standard input.
due() {
  if [ -n "${TRC_TEST_LONG:-}" ] || ! git rev-parse -q --verify HEAD >/dev/null 2>&1; then
    cat
  else
    grep -Fxf <({ git diff --name-only HEAD; git ls-files --others --exclude-standard; } |
      sed -nE 's/\.(h|cpp)$/.cpp/p') || true
  fi
}

sed -n "s|^ *\"file\": \"$PWD/\(.*\)\".*|\1|p" "$work/compile_commands.json" |
  grep -E '^(core|proto/wire|server|client)/' | sort -u | due |
  xargs -P "$(nproc)" -I{} bash -c 'check "$@"' check {} "$work" "$common"
