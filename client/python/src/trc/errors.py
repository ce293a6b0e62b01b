"""What can go wrong."""

from __future__ import annotations

from typing import Sequence

import grpc

from .result import Diagnostic, Severity


class TrcError(Exception):
    """The program, the path or the setup was refused.

    `diagnostics` holds what was raised, the cause last; it is empty where the call itself was wrong
    (a field out of range), which the message of the exception then names.
    """

    def __init__(self, message: str, diagnostics: Sequence[Diagnostic] = ()):
        super().__init__(message)
        self.diagnostics = list(diagnostics)

    @property
    def cause(self) -> Diagnostic | None:
        """The error that stopped the stream."""
        errors = [raised for raised in self.diagnostics if raised.severity == Severity.ERROR]
        return errors[-1] if errors else None


class ServerError(Exception):
    """No answer: the server is not reachable or lost, a limit or the deadline has passed."""

    def __init__(self, status: grpc.StatusCode, message: str):
        super().__init__(f"{status.name}: {message}")
        self.status = status


REFUSALS = (
    grpc.StatusCode.INVALID_ARGUMENT,
    grpc.StatusCode.FAILED_PRECONDITION,
    grpc.StatusCode.OUT_OF_RANGE,
)


def raised_by(error: grpc.RpcError, diagnostics: Sequence[Diagnostic]) -> Exception:
    """The exception a caller gets for a call that failed."""
    status, details = error.code(), error.details() or ""
    if status in REFUSALS:
        return TrcError(details, diagnostics)
    return ServerError(status, details)
