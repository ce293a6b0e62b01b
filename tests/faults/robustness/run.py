#!/usr/bin/env python3
"""Random faults against random clients, for a set time, and what must hold afterwards.

    run.py TRCD TRC [SECONDS [SEED]]

Without SECONDS it is 20, and 300 where TRC_TEST_LONG is set. TRC_ROBUSTNESS_KEEP names a folder for
what it leaves: history, logs, NC programs, and each answer that was not the right one (`differs.…`).

A server of limited memory (told, or by a cgroup), descriptors and streams, behind proxies that slow,
cut and stall; its log goes into a file, on a slow disk at times, into a pipe, or onto a device that is
full (trcd.py). Honest clients ask by `trc`, HTTP and Python, onto disks that are full or slow and pipes
that are read late (honest.py). Hostile ones send garbage, floods and bombs, hold connections, stop in
the middle or never read (hostile.py). Meanwhile the server is killed and started again, stopped, its
certificates are changed for good and for bad ones, its log is not read, its wall clock jumps.
Everything asked and answered goes into a history, which is checked:

- every finished output is that of `trc` without a server, byte for byte
- every refusal says why, and its exit code fits
- nobody waits longer than told, the server least of all
- health told the truth whenever nothing was disturbed
- memory and descriptors come back
- what was logged is whole lines, and no incident among them

The seed is printed; the same one gives the same faults, not the same timing.
"""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import types

from deck import Deck
from history import History
from honest import Honest
from hostile import Hostile, bomb
from programs import make_cases
from proxy import Proxy
from trcd import DRAIN_TIMEOUT_S, HOURS_S, Server

CHECKER_SHORTER = 20
HONEST, HOSTILE = 6, 2
IDLE_MIB, IDLE_DESCRIPTORS = 150, 60


class Test:
    def __init__(self, trcd, trc, folder, seconds, seed):
        self.trc, self.folder, self.seconds = trc, folder, seconds
        self.rng = random.Random(seed)
        self.history = History(os.path.join(folder, "history.jsonl"))
        self.server = Server(trcd, folder, self.history, random.Random(self.rng.random()))
        self.proxies = types.SimpleNamespace(grpc=Proxy(self.server.port), http=Proxy(self.server.http))
        self.over, self.bomb = threading.Event(), bomb()
        self.cases = make_cases(trc, folder, self.rng, CHECKER_SHORTER if self.server.checked else 1)
        self.honest = Honest(self)
        faults = [self.kill, self.restart, self.stop, self.cut, self.hold, self.slow, self.certificate,
                  self.broken_certificate, self.unread_log]
        if self.server.clock.exists:
            faults.append(self.clock_jump)
        self.faults = Deck(self.rng, faults)

    # --- faults -------------------------------------------------------------------------------

    def kill(self):
        self.server.kill()
        time.sleep(self.rng.random())
        self.server.start()

    def restart(self):
        seconds = self.server.end()
        if seconds > DRAIN_TIMEOUT_S + 2 + 1:
            self.history.fail(f"it took {seconds:.1f} s to end with a drain timeout of {DRAIN_TIMEOUT_S} s")
        # With 1 it says that something still ran then (drain_overrun).
        overrun = self.server.process.returncode == 1 and seconds >= DRAIN_TIMEOUT_S + 1.5
        if self.server.process.returncode != 0 and not overrun:
            self.history.fail(f"told to end, it ended with exit {self.server.process.returncode}")
        self.server.start()

    def stop(self):
        self.server.process.send_signal(signal.SIGSTOP)
        time.sleep(0.5 + 2 * self.rng.random())
        self.server.process.send_signal(signal.SIGCONT)

    def cut(self):
        self.disturb_network("cut")

    def hold(self):
        self.disturb_network("hold")

    def slow(self):
        self.disturb_network("slow")

    def disturb_network(self, mode):
        for proxy in (self.proxies.grpc, self.proxies.http):
            proxy.mode = mode
        time.sleep(0.2 + 3 * self.rng.random())
        for proxy in (self.proxies.grpc, self.proxies.http):
            proxy.mode = "pass"

    def certificate(self):
        name = self.rng.choice(["a", "b"])
        self.server.put_certificate(name, name)
        self.server.process.send_signal(signal.SIGHUP)

    def broken_certificate(self):
        self.server.put_certificate("a", "b")
        self.server.process.send_signal(signal.SIGHUP)
        time.sleep(1 + self.rng.random())
        self.server.put_certificate("a", "a")
        self.server.process.send_signal(signal.SIGHUP)

    def clock_jump(self):
        """Minutes or hours, back or forth; it stays so until the next one."""
        seconds = self.rng.choice([-1, 1]) * self.rng.choice([120, 3600, HOURS_S])
        self.history.add("fault", "clock", seconds=seconds)
        self.server.clock.jump_to(seconds)
        time.sleep(1 + self.rng.random())

    def unread_log(self):
        """For a while, and perhaps until the server has ended."""
        reader = self.server.reader
        reader.reads.clear()
        time.sleep(1 + 3 * self.rng.random())
        self.check_health()
        if self.rng.random() < 0.3:
            self.restart()
        reader.reads.set()

    def disturb(self):
        fault = self.faults.draw(lambda fault: fault != self.unread_log or self.server.reader is not None)
        self.history.add("fault", fault.__name__)
        fault()
        if not self.server.wait_ready(20):
            self.history.fail(f"not ready 20 s after {fault.__name__}")

    # --- what must hold -----------------------------------------------------------------------

    def check_health(self):
        """Nothing is disturbed: who is ready must serve, or say that there is no place."""
        ready = self.server.ready()
        code = self.honest.probe(self.cases[0], self.server.port)
        resident = self.server.resident_mib()
        self.history.add("probe", "health", ready=ready, code=code, mib=round(resident))
        if not self.server.lives():
            self.history.fail(f"the server has died by itself: {self.server.process.returncode}")
            self.server.start()
            self.server.wait_ready(20)
        elif ready != 200 and self.server.ready() != 200:
            self.history.fail(f"/readyz says {ready}, and nothing is disturbed")
        elif ready == 200 and self.probe_health() and (said := self.probe_health()) and self.server.ready() == 200:
            self.history.fail(f"/readyz says ready, and the probe of grpc.health.v1: {said}")
        if resident > self.server.memory_mib:
            self.history.fail(f"{resident:.0f} MiB resident, {self.server.memory_mib} are allowed")

    def probe_health(self):
        """Asks at the port for probes: at the other one a flood may leave no connection to its address.
        Nothing where it serves, else what was said."""
        line = [self.trc, "health", "--server", f"127.0.0.1:{self.server.health}", "--timeout-s", "10"]
        done = subprocess.run(line, capture_output=True, timeout=self.honest.longest_s)
        return (done.stdout + done.stderr).decode(errors="replace").strip() if done.returncode else None

    def check_recovery(self):
        """Nobody is there any more: what was taken comes back, and it serves at once."""
        end = time.monotonic() + 30
        while time.monotonic() < end:
            mib, descriptors = self.server.resident_mib(), self.server.descriptors()
            if (mib < IDLE_MIB or self.server.checked) and descriptors < IDLE_DESCRIPTORS:
                break
            time.sleep(0.5)
        else:
            self.history.fail(f"{mib:.0f} MiB and {descriptors} descriptors are still in use")
        self.check_health()
        seconds = self.server.end()
        longest = 10 if self.server.checked else 3
        if self.server.process.returncode != 0 or seconds > longest:
            self.history.fail(f"idle, it took {seconds:.1f} s to end, exit {self.server.process.returncode}")

    def check_logs(self):
        for number, log in self.server.logs():
            *lines, rest = log.split(b"\n")
            if rest and not self.history.count(actor="server", what="killed", incarnation=number):
                self.history.fail(f"the log of server {number} ends within a line")
            for line in lines:
                try:
                    event = json.loads(line)["event"]
                except (ValueError, KeyError):
                    self.history.fail(f"server {number} has logged {line!r}")
                    break
                if event == "incident":
                    self.history.fail(f"incident of server {number}: {line!r}")

    def run(self):
        self.server.start()
        if not self.server.wait_ready(20):
            sys.exit("the server does not start")
        for proxy in (self.proxies.grpc, self.proxies.http):
            proxy.start()
        clients = [threading.Thread(target=self.honest.run, args=(number, self.rng.random()))
                   for number in range(HONEST)]
        clients += [threading.Thread(target=Hostile(self, number, self.rng.random()).run)
                    for number in range(HOSTILE)]
        for client in clients:
            client.start()
        end = time.monotonic() + self.seconds
        try:
            while time.monotonic() < end:
                self.disturb()
                time.sleep(1 + 2 * self.rng.random())
                self.check_health()
        finally:
            self.over.set()
            for client in clients:
                client.join()
        self.check_recovery()
        self.check_logs()

    def close(self):
        if self.server.process is not None and self.server.lives():
            self.server.kill()
        for proxy in (self.proxies.grpc, self.proxies.http):
            proxy.stopped = True
        self.server.group.remove()
        self.honest.disk.remove()

    def report(self):
        done, faults = self.history.count(what="answered", code=0), self.history.count(actor="fault")
        if done == 0 or faults == 0:
            self.history.fail("nothing was tested")
        print(f"robustness: {faults} faults, {self.history.count(what='answered')} answers, {done} of them outputs, "
              f"{self.server.incarnation} servers, {len(self.history.failures)} failures", flush=True)


def kept_programs(folder):
    """The two programs as they are now: a build beside the test replaces them while it runs."""
    return [shutil.copy2(path, os.path.join(folder, f"program.{name}"))
            for name, path in zip(("trcd", "trc"), sys.argv[1:3])]


def main():
    long_run = os.environ.get("TRC_TEST_LONG") is not None
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 300 if long_run else 20
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else random.SystemRandom().randrange(1 << 32)
    print(f"seed {seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        test = Test(*kept_programs(folder), folder, seconds, seed)
        try:
            test.run()
        finally:
            test.close()
            test.report()
            kept = os.environ.get("TRC_ROBUSTNESS_KEEP")
            if kept:
                shutil.copytree(folder, kept, dirs_exist_ok=True, ignore=shutil.ignore_patterns("program.*"))
        if test.history.failures:
            sys.exit(1)


if __name__ == "__main__":
    main()
