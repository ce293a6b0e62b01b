"""A `trcd` of this machine, for who names no server."""

from __future__ import annotations

import atexit
import os
import shutil
import socket
import subprocess
import tempfile
import threading
import time
from pathlib import Path as File
from typing import Optional

import grpc

from .errors import ServerError

START_SECONDS = 10.0

_lock = threading.Lock()
_running: Optional["_Local"] = None


def address() -> str:
    """Of the local server of this process, which is started with the first call."""
    global _running
    with _lock:
        if _running is None or not _running.is_alive():
            if _running is not None:
                _running.stop()
            _running = _Local()
        return _running.address


def is_alive(at: str) -> bool:
    """Whether the local server at this address still runs."""
    running = _running
    return running is not None and running.address == at and running.is_alive()


def _forget() -> None:
    """A forked child has no server yet: that of its parent is the parent's to end."""
    global _lock, _running
    _lock = threading.Lock()
    _running = None


os.register_at_fork(after_in_child=_forget)


class _Local:
    def __init__(self) -> None:
        program = os.environ.get("TRC_TRCD") or shutil.which("trcd")
        if program is None:
            raise ServerError(grpc.StatusCode.UNAVAILABLE,
                              "no server was given and there is no trcd here: pass "
                              "server=\"HOST:PORT\", install the package trcd, or name the program in "
                              "TRC_TRCD")
        self._owner = os.getpid()
        self._folder = tempfile.mkdtemp(prefix="trc-")
        self.address = f"unix:{self._folder}/trcd.sock"
        self._process: Optional[subprocess.Popen[bytes]] = None
        self._fault: Optional[OSError] = None
        self._begun = threading.Event()
        threading.Thread(target=self._serve, args=(program,), daemon=True, name="trcd").start()
        atexit.register(self.stop)
        self._begun.wait()
        if not self._is_listening():
            said = self._said()
            self.stop()
            raise ServerError(grpc.StatusCode.UNAVAILABLE, f"{program} did not start: {said}")

    def _serve(self, program: str) -> None:
        """Starts the server and lives as long as it does.

        The server ends with the thread that has started it, which is when this process ends,
        however it does: setpriv asks the kernel for that.
        """
        setpriv = shutil.which("setpriv")
        command = [setpriv, "--pdeathsig", "TERM"] if setpriv else []
        try:
            with File(self._folder, "stderr").open("wb") as stderr:
                self._process = subprocess.Popen(
                    [*command, program, "--listen", self.address], stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL, stderr=stderr)
        except OSError as error:
            self._fault = error
        self._begun.set()
        if self._process is not None:
            self._process.wait()

    def _is_listening(self) -> bool:
        # The file is there a moment before the server listens at it.
        file = os.path.join(self._folder, "trcd.sock")
        ends = time.monotonic() + START_SECONDS
        while True:
            with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
                if connection.connect_ex(file) == 0:
                    return True
            if not self.is_alive() or time.monotonic() > ends:
                return False
            time.sleep(0.01)

    def _said(self) -> str:
        if self._fault is not None:
            return str(self._fault)
        return File(self._folder, "stderr").read_text(errors="replace").strip()

    def is_alive(self) -> bool:
        return self._process is not None and self._process.poll() is None

    def stop(self) -> None:
        """Ends it; a forked child leaves it alone."""
        if os.getpid() != self._owner:
            return
        atexit.unregister(self.stop)
        process = self._process
        if process is not None and self.is_alive():
            process.terminate()
            try:
                process.wait(timeout=2)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        shutil.rmtree(self._folder, ignore_errors=True)
