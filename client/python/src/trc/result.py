"""What comes back: diagnostics and results, without protobuf in them."""

from __future__ import annotations

import enum
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Mapping, Optional

if TYPE_CHECKING:
    from .path import CompensatedPath


class Severity(enum.IntEnum):
    """How much a diagnostic matters."""

    NOTE = 1
    WARNING = 2
    ERROR = 3


_GERMAN = {Severity.NOTE: "Hinweis", Severity.WARNING: "Warnung", Severity.ERROR: "Fehler"}


@dataclass(frozen=True)
class Place:
    """A place in a program."""

    line: Optional[int] = None
    """1-based line of the NC text."""
    column: Optional[int] = None
    """1-based byte of that line."""
    source_number: Optional[int] = None
    """N number of the block."""
    source_index: Optional[int] = None
    """0-based position of the input block."""

    @staticmethod
    def of(message: Any) -> "Place":
        """From the message of the protocol."""

        def given(name: str) -> Any:
            return getattr(message, name) if message.HasField(name) else None

        return Place(
            given("line"), given("column"), given("source_number"), given("source_index")
        )


@dataclass(frozen=True)
class RelatedPlace:
    """Another block that a diagnostic speaks of."""

    name: str
    """Which one it is: "first", "last", "other"."""
    text: str
    """The same in words, in the language of the diagnostic."""
    place: Place


@dataclass(frozen=True)
class Diagnostic:
    """Something the caller should know about the program."""

    code: int
    """Stable public number; proto/README.md lists all of them."""
    severity: Severity
    message: str
    """One sentence with the values in it."""
    remedy: str
    """What the operator or programmer can do."""
    line: Optional[int] = None
    """1-based line of the NC text."""
    column: Optional[int] = None
    """1-based byte of that line."""
    source_number: Optional[int] = None
    """N number of the block."""
    source_index: Optional[int] = None
    """0-based position of the input block."""
    point: Optional[tuple[float, float, float]] = None
    """Where it happens, mm."""
    values: Mapping[str, float] = field(default_factory=dict)
    """The numbers behind the message; mm, degrees or a count, as the name says."""
    title: str = ""
    """What kind of thing it is, in the language that the setup asks for."""
    text: str = ""
    """The title with the word at fault and the values, in the unit and that language."""
    help: str = ""
    """What the operator or programmer can do, in that language."""
    place: Place = Place()
    """Where it was found."""
    related_places: tuple[RelatedPlace, ...] = ()
    """Other blocks it speaks of, in the order of the text."""
    language: str = "en"
    """Of `title`, `text` and `help`: "en" or "de"."""
    inch: bool = False
    """The program counts in inches there; values are in mm all the same."""

    def __str__(self) -> str:
        is_german = self.language == "de"
        line = "Zeile" if is_german else "line"
        place = f"{line} {self.line}: " if self.line is not None else ""
        severity = _GERMAN[self.severity] if is_german else self.severity.name.lower()
        return f"{place}{severity} {self.code}: {self.text if is_german else self.message}"

    @staticmethod
    def of(message: Any) -> "Diagnostic":
        """From the message of the protocol."""

        def given(name: str) -> Any:
            return getattr(message, name) if message.HasField(name) else None

        point = given("point")
        return Diagnostic(
            code=message.code,
            severity=Severity(message.severity),
            message=message.message,
            remedy=message.remedy,
            line=given("line"),
            column=given("column"),
            source_number=given("source_number"),
            source_index=given("source_index"),
            point=None if point is None else (point.x, point.y, point.z),
            values=dict(message.values),
            title=message.title,
            text=message.text,
            help=message.help,
            place=Place.of(message.place),
            related_places=tuple(
                RelatedPlace(related.name, related.text, Place.of(related.place))
                for related in message.related_places
            ),
            language=message.language or "en",
            inch=message.inch,
        )


@dataclass(frozen=True)
class Result:
    """A compensated program."""

    text: str
    """NC text with tool radius compensation resolved, G40 throughout."""
    diagnostics: list[Diagnostic]
    """Notes and warnings, in the order they were raised."""
    summary: Any
    """The ProgramSummary of the protocol."""
    record: Optional[str] = None
    """With record=True: the record of the job as JSON, to be filed as it is."""
    blocks: Optional["CompensatedPath"] = None
    """With blocks=True: the path of the text as numpy columns."""


@dataclass(frozen=True)
class PathResult:
    """A compensated path."""

    path: "CompensatedPath"
    diagnostics: list[Diagnostic]
    """Notes and warnings, in the order they were raised."""
    summary: Any
    """The PathSummary of the protocol."""


@dataclass(frozen=True)
class ProgramPart:
    """A part of a compensated program, in the order of the program."""

    text: str
    """The next lines, or a piece of one; may be empty."""
    diagnostics: list[Diagnostic]
    """What was told since the part before."""
    summary: Optional[Any] = None
    """Of the last part: the ProgramSummary of the protocol. Nothing may be machined before."""
    record: Optional[str] = None
    """Of the last part, with record=True: the record of the job as JSON."""


@dataclass(frozen=True)
class PathPart:
    """A part of a compensated path, in path order."""

    path: "CompensatedPath"
    """The next blocks; may be empty."""
    diagnostics: list[Diagnostic]
    """What was told since the part before."""
    summary: Optional[Any] = None
    """Of the last part: the PathSummary of the protocol. Nothing may be machined before."""
