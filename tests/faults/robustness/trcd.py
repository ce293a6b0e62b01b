"""The server under test: started again and again at the same ports, each time in other surroundings."""

import fcntl
import os
import re
import shutil
import signal
import socket
import struct
import subprocess
import threading
import time
import urllib.error
import urllib.request

MEMORY_MIB = 512
CHECKER_MEMORY_MIB = 8192
DRAIN_TIMEOUT_S = 2
PIPE_BYTES = 4096  # two dozen lines of the log
HOURS_S = 12 * 3600  # the certificates are good for two days


def is_checked(program):
    """Whether it was built with a sanitizer, which takes many times the memory."""
    with open(program, "rb") as file:
        text = file.read()
    return b"__asan_init" in text or b"__tsan_init" in text


def openssl(*arguments):
    subprocess.run(["openssl", *arguments], check=True, capture_output=True)


def make_certificates(folder):
    """An authority and two certificates of it."""
    path = lambda name: os.path.join(folder, name)
    curve = ["-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes"]
    openssl("req", "-x509", *curve, "-days", "2", "-subj", "/CN=test authority",
            "-keyout", path("ca.key"), "-out", path("ca.pem"))
    with open(path("ext"), "w") as file:
        file.write("subjectAltName=IP:127.0.0.1\n")
    for name in ("a", "b"):
        openssl("req", *curve, "-subj", "/CN=127.0.0.1", "-keyout", path(name + ".key"), "-out", path(name + ".csr"))
        openssl("x509", "-req", "-days", "2", "-in", path(name + ".csr"), "-CA", path("ca.pem"), "-CAkey",
                path("ca.key"), "-CAcreateserial", "-extfile", path("ext"), "-out", path(name + ".pem"))


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as probe:
        return probe.getsockname()[1]


class MemoryGroup:
    """A cgroup of version 1 or 2 whose processes are killed above so much memory; root alone may make one."""

    HIERARCHIES = (("/sys/fs/cgroup/memory", "memory.limit_in_bytes"), ("/sys/fs/cgroup", "memory.max"))

    def __init__(self, mib):
        self.path = None
        for hierarchy, limit in self.HIERARCHIES:
            path = os.path.join(hierarchy, f"trc-robustness-{os.getpid()}")
            try:
                os.mkdir(path)
            except OSError:
                continue
            try:
                with open(os.path.join(path, limit), "w") as file:
                    file.write(str(mib << 20))
                self.path = path
                return
            except OSError:
                os.rmdir(path)

    def remove(self):
        for _ in range(100):  # What was in it may just be ending.
            try:
                if self.path is not None:
                    os.rmdir(self.path)
                return
            except OSError:
                time.sleep(0.05)


class Clock:
    """The wall clock the server sees; the monotonic one stays what it is. Its own library is needed for
    that, see there."""

    SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "shifted_clock.cpp")

    def __init__(self, folder, checked):
        self.library, self.file = os.path.join(folder, "shifted_clock.so"), os.path.join(folder, "clock")
        self.exists = not checked  # a sanitizer must be the first library there is
        with open(self.file, "wb") as file:
            file.write(bytes(8))
        if self.exists:
            subprocess.run(["c++", "-std=c++20", "-shared", "-fPIC", "-O1", "-o", self.library, self.SOURCE],
                           check=True)

    def jump_to(self, seconds):
        with open(self.file, "r+b") as file:
            file.write(struct.pack("=q", seconds))

    def environment(self, disk):
        """That of a server whose files lie on the disk, which is as fast as any where there is none."""
        if not self.exists:
            return []
        libraries = [self.library] + ([disk.library] if disk else [])
        return [f"LD_PRELOAD={' '.join(libraries)}", f"SHIFTED_CLOCK={self.file}",
                f"SLOW_DISK_MS={SlowDisk.WRITE_MS}"]


class SlowDisk:
    """Makes what a process writes to files take long; see its own library."""

    SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "slow_disk.cpp")
    WRITE_MS = 40

    def __init__(self, folder, checked):
        self.library = os.path.join(folder, "slow_disk.so")
        self.exists = not checked  # a sanitizer must be the first library there is
        if self.exists:
            subprocess.run(["c++", "-std=c++20", "-shared", "-fPIC", "-O1", "-o", self.library, self.SOURCE],
                           check=True)


class PipeReader(threading.Thread):
    """Reads what a server logs into a file; not while `reads` is not set."""

    def __init__(self, pipe, path):
        super().__init__(daemon=True)
        self.pipe, self.path, self.reads = pipe, path, threading.Event()
        self.reads.set()

    def run(self):
        with open(self.pipe, "rb", buffering=0) as pipe, open(self.path, "wb", buffering=0) as file:
            while True:
                self.reads.wait()
                part = pipe.read(PIPE_BYTES)
                if not part:
                    return
                file.write(part)


class Server:
    """trcd, with limits of memory, descriptors and streams."""

    def __init__(self, trcd, folder, history, rng):
        self.trcd, self.folder, self.history, self.rng = trcd, folder, history, rng
        self.checked = is_checked(trcd)
        self.memory_mib = CHECKER_MEMORY_MIB if self.checked else MEMORY_MIB
        self.process, self.incarnation, self.reader = None, 0, None
        self.port, self.admin, self.http, self.health = free_port(), free_port(), free_port(), free_port()
        self.clock, self.disk = Clock(folder, self.checked), SlowDisk(folder, self.checked)
        self.group = MemoryGroup(self.memory_mib)
        make_certificates(folder)
        self.put_certificate("a", "a")

    def path(self, name):
        return os.path.join(self.folder, name)

    def put_certificate(self, certificate, key):
        for name, source in (("server.pem", certificate + ".pem"), ("server.key", key + ".key")):
            shutil.copyfile(self.path(source), self.path("new"))
            os.replace(self.path("new"), self.path(name))

    def log_path(self, incarnation):
        return self.path(f"server.{incarnation}.log")

    def open_log(self, kind):
        """Standard output of the next server: a file, a pipe or a device that is full."""
        self.reader = None
        if kind == "file":
            return os.open(self.log_path(self.incarnation), os.O_WRONLY | os.O_CREAT)
        if kind == "full device":
            return os.open("/dev/full", os.O_WRONLY)
        ours, theirs = os.pipe()
        fcntl.fcntl(theirs, fcntl.F_SETPIPE_SZ, PIPE_BYTES)
        self.reader = PipeReader(ours, self.log_path(self.incarnation))
        self.reader.start()
        return theirs

    def flags(self, in_group):
        flags = {
            "listen": f"127.0.0.1:{self.port}", "admin-listen": f"127.0.0.1:{self.admin}",
            "health-listen": f"127.0.0.1:{self.health}", "http-listen": f"127.0.0.1:{self.http}",
            "http-timeout-s": 5, "http-max-connections": 64,
            "tls-cert-file": self.path("server.pem"), "tls-key-file": self.path("server.key"),
            "tls-refresh-s": 1, "resume-key-file": self.path("resume.key"),
            "max-streams": self.rng.choice([8, 24, 60]), "max-connections-per-peer": 20, "idle-timeout-s": 10,
            "keepalive-time-s": 5, "keepalive-timeout-s": 3, "drain-timeout-s": DRAIN_TIMEOUT_S,
            "max-selection-cpu-s": 10}
        if not in_group:
            flags["memory-limit-mib"] = self.memory_mib
        return [word for name, value in flags.items() for word in ("--" + name, str(value))]

    def start(self):
        self.incarnation += 1
        surroundings = {"descriptors": self.rng.choice([128, 256, 1024]),
                        "log": self.rng.choice(["file", "pipe", "pipe", "full device"]),
                       "slow disk": self.disk.exists and self.rng.random() < 0.3,
                        "group": self.group.path is not None and self.rng.random() < 0.5}
        output = self.open_log(surroundings["log"])
        join = f"echo $$ >{self.group.path}/cgroup.procs && " if surroundings["group"] else ""
        with open(self.path(f"server.{self.incarnation}.err"), "w") as errors:
            self.process = subprocess.Popen(
                ["/bin/sh", "-c", f"{join}ulimit -n {surroundings['descriptors']} && exec env \"$@\"", "trcd",
                 *self.clock.environment(self.disk if surroundings["slow disk"] else None), self.trcd,
                 *self.flags(surroundings["group"])],
                stdout=output, stderr=errors)
        os.close(output)
        self.history.add("server", "started", incarnation=self.incarnation, **surroundings)

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

    def resident_mib(self, what="VmRSS"):
        """Or, for VmHWM, the most there was; 0 where it has ended."""
        try:
            with open(f"/proc/{self.process.pid}/status") as file:
                return int(re.search(what + r":\s+(\d+)", file.read()).group(1)) / 1024
        except (OSError, AttributeError):
            return 0

    def descriptors(self):
        return len(os.listdir(f"/proc/{self.process.pid}/fd"))

    def lives(self):
        return self.process.poll() is None

    def kill(self):
        self.history.add("server", "killed", incarnation=self.incarnation, peak_mib=round(self.resident_mib("VmHWM")))
        self.process.kill()
        self.process.wait()

    def end(self):
        """Asks it to end. How long that took."""
        peak_mib, begin = round(self.resident_mib("VmHWM")), time.monotonic()
        self.process.send_signal(signal.SIGTERM)
        try:
            self.process.wait(30)
        except subprocess.TimeoutExpired:
            self.kill()
        seconds = time.monotonic() - begin
        self.history.add("server", "ended", incarnation=self.incarnation, seconds=round(seconds, 2), code=self.process.returncode,
                         peak_mib=peak_mib)
        return seconds

    def logs(self):
        """Of each server its number and what it has logged."""
        for number in range(1, self.incarnation + 1):
            if os.path.exists(self.log_path(number)):
                with open(self.log_path(number), "rb") as file:
                    yield number, file.read()
