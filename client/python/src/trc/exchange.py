"""One stream, from the setup to the summary: what is sent, what has come, where to go on.

No connection is in here: the client and its asyncio twin drive the same exchange. A stream that is
lost goes on from the last resume token, on any server of the same version and key; what came after
the token comes again and is dropped here, so that the joined answer is that of an unbroken stream.
"""

from __future__ import annotations

import codecs
from typing import Any, Iterator, Optional, Type, Union

from . import wire
from .errors import no_summary
from .path import CompensatedPath, Path
from .result import Diagnostic, PathPart, PathResult, ProgramPart, Result
from .survey import LargestRadius, Survey, SurveyedRadius
from .v1 import setup_pb2, survey_pb2, trc_service_pb2

TEXT_BYTES = 64 * 1024
BATCH_BLOCKS = 1024


def text_requests(request: Type[Any], text: bytes, first: int) -> Iterator[bytes]:
    """All text from a byte on, as messages of a type that has `text`."""
    while True:
        piece = text[first:first + TEXT_BYTES]
        is_last = first + len(piece) == len(text)
        yield request(text=trc_service_pb2.ProgramText(
            first_byte=first, text=piece, final=is_last)).SerializeToString()
        if is_last:
            return
        first += len(piece)


def path_requests(field: int, path: Path, first: int) -> Iterator[bytes]:
    """All blocks from one on, as messages whose columns are this field."""
    while True:
        yield wire.field(field, path.request(first, BATCH_BLOCKS))
        first += BATCH_BLOCKS
        if first >= len(path):
            return


class _Exchange:
    def __init__(self, path_setup: setup_pb2.PathSetup) -> None:
        self._path_setup = path_setup
        self._path_setup.want_resume_tokens = True
        self._position = 0
        self._token = b""
        self._certain = 0
        self._diagnostics_certain = 0
        self._parts: list[Any] = []
        self.diagnostics: list[Diagnostic] = []
        self.summary: Optional[Any] = None
        self.record: Optional[str] = None

    def go_on(self) -> None:
        """The stream was lost: back to what the last token holds."""
        del self._parts[self._certain:]
        del self.diagnostics[self._diagnostics_certain:]
        self.summary = None
        self._path_setup.resume_token = self._token

    def _absorb(self, part: Any, response: Any, consumed: Optional[int]) -> None:
        if part is not None:
            self._parts.append(part)
        self.diagnostics.extend(map(Diagnostic.of, response.diagnostics))
        if response.resume_token and consumed is not None:
            self._token = response.resume_token
            self._position = consumed
            self._certain = len(self._parts)
            self._diagnostics_certain = len(self.diagnostics)
        if response.HasField("summary"):
            self.summary = response.summary

    def _take(self, is_over: bool) -> tuple[list[Any], list[Diagnostic]]:
        """What has come since it was asked last and will not come again: all, where the stream has
        ended with OK. With the summary alone it may be lost still, and comes again then."""
        if is_over:
            if self.summary is None:
                raise no_summary()
            self._certain, self._diagnostics_certain = len(self._parts), len(self.diagnostics)
        parts, told = self._parts[:self._certain], self.diagnostics[:self._diagnostics_certain]
        del self._parts[:self._certain]
        del self.diagnostics[:self._diagnostics_certain]
        self._certain = self._diagnostics_certain = 0
        return parts, told


class ProgramExchange(_Exchange):
    """NC text to NC text."""

    METHOD = "/trc.v1.TrcService/CompensateProgram"

    def __init__(self, text: bytes, setup: setup_pb2.ProgramSetup) -> None:
        self._setup = setup
        super().__init__(setup.path)
        self._text = text
        self._decoder = codecs.getincrementaldecoder("utf-8")("surrogateescape")

    def requests(self) -> Iterator[bytes]:
        """The setup and all text, without waiting for an answer between."""
        request = trc_service_pb2.CompensateProgramRequest
        yield request(setup=self._setup).SerializeToString()
        yield from text_requests(request, self._text, self._position)

    def absorb(self, message: bytes) -> None:
        """The next response."""
        response = trc_service_pb2.CompensateProgramResponse.FromString(message)
        self._absorb(response.nc_text or None, response, response.consumed_bytes)
        self.record = response.record or self.record

    def take(self) -> Optional[ProgramPart]:
        """The next part that is certain; none: not yet."""
        parts, told = self._take(is_over=False)
        if not parts and not told:
            return None
        return ProgramPart(text=self._decoder.decode(b"".join(parts)), diagnostics=told)

    def last(self) -> ProgramPart:
        """The rest, with the summary; the stream has ended with OK."""
        parts, told = self._take(is_over=True)
        return ProgramPart(text=self._decoder.decode(b"".join(parts), True), diagnostics=told,
                           summary=self.summary, record=self.record)

    def result(self, blocks: Optional[CompensatedPath] = None) -> Result:
        """All of it; the stream has ended with OK."""
        if self.summary is None:
            raise no_summary()
        return Result(text=b"".join(self._parts).decode("utf-8", "surrogateescape"), blocks=blocks,
                      diagnostics=self.diagnostics, summary=self.summary, record=self.record)

    def for_blocks(self) -> "ProgramBlocksExchange":
        """The same program with the same setup once more, for its blocks."""
        return ProgramBlocksExchange(self._text, self._setup)


def _columns_of(message: bytes, response: Any, field: int) -> tuple[Any, Any]:
    """The columns of a response, none: it has none; and the rest of it."""
    found, rest = wire.take(memoryview(message), {field})
    columns = found.get(field)
    part = None if columns is None else CompensatedPath.Batch(columns)
    return part, response.FromString(rest)


class ProgramBlocksExchange(ProgramExchange):
    """NC text to compensated blocks, in columns: those whose text ProgramExchange has."""

    _COLUMNS_IN = (
        trc_service_pb2.CompensateProgramResponse.DESCRIPTOR.fields_by_name["columns"].number)

    def __init__(self, text: bytes, setup: setup_pb2.ProgramSetup) -> None:
        of_blocks = setup_pb2.ProgramSetup()
        of_blocks.CopyFrom(setup)
        of_blocks.output = setup_pb2.PROGRAM_OUTPUT_BLOCKS
        of_blocks.path.response_layout = setup_pb2.RESPONSE_LAYOUT_COLUMNS
        of_blocks.record = False
        super().__init__(text, of_blocks)

    def absorb(self, message: bytes) -> None:
        """The next response."""
        part, response = _columns_of(
            message, trc_service_pb2.CompensateProgramResponse, self._COLUMNS_IN)
        self._absorb(part, response, response.consumed_bytes)

    def blocks(self) -> CompensatedPath:
        """All of them; the stream has ended with OK."""
        if self.summary is None:
            raise no_summary()
        return CompensatedPath(self._parts)


class PathExchange(_Exchange):
    """Motion blocks to compensated blocks, in columns."""

    METHOD = "/trc.v1.TrcService/CompensatePath"
    _COLUMNS_OUT = trc_service_pb2.CompensatePathRequest.DESCRIPTOR.fields_by_name["columns"].number
    _COLUMNS_IN = trc_service_pb2.CompensatePathResponse.DESCRIPTOR.fields_by_name["columns"].number

    def __init__(self, path: Path, setup: setup_pb2.PathSetup) -> None:
        setup.response_layout = setup_pb2.RESPONSE_LAYOUT_COLUMNS
        super().__init__(setup)
        self._path = path

    def requests(self) -> Iterator[bytes]:
        """The setup and all blocks, without waiting for an answer between."""
        yield trc_service_pb2.CompensatePathRequest(setup=self._path_setup).SerializeToString()
        yield from path_requests(self._COLUMNS_OUT, self._path, self._position)

    def absorb(self, message: bytes) -> None:
        """The next response."""
        part, response = _columns_of(
            message, trc_service_pb2.CompensatePathResponse, self._COLUMNS_IN)
        consumed = (response.consumed_through_block + 1
                    if response.HasField("consumed_through_block") else 0)
        self._absorb(part, response, consumed)

    def take(self) -> Optional[PathPart]:
        """The next part that is certain; none: not yet."""
        parts, told = self._take(is_over=False)
        if not parts and not told:
            return None
        return PathPart(path=CompensatedPath(parts), diagnostics=told)

    def last(self) -> PathPart:
        """The rest, with the summary; the stream has ended with OK."""
        parts, told = self._take(is_over=True)
        return PathPart(path=CompensatedPath(parts), diagnostics=told, summary=self.summary)

    def result(self) -> PathResult:
        """All of it; the stream has ended with OK."""
        if self.summary is None:
            raise no_summary()
        return PathResult(path=CompensatedPath(self._parts), diagnostics=self.diagnostics,
                          summary=self.summary)


class SurveyExchange:
    """One program or path and many radii. One that is lost begins anew."""

    METHOD = "/trc.v1.TrcService/SurveyRadii"
    _COLUMNS_OUT = trc_service_pb2.SurveyRadiiRequest.DESCRIPTOR.fields_by_name["columns"].number

    def __init__(self, source: Union[bytes, Path], setup: survey_pb2.SurveySetup) -> None:
        self._source = source
        self._setup = setup
        self._radii: list[SurveyedRadius] = []
        self._summary: Any = None
        self.diagnostics: list[Diagnostic] = []
        self.record: Optional[str] = None

    def requests(self) -> Iterator[bytes]:
        """The setup and the whole input, without waiting for an answer between."""
        request = trc_service_pb2.SurveyRadiiRequest
        yield request(setup=self._setup).SerializeToString()
        if isinstance(self._source, Path):
            yield from path_requests(self._COLUMNS_OUT, self._source, 0)
        else:
            yield from text_requests(request, self._source, 0)

    def absorb(self, message: bytes) -> None:
        """The next response."""
        response = trc_service_pb2.SurveyRadiiResponse.FromString(message)
        self.diagnostics.extend(map(Diagnostic.of, response.diagnostics))
        if response.HasField("radius"):
            self._radii.append(SurveyedRadius.of(response.radius))
        if response.HasField("summary"):
            self._summary = response.summary

    def go_on(self) -> None:
        """The stream was lost: from the start."""
        self._summary = None
        self._radii.clear()
        self.diagnostics.clear()

    def result(self) -> Survey:
        """All of it; the stream has ended with OK."""
        summary = self._summary
        if summary is None:
            raise no_summary()
        largest = LargestRadius.of(summary.largest) if summary.HasField("largest") else None
        return Survey(radii=self._radii, largest=largest, diagnostics=self.diagnostics,
                      summary=summary)


PartExchange = Union[ProgramExchange, PathExchange]
Exchange = Union[ProgramExchange, PathExchange, SurveyExchange]
