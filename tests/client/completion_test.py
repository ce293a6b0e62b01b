#!/usr/bin/env python3
"""completion_test.py BUILD_FOLDER: the words that bash, zsh and fish offer at a line of trc.

bash and zsh get keys on a terminal of their own, fish has a command that tells what the tab key
would offer. The program on the lines is one that only notes its arguments: what is completed to the
end of a word is seen there.
"""

import os
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import termios
import time
import unittest
from pathlib import Path

TRC = Path(sys.argv[1]).resolve() / "bin" / "trc"
PROMPT = b"READY>"

# A line, and all that is offered there.
OFFERED = {
    "trc comp": {"compensate", "completion"},
    "trc compensate --max-": {"--max-blocks-per-selection", "--max-executed-lines",
                              "--max-session-memory-mib"},
    "trc compensate --dialect ": {"isg", "fanuc", "linuxcnc", "sinumerik", "heidenhain"},
    "trc plot part.nc --format ": {"svg", "html"},
    "trc compensate part.nc --set leads": {"leads=", "leads.find=", "leads.blocks_in=",
                                           "leads.blocks_out="},
    "trc explain 9001": {"90011", "90017", "90018", "90019", "900101", "900102", "900103", "900104",
                         "900105", "900106"},
    "trc completion ": {"bash", "zsh", "fish"},
    "trc compensate pa": {"part.nc", "parts/"},
    "trc verify --record pa": {"part.nc", "parts/"},
}
# A line, and the arguments that come of the tab key and what is typed after it.
COMPLETED = {
    ("trc hea", ""): ["health"],
    ("trc compensate --dia", "fanuc"): ["compensate", "--dialect", "fanuc"],
    ("trc compensate --unit in", ""): ["compensate", "--unit", "inch"],
    # A value follows at once.
    ("trc compensate --set tool_r", "5"): ["compensate", "--set", "tool_radius=5"],
    ("trc explain 90057", ""): ["explain", "90057"],
    ("trc plot part.n", ""): ["plot", "part.nc"],
    ("trc radii part.nc --too", "tab.csv"): ["radii", "part.nc", "--tools", "tab.csv"],
}


class Terminal:
    """An interactive shell; ends with the `with`."""

    def __init__(self, command, setup, folder, environment):
        self.folder = folder
        self.process, self.screen = pty.fork()
        if self.process == 0:
            os.chdir(folder)
            os.execvpe(command[0], command, environment)
        self.pending = b""
        termios.tcsetwinsize(self.screen, (500, 250))
        # Put together by the shell, so that the echo of the line is no prompt.
        self.type(setup + "; PS1='REA''DY>'\n")
        self.until(PROMPT)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.screen)
        os.waitpid(self.process, 0)

    def type(self, keys):
        os.write(self.screen, keys.encode())

    def until(self, sign):
        """What appears up to the sign, which is taken too."""
        end = time.monotonic() + 30
        while sign not in self.pending:
            ready, _, _ = select.select([self.screen], [], [], max(0, end - time.monotonic()))
            assert ready, self.pending
            self.pending += os.read(self.screen, 65536)
        said, _, self.pending = self.pending.partition(sign)
        return said

    def offered(self, line):
        self.type(line + "\t")
        # The list, and the line again below it.
        said = self.until(PROMPT)
        self.type("\x15: en''d\n")
        self.until(b"en''d")
        self.until(PROMPT)
        shown = re.sub(rb"\x1b\[[0-9;?]*[A-Za-z]|[\a\b\r]", b"", said).decode()
        rows = shown.split("\n")[1:]
        # After words zsh says what they are.
        return {word for row in rows for word in row.partition(" -- ")[0].split()}

    def arguments(self, line, rest):
        noted = self.folder / "noted"
        noted.unlink(missing_ok=True)
        self.type(line + "\t" + rest + "\n")
        self.until(PROMPT)
        return noted.read_text().splitlines()


class Completion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = Path(tempfile.mkdtemp(prefix="completion-"))
        (cls.work / "part.nc").touch()
        (cls.work / "parts").mkdir()
        programs = cls.work / "bin"
        programs.mkdir()
        (programs / "trc").write_text("#!/bin/sh\nprintf '%s\\n' \"$@\" >noted\n")
        (programs / "trc").chmod(0o755)
        scripts = cls.work / "scripts"
        scripts.mkdir()
        # Under the names that the package gives them.
        for shell, name in (("bash", "trc"), ("zsh", "_trc"), ("fish", "trc.fish")):
            with (scripts / name).open("wb") as script:
                subprocess.run([TRC, "completion", shell], stdout=script, check=True)
        cls.environment = {"PATH": f"{programs}:/usr/bin:/bin", "TERM": "dumb", "LC_ALL": "C.UTF-8",
                           "HOME": str(cls.work)}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.work)

    def check(self, command, setup):
        with Terminal(command, setup, self.work, self.environment) as terminal:
            for line, words in OFFERED.items():
                with self.subTest(shell=command[0], line=line):
                    self.assertEqual(terminal.offered(line), words)
            for (line, rest), arguments in COMPLETED.items():
                with self.subTest(shell=command[0], line=line):
                    self.assertEqual(terminal.arguments(line, rest), arguments)

    def test_bash(self):
        self.check(["bash", "--norc", "--noprofile", "-i"],
                   "bind 'set show-all-if-ambiguous on'; bind 'set completion-query-items 0'; "
                   "bind 'set page-completions off'; bind 'set enable-bracketed-paste off'; "
                   ". scripts/trc")

    def test_zsh(self):
        self.check(["zsh", "-f", "-i"],
                   "unset zle_bracketed_paste; unsetopt prompt_sp prompt_cr list_ambiguous; "
                   "LISTMAX=0; "
                   "fpath=(scripts $fpath); autoload -Uz compinit; compinit -u -D")

    def test_fish(self):
        def offered(line):
            script = f"source scripts/trc.fish; complete -C '{line}'"
            done = subprocess.run(["fish", "--no-config", "-c", script], cwd=self.work, text=True,
                                  env=self.environment, capture_output=True, check=True, timeout=60)
            return {found.split("\t")[0] for found in done.stdout.splitlines()}

        for line, words in OFFERED.items():
            with self.subTest(line=line):
                self.assertEqual(offered(line), words)
        for (line, rest), arguments in COMPLETED.items():
            with self.subTest(line=line):
                before, last = ["", *arguments][-2:]
                word = before if last == rest else last.removesuffix(rest)
                self.assertEqual(offered(line), {word})


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
