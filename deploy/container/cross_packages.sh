#!/bin/sh
# cross_packages.sh LIST ARCHITECTURE: what a build for another architecture needs, from the group
# `build` of LIST: the libraries of that architecture, everything else of this machine's.
set -eu
sed -n 's/^build //p' "$1" | while read -r package; do
  case $package in
    g++) echo "g++-aarch64-linux-gnu binutils" ;;
    *-dev)
      # One package for all architectures has headers only.
      if apt-cache show --no-all-versions "$package" | grep -x 'Architecture: all' >/dev/null; then
        echo "$package"
      else
        echo "$package:$2"
      fi ;;
    *) echo "$package" ;;
  esac
done
