"""What can go wrong."""

from __future__ import annotations

import struct
from typing import Optional, Sequence, Union

import grpc

from . import wire
from .result import Diagnostic, Severity


class TrcError(Exception):
    """The program, the path or the setup was refused.

    `diagnostics` holds what was raised, the cause last; it is empty where the call itself was wrong
    (a field out of range), which the message of the exception then names. `record` is that of the
    job as JSON, where record=True asked for it.
    """

    def __init__(self, message: str, diagnostics: Sequence[Diagnostic] = (),
                 record: Optional[str] = None):
        super().__init__(message)
        self.diagnostics = list(diagnostics)
        self.record = record

    @property
    def cause(self) -> Diagnostic | None:
        """The error that stopped the stream."""
        errors = [raised for raised in self.diagnostics if raised.severity == Severity.ERROR]
        return errors[-1] if errors else None


class ServerError(Exception):
    """No answer: the server is not reachable or lost, a limit or the deadline has passed.

    status: the code of gRPC. reason: the server's own word for it, UPPER_SNAKE and stable; empty
    where it gave none. retry_after: seconds after which it may have room; none: waiting does not
    help by itself. Calls without a deadline have waited for up to a minute before they raise it.
    """

    def __init__(self, status: grpc.StatusCode, message: str, reason: str = "",
                 retry_after: Optional[float] = None):
        super().__init__(f"{status.name}: {message}")
        self.status = status
        self.reason = reason
        self.retry_after = retry_after


REFUSALS = (
    grpc.StatusCode.INVALID_ARGUMENT,
    grpc.StatusCode.FAILED_PRECONDITION,
    grpc.StatusCode.OUT_OF_RANGE,
)


def raised_by(error: grpc.RpcError, diagnostics: Sequence[Diagnostic],
              record: Optional[str] = None) -> Union[TrcError, ServerError]:
    """The exception a caller gets for a call that failed."""
    status, text = error.code(), error.details() or ""
    if status in REFUSALS:
        refusal = TrcError(text, diagnostics, record)
        cause = refusal.cause
        # The status is in English, whatever the setup asks for.
        if cause is not None and cause.language != "en":
            refusal.args = (str(cause),)
        return refusal
    reason, retry_after = _details_of(error)
    return ServerError(status, text, reason, retry_after)


def _details_of(error: grpc.RpcError) -> tuple[str, Optional[float]]:
    """Reason and wait of the google.rpc.Status that travels with a status."""
    reason, retry_after = "", None
    for name, value in error.trailing_metadata() or ():
        if name != "grpc-status-details-bin":
            continue
        try:
            for detail in wire.contents(value, 3):
                kind = b"".join(wire.contents(detail, 1)).rpartition(b".")[2]
                content = b"".join(wire.contents(detail, 2))
                if kind == b"ErrorInfo":
                    reason = b"".join(wire.contents(content, 1)).decode()
                elif kind == b"RetryInfo":
                    delay = dict(wire.numbers(b"".join(wire.contents(content, 1))))
                    retry_after = delay.get(1, 0) + delay.get(2, 0) * 1e-9
        except (IndexError, struct.error, UnicodeDecodeError):
            continue  # what cannot be read takes nothing from code and message
    return reason, retry_after


def no_summary() -> ServerError:
    """The stream ended with OK, but what came may be half of it."""
    return ServerError(grpc.StatusCode.INTERNAL,
                       "the server ended the stream without a summary, the path may be incomplete",
                       "SUMMARY_MISSING")
