"""Folders of programs under interrupts, and with servers that die: what is there is whole, what was
done is told, and a second run does what is left."""
import json
import os
import random
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(TOP, "tests/http"))

from server import BUILD, NOTCH, SQUARE  # noqa: E402

ENVIRONMENT = {**os.environ, "LC_ALL": "C", "TRC_SERVER": ""}
PROGRAMS = 16
LINES = 12000


def zigzag(number):
    """A program that takes some tenths of a second, another one for each number."""
    text = ["N1 G00 X-20 Y-20", "N2 G41 G01 X0 Y0 F500"]
    text += [f"G01 X{(i + number) % 7 + i / 10:.1f} Y{10 + i}" for i in range(LINES)]
    return "\n".join(text + [f"G40 G01 X{LINES / 10 - 50} Y{LINES + 50}", "M30", ""])


class Trcd:
    """A server at a port that stays its own when it is started again."""

    def __init__(self, folder):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.address = f"127.0.0.1:{probe.getsockname()[1]}"
        self.key = folder
        self.start()

    def start(self):
        self.process = subprocess.Popen(
            [BUILD + "/bin/trcd", "--listen", self.address, "--resume-key-file", self.key],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(400):
            try:
                socket.create_connection(("127.0.0.1", int(self.address.split(":")[1]))).close()
                return
            except OSError:
                time.sleep(0.02)
        raise AssertionError("trcd does not start")

    def kill(self):
        self.process.kill()
        self.process.wait()


class Folders(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.top = cls.scratch.name
        cls.names = [f"p{number:02}.nc" for number in range(PROGRAMS)]
        cls.whole = {}
        for number, name in enumerate(cls.names):
            with open(os.path.join(cls.top, name), "w", encoding="ascii") as file:
                file.write(zigzag(number))
            cls.whole[name] = subprocess.run(
                [BUILD + "/bin/trc", "compensate", name, "--radius", "0.01"], cwd=cls.top,
                env=ENVIRONMENT, check=True, capture_output=True).stdout

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def setUp(self):
        self.out = tempfile.TemporaryDirectory()
        self.addCleanup(self.out.cleanup)

    def begin(self, *arguments, names=None, out=None, own_group=False):
        command = [BUILD + "/bin/trc", "compensate", *(names or self.names), "--radius", "0.01",
                   "--jobs", "2", "--output-dir", out or self.out.name, *arguments]
        return subprocess.Popen(command, cwd=self.top, env=ENVIRONMENT, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, start_new_session=own_group)

    def results(self):
        return {name for name in os.listdir(self.out.name) if name.endswith(".nc")}

    def wait_for_results(self, count):
        """So many with their records."""
        end = time.monotonic() + 30
        while sum(name.endswith(".json") for name in os.listdir(self.out.name)) < count:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.002)

    def table(self, told):
        """The result of each program, and that the last line counts them."""
        *lines, last = told.splitlines()
        table = {}
        for line in lines:
            name, result = re.match(
                r"(\S+) +(done|unchanged|refused|failed|interrupted|not begun)\b", line).groups()
            table[name] = result
        self.assertTrue(last.startswith(f"{len(table)} programs, "), last)
        counted = {result: int(count) for count, result in re.findall(r", (\d+) ([a-z ]+)", last)}
        self.assertEqual(counted, {result: list(table.values()).count(result)
                                   for result in table.values()})
        return table

    def is_sound(self):
        """Everything that has the name of a result or of a record is a whole one."""
        for name in os.listdir(self.out.name):
            path = os.path.join(self.out.name, name)
            if name.endswith(".nc"):
                with open(path, "rb") as file:
                    self.assertTrue(file.read() == self.whole[name], name + " is not whole")
            else:
                self.assertTrue(name.endswith(".nc.json"), name)
                with open(path, "rb") as file:
                    self.assertEqual(json.load(file)["outcome"], "DONE")

    def end(self, process):
        told, said = process.communicate(timeout=60)
        return process.returncode, told, said

    def test_the_wish_to_end_is_followed_and_a_second_run_does_the_rest(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with self.subTest(number.name):
                self.setUp()
                process = self.begin()
                self.wait_for_results(3)
                began = time.monotonic()
                process.send_signal(number)
                code, told, said = self.end(process)
                self.assertLess(time.monotonic() - began, 2)
                self.assertEqual(code, -number)
                self.assertEqual(said, "")
                self.is_sound()
                table = self.table(told)
                self.assertEqual(set(table), set(self.names))
                done = {name for name, result in table.items() if result == "done"}
                self.assertGreaterEqual(len(done), 3)
                self.assertIn("not begun", table.values())
                self.assertLessEqual(list(table.values()).count("interrupted"), 2)
                before = {name: os.stat(os.path.join(self.out.name, name)) for name in done}
                code, told, said = self.end(self.begin())
                self.assertEqual((code, said), (0, ""))
                again = self.table(told)
                self.assertEqual({name for name in again if again[name] == "unchanged"}, done)
                self.assertEqual(self.results(), set(self.names))
                self.is_sound()
                for name, stat in before.items():
                    self.assertEqual(os.stat(os.path.join(self.out.name, name)).st_ino,
                                     stat.st_ino)

    def test_a_terminal_interrupts_the_whole_group_at_any_moment(self):
        seed = random.randrange(1 << 32)
        print("seed", seed, file=sys.stderr)
        moments = random.Random(seed)
        for _ in range(40):
            process = self.begin(own_group=True)
            time.sleep(moments.uniform(0.0, 0.3))
            # Before it has begun to listen it ends as any program does.
            os.killpg(process.pid, signal.SIGINT)
            code, told, said = self.end(process)
            self.assertIn(code, (0, -signal.SIGINT), said)
            self.assertEqual(said, "")
            self.is_sound()
            if told:
                self.table(told)
        code, told, _ = self.end(self.begin())
        self.assertEqual(code, 0)
        self.assertEqual(self.results(), set(self.names))
        self.is_sound()

    def test_a_shell_sees_the_signal(self):
        done = subprocess.run(
            ["bash", "-c", '"$0" compensate "${@:2}" --radius 0.01 --output-dir "$1" & '
             "while ! ls $1/*.nc >/dev/null 2>&1; do sleep 0.01; done; kill -TERM $!; wait $!; "
             "echo $?", BUILD + "/bin/trc", self.out.name, *self.names],
            cwd=self.top, env=ENVIRONMENT, capture_output=True, text=True, timeout=60, check=True)
        self.assertEqual(done.stdout.splitlines()[-1], "143")

    def test_a_process_that_dies_is_one_program_that_failed(self):
        # It waits for what nobody writes.
        pipe = os.path.join(self.out.name, "pipe.nc")
        os.mkfifo(pipe)
        out = os.path.join(self.out.name, "out")
        process = self.begin(names=[pipe, *self.names], out=out)
        with open(pipe, "wb"):  # as soon as it is read
            with open(f"/proc/{process.pid}/task/{process.pid}/children", encoding="ascii") as file:
                children = file.read().split()
            reader, = (child for child in children
                       if pipe in (os.path.realpath(f"/proc/{child}/fd/{number}")
                                   for number in os.listdir(f"/proc/{child}/fd")))
            os.kill(int(reader), signal.SIGKILL)
        code, told, said = self.end(process)
        self.assertEqual(code, 5)
        self.assertIn("pipe.nc: the process was ended by signal 9", said)
        table = self.table(told)
        self.assertEqual({name for name in table if table[name] == "done"}, set(self.names))
        self.assertEqual(table[pipe], "failed")

    def test_another_server_takes_over(self):
        key = os.path.join(self.out.name + ".key")
        self.addCleanup(os.remove, key)
        servers = [Trcd(key), Trcd(key)]
        for server in servers:
            self.addCleanup(server.kill)
        process = self.begin("--server", ",".join(server.address for server in servers))
        self.wait_for_results(2)
        servers[0].kill()
        code, told, said = self.end(process)
        self.assertEqual(code, 0, said)
        self.assertEqual(set(self.table(told).values()), {"done"})
        self.assertEqual(self.results(), set(self.names))
        self.is_sound()

    def test_without_a_server_the_rest_is_for_the_next_run(self):
        key = os.path.join(self.out.name + ".key")
        self.addCleanup(os.remove, key)
        server = Trcd(key)
        self.addCleanup(lambda: server.kill())
        arguments = ("--server", server.address, "--wait", "0.5")
        process = self.begin(*arguments)
        self.wait_for_results(2)
        server.kill()
        began = time.monotonic()
        code, told, _ = self.end(process)
        self.assertLess(time.monotonic() - began, 10)
        self.assertEqual(code, 3)
        table = self.table(told)
        self.assertIn("not begun", table.values())
        self.is_sound()
        server.start()
        code, told, said = self.end(self.begin(*arguments))
        self.assertEqual(code, 0, said)
        self.assertEqual(list(self.table(told).values()).count("unchanged"),
                         list(table.values()).count("done"))
        self.is_sound()

    def test_a_refused_program_has_no_result_of_an_earlier_run(self):
        part = os.path.join(self.out.name, "part.nc")
        made = os.path.join(self.out.name, "out", "part.nc")
        for text, expected in ((SQUARE, 0), (NOTCH, 1)):
            with open(part, "w", encoding="ascii") as file:
                file.write(text)
            done = subprocess.run(
                [BUILD + "/bin/trc", "compensate", part, "--radius", "5", "--output-dir",
                 os.path.dirname(made)], env=ENVIRONMENT, capture_output=True, check=False)
            self.assertEqual(done.returncode, expected)
            self.assertEqual(os.path.exists(made), expected == 0)
            # The table says of each what came of it.
            told = done.stdout.decode().splitlines()[0]
            self.assertRegex(told, r" done +\d+ blocks, " if expected == 0 else
                             r" refused +error 90019 at line \d+$")
            with open(made + ".json", "rb") as file:
                self.assertEqual(json.load(file)["outcome"], ("DONE", "REFUSED")[expected])


if __name__ == "__main__":
    unittest.main()
