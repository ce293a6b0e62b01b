"""How long to wait for a server that is lost or full, and whether to."""

from __future__ import annotations

import random
import time
from typing import Optional

import grpc

from .errors import ServerError

PATIENCE = 60.0
"""Seconds without an answer after which a call fails with what happened last."""
FIRST_WAIT = 0.1
LONGEST_WAIT = 5.0
TRIES_UNANSWERED = 3


class Waiting:
    """For one call: waits grow from try to try, with a part of chance in them."""

    def __init__(self, timeout: Optional[float]) -> None:
        now = time.monotonic()
        self._ends = None if timeout is None else now + timeout
        self._heard = now
        self._tries = 0
        self.answered = False
        """Whether the server was there once."""

    def left(self) -> Optional[float]:
        """Seconds until the deadline of the call; none: no deadline."""
        return None if self._ends is None else max(self._ends - time.monotonic(), 0.001)

    def before_next_try(self, error: ServerError) -> Optional[float]:
        """Seconds to wait before the stream is tried again; none: it is not.

        A server that was never there is tried a few times, one that was lost as long as there is
        patience, and one that has no room too, as long as it says each time.
        """
        self._tries += 1
        asked_for = error.retry_after
        if asked_for is None:
            if not _is_lost(error, self.answered):
                return None
            if not self.answered and self._tries >= TRIES_UNANSWERED:
                return None
        wait = min(FIRST_WAIT * 2 ** (self._tries - 1), LONGEST_WAIT) * random.uniform(0.5, 1.0)
        wait = max(wait, asked_for or 0.0)
        if time.monotonic() + wait > self._heard + PATIENCE:
            return None
        left = self.left()
        return wait if left is None or wait < left else None

    def has_answered(self) -> None:
        """Something has come."""
        self.answered = True
        self._tries = 0
        self._heard = time.monotonic()


def _is_lost(error: ServerError, answered: bool) -> bool:
    """The stream was lost, or not taken: nothing says that the program or the server has a fault.

    Balancers report a server that died as CANCELLED or INTERNAL, gRPC itself some resets as UNKNOWN,
    and RESOURCE_EXHAUSTED where its buffers are full; what the server itself says has a reason.
    """
    code = grpc.StatusCode
    if error.status == code.UNAVAILABLE or error.reason == "STREAM_IDLE":
        return True
    if error.reason or error.status == code.RESOURCE_EXHAUSTED and "larger than max" in str(error):
        return False
    lost = (code.CANCELLED, code.RESOURCE_EXHAUSTED)
    return error.status in (*lost, code.INTERNAL, code.UNKNOWN) if answered else error.status in lost
