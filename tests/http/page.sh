#!/usr/bin/env bash
# The page in a browser: page.sh BUILD_FOLDER. Where there is no npm or no chromium the test is
# skipped, but never in CI.
set -euo pipefail
if [ ! -d .ci/node/node_modules/playwright-core ] || [ ! -x /usr/bin/chromium ]; then
  echo "playwright-core or chromium is not installed; ./test installs them where there is npm"
  [ "${CI:-}" = true ] && exit 1 || exit 77
fi
exec node tests/http/page_test.mjs "$@"
