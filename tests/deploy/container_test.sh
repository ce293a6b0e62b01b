#!/usr/bin/env bash
# The image: what is in it, how it runs, what it does under load and beyond its memory, how it ends.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/engine.sh
. tests/deploy/contours.sh

service=127.0.0.1:50051
trc=$bin/trc

load_image
id=$(podman inspect --format '{{.Id}}' "$image")

# --- what is in it ------------------------------------------------------------------------------
root=$(podman image mount "$image")
at_exit "podman image unmount $image"

for shell in sh bash dash busybox; do
  [ -z "$(find "$root" -name "$shell" ! -type d)" ] || fail "there is a $shell in the image"
done
[ -z "$(find "$root" -perm /6000)" ] || fail "a file of the image changes its user"
[ "$(find "$root" ! -user 0)" = "$root/var/lib/trcd" ] || fail "more than /var/lib/trcd is not root's"
[ -z "$(find "$root" -newermt '1970-01-02' ! -path "$root")" ] || fail "a time in the image is not reproducible"

compressed=$(podman save --format docker-archive "$image" | gzip -6 | wc -c)
[ "$compressed" -lt $((40 << 20)) ] || fail "the image takes $compressed bytes compressed"

python3 tests/deploy/sbom.py "$root" "$($trc --version | cut -d' ' -f2)" || fail "the bill of materials"
if command -v node >/dev/null && [ -d .ci/schemas/node_modules ]; then
  node tests/deploy/cyclonedx.js "$root/usr/share/doc/trcd/sbom.cdx.json" ||
    fail "the bill of materials is not valid CycloneDX"
fi

label() { podman inspect --format "{{index .Labels \"org.opencontainers.image.$1\"}}" "$image"; }
[ "trc $(label version)" = "$($trc --version | cut -d' ' -f1-2)" ] || fail "label version: $(label version)"
[ -n "$(label title)" ] && [ -n "$(label description)" ] && [ "$(label licenses)" = MIT ] || fail "labels"
[[ $(label revision) =~ ^[0-9a-f]{12}$ ]] || fail "label revision: $(label revision)"
config() { podman inspect --format "$1" "$image"; }
[ "$(config '{{.User}}')" = 65532:65532 ] || fail "the image's user"
[ "$(config '{{index .HealthCheck.Test 0}}')" = CMD ] || fail "the health check needs a shell"
say "image: $((compressed >> 10)) KiB compressed, no shell, labels, bill of materials"

# --- as the page says ---------------------------------------------------------------------------
bash -euo pipefail -c "$(readme_commands Container 2)" >"$work/shown" 2>"$work/said" ||
  fail "the commands of the page: $(cat "$work/shown" "$work/said")"
grep -q "^N40 G01 X30 Y30" "$work/shown" || fail "the page's example shows no program: $(cat "$work/shown")"
[ "$(podman inspect --format '{{.State.ExitCode}}' trcd)" = 0 ] || fail "stopped with an error"
podman rm trcd >/dev/null 2>&1
say "the commands of the page"

# --- hardened, as the kernel sees it ------------------------------------------------------------
# Starts a container by the call on the page, under another name.
start_server() { # name, replacement for sed
  local command
  command=$(readme_commands Container 2 | sed -n '/^podman run/,/[^\\]$/p' | sed "s/--name trcd/--name $1/; ${2:-}")
  bash -euo pipefail -c "$command" >/dev/null 2>"$work/said" || fail "does not start: $(cat "$work/said")"
  wait_until 20 "$trc" health --server "$service" || fail "does not serve: $(podman logs "$1")"
}
state() { podman inspect --format "{{.State.$2}}" "$1"; }

start_server hardened
pid=$(state hardened Pid)
status() { sed -n "s/^$1:[[:space:]]*//p" "/proc/$pid/status"; }
[ "$(status Uid)" = "$(printf '65532\t65532\t65532\t65532')" ] || fail "user: $(status Uid)"
for set in CapInh CapPrm CapEff CapBnd CapAmb; do
  [ "$(status $set)" = 0000000000000000 ] || fail "$set: $(status $set)"
done
[ "$(status NoNewPrivs)" = 1 ] || fail "new privileges are allowed"
[ "$(status Seccomp)" = 2 ] || fail "no system call filter"
awk '$5 == "/" { exit $6 !~ /(^|,)ro(,|$)/ }' "/proc/$pid/mountinfo" || fail "the root can be written to"
[ "$(memory_of "$pid" limit)" = $((1 << 30)) ] || fail "no memory limit"
! podman exec hardened sh -c true 2>/dev/null || fail "a shell runs in the container"
podman healthcheck run hardened >/dev/null 2>&1 || fail "unhealthy while it serves"
say "hardened: user, capabilities, filter, read-only root, memory limit as seen in /proc"

# --- load within the limit ----------------------------------------------------------------------
ring 20000 >"$work/ring.nc"
"$trc" compensate "$work/ring.nc" --set contour_masking=on -o "$work/ring.expected" 2>/dev/null ||
  fail "the contour of this test is refused"
"$trc" compensate client/samples/bracket.nc -o "$work/bracket.expected" || fail "bracket.nc is refused"

load() { # worker, seconds: how many programs; fails at the first one that differs
  local worker=$1 end=$((SECONDS + $2)) done=0
  while [ "$SECONDS" -lt "$end" ]; do
    "$trc" compensate client/samples/bracket.nc --server "$service" -o "$work/bracket.$worker" &&
      cmp -s "$work/bracket.$worker" "$work/bracket.expected" || return 1
    "$trc" compensate "$work/ring.nc" --set contour_masking=on --server "$service" \
      -o "$work/ring.$worker" 2>/dev/null && cmp -s "$work/ring.$worker" "$work/ring.expected" || return 1
    done=$((done + 2))
  done
  echo "$done"
}
workers=()
for worker in 1 2 3 4; do
  load $worker 15 >"$work/load.$worker" &
  workers+=($!)
done
for worker in "${workers[@]}"; do wait "$worker" || fail "under load a program fails or differs"; done
programs=$(awk "{ sum += \$1 } END { print sum }" "$work"/load.?)
peak() { echo $(($(memory_of "$pid" peak) >> 20)); }
say "load: $programs programs from 4 clients, all equal to those compensated here; peak $(peak) of 1024 MiB"

# --- beyond it ----------------------------------------------------------------------------------
refused='-mib'
ring 600000 >"$work/huge.nc"
ended=0
"$trc" compensate "$work/huge.nc" --set contour_masking=on --server "$service" -o "$work/huge.out" \
  2>"$work/huge.err" || ended=$?
[ "$ended" -ne 0 ] && grep -q -e "$refused" "$work/huge.err" ||
  fail "a program beyond the memory: exit $ended, $(cat "$work/huge.err")"
[ ! -e "$work/huge.out" ] || fail "a refused program left a file"

ring 60000 >"$work/large.nc"
"$trc" compensate "$work/large.nc" --set contour_masking=on -o "$work/large.expected" 2>/dev/null
clients=()
for client in $(seq 12); do
  "$trc" compensate "$work/large.nc" --set contour_masking=on --server "$service" \
    -o "$work/large.$client" 2>"$work/large.err.$client" &
  clients+=($!)
done
answered=0 turned_away=0
for client in $(seq 12); do
  if wait "${clients[client - 1]}"; then
    cmp -s "$work/large.$client" "$work/large.expected" || fail "an answer under overload differs"
    answered=$((answered + 1))
  else
    grep -q -e "$refused" "$work/large.err.$client" || fail "overload: $(cat "$work/large.err.$client")"
    turned_away=$((turned_away + 1))
  fi
done
[ "$(state hardened Pid)" = "$pid" ] && [ "$(state hardened Status)" = running ] ||
  fail "the container did not survive: $(state hardened Status), killed for memory: $(state hardened OOMKilled)"
load after 1 >/dev/null || fail "no service after the overload"
say "overload: $answered of 12 answered, $turned_away refused with a reason, peak $(peak) of 1024 MiB"

# --- the end ------------------------------------------------------------------------------------
mkfifo "$work/slow.nc"
"$trc" compensate "$work/slow.nc" --server "$service" -o "$work/slow.out" 2>"$work/slow.err" &
slow=$!
exec 9>"$work/slow.nc"
head -c 200 client/samples/bracket.nc >&9
sleep 2
podman kill --signal TERM hardened >/dev/null
probe_says_no() { ! podman healthcheck run hardened; }
wait_until 10 probe_says_no || fail "healthy while it drains"
# The client would wait for a server that takes it, longer than this one drains.
! timeout 5 "$trc" compensate client/samples/bracket.nc --server "$service" -o "$work/late" 2>/dev/null ||
  fail "a stream was taken while draining"
tail -c +201 client/samples/bracket.nc >&9
exec 9>&-
wait $slow || fail "the open stream was cut off: $(cat "$work/slow.err")"
cmp -s "$work/slow.out" "$work/bracket.expected" || fail "the open stream's answer differs"
[ "$(timeout 20 podman wait hardened)" = 0 ] || fail "ended with $(state hardened ExitCode)"
podman rm hardened >/dev/null 2>&1
say "SIGTERM: probe says no, new streams refused, the open one finished, exit code 0"

# --- were the limit not respected, the engine would kill: a limit that is never felt proves nothing.
# The engine leaves a file of this name where it was called.
at_exit rm -f oom
start_server careless 's/--memory 1g --memory-swap 1g/--memory 96m --memory-swap 96m/'
# The client would look for the lost server for a minute.
! timeout 20 "$trc" compensate "$work/huge.nc" --set contour_masking=on --server "$service" \
  -o "$work/careless.out" 2>/dev/null || fail "96 MiB were enough: the memory limit does not act"
[ "$(timeout 30 podman wait careless)" = 137 ] || fail "a server beyond the limit was not killed"
say "the same server in 96 MiB is killed: the limit is real"
[ "$(podman inspect --format '{{.Id}}' "$image")" = "$id" ]
