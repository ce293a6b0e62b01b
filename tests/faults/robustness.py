#!/usr/bin/env python3
"""Random faults against random clients, for a set time, and what must hold afterwards.

    robustness.py TRCD TRC [SECONDS [SEED]]

Without SECONDS it is 20, and 300 where TRC_TEST_LONG is set. TRC_ROBUSTNESS_KEEP names a folder for
what a run that fails leaves: history, logs, programs, outputs.

A server of limited memory, descriptors and streams, behind a proxy that slows, cuts and stalls.
Honest clients give programs to `trc compensate`; hostile ones send garbage, hold connections, ask
for too much, die or stop reading. Meanwhile the server is killed and started again, stopped, its
certificates are changed for good and for bad ones. Everything asked and answered goes into a
history, which is checked at the end:

- every finished output is that of `trc` without a server, byte for byte
- every refusal says why, and its exit code fits
- nobody waits longer than told, the server least of all
- health told the truth whenever nothing was disturbed
- memory and descriptors come back

The seed is printed; the same one gives the same faults, not the same timing.
"""

import json
import os
import random
import re
import select
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

LONGEST_CLIENT_S = 100  # the patience of a client is 60 s, and it may have begun to lose it late
MEMORY_MIB = 384
CHECKER_MEMORY_MIB = 8192
CHECKER_SHORTER = 20


def is_checked(program):
    """Whether it was built with a sanitizer, which takes many times the memory."""
    with open(program, "rb") as file:
        text = file.read()
    return b"__asan_init" in text or b"__tsan_init" in text


class History:
    """What happened, in order."""

    def __init__(self, path):
        self.lock, self.events, self.file = threading.Lock(), [], open(path, "w")
        self.start = time.monotonic()

    def add(self, actor, what, **more):
        event = {"s": round(time.monotonic() - self.start, 3), "actor": actor, "what": what, **more}
        with self.lock:
            self.events.append(event)
            self.file.write(json.dumps(event) + "\n")
            self.file.flush()


class Proxy(threading.Thread):
    """Carries connections to the server. `mode`: pass, slow (little at a time), hold (nothing moves)
    or cut (connections are reset, new ones too)."""

    def __init__(self, target):
        super().__init__(daemon=True)
        self.target, self.mode, self.stopped = target, "pass", False
        self.listener = socket.create_server(("127.0.0.1", 0), backlog=128)
        self.port = self.listener.getsockname()[1]
        self.pairs = {}

    def close(self, end):
        other = self.pairs.pop(end, None)
        if other is not None:
            self.pairs.pop(other, None)
            other.close()
        end.close()

    def accept(self):
        ours, _ = self.listener.accept()
        if self.mode == "cut":
            ours.close()
            return
        try:
            theirs = socket.create_connection(("127.0.0.1", self.target), timeout=1)
        except OSError:
            ours.close()
            return
        self.pairs[ours], self.pairs[theirs] = theirs, ours

    def carry(self, end):
        other = self.pairs.get(end)
        if other is None:
            return
        try:
            data = end.recv(512 if self.mode == "slow" else 65536)
            if data:
                other.settimeout(5)
                other.sendall(data)
                return
        except OSError:
            pass
        self.close(end)

    def run(self):
        while not self.stopped:
            if self.mode == "cut":
                for end in list(self.pairs):
                    self.close(end)
            if self.mode == "hold":
                time.sleep(0.05)
                continue
            if self.mode == "slow":
                time.sleep(0.01)
            try:
                ready, _, _ = select.select([self.listener, *self.pairs], [], [], 0.05)
            except (OSError, ValueError):
                self.pairs = {a: b for a, b in self.pairs.items() if a.fileno() >= 0 and b.fileno() >= 0}
                continue
            for end in ready:
                if end is self.listener:
                    self.accept()
                elif end in self.pairs:
                    self.carry(end)


def openssl(*arguments):
    subprocess.run(["openssl", *arguments], check=True, capture_output=True)


def make_certificates(folder):
    """An authority, two certificates of it, and a pair that does not match."""
    path = lambda name: os.path.join(folder, name)
    openssl("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2",
            "-subj", "/CN=test authority", "-keyout", path("ca.key"), "-out", path("ca.pem"))
    with open(path("ext"), "w") as file:
        file.write("subjectAltName=IP:127.0.0.1\n")
    for name in ("a", "b"):
        openssl("req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-subj", "/CN=127.0.0.1",
                "-keyout", path(name + ".key"), "-out", path(name + ".csr"))
        openssl("x509", "-req", "-days", "2", "-in", path(name + ".csr"), "-CA", path("ca.pem"), "-CAkey",
                path("ca.key"), "-CAcreateserial", "-extfile", path("ext"), "-out", path(name + ".pem"))


class Server:
    """trcd, started again and again at one port with settings that change."""

    def __init__(self, trcd, folder, history, rng):
        self.trcd, self.folder, self.history, self.rng = trcd, folder, history, rng
        self.checked = is_checked(trcd)
        self.memory_mib = CHECKER_MEMORY_MIB if self.checked else MEMORY_MIB
        self.process, self.incarnation = None, 0
        with socket.create_server(("127.0.0.1", 0)) as probe:
            self.port = probe.getsockname()[1]
        with socket.create_server(("127.0.0.1", 0)) as probe:
            self.admin = probe.getsockname()[1]
        self.put_certificate("a", "a")

    def path(self, name):
        return os.path.join(self.folder, name)

    def put_certificate(self, certificate, key):
        for name, source in (("server.pem", certificate + ".pem"), ("server.key", key + ".key")):
            with open(self.path(source)) as file:
                text = file.read()
            with open(self.path("new"), "w") as file:
                file.write(text)
            os.replace(self.path("new"), self.path(name))

    def start(self):
        self.incarnation += 1
        descriptors = self.rng.choice([128, 256, 1024])
        self.log = open(self.path(f"server.{self.incarnation}.log"), "w")
        limit = lambda: __import__("resource").setrlimit(
            __import__("resource").RLIMIT_NOFILE, (descriptors, descriptors))
        self.process = subprocess.Popen(
            [self.trcd, "--listen", f"127.0.0.1:{self.port}", "--admin-listen", f"127.0.0.1:{self.admin}",
             "--tls-cert-file", self.path("server.pem"), "--tls-key-file", self.path("server.key"),
             "--tls-refresh-s", "1", "--resume-key-file", self.path("resume.key"), "--memory-limit-mib",
             str(self.memory_mib), "--max-streams", str(self.rng.choice([8, 24, 60])), "--idle-timeout-s", "10",
             "--keepalive-time-s", "5", "--keepalive-timeout-s", "3", "--drain-timeout-s", "2",
             "--max-selection-cpu-s", "10"],
            stdout=self.log, stderr=subprocess.STDOUT, preexec_fn=limit)
        self.history.add("server", "started", incarnation=self.incarnation, descriptors=descriptors)

    def ready(self):
        """What /readyz says, or None."""
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.admin}/readyz", timeout=3) as answer:
                return answer.status
        except urllib.error.HTTPError as said:
            return said.code
        except OSError:
            return None

    def wait_ready(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.ready() == 200:
                return True
            time.sleep(0.1)
        return False

    def resident_mib(self):
        with open(f"/proc/{self.process.pid}/status") as file:
            return int(re.search(r"VmRSS:\s+(\d+)", file.read()).group(1)) / 1024

    def descriptors(self):
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    def kill(self):
        self.process.kill()
        self.process.wait()

    def end(self):
        """Asks it to end. How long that took."""
        begin = time.monotonic()
        self.process.send_signal(signal.SIGTERM)
        try:
            self.process.wait(30)
        except subprocess.TimeoutExpired:
            self.kill()
        return time.monotonic() - begin


def program(rng, kind, shorter):
    """A contour as a program: plain, masked as a whole, with a mistake, or with more than there is room
    for. `shorter`: so many times, but for the last kind."""
    turns = {"plain": rng.randint(5, 4000 // shorter), "masked": rng.randint(5, 8000 // shorter),
             "huge": 120000, "mistake": rng.randint(5, 500)}[kind]
    lines = ["G141"] if kind in ("masked", "huge") else []
    lines.append("N5 G1 G41 V.G.WZ_AKT.R=0.5 X0 Y10 F800")
    for turn in range(turns):
        x, y = 20 * (turn % 4000), 10 + turn * 7 % 11
        lines += [f"G1 X{x + 5} Y{y}", f"X{x + 10}", f"G2 X{x + 16} I3 J0", "M8"]
        if turn % 4000 == 3999:
            lines += ["G1 Y200", "X-50", "Y10"]
    if kind == "mistake":
        lines.append("G2 X0 Y0 I1 J1")
    return "\n".join(lines + ["G40", "G1 X0 Y-100", "M30", ""])


class Test:
    def __init__(self, trcd, trc, folder, seconds, seed):
        self.trc, self.folder, self.seconds = trc, folder, seconds
        self.rng = random.Random(seed)
        self.history = History(os.path.join(folder, "history.jsonl"))
        make_certificates(folder)
        self.server = Server(trcd, folder, self.history, random.Random(self.rng.random()))
        self.longest_client_s = LONGEST_CLIENT_S * (5 if self.server.checked else 1)
        self.proxy = Proxy(self.server.port)
        self.over = threading.Event()
        self.quiet = threading.Event()  # nothing is disturbed just now
        self.quiet.set()
        self.faults = []
        self.cases = [self.make_case(i, kind) for i, kind in enumerate(
            ["plain"] * 4 + ["masked"] * 3 + ["mistake"] + ["huge"])]

    def fail(self, what):
        self.faults.append(what)
        self.history.add("check", "FAILED", why=what)
        print(f"FAILED: {what}", flush=True)

    def make_case(self, number, kind):
        """A program, and what `trc` makes of it without a server."""
        source = os.path.join(self.folder, f"case{number}.nc")
        with open(source, "w") as file:
            file.write(program(self.rng, kind, CHECKER_SHORTER if self.server.checked else 1))
        alone = None
        if kind != "huge":
            local = subprocess.run([self.trc, "compensate", source], capture_output=True, timeout=120)
            alone = (local.returncode, local.stdout)
        return {"source": source, "kind": kind, "alone": alone}

    # --- clients ------------------------------------------------------------------------------

    def command(self, case, output, port):
        return [self.trc, "compensate", case["source"], "--server", f"127.0.0.1:{port}", "--tls-ca",
                os.path.join(self.folder, "ca.pem"), "-o", output]

    def honest(self, number):
        rng = random.Random(f"{number} {self.rng.random()}")
        count = 0
        while not self.over.is_set():
            case, count = rng.choice(self.cases), count + 1
            output = os.path.join(self.folder, f"out.{number}")
            if os.path.exists(output):
                os.remove(output)
            begin, name = time.monotonic(), f"client {number}.{count}"
            self.history.add(name, "asks", case=case["source"], kind=case["kind"])
            process = subprocess.Popen(self.command(case, output, self.proxy.port), stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE)
            if rng.random() < 0.1:  # It dies in the middle.
                time.sleep(rng.random())
                process.kill()
                process.communicate()
                self.history.add(name, "died")
                continue
            if rng.random() < 0.1:  # It does not read for a while.
                time.sleep(rng.random() / 4)
                process.send_signal(signal.SIGSTOP)
                time.sleep(rng.random() * 3)
                process.send_signal(signal.SIGCONT)
            try:
                _, said = process.communicate(timeout=self.longest_client_s)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                self.fail(f"{name} has waited for {self.longest_client_s} s")
                continue
            self.judge(name, case, process.returncode, said.decode(errors="replace"), output,
                       time.monotonic() - begin)

    def judge(self, name, case, code, said, output, seconds):
        self.history.add(name, "answered", code=code, said=said.strip()[-300:], seconds=round(seconds, 2))
        written = None
        if os.path.exists(output):
            with open(output, "rb") as file:
                written = file.read()
        if code == 0:
            if case["alone"] is None:
                return
            if case["alone"] != (0, written):
                self.fail(f"{name}: the output of {case['source']} is not that of trc alone")
        elif case["alone"] is not None and case["alone"][0] == code:
            if written:
                self.fail(f"{name}: refused, but left a file")
        else:
            if code not in (1, 3, 4) or not said.strip():
                self.fail(f"{name}: exit {code}, and says {said!r}")
            if written:
                self.fail(f"{name}: exit {code}, but left a file")

    def hostile(self, number):
        rng = random.Random(f"hostile {number} {self.rng.random()}")
        held = []
        while not self.over.is_set():
            kind = rng.choice(["garbage", "hold", "storm", "preface", "drop"])
            self.history.add(f"hostile {number}", kind)
            try:
                for _ in range({"storm": 60, "hold": 20}.get(kind, 1)):
                    end = socket.create_connection(("127.0.0.1", self.server.port), timeout=2)
                    if kind == "garbage":
                        end.sendall(rng.randbytes(rng.randint(1, 4096)))
                    elif kind == "preface":
                        end.sendall(b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + rng.randbytes(64))
                    if kind == "hold":
                        held.append(end)
                    else:
                        end.close()
            except OSError:
                pass
            if kind == "drop" or len(held) > 60:
                for end in held:
                    end.close()
                held = []
            time.sleep(rng.random())
        for end in held:
            end.close()

    # --- faults -------------------------------------------------------------------------------

    def disturb(self):
        fault = self.rng.choice(
            ["kill", "stop", "cut", "hold", "slow", "certificate", "broken certificate", "restart"])
        self.history.add("fault", fault)
        server = self.server
        if fault == "kill":
            server.kill()
            time.sleep(self.rng.random())
            server.start()
        elif fault == "restart":
            seconds = server.end()
            self.history.add("server", "ended", seconds=round(seconds, 2), code=server.process.returncode)
            if seconds > 2 + 2 + 1:
                self.fail(f"it took {seconds:.1f} s to end with a drain timeout of 2 s")
            server.start()
        elif fault == "stop":
            server.process.send_signal(signal.SIGSTOP)
            time.sleep(0.5 + 2 * self.rng.random())
            server.process.send_signal(signal.SIGCONT)
        elif fault in ("cut", "hold", "slow"):
            self.proxy.mode = fault
            time.sleep(0.2 + 3 * self.rng.random())
            self.proxy.mode = "pass"
        elif fault == "certificate":
            server.put_certificate(*(["b", "b"] if self.rng.random() < 0.5 else ["a", "a"]))
            server.process.send_signal(signal.SIGHUP)
        else:
            server.put_certificate("a", "b")
            server.process.send_signal(signal.SIGHUP)
            time.sleep(1 + self.rng.random())
            server.put_certificate("a", "a")
            server.process.send_signal(signal.SIGHUP)
        if not server.wait_ready(20):
            self.fail(f"not ready 20 s after {fault}")

    def check_health(self):
        """Nothing is disturbed: who is ready must serve, or say that there is no place."""
        ready = self.server.ready()
        output = os.path.join(self.folder, "out.probe")
        probe = self.cases[0]
        done = subprocess.run(self.command(probe, output, self.server.port), capture_output=True,
                              timeout=self.longest_client_s)
        self.judge("probe", probe, done.returncode, done.stderr.decode(errors="replace"), output, 0)
        self.history.add("probe", "health", ready=ready, code=done.returncode)
        if ready != 200 and self.server.process.poll() is None and self.server.ready() != 200:
            self.fail(f"/readyz says {ready}, and nothing is disturbed")
        if self.server.process.poll() is not None:
            self.fail(f"the server has died by itself: {self.server.process.returncode}")
            self.server.start()
            self.server.wait_ready(20)
        resident = self.server.resident_mib()
        if resident > self.server.memory_mib:
            self.fail(f"{resident:.0f} MiB resident, {self.server.memory_mib} are allowed")

    def check_recovery(self):
        """Nobody is there any more: what was taken comes back, and it serves at once."""
        before = (40, 40)
        end = time.monotonic() + 30
        while time.monotonic() < end:
            now = (self.server.resident_mib(), self.server.descriptors())
            if (now[0] < before[0] + 110 or self.server.checked) and now[1] < before[1] + 20:
                break
            time.sleep(0.5)
        else:
            self.fail(f"{now[0]:.0f} MiB and {now[1]} descriptors are still in use")
        self.check_health()
        seconds = self.server.end()
        longest = 10 if self.server.checked else 3
        if self.server.process.returncode != 0 or seconds > longest:
            self.fail(f"idle, it took {seconds:.1f} s to end, exit {self.server.process.returncode}")
        if any('"incident"' in line for line in self.log_lines()):
            self.fail("there was an incident")

    def log_lines(self):
        for number in range(1, self.server.incarnation + 1):
            with open(self.server.path(f"server.{number}.log")) as file:
                yield from file

    def run(self):
        self.server.start()
        if not self.server.wait_ready(20):
            sys.exit("the server does not start")
        self.proxy.start()
        clients = [threading.Thread(target=self.honest, args=(i,)) for i in range(6)]
        clients += [threading.Thread(target=self.hostile, args=(i,)) for i in range(2)]
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
        self.proxy.stopped = True

    def report(self):
        answered = [event for event in self.history.events if event["what"] == "answered"]
        done = sum(1 for event in answered if event["code"] == 0)
        faults = sum(1 for event in self.history.events if event["actor"] == "fault")
        print(f"{faults} faults, {len(answered)} answers, {done} of them outputs, "
              f"{self.server.incarnation} servers, {len(self.faults)} failures")
        if done == 0 or faults == 0:
            self.fail("nothing was tested")


def main():
    trcd, trc = (os.path.abspath(path) for path in sys.argv[1:3])
    long_run = os.environ.get("TRC_TEST_LONG") is not None
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 300 if long_run else 20
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else random.SystemRandom().randrange(1 << 32)
    print(f"seed {seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        test = Test(trcd, trc, folder, seconds, seed)
        try:
            test.run()
        finally:
            if test.server.process and test.server.process.poll() is None:
                test.server.kill()
            test.report()
            if test.faults:
                kept = os.environ.get("TRC_ROBUSTNESS_KEEP")
                if kept:
                    os.makedirs(kept, exist_ok=True)
                    subprocess.run(["cp", "-r", folder + "/.", kept], check=False)
        if test.faults:
            sys.exit(1)


if __name__ == "__main__":
    main()
