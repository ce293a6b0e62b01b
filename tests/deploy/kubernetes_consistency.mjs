// Usage: kubernetes_consistency.mjs RENDERED TOML
//
// What no schema knows: that the objects of a rendered overlay fit each other and the settings of
// trcd, which are written to TOML. Says what does not and ends with 1.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const YAML = createRequire(path.join(here, '../../.ci/schemas/package.json'))('yaml');

const [rendered, toml] = process.argv.slice(2);
const objects = YAML.parseAllDocuments(fs.readFileSync(rendered, 'utf8')).map((d) => d.toJS());
const all = (kind) => objects.filter((object) => object.kind === kind);
const faults = [];
const demand = (holds, text) => holds || faults.push(text);

const [deployment] = all('Deployment');
const pod = deployment.spec.template.spec;
const labels = deployment.spec.template.metadata.labels;
const [container] = pod.containers;
const fits = (selector) => Object.entries(selector).every(([key, value]) => labels[key] === value);

const configName = pod.volumes.find((volume) => volume.configMap).configMap.name;
const config = all('ConfigMap').find((map) => map.metadata.name === configName);
demand(config, `there is no ConfigMap ${configName}`);
const text = config.data['trcd.toml'];
fs.writeFileSync(toml, text);
const setting = (name) => new RegExp(`^${name} = (.*)$`, 'm').exec(text)?.[1].replace(/[[\]"]/g, '');

// Memory: three times what streams may hold back, gRPC's buffers, and 64 MiB (deploy/README.md).
const mebibytes = (quantity) => {
  const [, number, unit] = /^(\d+)(Mi|Gi)$/.exec(quantity);
  return Number(number) * (unit === 'Gi' ? 1024 : 1);
};
const { requests, limits } = container.resources;
const needed = 3 * Number(setting('max-session-memory-mib')) + Number(setting('max-grpc-buffer-mib')) + 64;
demand(mebibytes(limits.memory) >= needed, `limits.memory ${limits.memory}, trcd.toml needs ${needed} MiB`);
demand(mebibytes(limits.memory) <= 1.3 * needed, `limits.memory ${limits.memory}, trcd.toml uses ${needed} MiB of it`);
demand(limits.memory === requests.memory, 'the memory asked for is not the memory allowed');

// Ports. What the image sets for itself as a variable must be an argument here: it wins over a file.
const argument = (name) => container.args.find((one) => one.startsWith(`--${name}=`))?.split('=')[1];
const port = (name) => container.ports.find((one) => one.name === name)?.containerPort;
for (const [name, key, address] of [['grpc', 'listen', setting('listen')], ['metrics', 'admin-listen', setting('admin-listen')],
  ['health', 'health-listen', argument('health-listen')]])
  demand(address === `0.0.0.0:${port(name)}`, `${key} ${address} is not port ${name}, ${port(name)}`);
demand(setting('health-listen') === undefined, 'health-listen in trcd.toml has no effect in the image');
for (const probe of [container.startupProbe, container.readinessProbe])
  demand(probe.grpc.port === port('health'), 'a gRPC probe asks another port than that of health');
demand(container.livenessProbe.httpGet.path === '/healthz', 'a server that drains would be killed');
demand(deployment.spec.template.metadata.annotations['prometheus.io/port'] === String(port('metrics')), 'port of the scrape');

// Time to drain, and the files of TLS.
demand(pod.terminationGracePeriodSeconds > Number(setting('drain-timeout-s')), 'killed before it has drained');
for (const key of ['tls-cert-file', 'tls-key-file', 'tls-client-ca-file', 'resume-key-file'])
  demand(container.volumeMounts.some((mount) => setting(key)?.startsWith(`${mount.mountPath}/`)), `${key} is in no volume`);
for (const mount of container.volumeMounts)
  demand(pod.volumes.some((volume) => volume.name === mount.name), `there is no volume ${mount.name}`);

// Who selects the pods.
for (const service of all('Service')) {
  demand(fits(service.spec.selector), `Service ${service.metadata.name} selects nothing`);
  for (const { targetPort } of service.spec.ports) demand(port(targetPort), `there is no port ${targetPort}`);
}
demand(all('Service').some((service) => service.spec.clusterIP === 'None'), 'there is no headless Service');
const [policy] = all('NetworkPolicy');
demand(Object.keys(policy.spec.podSelector.matchLabels ?? {}).length > 0 && fits(policy.spec.podSelector.matchLabels),
  'the NetworkPolicy is for other pods');
for (const rule of policy.spec.ingress)
  for (const one of rule.ports) demand(['grpc', 'metrics'].includes(one.port), `the NetworkPolicy opens ${one.port}`);
for (const budget of all('PodDisruptionBudget'))
  demand(fits(budget.spec.selector.matchLabels), 'the PodDisruptionBudget is for other pods');
for (const spread of pod.topologySpreadConstraints ?? [])
  demand(fits(spread.labelSelector.matchLabels), 'the spread is over other pods');
for (const scaler of all('HorizontalPodAutoscaler')) {
  demand(scaler.spec.scaleTargetRef.name === deployment.metadata.name, 'the autoscaler is for another Deployment');
  demand(deployment.spec.replicas === undefined, 'the Deployment undoes what the autoscaler does');
  const by = scaler.spec.metrics.map((metric) => metric.resource?.name ?? metric.pods?.metric.name);
  demand(by.includes('cpu') && by.includes('trc_streams_active'), `the autoscaler goes by ${by}`);
}
for (const object of objects)
  demand(object.kind === 'Namespace' || object.metadata.namespace === 'trc', `${object.kind} ${object.metadata.name} is in no namespace`);

// What the namespace's pod security level "restricted" asks for.
demand(pod.securityContext.runAsNonRoot && pod.securityContext.seccompProfile.type === 'RuntimeDefault' &&
  container.securityContext.allowPrivilegeEscalation === false && container.securityContext.readOnlyRootFilesystem &&
  container.securityContext.capabilities.drop.includes('ALL'), 'the pod is not restricted');

for (const fault of faults) console.error(fault);
process.exit(faults.length > 0 ? 1 : 0);
