#!/usr/bin/env bash
# The defences of the programs and libraries given: position independent, nothing writable that need not be, no
# executable stack, checked stacks and string functions, and CET on x86. Of CET the code itself is
# looked at: the linker marks no program on Debian 12, whose own start code is without.
set -euo pipefail

fault=0
demand() { # what, pattern, text
  grep -Eq -- "$2" <<<"$3" || { echo "$program: no $1" >&2; fault=1; }
}

for program in "$@"; do
  headers=$(readelf -hlW "$program")
  demand "position independent code" 'Type: +DYN' "$headers"
  demand "read-only relocations" 'GNU_RELRO' "$headers"
  demand "stack without execution" 'GNU_STACK .* RW +0x' "$headers"
  demand "binding at start" 'BIND_NOW|FLAGS_1.*NOW' "$(readelf -dW "$program")"
  symbols=$(readelf -W --dyn-syms "$program")
  demand "stack protector" '__stack_chk_fail' "$symbols"
  demand "fortified functions" '__[a-z]+_chk' "$symbols"
  case $(uname -m) in
    x86_64)
      entry=main
      [[ $program != *.so* ]] || entry=trc_create
      demand "CET" endbr64 "$(objdump -d --disassemble=$entry "$program")" ;;
  esac
done
exit $fault
