#!/usr/bin/env bash
# Equal sources and packages give an equal image: it is built again without a cache.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/engine.sh

load_base
load_image
again=localhost/again
# Of the commit the first one was built from: the programs name it.
commit=$(podman inspect --format '{{index .Labels "org.opencontainers.image.revision"}}' "$image")
command=$(readme_commands Container | sed "s/\$(git rev-parse[^)]*)/$commit/; s#-t localhost/trcd#--no-cache -t $again#")
grep -q -- "COMMIT=\"$commit\" --no-cache -t $again " <<<"$command" || fail "the command of the page is not as expected"
say "building again"
eval "$command" >"$work/build.log" 2>&1 </dev/null || { tail -30 "$work/build.log" >&2; fail "does not build"; }

layers() { podman inspect --format '{{range .RootFS.Layers}}{{println .}}{{end}}' "$1"; }
if [ "$(layers "$image")" != "$(layers $again)" ]; then
  first=$(podman image mount "$image")
  second=$(podman image mount $again)
  diff -rq --no-dereference "$first" "$second" >&2 || true
  podman image unmount "$image" $again >/dev/null
  fail "two builds of the same sources differ: $(layers "$image") and $(layers $again)"
fi

# Of layer, settings and labels together. Docker's format has a random host name in it.
digest() { # image, name of a folder
  podman save --quiet --format oci-dir -o "$work/$2" "$1" >/dev/null
  sed -n 's/.*"digest":"\(sha256:[0-9a-f]*\)".*/\1/p' "$work/$2/index.json"
}
first=$(digest "$image" first) second=$(digest $again second)
[ -n "$first" ] && [ "$first" = "$second" ] || fail "layers are equal, but not the images: $first and $second"
say "two builds without a cache are $first"
