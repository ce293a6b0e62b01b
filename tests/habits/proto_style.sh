#!/usr/bin/env bash
# buf lint with the rules of proto/buf.yaml. Where buf is not installed the test is skipped, but
# never in CI. Run from the top of the source tree.
set -euo pipefail

buf=.ci/node/node_modules/@bufbuild/buf-linux-$(uname -m | sed 's/x86_64/x64/')/bin/buf
if [ ! -x "$buf" ]; then
  echo "buf is not installed; ./test installs it where there is npm"
  [ "${CI:-}" = true ] && exit 1 || exit 77
fi
"$buf" lint proto
