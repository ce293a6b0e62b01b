"""A `trcd` of this machine, for who names no server."""

from __future__ import annotations

import atexit
import os
import shutil
import subprocess
import tempfile
import threading
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
            _running = _Local()
        return _running.address


class _Local:
    def __init__(self) -> None:
        program = os.environ.get("TRC_TRCD") or shutil.which("trcd")
        if program is None:
            raise ServerError(grpc.StatusCode.UNAVAILABLE,
                              "no server was given and there is no trcd here: pass "
                              "server=\"HOST:PORT\", install the package trcd, or name the program in "
                              "TRC_TRCD")
        self._folder = tempfile.mkdtemp(prefix="trc-")
        self.address = f"unix:{self._folder}/trcd.sock"
        said = File(self._folder, "stderr")
        with said.open("wb") as stderr:
            self._process = subprocess.Popen(
                [program, "--listen", self.address], stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL, stderr=stderr)
        atexit.register(self.stop)
        with grpc.insecure_channel(self.address) as channel:
            try:
                grpc.channel_ready_future(channel).result(timeout=START_SECONDS)
            except grpc.FutureTimeoutError as error:
                self._process.kill()
                self._process.wait()
                raise ServerError(
                    grpc.StatusCode.UNAVAILABLE,
                    f"{program} did not start: {said.read_text(errors='replace').strip()}"
                ) from error

    def is_alive(self) -> bool:
        return self._process.poll() is None

    def stop(self) -> None:
        if self.is_alive():
            self._process.terminate()
            try:
                self._process.wait(timeout=2)
            except subprocess.TimeoutExpired:
                self._process.kill()
        shutil.rmtree(self._folder, ignore_errors=True)
