#!/usr/bin/env bash
# The manifests, started: rendered by kustomize, played by podman, which knows Deployments, ConfigMaps
# and Secrets. What needs an API server is not seen here: Services, NetworkPolicy, HPA, PDB.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/engine.sh
. tests/deploy/tls.sh

trc=$bin/trc
sample=client/samples/bracket.nc
service=127.0.0.1:50051
# Debian's is too old for what the overlays use.
kubectl kustomize deploy/kubernetes/overlays/edge >/dev/null 2>&1 ||
  skip "needs a kubectl that renders the manifests, 1.25 or later"

load_image
"$trc" compensate "$sample" -o "$work/expected" || fail "$sample is refused"
make_certificates "$work/tls"
cp "$work/tls/ca.pem" "$work/tls/clients.pem"

# A kubectl that plays on this machine what it is to apply to a cluster. Secrets come decoded into
# their volumes only with later versions of podman.
mkdir "$work/path"
cat >"$work/path/kubectl" <<'TEXT'
#!/bin/bash
set -euo pipefail
case "$1 $2" in
  "create namespace") ;;
  "create secret") { "$REAL_KUBECTL" "$@" --dry-run=client -o yaml; echo ---; } >>"$WORK/objects.yaml" ;;
  "apply -k")
    "$REAL_KUBECTL" kustomize "$3" >>"$WORK/objects.yaml"
    podman play kube "$WORK/objects.yaml"
    for volume in trcd-tls trcd-resume-key; do
      for file in "$(podman volume inspect --format '{{.Mountpoint}}' $volume)"/*; do
        base64 -d "$file" >"$WORK/decoded" 2>/dev/null && cat "$WORK/decoded" >"$file"
      done
    done ;;
  "rollout status")
    for attempt in $(seq 60); do
      ! "$TRC" health --server "$(pod_address):50052" 2>/dev/null || exit 0
      sleep 1
    done
    exit 1 ;;
  *) echo "kubectl $*: not expected" >&2; exit 1 ;;
esac
TEXT
chmod +x "$work/path/kubectl"
REAL_KUBECTL=$(command -v kubectl)
# From the network of the pod: its engine maps neighbouring ports of a pod wrongly.
in_pod() { nsenter --net --target "$(podman inspect --format '{{.State.Pid}}' trcd-pod-0-trcd)" "$@"; }
pod_address() { in_pod ip -4 -oneline address show dev eth0 | sed 's/.* inet \([0-9.]*\).*/\1/'; }
export WORK=$work REAL_KUBECTL TRC=$trc
export -f in_pod pod_address

# play OVERLAY: with the commands of the page.
play() {
  rm -f "$work/objects.yaml"
  PATH=$work/path:$PATH timeout 200 bash -euo pipefail -c "$(readme_commands Kubernetes |
    sed "s#overlays/[a-z]*#overlays/$1#; s#=\(server\|clients\)\.#=$work/tls/\1.#g; s#build/release/bin#$bin#")" \
    >"$work/shown" 2>"$work/said" ||
    fail "the commands of the page: $(cat "$work/shown" "$work/said" | tail -n 20; podman logs trcd-pod-0-trcd 2>&1 | tail -n 3)"
}

serves() {
  in_pod "$trc" compensate "$sample" --server "$service" --tls-ca "$work/tls/ca.pem" \
    --tls-cert "$work/tls/client.pem" --tls-key "$work/tls/client.key" -o "$work/out" 2>"$work/err" &&
    cmp -s "$work/out" "$work/expected"
}

check_running() { # overlay, memory limit in MiB
  local pid
  serves || fail "$1: no answer over mutual TLS: $(cat "$work/err")"
  ! in_pod "$trc" health --server "$service" --tls-ca "$work/tls/ca.pem" 2>/dev/null ||
    fail "$1: served without a client certificate"
  ! in_pod "$trc" health --server "$service" 2>/dev/null || fail "$1: served in plain text"
  # What kubelet and Prometheus ask, from outside of the pod as they do.
  "$trc" health --server "$(pod_address):50052" >/dev/null || fail "$1: the probes' port does not answer"
  curl -sf "http://$(pod_address):9464/healthz" >/dev/null || fail "$1: not alive"
  curl -sf "http://$(pod_address):9464/metrics" | grep '^trc_streams_active ' >/dev/null ||
    fail "$1: the metric the autoscaler goes by is not exported"

  pid=$(podman inspect --format '{{.State.Pid}}' trcd-pod-0-trcd)
  [ "$(awk '/^Uid/ { print $2 }' "/proc/$pid/status")" = 65532 ] || fail "$1: user"
  [ "$(awk '/^CapBnd/ { print $2 }' "/proc/$pid/status")" = 0000000000000000 ] || fail "$1: capabilities"
  [ "$(awk '/^NoNewPrivs/ { print $2 }' "/proc/$pid/status")" = 1 ] || fail "$1: new privileges"
  awk '$5 == "/" { exit $6 !~ /(^|,)ro(,|$)/ }' "/proc/$pid/mountinfo" || fail "$1: writable root"
  [ "$(memory_of "$pid" limit)" = $(($2 << 20)) ] || fail "$1: memory limit"
}

take_down() {
  podman pod stop --time 45 trcd-pod-0 >/dev/null 2>&1 || fail "$1: does not stop"
  [ "$(podman inspect --format '{{.State.ExitCode}}' trcd-pod-0-trcd)" = 0 ] || fail "$1: ended with an error"
  podman pod rm --force --all >/dev/null 2>&1
  podman volume rm --all --force >/dev/null
  podman secret rm --all >/dev/null
}

for overlay in edge:1024 cluster:4096; do
  play "${overlay%:*}"
  check_running "${overlay%:*}" "${overlay#*:}"
  take_down "${overlay%:*}"
  say "${overlay%:*}: mutual TLS, probes, metrics, ${overlay#*:} MiB, read-only, no capabilities, ends with 0"
done
