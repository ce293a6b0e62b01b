"""The client for asyncio: the same calls, awaited."""

from __future__ import annotations

import asyncio
from typing import Any, Iterable, Optional, Union

import grpc
import grpc.aio

from . import local, settings
from .client import bytes_of, identity, survey_of, target_of
from .errors import raised_by
from .exchange import Exchange, PathExchange, ProgramExchange
from .path import Path
from .result import PathResult, Result
from .survey import Survey
from .tls import Tls
from .waiting import Waiting


class Client:
    """As trc.Client; close it, or use it in an `async with` statement."""

    def __init__(self, server: Optional[str] = None, *, tls: Optional[Tls] = None,
                 timeout: Optional[float] = None) -> None:
        self._timeout = timeout
        target = target_of(server or local.address())
        self._channel = (grpc.aio.insecure_channel(target) if tls is None
                         else grpc.aio.secure_channel(target, tls.credentials()))

    async def __aenter__(self) -> "Client":
        return self

    async def __aexit__(self, *error: object) -> None:
        await self.close()

    async def close(self) -> None:
        """Ends the connection."""
        await self._channel.close()

    async def compensate(self, text: Union[str, bytes], *, tools: settings.Tools = (),
                         **setup: Any) -> Result:
        """As trc.Client.compensate()."""
        exchange = ProgramExchange(bytes_of(text), settings.program_setup(setup, tools))
        await self._run(exchange)
        return exchange.result()

    async def compensate_path(self, path: Path, **setup: Any) -> PathResult:
        """As trc.Client.compensate_path()."""
        exchange = PathExchange(path, settings.path_setup(setup))
        await self._run(exchange)
        return exchange.result()

    async def survey_radii(self, program: Union[str, bytes, Path], radii: Iterable[float] = (), *,
                           uncut: bool = False, largest: bool = True, **setup: Any) -> Survey:
        """As trc.Client.survey_radii()."""
        exchange = survey_of(program, radii, uncut, largest, setup)
        await self._run(exchange)
        return exchange.result()

    async def _run(self, exchange: Exchange) -> None:
        open_stream = self._channel.stream_stream(exchange.METHOD, identity, identity)
        waiting = Waiting(self._timeout)
        while True:
            try:
                async for message in open_stream(exchange.requests(), timeout=waiting.left()):
                    exchange.absorb(message)
                    waiting.has_answered()
                return
            except grpc.RpcError as error:
                wait = waiting.before_next_try(error)
                if wait is None:
                    raise raised_by(error, exchange.diagnostics) from error
                await asyncio.sleep(wait)
                exchange.go_on()


async def compensate(text: Union[str, bytes], *, server: Optional[str] = None,
                     tls: Optional[Tls] = None, timeout: Optional[float] = None,
                     tools: settings.Tools = (), **setup: Any) -> Result:
    """trc.compensate(), awaited."""
    async with Client(server, tls=tls, timeout=timeout) as client:
        return await client.compensate(text, tools=tools, **setup)
