#!/usr/bin/env bash
# Builds what is shipped and measures it: the performance table of tests/bench/README.md, in less than ten
# minutes. Options go to table.py; --help lists them.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
.ci/install build bench >&2
cmake --preset bench >/dev/null
cmake --build --preset bench --target trc trcd trc_bench trc_echo_server >&2
exec tests/bench/table.py "$@"
