// Where a server is, and how a connection to it is kept.
import { isIPv4, isIPv6 } from "node:net";

/** A server that is frozen or unplugged is noticed after the sum of the first two, ms. */
export const channelOptions = {
  "grpc.keepalive_time_ms": 30_000,
  "grpc.keepalive_timeout_ms": 10_000,
  "grpc.initial_reconnect_backoff_ms": 100,
  "grpc.max_reconnect_backoff_ms": 5_000,
};

function hostOf(server, whole) {
  const [, host, port] = /^(.+):(\d+)$/.exec(server) ?? [];
  const isHost = host !== undefined && !host.includes("/") && (!host.includes(":") || host.startsWith("["));
  if (!isHost || Number(port) < 1 || Number(port) > 65535) {
    throw new TypeError(`"${whole}" is no server: give "HOST:PORT", several with commas between, ` +
      'or "unix:/path"');
  }
  return host.replace(/^\[(.*)\]$/, "$1");
}

/** The target of gRPC for a server, or for several with commas between. */
export function targetOf(server) {
  if (typeof server !== "string")
    throw new TypeError(`server takes text as in "box:50051", not ${server}`);
  if (/^(unix|dns):/.test(server)) return server;
  const list = server.split(",").map((one) => one.trim());
  const hosts = list.map((one) => hostOf(one, server));
  if (list.length === 1) return server;
  if (hosts.every((host) => isIPv4(host))) return `ipv4:${list.join(",")}`;
  if (hosts.every((host) => isIPv6(host))) return `ipv6:${list.join(",")}`;
  throw new TypeError(`in "${server}" all must be IPv4 addresses, or all IPv6 addresses`);
}
