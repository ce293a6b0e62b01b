#!/usr/bin/env python3
"""readme_test.py BUILD_FOLDER: what README.md and client/README.md say of the command line, done.

Every command of their sh blocks is run in a folder that has the files they name, and what they show
as an answer is compared with the answer; "…" stands for what is left out there.
"""

import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv[1]).resolve()
MAIN = (TOP / "README.md").read_text()
CLIENT = (TOP / "client" / "README.md").read_text()

SLOT = "X26\nY30\nX34\nY40\n"
PART = """N10 G17 G90 G0 X-20 Y-20
N20 V.G.WZ_AKT.R=5
N30 G41 G1 X0 Y0 F500
N40 Y40
N50 X60
N60 Y0
N70 X0
N80 G40 X-20 Y-20
M30
"""
# What a machine of the reader has and this one has not.
MISSING = ("grpcurl",)
# Not run here: they build the project.
BUILDING = ("./run", "./test", "apt-get", "cmake")


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def commands(text):
    """One command each, without the comments beside them."""
    for block in blocks(text, "sh"):
        for line in block.replace("\\\n", " ").splitlines():
            command = re.sub(r"\s+# .*", "", line).strip()
            if command:
                yield command


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as listener:
        return listener.getsockname()[1]


class Readme(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = Path(tempfile.mkdtemp(prefix="readme-"))
        (cls.work / "nc").mkdir()
        samples = cls.work / "client" / "samples"
        shutil.copytree(TOP / "client" / "samples", samples)
        for name in ("part.nc", "nc/one.nc", "nc/other.nc"):
            (cls.work / name).write_text(PART)
        # Inside a square of 40 mm.
        (cls.work / "pocket.nc").write_text(
            "N10 G0 X20 Y10 F1000\nN20 G41 G1 X20 Y0\nN30 X40\nN40 Y40\nN50 X0\nN60 Y0\n"
            "N70 X20\nN80 G40 Y10\nM30\n")
        (cls.work / "tools.csv").write_text("number,radius,wear\n1,5,-0.02\n")
        # As a program of Fanuc that is both: its tool is that of the table.
        (cls.work / "fanuc.nc").write_text(
            "G17 G90 G21 G0 X-20. Y-20.\nG41 D1 G1 X0. Y0. F500\nY40.\nX60.\nY0.\nX0.\n"
            "G40 X-20. Y-20.\nM30\n")
        cls.port = free_port()
        cls.http = free_port()
        cls.certificates()
        cls.environment = {**os.environ, "PATH": f"{BUILD / 'bin'}:{os.environ['PATH']}",
                           "LC_ALL": "C", "BROWSER": "true"}
        cls.environment.pop("TRC_SERVER", None)
        cls.server = subprocess.Popen(
            [BUILD / "bin" / "trcd", "--listen", f"127.0.0.1:{cls.port}", "--http-listen",
             f"127.0.0.1:{cls.http}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        cls.run_here(f"until trc health --server 127.0.0.1:{cls.port}; do sleep 0.1; done 2>/dev/null")

    @classmethod
    def certificates(cls):
        name = ["-subj", "/CN=localhost", "-addext", "subjectAltName=IP:127.0.0.1"]
        subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2",
                        "-keyout", "server.key", "-out", "server.pem", *name],
                       cwd=cls.work, check=True, capture_output=True)
        shutil.copy(cls.work / "server.pem", cls.work / "clients.pem")

    @classmethod
    def tearDownClass(cls):
        cls.server.kill()
        cls.server.wait()
        shutil.rmtree(cls.work)

    @classmethod
    def run_here(cls, command, seconds=60):
        return subprocess.run(["bash", "-c", command], cwd=cls.work, env=cls.environment,
                              capture_output=True, text=True, timeout=seconds)

    def here(self, command):
        """On loopback, on ports that are free, and soon over."""
        command = command.replace("box:50051", f"127.0.0.1:{self.port}")
        command = command.replace("127.0.0.1:50051", f"127.0.0.1:{self.port}")
        if command.startswith("curl"):
            command = command.replace("127.0.0.1:8080", f"127.0.0.1:{self.http}")
        command = command.replace("0.0.0.0:50051", f"127.0.0.1:{free_port()}")
        command = command.replace("127.0.0.1:8080", f"127.0.0.1:{free_port()}")
        command = command.replace("/run/trcd/trcd.sock", str(self.work / "trcd.sock"))
        if "--dialect fanuc" in command:
            command = command.replace("part.nc", "fanuc.nc")
        if command == "trcd":
            command = f"trcd --listen 127.0.0.1:{free_port()}"
        return command.replace("--duration 30", "--duration 0.5")

    def starts(self, command, sign):
        """A server: says that it has begun, and ends when it is told to."""
        with subprocess.Popen(["bash", "-c", "exec " + command], cwd=self.work, text=True,
                              env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT) as server:
            try:
                said = ""
                while sign not in said:
                    line = server.stdout.readline()
                    self.assertTrue(line, f"{command}: {said}")
                    said += line
                server.send_signal(signal.SIGTERM)
                server.stdout.read()
                self.assertIn(server.wait(30), (0, 143), command)
            finally:
                server.kill()

    def test_commands_run(self):
        seen = 0
        for command in [*commands(MAIN), *commands(CLIENT)]:
            tool = command.split()[0]
            if tool in BUILDING or tool in MISSING and shutil.which(tool) is None:
                continue
            if tool == "buf":
                tool = f"{TOP}/.ci/node/node_modules/@bufbuild/buf-linux-x64/bin/buf"
                if not Path(tool).exists():
                    continue
                command = command.replace("buf", tool, 1)
            command = self.here(command)
            with self.subTest(command=command):
                seen += 1
                if tool == "trcd" and "--print-config" not in command:
                    self.starts(command, '"event":"started"')
                elif command.startswith("trc view"):
                    self.starts(command + " --no-browser", "http://")
                else:
                    done = self.run_here(command)
                    self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        self.assertGreater(seen, 30)

    def is_said(self, shown, said):
        """What is shown is what is said, "…" apart and however lines are broken."""
        parts = (re.escape(" ".join(part.split())) for part in shown.split("…"))
        self.assertRegex(" ".join(said.split()), "^" + ".*".join(parts) + "$")

    def test_first_ten_minutes(self):
        table = next(block for block in blocks(MAIN, "text") if block.startswith("$ cat outside.nc"))
        head, *rows = table.splitlines()
        begins = [found.start() for found in re.finditer(r"\$ ", head)] + [None]
        columns = ["\n".join(row[begin:end].rstrip() for row in rows).strip() + "\n"
                   for begin, end in zip(begins, begins[1:])]
        (self.work / "outside.nc").write_text(columns[0])
        pocket = self.work / "pocket.nc"
        self.addCleanup(pocket.write_text, pocket.read_text())  # that of the client's README
        pocket.write_text(columns[1])
        tools, _, asked = columns[2].partition("$ ")
        command, _, shown = asked.partition("\n")
        self.assertEqual(tools, (self.work / "tools.csv").read_text())
        done = self.run_here(command)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.is_said(shown, done.stdout)
        around = self.run_here("trc compensate outside.nc --tools tools.csv")
        self.assertEqual(around.returncode, 0, around.stderr)

        first = columns[0].replace("Y40\n", "Y40\n" + SLOT, 1)
        (self.work / "slot.nc").write_text(first)
        refused = self.run_here("trc compensate slot.nc --tools tools.csv")
        self.assertEqual(refused.returncode, 1)
        shown = next(block for block in blocks(MAIN, "text") if block.startswith("slot.nc:"))
        self.is_said(shown, refused.stderr)
        for command in re.findall(r"`(trc [a-z]+ slot\.nc[^`]*)`", MAIN.replace("\n", " ")):
            with self.subTest(command=command):
                if command.startswith("trc view"):
                    self.starts(f"{command} --no-browser", "http://")
                else:
                    self.assertIn(self.run_here(command).returncode, (0, 1), command)
        masked = first.replace("G26", "G26 G141\n#TRC[REMOVE_MASKED_BLOCKS=1]")
        (self.work / "masked.nc").write_text(masked)
        passed = self.run_here("trc compensate masked.nc --tools tools.csv")
        self.assertEqual(passed.returncode, 0, passed.stderr)

    def test_answers_of_the_client_readme(self):
        for block in blocks(CLIENT, "text"):
            if block.startswith("$ "):
                head, _, shown = block[2:].partition("\n")
                done = self.run_here(head)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.is_said(shown, done.stdout)
            else:
                line = re.search(r"^ +3 \| (.*)$", block, re.MULTILINE).group(1)
                (self.work / "part.nc").write_text(f"N10 G17 G90 G0 X0 Y20\nN20 F500\n{line}\nM30\n")
                done = self.run_here("trc compensate part.nc")
                (self.work / "part.nc").write_text(PART)
                self.assertEqual(done.returncode, 1)
                self.is_said(block, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
