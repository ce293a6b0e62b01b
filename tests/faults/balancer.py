#!/usr/bin/env python3
"""Clients behind the HAProxy of deploy/haproxy, with the ports that are named there: streams come
through whole, and metadata that gRPC ends a connection for (CVE-2023-32732) ends nobody else's.

    balancer.py TRCD TRC FAULT_CLIENT

Exit code 77 where there is no HAProxy, or no network namespace for its ports.
"""

import contextlib
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "robustness"))

import http2  # noqa: E402
from network import SKIPPED, enter_namespace  # noqa: E402

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BALANCER, SERVERS = 50050, (50051, 50052, 50053)
COMPENSATE = b"/trc.v1.TrcService/CompensateProgram"
# What is no base64, and what passes the 8 KB that a server takes.
BAD_METADATA = ([(b"x-bin", b"!!!!")], [(b"x-%d" % i, b"x" * 200) for i in range(60)])
CLIENTS, PAUSE_MS = 4, 30


def program():
    lines = ["G1 G41 V.G.WZ_AKT.R=0.5 X0 Y10 F800"]
    for turn in range(6000):
        lines += [f"G1 X{20 * turn + 5} Y{10 + turn % 7}", f"X{20 * turn + 10}"]
    return "\n".join(lines + ["G40", "G1 Y-100", "M30", ""])


def listens(port):
    try:
        socket.create_connection(("127.0.0.1", port), 1).close()
        return True
    except OSError:
        return False


def wait_for(port):
    end = time.monotonic() + 20
    while not listens(port):
        if time.monotonic() > end:
            sys.exit(f"nobody listens on port {port}")
        time.sleep(0.05)


class Hostile(threading.Thread):
    """Sends calls with bad metadata, each on a connection of its own, until it is over."""

    def __init__(self, over):
        super().__init__()
        self.over, self.sent = over, 0

    def run(self):
        while not self.over.is_set():
            for fields in BAD_METADATA:
                with socket.create_connection(("127.0.0.1", BALANCER), 5) as end:
                    try:
                        end.sendall(http2.greeting() + http2.call(1, COMPENSATE, *fields))
                        end.settimeout(0.2)
                        end.recv(4096)
                        self.sent += 1
                    except OSError:
                        pass  # It has been thrown out.


def faults_of(trc, fault_client, folder):
    """What is wrong with the answers of clients beside a hostile one."""
    source = os.path.join(folder, "program.nc")
    with open(source, "w") as file:
        file.write(program())
    alone = subprocess.run([trc, "compensate", source], capture_output=True, check=True).stdout
    over = threading.Event()
    hostile = Hostile(over)
    hostile.start()
    outputs = [os.path.join(folder, f"out{number}") for number in range(CLIENTS)]
    clients = [subprocess.Popen([fault_client, f"127.0.0.1:{BALANCER}", source, output, str(PAUSE_MS)],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE) for output in outputs]
    faults = []
    for client, output in zip(clients, outputs):
        said, why = client.communicate(timeout=100)
        with open(output, "rb") as file:
            if client.returncode != 0 or file.read() != alone:
                faults.append(f"exit {client.returncode}, or another path: {why!r}")
        if b"resumed 0" not in said:
            faults.append(f"a stream was lost: {said!r}")
    over.set()
    hostile.join()
    if hostile.sent == 0:
        faults.append("nothing hostile was sent")
    return faults


def find_haproxy():
    """Where it is, from inside a network namespace with its ports; else the test is not run."""
    haproxy = shutil.which("haproxy", path=os.environ["PATH"] + ":/usr/sbin")
    if haproxy is None:
        print("haproxy is not installed", file=sys.stderr)
        sys.exit(SKIPPED)
    try:
        enter_namespace()
        subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
    except OSError as fault:
        print(f"no network namespace here: {fault}", file=sys.stderr)
        sys.exit(SKIPPED)
    return haproxy


@contextlib.contextmanager
def balanced(haproxy, way, trcd, *options, servers=SERVERS):
    """Servers behind HAProxy; gives a folder for what the clients write."""
    with tempfile.TemporaryDirectory() as folder:
        key = os.path.join(folder, "resume.key")
        with open(key, "wb") as file:
            file.write(os.urandom(32))
        os.chmod(key, 0o600)
        started = [subprocess.Popen(
            [trcd, "--listen", f"127.0.0.1:{port}", "--health-listen", f"127.0.0.1:{port + 100}",
             "--resume-key-file", key, *options], stdout=subprocess.DEVNULL) for port in servers]
        files = [os.path.join(TOP, "deploy/haproxy", name) for name in ("defaults.cfg", f"{way}.cfg")]
        started.append(subprocess.Popen([haproxy, "-db", *(word for name in files for word in ("-f", name))],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        try:
            for port in (*servers, BALANCER):
                wait_for(port)
            time.sleep(3)  # HAProxy has asked the servers for their health.
            yield folder
        finally:
            for process in started:
                process.terminate()
                process.wait()


def main():
    trcd, trc, fault_client = (os.path.abspath(path) for path in sys.argv[1:4])
    haproxy = find_haproxy()
    with balanced(haproxy, "h2", trcd, "--trusted-proxies", "127.0.0.1") as folder:
        faults = faults_of(trc, fault_client, folder)
    for fault in faults:
        print(f"FAILED: {fault}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
