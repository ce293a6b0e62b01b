"""The client, for threads that may wait; trc.aio has its asyncio twin."""

from __future__ import annotations

import threading
import time
from typing import Any, Iterable, Iterator, Optional, Union

import grpc

from . import local, settings
from .errors import TrcError, raised_by
from .exchange import Exchange, PartExchange, PathExchange, ProgramExchange, SurveyExchange
from .path import Path
from .result import PathPart, PathResult, ProgramPart, Result
from .survey import Survey
from .target import seconds_of, target_of
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
    no end. A server that is lost, or has no room, is waited for up to a minute. Close it, or use it
    in a `with` statement. A process that is forked makes clients of its own.
    """

    def __init__(self, server: Optional[str] = None, *, tls: Optional[Tls] = None,
                 timeout: Optional[float] = None) -> None:
        self._timeout = seconds_of(timeout)
        self._lock = threading.Lock()
        self._is_closed = False
        self._local = None if server else local.address()
        self._channel = _channel_to(server or local.address(), tls)

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the connection, and calls of other threads with a ServerError."""
        with self._lock:
            self._is_closed = True
            self._channel.close()

    def compensate(self, text: Union[str, bytes], *, tools: settings.Tools = (),
                   blocks: bool = False, **setup: Any) -> Result:
        """The NC program with tool radius compensation resolved.

        tools: D number → radius in mm, or Tool messages as dictionaries. blocks: the result has the
        compensated path as columns too, for which the program is sent once more. setup: fields of
        ProgramSetup, PathSetup and TrcOptions by name (radius=5, transition="G26",
        remove_masked_blocks=True). Raises TrcError where the program is refused, ServerError where
        there is no answer, TypeError or ValueError where an argument is wrong by itself.
        """
        exchange = ProgramExchange(bytes_of(text), settings.program_setup(setup, tools))
        of_blocks = exchange.for_blocks() if blocks else None
        self._run(exchange)
        if of_blocks is None:
            return exchange.result()
        self._run(of_blocks)
        return exchange.result(of_blocks.blocks())

    def compensate_path(self, path: Path, **setup: Any) -> PathResult:
        """The compensated path of motion blocks. setup: fields of PathSetup and TrcOptions by name.

        Raises TrcError where the path is refused, ServerError where there is no answer.
        """
        exchange = PathExchange(path_of(path), settings.path_setup(setup))
        self._run(exchange)
        return exchange.result()

    def stream(self, text: Union[str, bytes], *, tools: settings.Tools = (),
               **setup: Any) -> Iterator[ProgramPart]:
        """As compensate(), in parts as they become certain; the last one has the summary.

        The parts together are the text of compensate(). Nothing may be machined before the summary:
        TrcError and ServerError come out of the iteration. A stream that is not read to its end is
        given up when the iterator is closed or dropped.
        """
        return self._parts(ProgramExchange(bytes_of(text), settings.program_setup(setup, tools)))

    def stream_path(self, path: Path, **setup: Any) -> Iterator[PathPart]:
        """As compensate_path(), in parts: see stream()."""
        return self._parts(PathExchange(path_of(path), settings.path_setup(setup)))

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
        stub = trc_service_pb2_grpc.TrcServiceStub(self._ready())
        try:
            return stub.GetServerInfo(trc_service_pb2.GetServerInfoRequest(),
                                      timeout=self._timeout)
        except grpc.RpcError as error:
            raise raised_by(error, ()) from error

    def _ready(self) -> grpc.Channel:
        """The channel; to another server of this machine where the one there was has ended."""
        with self._lock:
            if self._is_closed:
                raise ValueError("this client is closed")
            if self._local is not None and not local.is_alive(self._local):
                self._channel.close()
                self._local = local.address()
                self._channel = _channel_to(self._local, None)
            return self._channel

    def _run(self, exchange: Exchange) -> None:
        for _ in self._messages(exchange):
            pass

    def _parts(self, exchange: PartExchange) -> Iterator[Any]:
        for _ in self._messages(exchange):
            part = exchange.take()
            if part is not None:
                yield part
        yield exchange.last()

    def _messages(self, exchange: Exchange) -> Iterator[None]:
        """Drives an exchange to its end, and stops after each message it has absorbed."""
        waiting = Waiting(self._timeout)
        while True:
            call = self._ready().stream_stream(exchange.METHOD, identity, identity)(
                exchange.requests(), timeout=waiting.left())
            try:
                for message in call:
                    exchange.absorb(message)
                    waiting.has_answered()
                    yield
                return
            except grpc.RpcError as error:
                raised = raised_by(error, exchange.diagnostics, exchange.record)
                wait = None
                if not isinstance(raised, TrcError) and not self._is_closed:
                    wait = waiting.before_next_try(raised)
                if wait is not None:
                    time.sleep(wait)
                # Another server of this machine does not take the streams of the one there was.
                if wait is None or waiting.answered and self._has_lost_its_own():
                    raise raised from error
                exchange.go_on()
            finally:
                call.cancel()

    def _has_lost_its_own(self) -> bool:
        """The server that was started on this machine has ended."""
        return self._local is not None and not local.is_alive(self._local)


def _channel_to(server: str, tls: Optional[Tls]) -> grpc.Channel:
    target, options = target_of(server)
    if tls is None:
        return grpc.insecure_channel(target, options)
    return grpc.secure_channel(target, tls.credentials(), options)


def bytes_of(text: Union[str, bytes]) -> bytes:
    """NC text as it is sent; bytes that are no UTF-8 reach the server, which names their place."""
    if isinstance(text, str):
        return text.encode("utf-8", "surrogateescape")
    if isinstance(text, (bytes, bytearray, memoryview)):
        return bytes(text)
    raise TypeError(f"an NC program is text or bytes, not {type(text).__name__}; of a file: "
                    "Path(\"part.nc\").read_bytes()")


def path_of(path: Path) -> Path:
    """A path, checked."""
    if not isinstance(path, Path):
        raise TypeError(f"a path is a trc.Path, not {type(path).__name__}")
    return path


def survey_of(program: Union[str, bytes, Path], radii: Iterable[float], uncut: bool, largest: bool,
              setup: Any) -> SurveyExchange:
    """The exchange of a survey."""
    is_path = isinstance(program, Path)
    return SurveyExchange(program if isinstance(program, Path) else bytes_of(program),
                          settings.survey_setup(radii, is_path, uncut, largest, setup))


def compensate(text: Union[str, bytes], *, server: Optional[str] = None, tls: Optional[Tls] = None,
               timeout: Optional[float] = None, tools: settings.Tools = (), blocks: bool = False,
               **setup: Any) -> Result:
    """Client.compensate() over a connection of its own."""
    with Client(server, tls=tls, timeout=timeout) as client:
        return client.compensate(text, tools=tools, blocks=blocks, **setup)


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
