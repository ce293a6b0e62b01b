"""Where a server is, and how a connection to it is kept."""

from __future__ import annotations

import ipaddress
import json
from typing import Any, Optional, Union

FIRST_WAIT_MS = 100
LONGEST_WAIT_MS = 5_000

# A server that is frozen or unplugged is noticed after the sum of both; between the programs too.
# By itself gRPC would try an address again after a second, then after up to two minutes.
_KEPT: list[tuple[str, Any]] = [
    ("grpc.keepalive_time_ms", 30_000),
    ("grpc.keepalive_timeout_ms", 10_000),
    ("grpc.http2.max_pings_without_data", 0),
    ("grpc.initial_reconnect_backoff_ms", FIRST_WAIT_MS),
    ("grpc.min_reconnect_backoff_ms", LONGEST_WAIT_MS),
    ("grpc.max_reconnect_backoff_ms", LONGEST_WAIT_MS),
    # Calls begin anew by themselves. gRPC 1.51, which tries one again that no server has seen, forgets
    # what is asked of it when that fails too: whoever waits for it waits for ever, beyond its deadline.
    ("grpc.enable_retries", 0),
]

# Streams go to the servers in turn, but not to one that takes no work.
_IN_TURN = json.dumps({
    "loadBalancingConfig": [{"round_robin": {}}],
    "healthCheckConfig": {"serviceName": "trc.v1.TrcService"},
})

_Address = Union[ipaddress.IPv4Address, ipaddress.IPv6Address]


def _host_and_port(server: str, whole: str) -> str:
    """The host of HOST:PORT or [IPV6]:PORT."""
    host, _, port = server.rpartition(":")
    is_port = port.isascii() and port.isdigit() and 0 < int(port) < 65536
    if not host or not is_port or (":" in host and not host.startswith("[")):
        raise ValueError(f"{whole!r} is no server: give \"HOST:PORT\", several with commas between, "
                         "or \"unix:/path\"")
    return host


def _number(host: str, whole: str) -> _Address:
    try:
        return ipaddress.ip_address(host.strip("[]"))
    except ValueError:
        raise ValueError(f"in {whole!r} {host!r} must be an IP address; one name that stands for all "
                         "servers is \"dns:///NAME:PORT\"") from None


def target_of(server: str) -> tuple[str, list[tuple[str, Any]]]:
    """The target of gRPC and the options of its channel."""
    if not isinstance(server, str):
        raise TypeError(f"server takes text as in \"box:50051\", not {server!r}")
    if server.startswith("dns:"):
        return server, [*_KEPT, ("grpc.service_config", _IN_TURN)]
    if server.startswith("unix:"):
        return server, _KEPT
    one_of = server.split(",")
    hosts = [_host_and_port(one.strip(), server) for one in one_of]
    if len(one_of) == 1:
        return server, _KEPT
    versions = {_number(host, server).version for host in hosts}
    if len(versions) > 1:
        raise ValueError(f"{server!r} mixes IPv4 and IPv6")
    return (f"ipv{versions.pop()}:" + ",".join(one.strip() for one in one_of),
            [*_KEPT, ("grpc.service_config", _IN_TURN)])


def seconds_of(timeout: Optional[float]) -> Optional[float]:
    """The timeout of a call, checked; none: no end."""
    if timeout is None or timeout == float("inf"):
        return None
    if isinstance(timeout, bool) or not isinstance(timeout, (int, float)):
        raise TypeError(f"timeout takes seconds, not {timeout!r}")
    if not timeout > 0:
        raise ValueError(f"timeout is {timeout!r}; it takes seconds, more than 0")
    return float(timeout)
