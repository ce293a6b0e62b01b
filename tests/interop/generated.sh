#!/usr/bin/env bash
# What others generate from the protos has names as they are usual there: Java and C#, by protoc alone;
# Go needs a plugin, so that its option is looked at.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "error: $*" >&2; exit 1; }

protos=(proto/trc/v1/*.proto)
mkdir "$work/java" "$work/csharp"
protoc -I proto --java_out="$work/java" --csharp_out="$work/csharp" "${protos[@]}"
# A class of its own for each message.
grep -qx 'package trc.v1;' "$work/java/trc/v1/ProgramSetup.java" || fail "no Java class ProgramSetup"
[ "$(grep -lx 'namespace Trc.V1 {' "$work"/csharp/*.cs | wc -l)" -eq ${#protos[@]} ] ||
  fail "another namespace in C#"
without=$(grep -L '^option go_package = "trc/v1;trcv1";$' "${protos[@]}" || true)
[ -z "$without" ] || fail "no package of Go: $without"
