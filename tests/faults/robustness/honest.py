"""Clients that mean well, what may happen to them, and whether their answers are right."""

import glob
import http.client
import json
import os
import random
import shutil
import signal
import ssl
import subprocess
import time
import urllib.error
import urllib.request

from deck import Deck

LONGEST_S = 100  # the patience of a client is 60 s, and it may have begun to lose it late
SMALL_DISK_BYTES = 128 << 10
DONE, REFUSED, WRONG_CALL, NOT_REACHABLE, LIMIT = range(5)  # exit codes of trc
PYTHON = "/usr/bin/python3"  # Debian's, which has the modules the package needs
TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))


class SmallDisk:
    """A folder with little room; only root has one."""

    def __init__(self, folder):
        self.path = os.path.join(folder, "small")
        os.mkdir(self.path)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={SMALL_DISK_BYTES}", "tmpfs", self.path],
                                 capture_output=True) if os.getuid() == 0 else None
        self.exists = mounted is not None and mounted.returncode == 0

    def remove(self):
        if self.exists:
            subprocess.run(["umount", "-l", self.path], check=False)


def python_package(folder):
    """Where the package of client/python is, with the modules of the protocol; None where these cannot
    be made or used."""
    plugin, package = shutil.which("grpc_python_plugin"), os.path.join(folder, "python")
    usable = subprocess.run([PYTHON, "-c", "import grpc, google.protobuf, numpy"], capture_output=True)
    if plugin is None or shutil.which("protoc") is None or usable.returncode != 0:
        return None
    shutil.copytree(os.path.join(TOP, "client/python/src"), package)
    os.makedirs(os.path.join(package, "trc/v1"), exist_ok=True)
    proto = os.path.join(TOP, "proto")
    subprocess.run(["protoc", f"-I{proto}", f"--python_out={package}", f"--grpc_python_out={package}",
                    f"--plugin=protoc-gen-grpc_python={plugin}", *glob.glob(proto + "/trc/v1/*.proto")], check=True)
    return package


class Answer:
    """How a question ended, in the terms of `trc`: exit code, what it wrote, what it said."""

    def __init__(self, code, output, said):
        self.code, self.output, self.said = code, output or b"", said


class Honest:
    """Asks one question after another, until it is over."""

    def __init__(self, test):
        self.trc, self.folder, self.cases = test.trc, test.folder, test.cases
        self.history, self.over, self.proxies = test.history, test.over, test.proxies
        self.longest_s = LONGEST_S * (5 if test.server.checked else 1)
        self.authority = os.path.join(test.folder, "ca.pem")
        self.package, self.disk, self.slow_disk = python_package(test.folder), SmallDisk(test.folder), test.server.disk
        self.ways = [self.to_file, self.to_file, self.to_file, self.to_slow_pipe, self.to_full_disk,
                     self.measured, self.surveyed, self.by_http, self.by_http]
        self.patient = [self.to_file, self.to_slow_pipe, self.to_full_disk, self.measured, self.surveyed]
        if self.package is not None:
            self.ways.append(self.by_python)
        if self.slow_disk.exists:
            self.ways.append(self.to_slow_disk)
            self.patient.append(self.to_slow_disk)

    def run(self, number, seed):
        rng, count = random.Random(seed), 0
        cases, ways = Deck(rng, self.cases), Deck(rng, self.ways)
        while not self.over.is_set():
            case, way, count = cases.draw(), ways.draw(), count + 1
            self.ask(f"client {number}.{count}", case, way, rng)

    def ask(self, name, case, way, rng):
        self.history.add(name, "asks", way=way.__name__, case=os.path.basename(case.source), kind=case.kind)
        begin = time.monotonic()
        answer = way(name, case, rng)
        seconds = time.monotonic() - begin
        if seconds > self.longest_s:
            self.history.fail(f"{name} has waited for {seconds:.0f} s")
        elif answer is not None:
            self.judge(name, case, way, answer, seconds)

    # --- ways to ask --------------------------------------------------------------------------

    def to_file(self, name, case, rng):
        return self.command(name, case, "compensate", rng, os.path.join(self.folder, f"out.{name}"))

    def to_slow_pipe(self, name, case, rng):
        return self.command(name, case, "compensate", rng)

    def to_slow_disk(self, name, case, rng):
        return self.command(name, case, "compensate", rng, os.path.join(self.folder, f"out.{name}"),
                            {"LD_PRELOAD": self.slow_disk.library, "SLOW_DISK_MS": str(self.slow_disk.WRITE_MS)})

    def to_full_disk(self, name, case, rng):
        full = os.path.join(self.disk.path, name) if self.disk.exists and rng.random() < 0.7 else "/dev/full"
        return self.command(name, case, "compensate", rng, full)

    def measured(self, name, case, rng):
        return self.command(name, case, "verify", rng)

    def surveyed(self, name, case, rng):
        return self.command(name, case, "radii", rng)

    def command(self, name, case, command, rng, output=None, environment=None):
        line = case.line(self.trc, command, self.proxies.grpc.port, self.authority)
        return self.process(name, line + (["-o", output] if output else []), rng, output, environment)

    def by_python(self, name, case, rng):
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "python_client.py")
        return self.process(name, [PYTHON, script, str(self.proxies.grpc.port), self.authority, case.source],
                            rng)

    def process(self, name, line, rng, output=None, environment=None):
        """None where it dies in the middle."""
        process = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env={**os.environ, "PYTHONPATH": self.package or "", **(environment or {})})
        if rng.random() < 0.1:
            time.sleep(rng.random())
            process.kill()
            process.communicate()
            self.history.add(name, "died")
            return None
        if rng.random() < 0.1:  # It stands still for a while.
            time.sleep(rng.random() / 4)
            process.send_signal(signal.SIGSTOP)
            time.sleep(rng.random() * 3)
            process.send_signal(signal.SIGCONT)
        if rng.random() < 0.2:  # Nobody reads what it has.
            time.sleep(rng.random() * 3)
        try:
            printed, said = process.communicate(timeout=self.longest_s)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return None
        return Answer(process.returncode, taken(output) if output else printed, said.decode(errors="replace"))

    def by_http(self, name, case, rng):
        with open(case.source, "rb") as file:
            text = file.read()
        request = urllib.request.Request(f"https://127.0.0.1:{self.proxies.http.port}/v1/programs:compensate",
                                         data=text, headers={"Content-Type": "text/plain"})
        trusting = ssl.create_default_context(cafile=self.authority)
        try:
            with urllib.request.urlopen(request, timeout=60, context=trusting) as answer:
                if rng.random() < 0.1:  # It does not read for a while.
                    time.sleep(rng.random() * 3)
                body = answer.read()
                if answer.headers["Trc-Status"] != "OK" and answer.headers["Transfer-Encoding"] != "chunked":
                    self.history.fail(f"{name}: HTTP 200 and no Trc-Status")
                return Answer(DONE, body, "")
        except urllib.error.HTTPError as refusal:
            return self.refused_by_http(name, refusal)
        except (OSError, http.client.HTTPException) as lost:
            return Answer(NOT_REACHABLE, None, repr(lost))

    def refused_by_http(self, name, refusal):
        try:
            said = refusal.read().decode()
            problem = json.loads(said)
        except (OSError, http.client.HTTPException) as lost:
            return Answer(NOT_REACHABLE, None, repr(lost))
        if refusal.code == 422 and problem.get("diagnostics"):
            return Answer(REFUSED, None, said)
        if refusal.code == 503 and refusal.headers["Retry-After"] is not None or refusal.code == 413:
            return Answer(LIMIT, None, said)
        self.history.fail(f"{name}: HTTP {refusal.code}: {said}")
        return None

    def probe(self, case, port):
        """Asks past the proxies, and judges the answer; its exit code."""
        line = case.line(self.trc, "compensate", port, self.authority)
        done = subprocess.run(line, capture_output=True, timeout=self.longest_s)
        self.judge("probe", case, self.to_slow_pipe,
                   Answer(done.returncode, done.stdout, done.stderr.decode(errors="replace")), 0)
        return done.returncode

    # --- what must hold -----------------------------------------------------------------------

    def judge(self, name, case, way, answer, seconds):
        said = answer.said.strip()
        self.history.add(name, "answered", code=answer.code, said=said[-300:], seconds=round(seconds, 2))
        alone = case.alone.get({self.measured: "verify", self.surveyed: "radii"}.get(way, "compensate"))
        if alone is not None and answer.code == alone[0]:
            if answer.output != alone[1]:
                got = os.path.join(self.folder, f"differs.{name}")
                with open(got, "wb") as file:
                    file.write(answer.output)
                self.history.fail(f"{name} {way.__name__}: exit {answer.code}, but not the output of trc alone: "
                                  f"{len(answer.output)} bytes instead of {len(alone[1])}, another one from byte "
                                  f"{len(os.path.commonprefix([answer.output, alone[1]]))} on ({case.source})")
            return
        if answer.code == DONE and alone is None:
            return
        full = way == self.to_full_disk and answer.code == WRONG_CALL and "No space left on device" in said
        if not full and (answer.code not in (NOT_REACHABLE, LIMIT) or not said):
            self.history.fail(f"{name}: exit {answer.code}, and says {said!r}")
        told_to_wait = answer.code == LIMIT and "try again later" in said.splitlines()[-1]
        if told_to_wait and way in self.patient and "waiting for up to" not in said:
            self.history.fail(f"{name}: it has not waited: {said!r}")
        if answer.output:
            self.history.fail(f"{name}: exit {answer.code}, but left an output")


def taken(path):
    """What is in a file, which is removed; None where there is none."""
    if not os.path.isfile(path):
        return None
    with open(path, "rb") as file:
        text = file.read()
    os.remove(path)
    return text
