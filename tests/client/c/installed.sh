#!/usr/bin/env bash
# installed.sh PREFIX TRC: from an empty folder to the first compensated contour with what is installed
# below PREFIX alone: the program of client/c/README.md says what stands there, and that of
# client/examples/c gives the bytes of the command line TRC.
set -euo pipefail

prefix=$1
trc=$2
top=$PWD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "error: $*" >&2; exit 1; }

# block LANGUAGE: the first such block of the README.
block() { awk -v mark="\`\`\`$1" '$0 == mark {inside=1; next} /^```$/ {if (inside) exit} inside' client/c/README.md; }
block c >"$work/contour.c"
block cmake >"$work/CMakeLists.txt"
block text >"$work/expected"
cp client/examples/c/compensate.c "$work/"
cp client/samples/bracket.nc "$work/"

folder=$(dirname "$(find "$prefix" -name trc.pc)")
! grep -rlF -e "$top" -e "$(dirname "$trc")" "$folder" "$folder/../cmake/libtrc" || fail "the installed files name the tree they came from"
export PKG_CONFIG_PATH=$folder
LD_LIBRARY_PATH=$(pkg-config --variable=libdir trc)
export LD_LIBRARY_PATH
cd "$work"
for program in contour compensate; do
  # As the README says, and as strictly as C99 has it.
  strict=(-std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
  # shellcheck disable=SC2046
  cc "${strict[@]}" $program.c $(pkg-config --cflags --libs trc) -o $program
done
readelf -d contour | grep -F '[libtrc.so.0]' >/dev/null || fail "not linked by its soname"

./contour | diff expected - || fail "the README says something else"
cmake -G Ninja -S . -B build "-DCMAKE_PREFIX_PATH=$prefix" >messages && cmake --build build >>messages ||
  fail "not found by CMake: $(cat messages)"
./build/contour | diff expected - || fail "another answer when built by CMake"
./compensate bracket.nc >text
"$trc" compensate bracket.nc --server "" >by_trc 2>messages
cmp by_trc text
./compensate bracket.nc tool_radius=3 verify=enforce >text
cmp by_trc text  # the program says its own radius

printf 'N10 G1 X10 F100\nN20 G999\n' >bad.nc
code=0
./compensate bad.nc >text 2>messages || code=$?
[ "$code" = 1 ] && grep -q '^line 2: error 900002: ' messages || fail "exit code $code: $(cat messages)"
code=0
./compensate bracket.nc tool_radious=3 >text 2>messages || code=$?
[ "$code" = 2 ] && grep -q tool_radius messages || fail "exit code $code: $(cat messages)"

if command -v valgrind >/dev/null; then
  for call in ./contour "./compensate bracket.nc" "./compensate bad.nc" "./compensate bad.nc x=1"; do
    code=0
    # shellcheck disable=SC2086
    valgrind -q --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite \
      --error-exitcode=99 $call >text 2>messages || code=$?
    [ "$code" != 99 ] || fail "valgrind of $call: $(cat messages)"
  done
fi
