# The checks of systemd_test.sh, inside. `readme` is what deploy/README.md says.
cd /src
readme
is_serving || fail "the service does not answer"
say "installed and serving"

# Who it is and what it may.
of_process() { sed -n "s/^$1:[[:space:]]*//p" "/proc/$(pid)/status"; }
[ "$(stat -c %U "/proc/$(pid)")" = trcd ] || fail "runs as $(stat -c %U "/proc/$(pid)")"
for set in CapInh CapPrm CapEff CapBnd CapAmb; do
  [ "$(of_process $set)" = 0000000000000000 ] || fail "$set is $(of_process $set)"
done
[ "$(of_process NoNewPrivs)" = 1 ] || fail "may gain privileges"
[ "$(of_process Seccomp)" = 2 ] || fail "no filter of system calls"
seen_by_it() { nsenter --mount --target "$(pid)" "$@"; }
for place in /usr/bin /etc/trcd /home /boot /src; do
  mkdir -p "$place"
  ! seen_by_it touch "$place/x" 2>/dev/null || fail "$place is writable"
done
seen_by_it touch /var/lib/trcd/x && rm /var/lib/trcd/x
touch /home/file && ! seen_by_it test -e /home/file || fail "/home is visible"
say "confined"

# Who may connect: members of its group, and the port is another matter.
[ "$(stat -c '%A %U %G' /run/trcd)" = 'drwxr-x--- trcd trcd' ] || fail "$(stat -c '%A %U %G' /run/trcd)"
[ "$(stat -c '%A %U %G' /run/trcd/trcd.sock)" = 'srwxrwx--- trcd trcd' ] ||
  fail "$(stat -c '%A %U %G' /run/trcd/trcd.sock)"
[ "$(stat -c '%A %U %s' /var/lib/trcd/resume.key)" = '-rw------- trcd 32' ] || fail "the key is open"
useradd --no-create-home turner
as_turner() { setpriv --reuid turner --regid turner --init-groups trc health --server "$1"; }
! as_turner "$socket" >/dev/null 2>&1 || fail "a stranger reaches the socket"
as_turner 127.0.0.1:50051 >/dev/null || fail "a user does not reach the port"
usermod --append --groups trcd turner
as_turner "$socket" >/dev/null || fail "a member of the group does not reach the socket"
say "socket for the group"

slow_program 1 >/tmp/part.nc
trc compensate /tmp/part.nc -o /tmp/here
trc compensate /tmp/part.nc --server "$socket" -o /tmp/there
cmp /tmp/here /tmp/there || fail "the service gives another path"

# Killed in the middle of a stream: it comes back, and the stream goes on.
trc compensate <(slowly=yes slow_program 6) --server "$socket" -o /tmp/there &
client=$!
sleep 3
before=$(pid)
kill -9 "$before"
wait_until 20 is_another "$before" || fail "not restarted"
[ "$(of_unit NRestarts)" = 1 ] || fail "$(of_unit NRestarts) restarts"
wait "$client" || fail "the stream was lost with its server"
slow_program 6 >/tmp/part.nc
trc compensate /tmp/part.nc -o /tmp/here
cmp /tmp/here /tmp/there || fail "the resumed path is another one"
say "restarted after a kill, the stream went on"

# Hangs: systemd notices. The interval is shortened for the purpose.
[ "$(systemctl service-watchdogs)" = yes ] || fail "watchdogs are off"
[ "$(of_unit WatchdogUSec)" = 30s ] || fail "watchdog $(of_unit WatchdogUSec)"
mkdir -p /run/systemd/system/trcd.service.d
printf '[Service]\nWatchdogSec=3\n' >/run/systemd/system/trcd.service.d/watchdog.conf
systemctl daemon-reload && systemctl restart trcd
before=$(pid)
sleep 7
[ "$(pid)" = "$before" ] || fail "the watchdog ended a server that was well"
kill -STOP "$before"
wait_until 30 is_another "$before" || fail "the watchdog saw nothing"
journalctl --unit=trcd.service | grep -ci 'watchdog timeout' >/dev/null || fail "no word of the watchdog"
rm -r /run/systemd/system/trcd.service.d && systemctl daemon-reload
say "restarted after a hang"

# A new log level without a restart; a configuration with a fault changes nothing.
before=$(pid)
sed -i '$a log-level = "debug"' /etc/trcd/trcd.toml
systemctl reload trcd
has_reloaded() { journal | grep '"event":"reloaded"' | grep -c debug; }
wait_until 10 has_reloaded || fail "not reloaded"
sed -i '$d' /etc/trcd/trcd.toml
sed -i '$a max-streams = -1' /etc/trcd/trcd.toml
systemctl reload trcd
has_refused() { journal | grep -c reload_refused; }
wait_until 10 has_refused || fail "took a configuration with a fault"
[ "$(pid)" = "$before" ] && is_serving || fail "a reload ended the server"

# Such a configuration does not start, and is not tried again and again.
systemctl stop trcd
! systemctl start trcd || fail "started with a wrong configuration"
sleep 3
[ "$(of_unit ActiveState) $(of_unit ExecMainStatus)" = 'failed 2' ] ||
  fail "after a wrong configuration: $(of_unit ActiveState) $(of_unit ExecMainStatus)"
sed -i '$d' /etc/trcd/trcd.toml
systemctl reset-failed trcd && systemctl start trcd
say "reloaded, and refused a wrong configuration"

# Stopped in the middle of a stream: the stream ends well first.
trc compensate <(slowly=yes slow_program 6) --server "$socket" -o /tmp/there &
client=$!
sleep 3
systemctl stop trcd
wait "$client" || fail "the stream was cut off by a stop"
cmp /tmp/here /tmp/there || fail "the path of the drained stream is another one"
journal | grep '"event":"draining"' | tail -n 1 | grep -c '"streams":1' >/dev/null || fail "did not drain"
journal | grep '"event":"stopped"' | tail -n 1 | grep -c '"streams_cut_off":0' >/dev/null || fail "cut off"
[ "$(of_unit Result) $(of_unit ExecMainStatus)" = 'success 0' ] ||
  fail "ended with $(of_unit Result) $(of_unit ExecMainStatus)"
[ ! -e /run/trcd ] || fail "left /run/trcd behind"
say "drained"
