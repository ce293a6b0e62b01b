"""The client for asyncio: the same calls, awaited."""

from __future__ import annotations

import asyncio
from typing import Any, AsyncIterator, Iterable, Optional, Union

import grpc
import grpc.aio

from . import local, settings
from .client import bytes_of, identity, path_of, survey_of
from .errors import TrcError, raised_by
from .exchange import Exchange, PartExchange, PathExchange, ProgramExchange
from .path import Path
from .result import PathPart, PathResult, ProgramPart, Result
from .survey import Survey
from .target import seconds_of, target_of
from .tls import Tls
from .v1 import trc_service_pb2, trc_service_pb2_grpc
from .waiting import Waiting


class Client:
    """As trc.Client; close it, or use it in an `async with` statement.

    A task that is cancelled ends its stream on the server.
    """

    def __init__(self, server: Optional[str] = None, *, tls: Optional[Tls] = None,
                 timeout: Optional[float] = None) -> None:
        self._timeout = seconds_of(timeout)
        self._local = None if server else local.address()
        self._channel = _channel_to(server or local.address(), tls)
        # Closed at the end only: calls of other tasks may still be about to fail in them.
        self._lost: list[grpc.aio.Channel] = []

    async def __aenter__(self) -> "Client":
        return self

    async def __aexit__(self, *error: object) -> None:
        await self.close()

    async def close(self) -> None:
        """Ends the connection."""
        for channel in (*self._lost, self._channel):
            await channel.close()

    async def compensate(self, text: Union[str, bytes], *, tools: settings.Tools = (),
                         blocks: bool = False, **setup: Any) -> Result:
        """As trc.Client.compensate()."""
        exchange = ProgramExchange(bytes_of(text), settings.program_setup(setup, tools))
        of_blocks = exchange.for_blocks() if blocks else None
        await self._run(exchange)
        if of_blocks is None:
            return exchange.result()
        await self._run(of_blocks)
        return exchange.result(of_blocks.blocks())

    async def compensate_path(self, path: Path, **setup: Any) -> PathResult:
        """As trc.Client.compensate_path()."""
        exchange = PathExchange(path_of(path), settings.path_setup(setup))
        await self._run(exchange)
        return exchange.result()

    def stream(self, text: Union[str, bytes], *, tools: settings.Tools = (),
               **setup: Any) -> AsyncIterator[ProgramPart]:
        """As trc.Client.stream(), with `async for`."""
        return self._parts(ProgramExchange(bytes_of(text), settings.program_setup(setup, tools)))

    def stream_path(self, path: Path, **setup: Any) -> AsyncIterator[PathPart]:
        """As trc.Client.stream_path(), with `async for`."""
        return self._parts(PathExchange(path_of(path), settings.path_setup(setup)))

    async def survey_radii(self, program: Union[str, bytes, Path], radii: Iterable[float] = (), *,
                           uncut: bool = False, largest: bool = True, **setup: Any) -> Survey:
        """As trc.Client.survey_radii()."""
        exchange = survey_of(program, radii, uncut, largest, setup)
        await self._run(exchange)
        return exchange.result()

    async def info(self) -> Any:
        """As trc.Client.info()."""
        stub = trc_service_pb2_grpc.TrcServiceStub(await self._ready())
        try:
            return await stub.GetServerInfo(trc_service_pb2.GetServerInfoRequest(),
                                            timeout=self._timeout)
        except grpc.RpcError as error:
            raise raised_by(error, ()) from error

    async def _ready(self) -> grpc.aio.Channel:
        """The channel; to another server of this machine where the one there was has ended."""
        if self._has_lost_its_own():
            address = await asyncio.to_thread(local.address)
            # Another task may have been here meanwhile.
            if address != self._local:
                self._lost.append(self._channel)
                self._local, self._channel = address, _channel_to(address, None)
        return self._channel

    def _has_lost_its_own(self) -> bool:
        """The server that was started on this machine has ended."""
        return self._local is not None and not local.is_alive(self._local)

    async def _run(self, exchange: Exchange) -> None:
        async for _ in self._messages(exchange):
            pass

    async def _parts(self, exchange: PartExchange) -> AsyncIterator[Any]:
        async for _ in self._messages(exchange):
            part = exchange.take()
            if part is not None:
                yield part
        yield exchange.last()

    async def _messages(self, exchange: Exchange) -> AsyncIterator[None]:
        waiting = Waiting(self._timeout)
        while True:
            channel = await self._ready()
            call = channel.stream_stream(exchange.METHOD, identity, identity)(
                exchange.requests(), timeout=waiting.left())
            try:
                async for message in call:
                    exchange.absorb(message)
                    waiting.has_answered()
                    yield
                return
            except grpc.RpcError as error:
                raised = raised_by(error, exchange.diagnostics, exchange.record)
                wait = (None if isinstance(raised, TrcError)
                        else waiting.before_next_try(raised))
                if wait is not None:
                    await asyncio.sleep(wait)
                # Another server of this machine does not take the streams of the one there was.
                if wait is None or waiting.answered and self._has_lost_its_own():
                    raise raised from error
                exchange.go_on()
            finally:
                call.cancel()


def _channel_to(server: str, tls: Optional[Tls]) -> grpc.aio.Channel:
    target, options = target_of(server)
    if tls is None:
        return grpc.aio.insecure_channel(target, options)
    return grpc.aio.secure_channel(target, tls.credentials(), options)


async def compensate(text: Union[str, bytes], *, server: Optional[str] = None,
                     tls: Optional[Tls] = None, timeout: Optional[float] = None,
                     tools: settings.Tools = (), blocks: bool = False, **setup: Any) -> Result:
    """trc.compensate(), awaited."""
    async with Client(server, tls=tls, timeout=timeout) as client:
        return await client.compensate(text, tools=tools, blocks=blocks, **setup)


async def compensate_path(path: Path, *, server: Optional[str] = None, tls: Optional[Tls] = None,
                          timeout: Optional[float] = None, **setup: Any) -> PathResult:
    """trc.compensate_path(), awaited."""
    async with Client(server, tls=tls, timeout=timeout) as client:
        return await client.compensate_path(path, **setup)


async def survey_radii(program: Union[str, bytes, Path], radii: Iterable[float] = (), *,
                       server: Optional[str] = None, tls: Optional[Tls] = None,
                       timeout: Optional[float] = None, uncut: bool = False, largest: bool = True,
                       **setup: Any) -> Survey:
    """trc.survey_radii(), awaited."""
    async with Client(server, tls=tls, timeout=timeout) as client:
        return await client.survey_radii(program, radii, uncut=uncut, largest=largest, **setup)
