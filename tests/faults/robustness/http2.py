"""Frames of HTTP/2, as gRPC takes them."""

import struct

DATA, HEADERS, PRIORITY, RST_STREAM, SETTINGS, PING, WINDOW_UPDATE, CONTINUATION = 0, 1, 2, 3, 4, 6, 8, 9
END_HEADERS = 4
GREETING = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"


def frame(kind, flags, stream, payload=b""):
    return struct.pack(">I", len(payload))[1:] + bytes([kind, flags]) + struct.pack(">I", stream) + payload


def literal(name, value):
    """A header that is not remembered, without Huffman's code."""
    return b"\0" + bytes([len(name)]) + name + bytes([len(value)]) + value


def greeting(settings=b""):
    return GREETING + frame(SETTINGS, 0, 0, settings)


def call(stream, path, *more):
    """The headers of a call."""
    fields = [(b":method", b"POST"), (b":scheme", b"https"), (b":path", path), (b":authority", b"localhost"),
              (b"te", b"trailers"), (b"content-type", b"application/grpc"), *more]
    return frame(HEADERS, END_HEADERS, stream, b"".join(literal(name, value) for name, value in fields))


def reset(stream):
    cancel = 8
    return frame(RST_STREAM, 0, stream, struct.pack(">I", cancel))


def message(stream, payload, compressed):
    """A message in frames of the size that every server takes."""
    largest = 16384
    whole = bytes([compressed]) + struct.pack(">I", len(payload)) + payload
    return b"".join(frame(DATA, 0, stream, whole[at:at + largest]) for at in range(0, len(whole), largest))
