#!/usr/bin/env bash
# The manifests, judged without a cluster: against the schemas of Kubernetes, against each other, and
# their configuration by trcd itself.
. "$(dirname "$(readlink -f "$0")")/lib.sh"
. tests/deploy/tls.sh

command -v npm >/dev/null || fail "npm is needed for the schemas"
installed=.ci/schemas/node_modules/.package-lock.json
[ "$installed" -nt .ci/schemas/package-lock.json ] || npm --prefix .ci/schemas ci >"$work/npm.log" 2>&1 ||
  fail "npm: $(tail -3 "$work/npm.log")"
check() { node tests/deploy/kubernetes_schema.mjs "$@"; }

make_certificates "$work/tls"
if kubectl kustomize deploy/kubernetes/overlays/edge >/dev/null 2>&1; then
  for overlay in edge cluster; do
    kubectl kustomize deploy/kubernetes/overlays/$overlay >"$work/$overlay.yaml" || fail "$overlay cannot be rendered"
    counted=$(check "$work/$overlay.yaml") || fail "$overlay does not fit the schemas of Kubernetes"
    node tests/deploy/kubernetes_consistency.mjs "$work/$overlay.yaml" "$work/$overlay.toml" ||
      fail "$overlay contradicts itself"
    # The files named there are in the cluster only.
    TRCD_TLS_CERT_FILE=$work/tls/server.pem TRCD_TLS_KEY_FILE=$work/tls/server.key TRCD_TLS_CLIENT_CA_FILE=$work/tls/ca.pem \
      "$bin/trcd" --config "$work/$overlay.toml" --health-listen 0.0.0.0:50052 --print-config >/dev/null || fail "trcd refuses trcd.toml of $overlay"
    ! TRCD_TLS_CERT_FILE='' TRCD_TLS_KEY_FILE='' TRCD_TLS_CLIENT_CA_FILE='' \
      "$bin/trcd" --config "$work/$overlay.toml" --print-config >/dev/null 2>&1 ||
      fail "without certificates trcd.toml of $overlay serves plain text"
    say "$overlay: $counted"
  done
else
  say "without kubectl 1.25 or later the overlays are not rendered; their files are checked one by one"
  check $(find deploy/kubernetes -name '*.yaml' ! -name kustomization.yaml ! -path '*/overlays/*/outside.yaml' \
    ! -name replicas.yaml ! -name size.yaml) || fail "a file does not fit the schemas of Kubernetes"
fi

# A checker that finds nothing would pass everything.
broken() { # what to break, how, in which file
  sed "$2" "$3" >"$work/broken.yaml"
  ! cmp -s "$3" "$work/broken.yaml" || fail "nothing was broken: $1"
  ! check "$work/broken.yaml" >/dev/null 2>&1 || fail "not found: $1"
}
broken "a misspelt field" s/readOnlyRootFilesystem/readOnlyRootFileSystem/ deploy/kubernetes/base/deployment.yaml
broken "a wrong type" 's/minReplicas: 3/minReplicas: three/' deploy/kubernetes/overlays/cluster/autoscaler.yaml
broken "a missing field" '/maxReplicas/d' deploy/kubernetes/overlays/cluster/autoscaler.yaml
broken "an unknown version" s,policy/v1,policy/v7, deploy/kubernetes/overlays/cluster/disruption.yaml
say "broken manifests are found"
