"""trcd for the tests of its HTTP, and what asks it."""
import http.client
import json
import os
import re
import socket
import subprocess
import tempfile
import time

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.environ.get("TRC_BUILD", os.path.join(TOP, "build/dev"))

SQUARE = """N10 G00 X-20 Y-20
N20 G41 G01 X0 Y0 F500
N30 G01 X0 Y50
N40 G01 X50 Y50
N50 G01 X50 Y0
N60 G01 X0 Y0
N70 G40 G01 X-20 Y-20
N80 M30
"""
# The tool does not fit into the notch.
NOTCH = """N10 G00 X-20 Y0
N20 G42 G01 X0 Y0 F500
N30 G01 X20 Y0
N40 G01 X20 Y10
N50 G01 X24 Y10
N60 G01 X24 Y0
N70 G01 X60 Y0
N80 G40 G01 X80 Y-20
N90 M30
"""
# The path beside N30 runs through the wall N70, after a change of side.
THROUGH_A_WALL = """N10 G00 X-20 Y0 F1000
N20 G138 G26 G141
N25 G41 G01 X0 Y0
N30 X60
N40 G42 X70 Y20
N50 Y40
N60 X30
N70 Y3
N80 X20
N90 Y40
N100 X0
N110 G40 X-20
N120 M30
"""


def trc(*arguments, text=None):
    """The command line, which is the service in a process of its own."""
    done = subprocess.run([BUILD + "/bin/trc", *arguments], input=text, capture_output=True,
                          timeout=60, check=False)
    return done.returncode, done.stdout


class HalfSent:
    """A program of which gRPC has one half: its stream is open until the other one comes."""

    def __init__(self, address, text, *arguments):
        self.begin, self.rest = text[:len(text) // 2], text[len(text) // 2:]
        self.process = subprocess.Popen(
            [BUILD + "/bin/trc", "compensate", "-", "--server", address, "--wait", "0", *arguments],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.process.stdin.write(self.begin.encode())
        self.process.stdin.flush()

    def finish(self):
        """What comes of the whole of it."""
        out, _ = self.process.communicate(self.rest.encode(), timeout=60)
        return self.process.returncode, out


class Server:
    """trcd with HTTP on a free port; ends with the `with`."""

    def __init__(self, *flags, listen="127.0.0.1:0"):
        self.log = tempfile.TemporaryFile()
        self.process = subprocess.Popen(
            [BUILD + "/bin/trcd", "--listen", "127.0.0.1:0", "--http-listen", listen, *flags],
            stdout=self.log, stderr=subprocess.STDOUT)
        started = None
        for _ in range(200):
            started = re.search(r'"ports":"(\d+)".*"http_port":(\d+)', self.said())
            if started or self.process.poll() is not None:
                break
            time.sleep(0.05)
        assert started, self.said()
        self.grpc_address = "127.0.0.1:" + started[1]
        self.port = int(started[2])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(timeout=60)
        self.log.close()

    def said(self):
        """The lines it has logged so far, read without a move of where it writes."""
        descriptor = self.log.fileno()
        logged = os.pread(descriptor, os.fstat(descriptor).st_size, 0).decode()
        return logged[:logged.rfind("\n") + 1]

    def said_soon(self, pattern):
        """The log, once it has that line: lines are written after the answers."""
        for _ in range(400):
            if re.search(pattern, self.said()):
                break
            time.sleep(0.05)
        return self.said()

    def resident_mib(self):
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as status:
            return int(re.search(r"VmRSS:\s*(\d+)", status.read())[1]) / 1024

    def connect(self, timeout=30):
        return socket.create_connection(("127.0.0.1", self.port), timeout=timeout)

    def ask(self, method, path, body=None, headers=None):
        """Status, headers and body of one answer."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        try:
            connection.request(method, path, body=body, headers=headers or {})
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def ask_json(self, method, path, body=None, headers=None):
        status, _, answer = self.ask(method, path, body, headers)
        return status, json.loads(answer) if answer else None

    def grpc_works(self):
        """A program through gRPC, in seconds; fails where it does not come out right."""
        begin = time.monotonic()
        code, _ = trc("compensate", "-", "--server", self.grpc_address, "--set", "tool_radius=5",
                      text=SQUARE.encode())
        assert code == 0, code
        return time.monotonic() - begin
