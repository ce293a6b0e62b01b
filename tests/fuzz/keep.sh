#!/usr/bin/env bash
# Adds what a search has found to the archive of minimised inputs of a target.
# Usage: keep.sh <fuzz target> <program | session | request | …> <folder of finds>
set -euo pipefail
target=$(readlink -f "$1")
corpus=$(dirname "$(readlink -f "$0")")/corpus
archive=$corpus/$2.tar.xz
found=$(readlink -f "$3")

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/kept" "$scratch/all"
[ ! -f "$archive" ] || tar -C "$scratch/all" -xJf "$archive"
"$target" -merge=1 "$scratch/kept" "$corpus/$2" "$scratch/all" "$found"
# Named regressions stay files of their own.
for named in "$corpus/$2"/*; do
  rm -f "$scratch/kept/$(sha1sum "$named" | cut -d' ' -f1)"
done
tar -C "$scratch/kept" --sort=name --owner=0 --group=0 --numeric-owner --mtime=@0 -cJf "$archive" .
