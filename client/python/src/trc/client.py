"""The client, for threads that may wait; trc.aio has its asyncio twin."""

from __future__ import annotations

import time
from typing import Any, Iterable, Optional, Union

import grpc

from . import local, settings
from .errors import raised_by
from .exchange import Exchange, PathExchange, ProgramExchange, SurveyExchange
from .path import Path
from .result import PathResult, Result
from .survey import Survey
from .tls import Tls
from .v1 import trc_service_pb2, trc_service_pb2_grpc
from .waiting import Waiting


def identity(message: bytes) -> bytes:
    """Messages are bytes already: the exchange knows their form."""
    return message


class Client:
    """A connection to a server, for many calls and many threads.

    server: "HOST:PORT", several of one key with commas between, or "unix:/path"; none: a trcd of
    this machine is started. tls: for an encrypted connection. timeout: seconds of each call; none:
    no end. Close it, or use it in a `with` statement.
    """

    def __init__(self, server: Optional[str] = None, *, tls: Optional[Tls] = None,
                 timeout: Optional[float] = None) -> None:
        self._timeout = timeout
        target = target_of(server or local.address())
        self._channel = (grpc.insecure_channel(target) if tls is None
                         else grpc.secure_channel(target, tls.credentials()))

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the connection."""
        self._channel.close()

    def compensate(self, text: Union[str, bytes], *, tools: settings.Tools = (),
                   **setup: Any) -> Result:
        """The NC program with tool radius compensation resolved.

        tools: D number → radius in mm, or Tool messages as dictionaries. setup: fields of
        ProgramSetup, PathSetup and TrcOptions by name (radius=5, transition="G26",
        remove_masked_blocks=True). Raises TrcError where the program is refused, ServerError where
        there is no answer.
        """
        exchange = ProgramExchange(bytes_of(text), settings.program_setup(setup, tools))
        self._run(exchange)
        return exchange.result()

    def compensate_path(self, path: Path, **setup: Any) -> PathResult:
        """The compensated path of motion blocks. setup: fields of PathSetup and TrcOptions by name.

        Raises TrcError where the path is refused, ServerError where there is no answer.
        """
        exchange = PathExchange(path, settings.path_setup(setup))
        self._run(exchange)
        return exchange.result()

    def survey_radii(self, program: Union[str, bytes, Path], radii: Iterable[float] = (), *,
                     uncut: bool = False, largest: bool = True, **setup: Any) -> Survey:
        """What tools of many radii make of an NC program or a path, and the largest that fits.

        radii: mm, 0.0001 to 107374, each at most once, 64 at most; each takes the place of every
        radius that setup and program give. uncut: names the stretches of wall that each leaves
        uncut. largest: looks for the largest radius that reaches every wall. setup: as of
        compensate() or compensate_path(), without tools. A radius that does not fit is told, not
        raised: TrcError says that the program is wrong with every radius, ServerError that there
        is no answer.
        """
        exchange = survey_of(program, radii, uncut, largest, setup)
        self._run(exchange)
        return exchange.result()

    def info(self) -> Any:
        """GetServerInfoResponse: version, limits, options, functions and diagnostics."""
        stub = trc_service_pb2_grpc.TrcServiceStub(self._channel)
        try:
            return stub.GetServerInfo(trc_service_pb2.GetServerInfoRequest(),
                                      timeout=self._timeout)
        except grpc.RpcError as error:
            raise raised_by(error, ()) from error

    def _run(self, exchange: Exchange) -> None:
        open_stream = self._channel.stream_stream(exchange.METHOD, identity, identity)
        waiting = Waiting(self._timeout)
        while True:
            try:
                for message in open_stream(exchange.requests(), timeout=waiting.left()):
                    exchange.absorb(message)
                    waiting.has_answered()
                return
            except grpc.RpcError as error:
                wait = waiting.before_next_try(error)
                if wait is None:
                    raise raised_by(error, exchange.diagnostics) from error
                time.sleep(wait)
                exchange.go_on()


def bytes_of(text: Union[str, bytes]) -> bytes:
    """NC text as it is sent; bytes that are no UTF-8 reach the server, which names their place."""
    return text.encode("utf-8", "surrogateescape") if isinstance(text, str) else text


def survey_of(program: Union[str, bytes, Path], radii: Iterable[float], uncut: bool, largest: bool,
              setup: Any) -> SurveyExchange:
    """The exchange of a survey."""
    is_path = isinstance(program, Path)
    return SurveyExchange(program if isinstance(program, Path) else bytes_of(program),
                          settings.survey_setup(radii, is_path, uncut, largest, setup))


def target_of(server: str) -> str:
    """The target of gRPC for a server, or for several with commas between."""
    return f"ipv4:{server}" if "," in server and "://" not in server else server


def compensate(text: Union[str, bytes], *, server: Optional[str] = None, tls: Optional[Tls] = None,
               timeout: Optional[float] = None, tools: settings.Tools = (), **setup: Any) -> Result:
    """Client.compensate() over a connection of its own."""
    with Client(server, tls=tls, timeout=timeout) as client:
        return client.compensate(text, tools=tools, **setup)


def compensate_path(path: Path, *, server: Optional[str] = None, tls: Optional[Tls] = None,
                    timeout: Optional[float] = None, **setup: Any) -> PathResult:
    """Client.compensate_path() over a connection of its own."""
    with Client(server, tls=tls, timeout=timeout) as client:
        return client.compensate_path(path, **setup)


def survey_radii(program: Union[str, bytes, Path], radii: Iterable[float] = (), *,
                 server: Optional[str] = None, tls: Optional[Tls] = None,
                 timeout: Optional[float] = None, uncut: bool = False, largest: bool = True,
                 **setup: Any) -> Survey:
    """Client.survey_radii() over a connection of its own."""
    with Client(server, tls=tls, timeout=timeout) as client:
        return client.survey_radii(program, radii, uncut=uncut, largest=largest, **setup)
