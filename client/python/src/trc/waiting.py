"""How long to wait for a server that is lost, and whether to."""

from __future__ import annotations

import random
import time
from typing import Optional

import grpc

MOST_TRIES = 8
FIRST_WAIT = 0.1
LONGEST_WAIT = 5.0


class Waiting:
    """For one call: waits grow from try to try, with a part of chance in them."""

    def __init__(self, timeout: Optional[float]) -> None:
        self._ends = None if timeout is None else time.monotonic() + timeout
        self._tries = 0

    def left(self) -> Optional[float]:
        """Seconds until the deadline of the call; none: no deadline."""
        return None if self._ends is None else max(self._ends - time.monotonic(), 0.001)

    def before_next_try(self, error: grpc.RpcError) -> Optional[float]:
        """Seconds to wait before the stream is tried again; none: it is not."""
        self._tries += 1
        if error.code() != grpc.StatusCode.UNAVAILABLE or self._tries >= MOST_TRIES:
            return None
        wait = min(FIRST_WAIT * 2 ** (self._tries - 1), LONGEST_WAIT) * random.uniform(0.5, 1.0)
        left = self.left()
        return wait if left is None or wait < left else None

    def has_answered(self) -> None:
        """Something has come: the server was there."""
        self._tries = 0
