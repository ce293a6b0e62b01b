# Sourced by tests that need a whole machine: Debian 12 with systemd as its first process, in a
# container of systemd-nspawn. It lies in $work/machine and has loopback, but no network.

machine=$work/machine

# The root file system is made once a day and kept in build/deploy. What it is made of comes from
# this machine's package sources, which it inherits.
make_machine() {
  local archive=build/deploy/machine.tar sources
  if [ -z "$(find "$archive" -mtime -1 2>/dev/null)" ]; then
    mapfile -t sources < <(grep -lsE '^(deb |Suites:).*[[:space:]]bookworm([[:space:]]|$)' \
      /etc/apt/sources.list /etc/apt/sources.list.d/*)
    apt-config dump | grep -E '^Acquire::(http|https|Check|Retries)' >"$work/apt.conf" || true
    mkdir -p build/deploy
    timeout 900 unshare --mount mmdebstrap --quiet --format=tar --variant=minbase \
      --aptopt="$work/apt.conf" --include=systemd,systemd-sysv,dbus,procps \
      bookworm "$archive.new" "${sources[@]}" </dev/null
    mv "$archive.new" "$archive"
  fi
  mkdir "$machine"
  tar -x -C "$machine" -f "$archive"
  # What is installed later inside comes from the archive apt keeps: there is no network then.
  rm -f "$machine"/etc/apt/apt.conf.d/*clean*
  printf 'quiet "2";\nDpkg::Use-Pty "0";\n' >"$machine/etc/apt/apt.conf.d/quiet"
  mkdir -p "$machine/check"
  in_machine "apt-get -q update"
  say "a machine with Debian $(cat "$machine/etc/debian_version")"
}

# nspawn OPTION… COMMAND…: without a trace in this machine's own service manager, if it has one.
nspawn() {
  systemd-nspawn --quiet --directory="$machine" --register=no --keep-unit --link-journal=no \
    --machine="trc-$$" --bind-ro="$PWD:/src" "$@" </dev/null
}

# in_machine COMMAND: with the network of this machine and without starting the system.
in_machine() {
  nspawn --as-pid2 --pipe --resolv-conf=copy-host --setenv=DEBIAN_FRONTEND=noninteractive \
    ${http_proxy:+--setenv=http_proxy="$http_proxy"} --chdir=/src \
    timeout 600 bash -ec "$1" >"$work/in_machine.log" 2>&1 ||
    { cat "$work/in_machine.log"; fail "in the machine: $1"; }
}

# boot SECONDS SCRIPT: starts the system, which runs the script in the source tree and stops. Fails
# unless the script has come to its end.
boot() {
  rm -rf "$machine"/check/*
  cp "$2" "$machine/check/script"
  cp tests/deploy/inside.sh "$machine/check/"
  cat >"$machine/etc/systemd/system/check.service" <<'UNIT'
[Unit]
After=multi-user.target
[Service]
Type=oneshot
WorkingDirectory=/src
Environment=HOME=/root DEBIAN_FRONTEND=noninteractive
ExecStart=/bin/bash /check/inside.sh
ExecStopPost=/bin/systemctl --no-block poweroff
StandardOutput=append:/check/output
StandardError=inherit
[Install]
WantedBy=default.target
UNIT
  ln -sf ../check.service "$machine/etc/systemd/system/multi-user.target.wants/check.service"
  timeout --kill-after=10 "$1" systemd-nspawn --quiet --directory="$machine" --boot --register=no \
    --keep-unit --link-journal=no --machine="trc-$$" --private-network --bind-ro="$PWD:/src" \
    </dev/null >"$work/console" 2>&1 || true
  cat "$machine/check/output" 2>/dev/null || cat "$work/console"
  [ -e "$machine/check/done" ] || fail "the machine did not come to the end of ${2##*/}"
}
