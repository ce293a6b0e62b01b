#!/usr/bin/env python3
"""Behind the HAProxy of deploy/haproxy one address opens calls and says nothing on them: clients at
another address still get theirs through, and the calls beyond its share are refused clearly.

    balancer_crowd.py TRCD TRC

Exit code 77 where there is no HAProxy, or no network namespace for its ports.
"""

import os
import selectors
import socket
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "robustness"))

import http2  # noqa: E402
from balancer import BALANCER, COMPENSATE, SERVERS, TOP, balanced, find_haproxy  # noqa: E402

HOSTILE = "127.0.0.2"  # The others come from 127.0.0.1.
SAMPLE = os.path.join(TOP, "client/samples/bracket.nc")
REFUSED = b"grpc-status\x018"  # RESOURCE_EXHAUSTED
PROGRAMS, PATIENCE_S = 5, 30


class Crowd:
    """Connections with calls that say nothing. Counts what has been refused."""

    def __init__(self, connections, calls):
        self.open, self.closed, self.answers = selectors.DefaultSelector(), 0, b""
        for _ in range(connections):
            try:
                end = socket.create_connection(("127.0.0.1", BALANCER), 10, (HOSTILE, 0))
                silent = (http2.call(2 * number + 1, COMPENSATE) for number in range(calls))
                end.sendall(http2.greeting() + b"".join(silent))
                self.open.register(end, selectors.EVENT_READ)
            except OSError:
                self.closed += 1
        self.listen(quiet_s=3)

    def listen(self, quiet_s):
        """Until nothing has come for so long."""
        while self.open.get_map() and (ready := self.open.select(quiet_s)):
            for key, _ in ready:
                try:
                    answer = key.fileobj.recv(65536)
                except OSError:
                    answer = b""
                self.answers += answer
                if not answer:
                    self.closed += 1
                    self.leave(key.fileobj)

    def leave(self, end):
        self.open.unregister(end)
        end.close()

    def refused(self):
        return self.answers.count(REFUSED)

    def go(self):
        for key in list(self.open.get_map().values()):
            self.leave(key.fileobj)


def faults_of_others(trc, folder, expected):
    """What is wrong with the programs of clients at another address."""
    output = os.path.join(folder, "out.nc")
    for number in range(PROGRAMS):
        try:
            run = subprocess.run([trc, "compensate", SAMPLE, "--server", f"127.0.0.1:{BALANCER}", "-o", output],
                                 stderr=subprocess.PIPE, timeout=PATIENCE_S)
        except subprocess.TimeoutExpired:
            yield f"program {number} of another client: no answer in {PATIENCE_S} s"
            return
        if run.returncode != 0:
            yield f"program {number} of another client: exit {run.returncode}, {run.stderr!r}"
            return
        with open(output, "rb") as file:
            if file.read() != expected:
                yield f"program {number} of another client has another path"


def faults_of_room(most):
    """Those who crowded have their share again when they have gone."""
    end = time.monotonic() + 20
    while (again := Crowd(1, 1)).refused() + again.closed > 0:
        again.go()
        if time.monotonic() > end:
            yield f"still refused, after {most} calls have ended"
            return
    again.go()


def faults_of(case, haproxy, trcd, trc):
    expected = subprocess.run([trc, "compensate", SAMPLE], capture_output=True, check=True).stdout
    with balanced(haproxy, case["way"], trcd, *case["options"], servers=case["servers"]) as folder:
        crowd = Crowd(*case["crowd"])
        yield from faults_of_others(trc, folder, expected)
        crowd.listen(quiet_s=0.1)
        got = {"refused": crowd.refused(), "closed": crowd.closed}
        for what, number in case["expected"].items():
            if got[what] != number:
                yield f"{got[what]} {what}, not {number}"
        crowd.go()
        yield from faults_of_room(case["crowd"][0] * case["crowd"][1])


def main():
    trcd, trc = (os.path.abspath(path) for path in sys.argv[1:3])
    haproxy = find_haproxy()
    knows_proxy = ("--trusted-proxies", "127.0.0.1")
    # As large as those of deploy/compose: one address may have 60 of the 80 streams of a server.
    small = ("--max-streams", "80")
    # As large as usual, with less memory than that. The balancer is one client, which may have all.
    large = ("--max-streams", "1000", "--max-streams-per-peer", "1000", "--max-message-bytes", "4096")
    few = ("--max-streams-per-connection", "4")
    cases = {
        "three small servers": {
            "way": "h2", "options": knows_proxy + small, "servers": SERVERS, "crowd": (5, 50),
            "expected": {"refused": 70, "closed": 0}},
        "the last small server": {
            "way": "h2", "options": knows_proxy + small, "servers": SERVERS[:1], "crowd": (5, 50),
            "expected": {"refused": 190, "closed": 0}},
        "a server that does not know the balancer": {
            "way": "h2", "options": large, "servers": SERVERS[:1], "crowd": (24, 50),
            "expected": {"refused": 450, "closed": 0}},
        "too many connections": {
            "way": "h2", "options": knows_proxy + small, "servers": SERVERS, "crowd": (300, 1),
            "expected": {"refused": 70, "closed": 50}},
        "connections kept for later": {
            "way": "h2", "options": knows_proxy + small, "servers": SERVERS[:1], "crowd": (250, 5),
            "expected": {"refused": 1190, "closed": 0}},
        "connections that go through": {
            "way": "tcp", "options": large + few, "servers": SERVERS[:1], "crowd": (300, 4),
            "expected": {"refused": 0, "closed": 150}},
    }
    failed = False
    for name, case in cases.items():
        faults = list(faults_of(case, haproxy, trcd, trc))
        print(f"{name}: {'; '.join(faults) if faults else 'others get in'}", flush=True)
        failed = failed or bool(faults)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
