#!/usr/bin/env bash
# Connect by its authors' client: connect.sh BUILD_FOLDER. Where there is no npm the test is skipped,
# but never in CI.
set -euo pipefail
if [ ! -d .ci/node/node_modules/@connectrpc/connect-web ]; then
  echo "@connectrpc/connect-web is not installed; ./test installs it where there is npm"
  [ "${CI:-}" = true ] && exit 1 || exit 77
fi
exec node tests/http/connect_test.mjs "$@"
