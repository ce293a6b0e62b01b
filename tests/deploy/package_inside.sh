# The checks of package_test.sh, inside. `readme` is what deploy/README.md says.
next=/root/next.deb
package=$(echo /src/build/release/trcd_0.1.0-1_*.deb)
installed() { dpkg-query --showformat '${db:Status-Status} ${Version}' --show trcd; }
compensates() {
  trc compensate /tmp/part.nc --server "$socket" -o /tmp/there && cmp /tmp/here /tmp/there
}

readme
slow_program 1 >/tmp/part.nc
trc compensate /tmp/part.nc -o /tmp/here
[ "$(installed)" = 'installed 0.1.0-1' ] || fail "$(installed)"
dpkg --verify trcd || fail "files differ from the package"
is_serving && compensates || fail "the installed service does not answer"
[ "$(systemctl is-enabled trcd)" = enabled ] || fail "does not start with the machine"
[ "$(stat -c %U "/proc/$(pid)")" = trcd ] || fail "runs as another user"
say "installed and serving"

# Upgraded in the middle of a stream, with a configuration that was changed.
sed -i '$a max-streams = 999' /etc/trcd/trcd.toml
systemctl restart trcd
key=$(sha256sum /var/lib/trcd/resume.key)
trc compensate <(slowly=yes slow_program 6) --server "$socket" -o /tmp/upgraded &
client=$!
sleep 2
before=$(pid)
apt-get install -y "$next" || fail "not upgraded"
[ "$(installed)" = 'installed 0.1.0-2' ] || fail "$(installed)"
wait_until 20 is_another "$before" && compensates || fail "the upgraded service does not answer"
wait "$client" || fail "the upgrade lost a stream"
slow_program 6 >/tmp/long.nc
trc compensate /tmp/long.nc -o /tmp/long
cmp /tmp/long /tmp/upgraded || fail "the upgrade changed a path"
grep -qx 'max-streams = 999' /etc/trcd/trcd.toml || fail "the upgrade took the configuration back"
[ "$key" = "$(sha256sum /var/lib/trcd/resume.key)" ] || fail "the upgrade changed the key"
say "upgraded in the middle of a stream"

# An administrator who does not want it to start with the machine is heard.
systemctl disable trcd
apt-get install -y --reinstall "$next"
[ "$(systemctl is-enabled trcd)" = disabled ] || fail "a reinstallation has enabled it"
systemctl enable trcd

apt-get remove -y trcd
[ "$(installed)" = 'config-files 0.1.0-2' ] || fail "$(installed)"
! pgrep -x trcd || fail "removed, but runs"
[ -e /etc/trcd/trcd.toml ] && [ -e /var/lib/trcd/resume.key ] || fail "a removal took the configuration"
apt-get install -y "$package"
is_serving && compensates || fail "does not answer when installed again"
[ "$(systemctl is-enabled trcd)" = enabled ] || fail "not enabled when installed again"
[ "$key" = "$(sha256sum /var/lib/trcd/resume.key)" ] || fail "another key when installed again"
say "removed and installed again"

apt-get purge -y trcd
! dpkg-query --show trcd 2>/dev/null | grep . || fail "$(installed)"
! pgrep -x trcd || fail "purged, but runs"
for left in /etc/trcd /var/lib/trcd /run/trcd /usr/bin/trcd /usr/share/doc/trcd \
  /lib/systemd/system/trcd.service /etc/systemd/system/trcd.service \
  /etc/systemd/system/multi-user.target.wants/trcd.service; do
  [ ! -e "$left" ] && [ ! -L "$left" ] || fail "a purge has left $left"
done
! systemctl cat trcd.service 2>/dev/null || fail "systemd still knows it"
say "purged"
