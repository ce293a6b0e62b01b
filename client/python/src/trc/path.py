"""Motion blocks as numpy columns, in and out."""

from __future__ import annotations

import enum
import math
import numbers
from dataclasses import dataclass
from typing import Any, Iterator, Mapping, Optional, Sequence

import numpy as np

from . import settings, wire
from .v1 import block_pb2, compensated_block_pb2, setup_pb2


class Kind(enum.IntEnum):
    """What a programmed block is."""

    LINEAR = 1
    """G01"""
    RAPID = 2
    """G00"""
    CLOCKWISE = 3
    """G02"""
    COUNTER_CLOCKWISE = 4
    """G03"""
    COMMAND = 5
    """TRC is switched on or off, or set otherwise."""
    TEXT = 6
    """Comes out in its place, never interpreted."""


_COLUMNS = block_pb2.BlockColumns.DESCRIPTOR.fields_by_name
_COORDINATES = ("x", "y", "z", "i", "j", "k", "feed")
_SIDES = {"left": setup_pb2.COMPENSATION_SIDE_LEFT, "right": setup_pb2.COMPENSATION_SIDE_RIGHT,
          "off": setup_pb2.COMPENSATION_SIDE_OFF}


class Path:
    """The programmed path, mm and mm/min.

    Block by block:

        path = trc.Path().left().line(10, 0).line(50).off().line(60, -20)

    or as columns, each with one number a block; NaN where a block does not have it, so that the
    coordinate keeps its value:

        path = trc.Path.of_columns(kinds, x=x, y=y)
    """

    def __init__(self) -> None:
        self._kinds: Any = []
        self._values: dict[str, Any] = {name: [] for name in _COORDINATES}
        self._commands: dict[int, Any] = {}
        self._texts: dict[int, str] = {}

    @classmethod
    def of_columns(cls, kinds: Sequence[int], *, commands: Mapping[int, Any] = {},
                   texts: Mapping[int, str] = {}, **columns: Sequence[float]) -> "Path":
        """Of numpy columns, which are not copied where they hold 64-bit floats.

        kinds: a Kind for each block. commands: block number → TrcCommand of the protocol, or
        "left", "right", "off". texts: block number → text. columns: x y z, i j k (centres of arcs)
        and feed, each of one dimension; a value that is masked (numpy.ma) is one that the block does
        not have. 32-bit floats hold about seven digits, and that is what is compensated.
        """
        path = cls()
        path._kinds = _kind_column(kinds)
        count = len(path._kinds)
        for name in columns:
            if name not in _COORDINATES:
                raise TypeError(f"{name!r} is no column; there are {', '.join(_COORDINATES)}")
        path._values = {name: _column(name, columns[name], count) if name in columns else None
                        for name in _COORDINATES}
        path._commands = {at: _command(at, given) for at, given in commands.items()}
        path._texts = {at: _text(text) for at, text in texts.items()}
        for kind, at in ((Kind.COMMAND, path._commands), (Kind.TEXT, path._texts)):
            if sorted(at) != np.flatnonzero(path._kinds == kind).tolist():
                raise ValueError(f"the blocks of kind {kind.name} are {_few(path._kinds, kind)}, given "
                                 f"are {sorted(at)}")
        return path

    def __len__(self) -> int:
        return len(self._kinds)

    def line(self, x: Optional[float] = None, y: Optional[float] = None, z: Optional[float] = None,
             *, feed: Optional[float] = None) -> "Path":
        """G01 to a point."""
        return self._append(Kind.LINEAR, x=x, y=y, z=z, feed=feed)

    def rapid(self, x: Optional[float] = None, y: Optional[float] = None,
              z: Optional[float] = None) -> "Path":
        """G00 to a point."""
        return self._append(Kind.RAPID, x=x, y=y, z=z)

    def arc(self, x: Optional[float] = None, y: Optional[float] = None, z: Optional[float] = None,
            *, i: Optional[float] = None, j: Optional[float] = None, k: Optional[float] = None,
            clockwise: bool = False, feed: Optional[float] = None) -> "Path":
        """G02 or G03 to a point; i j k: the centre, from the start point unless set otherwise."""
        kind = Kind.CLOCKWISE if clockwise else Kind.COUNTER_CLOCKWISE
        return self._append(kind, x=x, y=y, z=z, i=i, j=j, k=k, feed=feed)

    def left(self, **command: Any) -> "Path":
        """G41"""
        return self.command(side=_SIDES["left"], **command)

    def right(self, **command: Any) -> "Path":
        """G42"""
        return self.command(side=_SIDES["right"], **command)

    def off(self) -> "Path":
        """G40"""
        return self.command(side=_SIDES["off"])

    def command(self, **fields: Any) -> "Path":
        """A TrcCommand of the protocol by its fields."""
        made = settings.command(**fields)
        self._append(Kind.COMMAND)
        self._commands[len(self) - 1] = made
        return self

    def text(self, text: str) -> "Path":
        """Comes out in its place, never interpreted: M8."""
        checked = _text(text)
        self._append(Kind.TEXT)
        self._texts[len(self) - 1] = checked
        return self

    def _append(self, kind: Kind, **values: Optional[float]) -> "Path":
        if not isinstance(self._kinds, list):
            raise TypeError("a path of columns does not grow")
        row = [_coordinate(name, values.get(name)) for name in _COORDINATES]
        self._kinds.append(kind)
        for name, value in zip(_COORDINATES, row):
            self._values[name].append(value)
        return self

    def request(self, first: int, most: int) -> bytes:
        """The BlockColumns, serialized, of up to `most` blocks from `first` on."""
        end = min(first + most, len(self))
        kinds = np.asarray(self._kinds[first:end], np.uint8)
        moves = (kinds >= Kind.LINEAR) & (kinds <= Kind.COUNTER_CLOCKWISE)
        arcs = (kinds == Kind.CLOCKWISE) | (kinds == Kind.COUNTER_CLOCKWISE)
        columns: dict[str, np.ndarray] = {}
        present = np.zeros(len(kinds), np.uint8)
        is_partial = False
        for bit, name in enumerate(_COORDINATES):
            column = self._values[name]
            if column is None:
                continue
            values = np.asarray(column[first:end], np.float64)
            of_kind = arcs if name in "ijk" else moves
            given = of_kind & ~np.isnan(values)
            count = int(given.sum())
            if count == 0:
                continue
            present[given] |= 1 << bit
            is_partial |= count != int(of_kind.sum())
            columns[name] = values if count == len(values) else values[given]
        rest = block_pb2.BlockColumns(first_block=first, final=end == len(self),
                                      kinds=kinds.tobytes(),
                                      present=present.tobytes() if is_partial else b"")
        for at in range(first, end) if self._commands or self._texts else ():
            if at in self._commands:
                rest.commands.add(index=at - first, command=self._commands[at])
            elif at in self._texts:
                rest.passthroughs.add(index=at - first).passthrough.text = self._texts[at]
        return rest.SerializeToString() + b"".join(
            wire.doubles(_COLUMNS[name].number, column) for name, column in columns.items())


def _coordinate(name: str, value: Optional[float]) -> float:
    """NaN for none; a NaN that was computed must not become a coordinate that keeps its value."""
    if value is None:
        return math.nan
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} takes a number, not {value!r}")
    if not math.isfinite(value):
        raise ValueError(f"{name} is {value}; it takes a finite number")
    return float(value)


def _text(text: str) -> str:
    if not isinstance(text, str):
        raise TypeError(f"a text block takes text, not {text!r}")
    return text


def _column(name: str, values: Any, count: int) -> np.ndarray:
    """Of one dimension, in 64-bit floats; not copied where it holds them."""
    column = np.asanyarray(values)
    if column.ndim != 1:
        raise ValueError(f"column {name} has {column.ndim} dimensions; it takes one")
    if len(column) != count:
        raise ValueError(f"column {name} has {len(column)} values for {count} blocks")
    if count > 0 and column.dtype.kind not in "fiuO":
        raise TypeError(f"column {name} takes numbers, not {column.dtype}")
    if isinstance(column, np.ma.MaskedArray):
        column = column.astype(np.float64).filled(np.nan)
    return np.asarray(column, np.float64)


def _kind_column(values: Any) -> np.ndarray:
    kinds = np.asarray(values)
    if kinds.ndim != 1:
        raise ValueError(f"kinds has {kinds.ndim} dimensions; it takes one")
    if len(kinds) == 0:
        return np.empty(0, np.uint8)
    if kinds.dtype.kind not in "iu":
        raise TypeError(f"kinds takes whole numbers, a Kind for each block, not {kinds.dtype}")
    wrong = np.flatnonzero((kinds < min(Kind)) | (kinds > max(Kind)))
    if len(wrong) > 0:
        raise ValueError(f"kinds[{wrong[0]}] is {kinds[wrong[0]]}, which Kind has not")
    return kinds.astype(np.uint8)


def _few(kinds: np.ndarray, kind: Kind) -> str:
    at = np.flatnonzero(kinds == kind).tolist()
    return str(at) if len(at) <= 10 else f"{at[:10]} and {len(at) - 10} others"


def _command(at: int, given: Any) -> Any:
    if isinstance(given, str):
        if given not in _SIDES:
            raise ValueError(f"commands[{at}] takes {', '.join(_SIDES)}, not {given!r}")
        return block_pb2.TrcCommand(side=_SIDES[given])
    if not isinstance(given, block_pb2.TrcCommand):
        raise TypeError(f"commands[{at}] takes a TrcCommand or a word, not {given!r}")
    return given


@dataclass(frozen=True)
class Block:
    """One block of the compensated path, mm and mm/min."""

    kind: str
    """linear, rapid, arc or text"""
    origin: str
    """PROGRAMMED, APPROACH, RETRACT, TRANSITION …: CompensatedBlock.Origin of the protocol"""
    start: Optional[np.ndarray]
    end: Optional[np.ndarray]
    center: Optional[np.ndarray]
    sweep: Optional[float]
    """rad, positive: counter-clockwise"""
    text: Optional[str]


_OUT = compensated_block_pb2.CompensatedColumns.DESCRIPTOR.fields_by_name
_OUT_DOUBLES = ("start_x", "start_y", "start_z", "end_x", "end_y", "end_z", "center_x", "center_y",
                "center_z", "sweep", "feed")
_OUT_KIND = ("", "linear", "rapid", "arc", "text")
_ARC, _TEXT = 3, 4
_FLAG_FEED = 2


class CompensatedPath:
    """The compensated path as columns, one row a block; NaN where a block has no such number."""

    def __init__(self, batches: Sequence["CompensatedPath.Batch"]) -> None:
        def joined(name: str) -> np.ndarray:
            parts = [getattr(batch, name) for batch in batches]
            return np.concatenate(parts) if parts else np.empty((0, 3))

        self.kinds: np.ndarray = np.concatenate(
            [b.kinds for b in batches] or [np.empty(0, np.uint8)])
        self.origins: np.ndarray = np.concatenate(
            [b.origins for b in batches] or [np.empty(0, np.uint8)])
        self.start: np.ndarray = joined("start")
        """n × 3"""
        self.end: np.ndarray = joined("end")
        """n × 3"""
        self.center: np.ndarray = joined("center")
        """n × 3, arcs"""
        self.sweep: np.ndarray = joined("sweep").reshape(-1)
        """rad, arcs; positive: counter-clockwise"""
        self.feed: np.ndarray = joined("feed").reshape(-1)
        self.texts: dict[int, str] = {}
        first = 0
        for batch in batches:
            self.texts.update({first + at: text for at, text in batch.texts.items()})
            first += len(batch.kinds)

    def __len__(self) -> int:
        return len(self.kinds)

    def __getitem__(self, at: int) -> Block:
        kind = int(self.kinds[at])
        moves = kind != _TEXT
        return Block(
            kind=_OUT_KIND[kind],
            origin=compensated_block_pb2.CompensatedBlock.Origin.Name(int(self.origins[at])),
            start=self.start[at] if moves else None,
            end=self.end[at] if moves else None,
            center=self.center[at] if kind == _ARC else None,
            sweep=float(self.sweep[at]) if kind == _ARC else None,
            text=self.texts.get(at))

    def __iter__(self) -> Iterator[Block]:
        return (self[at] for at in range(len(self)))

    class Batch:
        """What one response holds, of CompensatedColumns as they are on the wire."""

        def __init__(self, message: memoryview) -> None:
            numbers = {_OUT[name].number: name for name in _OUT_DOUBLES}
            found, rest = wire.take(message, set(numbers))
            columns = {numbers[number]: np.frombuffer(view, wire.DOUBLE)
                       for number, view in found.items()}
            others = compensated_block_pb2.CompensatedColumns.FromString(rest)
            self.kinds = np.frombuffer(others.kinds, np.uint8)
            count = len(self.kinds)
            # One value holds for all blocks.
            self.origins = np.broadcast_to(np.frombuffer(others.origins, np.uint8), count)
            flags = np.broadcast_to(np.frombuffer(others.flags, np.uint8), count)
            self.texts = {text.index: text.text for text in others.texts}
            moves = self.kinds != _TEXT
            arcs = self.kinds == _ARC
            self.end = self._spread(columns, "end", moves)
            self.center = self._spread(columns, "center", arcs)
            self.start = self._starts(columns, moves, self.end)
            self.sweep = np.full(count, np.nan)
            self.feed = np.full(count, np.nan)
            if arcs.any():
                self.sweep[arcs] = columns["sweep"]
            with_feed = flags & _FLAG_FEED != 0
            if with_feed.any():
                self.feed[with_feed] = columns["feed"]

        @staticmethod
        def _spread(columns: Mapping[str, np.ndarray], name: str, rows: np.ndarray) -> np.ndarray:
            out = np.full((len(rows), 3), np.nan)
            for axis, letter in enumerate("xyz"):
                column = columns.get(f"{name}_{letter}")
                if column is not None:
                    out[rows, axis] = column
            return out

        @staticmethod
        def _starts(columns: Mapping[str, np.ndarray], moves: np.ndarray,
                    end: np.ndarray) -> np.ndarray:
            out = np.full((len(moves), 3), np.nan)
            if not moves.any():
                return out
            for axis, letter in enumerate("xyz"):
                column = columns[f"start_{letter}"]
                if len(column) == 1:
                    column = np.concatenate([column, end[moves, axis][:-1]])
                out[moves, axis] = column
            return out
