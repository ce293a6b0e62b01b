"""What tools of many radii make of one program or path."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

from .result import Diagnostic


@dataclass(frozen=True)
class SurveyPlace:
    """A block of the program."""

    source_index: int
    """0-based position of the input block."""
    line: Optional[int] = None
    """1-based line of the NC text; none: a path."""
    source_number: Optional[int] = None
    """N number of the block."""

    @staticmethod
    def of(message: Any) -> "SurveyPlace":
        """From the message of the protocol."""
        return SurveyPlace(
            source_index=message.source_index,
            line=message.line or None,
            source_number=message.source_number if message.HasField("source_number") else None)


@dataclass(frozen=True)
class UncutWall:
    """A stretch of a wall that the path does not touch; points in the plane, mm."""

    place: SurveyPlace
    """The block of the wall."""
    start: tuple[float, float, float]
    end: tuple[float, float, float]
    center: Optional[tuple[float, float, float]] = None
    """Of an arc."""
    sweep: float = 0.0
    """Of an arc: rad, positive: counter-clockwise."""

    @staticmethod
    def of(message: Any) -> "UncutWall":
        """From the message of the protocol."""

        def point(position: Any) -> tuple[float, float, float]:
            return (position.x, position.y, position.z)

        return UncutWall(
            place=SurveyPlace.of(message.place), start=point(message.start), end=point(message.end),
            center=point(message.center) if message.HasField("center") else None,
            sweep=message.sweep)


@dataclass(frozen=True)
class Clearance:
    """Where the path comes nearest to the contour, measured by a second method."""

    distance: float
    """mm; negative: behind the contour."""
    point: tuple[float, float, float]
    """Of the tool centre, mm."""


@dataclass(frozen=True)
class SurveyedRadius:
    """What becomes of the program with one radius."""

    radius: float
    """Of the tool, mm."""
    accepted: bool
    """It is compensated, and the path is nowhere nearer than the tool radius."""
    refusal: Optional[Diagnostic]
    """Why it is not accepted."""
    reaches_every_wall: bool
    """It is accepted, nothing is left out, and it comes nowhere too near."""
    masked_share: float
    """Share of the wall length in masked blocks and removed loops, 0 to 1."""
    clearance: Optional[Clearance]
    """None: it was refused, or nothing is compensated."""
    compensated_length: Optional[float]
    """mm, in the plane; none: it was refused."""
    programmed_length: Optional[float]
    """mm, in the plane; none: it was refused."""
    warnings: int
    """How many diagnostics are warnings."""
    wall_length: Optional[float]
    """Length of all walls, mm; none: not known."""
    uncut_length: Optional[float]
    """Length of the walls that the path does not touch, mm, inside corners too; none: not known."""
    uncut_by_removal: bool
    """The radius is refused: both lengths are those of the path that leaves the loops out."""
    uncut: list[UncutWall]
    """With `uncut=True`: the stretches, in the order of the program, 2000 at most."""
    uncut_left_out: int
    """How many more stretches there were."""
    limits: list[SurveyPlace]
    """What is in the way where it does not reach every wall: two blocks, or one."""

    @staticmethod
    def of(message: Any) -> "SurveyedRadius":
        """From the message of the protocol."""

        def given(name: str) -> Any:
            return getattr(message, name) if message.HasField(name) else None

        refusal, measured = given("refusal"), given("certificate")
        return SurveyedRadius(
            radius=message.radius,
            accepted=message.accepted,
            refusal=None if refusal is None else Diagnostic.of(refusal),
            reaches_every_wall=message.reaches_every_wall,
            masked_share=message.masked_share,
            clearance=None if measured is None else Clearance(
                measured.clearance,
                (measured.point.x, measured.point.y, measured.point.z)),
            compensated_length=given("compensated_length"),
            programmed_length=given("programmed_length"),
            warnings=message.warnings,
            wall_length=given("wall_length"),
            uncut_length=given("uncut_length"),
            uncut_by_removal=message.uncut_by_removal,
            uncut=list(map(UncutWall.of, message.uncut)),
            uncut_left_out=message.uncut_left_out,
            limits=list(map(SurveyPlace.of, message.limits)))


@dataclass(frozen=True)
class LargestRadius:
    """The largest radius that reaches every wall."""

    radius: float
    """mm, in whole micrometres; 0: there is none."""
    is_limited: bool
    """A tool larger by a micrometre does not. Else the search ended, much above the part's size."""
    limits: list[SurveyPlace]
    """The blocks that limit it: two, or one that is too small by itself."""
    refusal: Optional[Diagnostic]
    """What a larger tool is refused with; none: it leaves something out."""

    @staticmethod
    def of(message: Any) -> "LargestRadius":
        """From the message of the protocol."""
        return LargestRadius(
            radius=message.radius, is_limited=message.is_limited,
            limits=list(map(SurveyPlace.of, message.limits)),
            refusal=Diagnostic.of(message.refusal) if message.HasField("refusal") else None)


@dataclass(frozen=True)
class Survey:
    """All that was asked."""

    radii: list[SurveyedRadius]
    """In the order asked."""
    largest: Optional[LargestRadius]
    """None: it was not asked for."""
    diagnostics: list[Diagnostic]
    """Notes and warnings of reading, which hold for every radius."""
    summary: Any
    """The SurveySummary of the protocol."""
