#!/usr/bin/env bash
# Equal sources and packages give an equal layer: the image built again without a cache.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/engine.sh

load_base
load_image
layers() { podman inspect --format '{{range .RootFS.Layers}}{{println .}}{{end}}' "$1"; }
# Of the commit the first one was built from: the programs name it.
commit=$(podman inspect --format '{{index .Labels "org.opencontainers.image.revision"}}' "$image")
command=$(readme_commands Container | sed "s/\$(git rev-parse[^)]*)/$commit/; s/-t localhost\/trcd/--no-cache -t localhost\/again/")
grep -q -- '--no-cache -t localhost/again' <<<"$command" || fail "the command of the page is not as expected"
say "building again"
eval "$command" >"$work/build.log" 2>&1 </dev/null || { tail -30 "$work/build.log" >&2; fail "does not build"; }

if [ "$(layers "$image")" != "$(layers localhost/again)" ]; then
  first=$(podman image mount "$image")
  second=$(podman image mount localhost/again)
  diff -rq --no-dereference "$first" "$second" >&2 || true
  podman image unmount "$image" localhost/again >/dev/null
  fail "two builds of the same sources differ: $(layers "$image") and $(layers localhost/again)"
fi
say "two builds without a cache have the layer $(layers "$image")"
