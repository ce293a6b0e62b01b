# Sourced after lib.sh by the tests that run containers: an engine of their own, whose images,
# containers and settings lie in $work, and the image of this source tree.
#
# No registry is asked. In place of the official Debian image stands one made from Debian packages,
# under the same name. Images are kept in build/deploy and made again when they are old or the source
# has changed.

export CONTAINERS_CONF=$work/containers.conf
export CONTAINERS_STORAGE_CONF=$work/storage.conf
export CONTAINERS_REGISTRIES_CONF=$work/registries.conf
export BUILDAH_ISOLATION=chroot
base=docker.io/library/debian:bookworm-slim
image=localhost/trcd:latest
kept=build/deploy

# An engine asks for more file descriptors and processes than a machine without CAP_SYS_RESOURCE
# may give; crun does not start where cgroups v1 and v2 stand side by side.
cat >"$CONTAINERS_CONF" <<TEXT
[containers]
default_ulimits = ["nofile=4096:4096", "nproc=4096:4096"]
[engine]
runtime = "runc"
cgroup_manager = "cgroupfs"
events_logger = "file"
[network]
network_backend = "netavark"
TEXT
cat >"$CONTAINERS_STORAGE_CONF" <<TEXT
[storage]
driver = "overlay"
graphroot = "$work/storage"
runroot = "$work/storage-run"
TEXT
cat >"$CONTAINERS_REGISTRIES_CONF" <<TEXT
[[registry]]
location = "docker.io"
blocked = true
TEXT

end_engine() {
  podman pod rm --all --force --time 1
  podman rm --all --force --time 1
  podman network prune --force
  podman unmount --all
  # With what a build that was killed has left mounted.
  umount --recursive "$work/storage/overlay"
}
at_exit end_engine

# What published ports and bridges leave behind: packet filter tables and forwarding.
at_exit "$(printf 'sysctl -w net.ipv4.ip_forward=%s' "$(cat /proc/sys/net/ipv4/ip_forward)")"
tables_before=$(nft list tables | sort)
restore_tables() {
  local table
  nft list tables | sort | while read -r table; do
    grep -qxF "$table" <<<"$tables_before" || nft delete "$table"
  done
}
at_exit restore_tables

make_base() {
  local sources tar=$kept/base.tar new=$kept/base.new.tar
  [ -z "$(find "$tar" -mtime -7 2>/dev/null)" ] || return 0
  say "making a base image from Debian packages"
  mapfile -t sources < <(grep -lsE '^(deb |Suites:).*[[:space:]]bookworm([[:space:]]|$)' \
    /etc/apt/sources.list /etc/apt/sources.list.d/*)
  mkdir -p "$kept"
  # shellcheck disable=SC2016  # $1 is for the hook
  timeout 600 unshare --mount mmdebstrap --quiet --variant=minbase \
    --dpkgopt='path-exclude=/usr/share/doc/*' --dpkgopt='path-include=/usr/share/doc/*/copyright' \
    --dpkgopt='path-exclude=/usr/share/man/*' --dpkgopt='path-exclude=/usr/share/locale/*' \
    --customize-hook='rm -rf "$1"/var/lib/apt/lists/* "$1"/var/cache/apt/*.bin' \
    bookworm "$new" "${sources[@]}" </dev/null || fail "no base image"
  mv "$new" "$tar"
}

load_base() {
  make_base
  podman import --quiet "$kept/base.tar" "$base" >/dev/null
}

# source_hash SECTION: the same for equal sources and the same commands, whatever their times.
source_hash() {
  { readme_commands "$1"; contents_of_sources; } | sha256sum | cut -c1-16
}
contents_of_sources() {
  find .ci/install .ci/packages .cmake .dockerignore CMakeLists.txt CMakePresets.json LICENSE \
    core proto server client deploy/container deploy/debian -type f ! -path '*/node_modules/*' -print0 |
    sort -z | xargs -0 sha256sum
}

# load_image [SECTION NAME]: an image of this source tree, built with the commands of deploy/README.md
# under SECTION, which call it NAME; the one for this machine without arguments.
load_image() {
  local section=${1:-Container} name=${2:-$image} archive
  archive=$kept/$section-$(source_hash "$section").tar
  if [ ! -s "$archive" ]; then
    load_base
    say "building $name"
    eval "$(readme_commands "$section")" >"$work/build.log" 2>&1 </dev/null ||
      { tail -30 "$work/build.log" >&2; fail "the image does not build"; }
    rm -f "$kept/$section"-*.tar
    podman save --quiet --format docker-archive -o "$archive" "$name"
  else
    podman load --quiet --input "$archive" >/dev/null
  fi
}

# memory_of PROCESS limit|peak: of its cgroup, in bytes; under cgroup v1 and v2.
memory_of() {
  local group file
  group=$(sed -n 's/^[0-9]*:memory://p' "/proc/$1/cgroup")
  if [ -n "$group" ]; then
    [ "$2" = limit ] && file=memory.limit_in_bytes || file=memory.max_usage_in_bytes
    cat "/sys/fs/cgroup/memory$group/$file"
  else
    [ "$2" = limit ] && file=memory.max || file=memory.peak
    cat "/sys/fs/cgroup$(sed -n 's/^0:://p' "/proc/$1/cgroup")/$file"
  fi
}
