#!/usr/bin/env bash
# The Debian package: built and installed as deploy/README.md says, judged by lintian, upgraded,
# removed, installed again and purged on a machine of its own, with the service asked after each.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/machine.sh

readme_commands "Debian package" 1 >"$work/build"
bash -euo pipefail "$work/build" >"$work/build.log" 2>&1 || { cat "$work/build.log"; fail "not built"; }
package=build/release/trcd_0.1.0-1_$(dpkg --print-architecture).deb
[ -e "$package" ] || fail "no $package"
lintian --fail-on error,warning --tag-display-limit 0 --allow-root "$package" || fail "lintian refuses $package"
for field in libgrpc++1.51 libprotobuf32 libsystemd0; do
  dpkg-deb --field "$package" Depends | grep -cF "$field" >/dev/null || fail "does not depend on $field"
done
dpkg-deb --contents "$package" | awk '$6 !~ /\/$/ {print $1, $2, $6}' | sort -k 3 >"$work/contents"
cat >"$work/expected" <<'LIST'
-rw-r--r-- root/root ./etc/trcd/trcd.toml
-rw-r--r-- root/root ./lib/systemd/system/trcd.service
-rwxr-xr-x root/root ./usr/bin/trc
-rwxr-xr-x root/root ./usr/bin/trcd
-rw-r--r-- root/root ./usr/lib/sysusers.d/trcd.conf
-rw-r--r-- root/root ./usr/share/bash-completion/completions/trc
-rw-r--r-- root/root ./usr/share/doc/trcd/changelog.Debian.gz
-rw-r--r-- root/root ./usr/share/doc/trcd/copyright
-rw-r--r-- root/root ./usr/share/fish/vendor_completions.d/trc.fish
-rw-r--r-- root/root ./usr/share/lintian/overrides/trcd
-rw-r--r-- root/root ./usr/share/man/man1/trc.1.gz
-rw-r--r-- root/root ./usr/share/man/man8/trcd.8.gz
-rw-r--r-- root/root ./usr/share/zsh/vendor-completions/_trc
LIST
diff "$work/expected" "$work/contents" || fail "the package holds other files"
tests/deploy/libraries.sh build/release "$bin/trc" "$bin/trcd"
say "built: $(du -k "$package" | cut -f 1) kB, lintian is content"

make_machine
in_machine "apt-get install -y --download-only ./$package"
# The package under the next revision, to upgrade to.
mkdir "$work/next"
(cd build/release && cpack -B "$work/next" -D CPACK_DEBIAN_PACKAGE_RELEASE=2 >/dev/null)
cp "$work"/next/trcd_0.1.0-2_*.deb "$machine/root/next.deb"
{
  echo "readme() {"
  readme_commands "Debian package" 2
  echo "}"
  cat tests/deploy/package_inside.sh
} >"$work/script"
boot 300 "$work/script"
say "package: installed, upgraded, removed, installed again, purged"
