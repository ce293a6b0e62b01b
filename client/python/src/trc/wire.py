"""Packed columns on the wire.

Protobuf's Python classes copy repeated numbers one by one. A packed column is its numbers side by
side in memory, as numpy has them, so columns are written and read here as they are.
"""

from __future__ import annotations

from typing import Iterator

import numpy as np

LENGTH_DELIMITED = 2
DOUBLE = np.dtype("<f8")


def varint(number: int) -> bytes:
    """A number as protobuf writes it."""
    out = bytearray()
    while number > 0x7F:
        out.append(number & 0x7F | 0x80)
        number >>= 7
    out.append(number)
    return bytes(out)


def field(number: int, content: bytes) -> bytes:
    """A length-delimited field; nothing for an empty one."""
    if not content:
        return b""
    return varint(number << 3 | LENGTH_DELIMITED) + varint(len(content)) + content


def doubles(number: int, column: np.ndarray) -> bytes:
    """A packed column of doubles."""
    return field(number, np.ascontiguousarray(column, DOUBLE).tobytes())


def fields(message: memoryview) -> Iterator[tuple[int, int, int, int]]:
    """The fields of a message: number, start of the whole field, start and end of its content."""
    at = 0
    while at < len(message):
        begin = at
        tag, at = _read_varint(message, at)
        wire_type = tag & 7
        if wire_type == LENGTH_DELIMITED:
            length, at = _read_varint(message, at)
            yield tag >> 3, begin, at, at + length
            at += length
        elif wire_type == 0:
            start = at
            _, at = _read_varint(message, at)
            yield tag >> 3, begin, start, at
        else:
            size = 8 if wire_type == 1 else 4
            yield tag >> 3, begin, at, at + size
            at += size


def _read_varint(message: memoryview, at: int) -> tuple[int, int]:
    number = shift = 0
    while True:
        byte = message[at]
        at += 1
        number |= (byte & 0x7F) << shift
        if byte < 0x80:
            return number, at
        shift += 7


def take(message: memoryview, wanted: set[int]) -> tuple[dict[int, memoryview], bytes]:
    """The contents of the wanted fields, as views, and the message without them."""
    found: dict[int, memoryview] = {}
    rest = bytearray()
    for number, begin, start, end in fields(message):
        if number in wanted:
            found[number] = message[start:end]
        else:
            rest += message[begin:end]
    return found, bytes(rest)


def contents(message: bytes, wanted: int) -> list[bytes]:
    """The contents of a length-delimited field, each time it is there."""
    view = memoryview(message)
    return [bytes(view[start:end]) for number, _, start, end in fields(view) if number == wanted]


def numbers(message: bytes) -> Iterator[tuple[int, int]]:
    """The fields of a message that has varints alone."""
    view = memoryview(message)
    for number, _, start, _ in fields(view):
        yield number, _read_varint(view, start)[0]
