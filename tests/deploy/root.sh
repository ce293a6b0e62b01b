# Sourced by tests that need a bare Debian 12: a root file system, and commands that run in a copy.

# Bounds of time are those of a machine of two cores that does nothing else. Where it does,
# TRC_FRESH_PATIENCE=3 allows three times as much.
allowed() {
  echo $(($1 * ${TRC_FRESH_PATIENCE:-1}))
}

# make_root FOLDER CONFIGURATION: from this machine's package sources, which it inherits. In a mount
# namespace of its own, so that an interrupted run leaves nothing mounted.
make_root() {
  local sources
  mapfile -t sources < <(grep -lsE '^(deb |Suites:).*[[:space:]]bookworm([[:space:]]|$)' \
    /etc/apt/sources.list /etc/apt/sources.list.d/*)
  apt-config dump | grep -E '^Acquire::(http|https|Check|Retries)' >"$2" || true
  timeout "$(allowed 600)" unshare --mount mmdebstrap --quiet --variant=minbase --aptopt="$2" \
    bookworm "$1" "${sources[@]}" </dev/null
}

# copy_root BARE ROOT: one that finds its way into the network.
copy_root() {
  cp -a "$1" "$2"
  cp /etc/resolv.conf /etc/hosts "$2/etc/"
}

# in_root ROOT SECONDS COMMAND: mounts live in a namespace of their own and end with the command,
# like every process it leaves behind. `isolate=--net`: without a network.
in_root() {
  local root=$1 seconds command=$3
  seconds=$(allowed "$2")
  timeout --kill-after=30 "$seconds" unshare --mount --pid --fork --kill-child ${isolate:-} bash -c '
    mount -t proc proc "$1/proc" && mkdir -p "$1/dev/shm" "$1/dev/pts" &&
      mount -t tmpfs tmpfs "$1/dev/shm" &&
      mount -t devpts -o newinstance,ptmxmode=0666 devpts "$1/dev/pts" &&
      ln -sf pts/ptmx "$1/dev/ptmx" &&
      exec chroot "$1" /usr/bin/env -i HOME=/root TERM=dumb LANG=C.UTF-8 \
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        ${http_proxy:+"http_proxy=$http_proxy"} bash -c "$2"' in_root "$root" "$command" </dev/null
}
