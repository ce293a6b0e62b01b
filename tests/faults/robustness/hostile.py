"""Clients that mean harm, each from an address of its own: what they take must not be that of others."""

import os
import random
import signal
import socket
import ssl
import subprocess
import time
import zlib

import http2
from deck import Deck

COMPENSATE = b"/trc.v1.TrcService/CompensateProgram"
HEALTH = b"/grpc.health.v1.Health/Check"
WATCH = b"/grpc.health.v1.Health/Watch"
SERVER_INFO = b"/trc.v1.TrcService/GetServerInfo"
NO_WINDOW = b"\0\4\0\0\0\0"  # of SETTINGS: a client that lets nothing out
INFLATED_BYTES = 256 << 20
FLOOD_S = 3
DEAF_S = 12  # longer than the server waits for a client
POST = b"POST /v1/programs:compensate HTTP/1.1\r\nHost: localhost\r\nContent-Type: text/plain\r\n"


def bomb():
    """Next to nothing that becomes very much."""
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    piece = bytes(1 << 20)
    return b"".join(packer.compress(piece) for _ in range(INFLATED_BYTES >> 20)) + packer.flush()


class Hostile:
    def __init__(self, test, number, seed):
        self.number, self.rng, self.held = number, random.Random(seed), []
        self.history, self.over, self.server = test.history, test.over, test.server
        self.cases, self.trc, self.proxies = test.cases, test.trc, test.proxies
        self.authority = os.path.join(test.folder, "ca.pem")
        self.address, self.bomb = f"127.0.0.{2 + number}", test.bomb
        self.kinds = Deck(self.rng, [
            self.garbage, self.preface, self.hold, self.storm, self.drop, self.compressed_bomb,
            self.rapid_reset, self.empty_data, self.endless_headers, self.frames, self.shut_window,
            self.resets_together, self.unread_answers, self.unfinished_messages,
            self.half_handshake, self.deaf, self.deaf_http, self.endless_head,
            self.slow_head, self.half_body])

    def run(self):
        while not self.over.is_set():
            kind = self.kinds.draw()
            self.history.add(f"hostile {self.number}", kind.__name__)
            try:
                kind()
            except OSError:
                pass  # It has been thrown out, or nobody is there just now.
            if len(self.held) > 60:
                self.drop()
            time.sleep(self.rng.random())
        self.drop()

    def connect(self, port=None):
        return socket.create_connection(("127.0.0.1", port or self.server.port), 2, (self.address, 0))

    def connect_tls(self, port=None, protocol="h2"):
        context = ssl.create_default_context(cafile=self.authority)
        context.set_alpn_protocols([protocol])
        return context.wrap_socket(self.connect(port), server_hostname="127.0.0.1")

    def flood(self, end, frames):
        """`frames(stream)` again and again, until it is thrown out."""
        stop, stream = time.monotonic() + FLOOD_S, 1
        while time.monotonic() < stop and not self.over.is_set():
            part = b""
            for _ in range(200):
                part, stream = part + frames(stream), stream + 2
            end.sendall(part)

    # --- at the port of gRPC --------------------------------------------------------------------

    def garbage(self):
        with self.connect() as end:
            end.sendall(self.rng.randbytes(self.rng.randint(1, 4096)))

    def preface(self):
        with self.connect() if self.rng.random() < 0.5 else self.connect_tls() as end:
            end.sendall(http2.GREETING + self.rng.randbytes(64))

    def hold(self):
        for _ in range(20):
            self.held.append(self.connect())

    def storm(self):
        for _ in range(60):
            self.connect().close()

    def drop(self):
        for end in self.held:
            end.close()
        self.held = []

    def compressed_bomb(self):
        with self.connect_tls() as end:
            end.sendall(http2.greeting() + http2.call(1, self.rng.choice([COMPENSATE, HEALTH]),
                                                      (b"grpc-encoding", b"gzip")))
            end.sendall(http2.message(1, self.bomb, compressed=True))
            end.recv(4096)

    def rapid_reset(self):
        with self.connect_tls() as end:
            end.sendall(http2.greeting())
            self.flood(end, lambda stream: http2.call(stream, COMPENSATE) + http2.reset(stream))

    def empty_data(self):
        with self.connect_tls() as end:
            end.sendall(http2.greeting() + http2.call(1, COMPENSATE))
            self.flood(end, lambda stream: http2.frame(http2.DATA, 0, 1))

    def endless_headers(self):
        """A head of HTTP/2 without an end."""
        with self.connect_tls() as end:
            end.sendall(http2.greeting() + http2.frame(http2.HEADERS, 0, 1))
            part = self.rng.choice([b"", http2.literal(b"x", b"y" * 100)])
            self.flood(end, lambda stream: http2.frame(http2.CONTINUATION, 0, 1, part))

    def frames(self):
        """One kind of frame that asks for nothing."""
        kind, payload = self.rng.choice([(http2.SETTINGS, b""), (http2.PING, b"12345678"),
                                         (http2.PRIORITY, b"\0\0\0\0\1"), (http2.WINDOW_UPDATE, b"\0\0\0\1")])
        streams = kind == http2.PRIORITY
        with self.connect_tls() as end:
            end.sendall(http2.greeting())
            self.flood(end, lambda stream: http2.frame(kind, 0, stream if streams else 0, payload))

    def shut_window(self):
        with self.connect_tls() as end:
            end.sendall(http2.greeting(NO_WINDOW) + http2.call(1, COMPENSATE)
                        + http2.message(1, b"\x0a\0", compressed=False))
            self.over.wait(DEAF_S)

    def together(self, count):
        """So many connections at once, as far as they are let in."""
        ends = []
        for _ in range(count):
            try:
                ends.append(self.connect_tls())
            except OSError:
                break
        return ends

    def of_each(self, ends, bytes_of):
        """Sends to each end what `bytes_of(round)` says, until all have been thrown out."""
        stop, turn = time.monotonic() + FLOOD_S, 0
        while ends and time.monotonic() < stop and not self.over.is_set():
            part, turn = bytes_of(turn), turn + 1
            for end in list(ends):
                try:
                    end.sendall(part)
                except OSError:
                    ends.remove(end)

    def resets_together(self):
        ends = self.together(12)
        self.of_each(list(ends), lambda turn: (http2.greeting() if turn == 0 else b"") + b"".join(
            http2.call(stream, COMPENSATE) + http2.reset(stream)
            for stream in range(turn * 200 + 1, turn * 200 + 201, 2)))
        for end in ends:
            end.close()

    def unread_answers(self):
        """Streams of health that nobody follows, and answers that nobody takes."""
        path = self.rng.choice([WATCH, SERVER_INFO])
        ends = self.together(20)
        self.of_each(ends, lambda turn: (http2.greeting(NO_WINDOW) if turn == 0 else b"") + b"".join(
            http2.call(stream, path) + http2.frame(http2.DATA, 1, stream, bytes(5))
            for stream in range(turn * 100 + 1, turn * 100 + 101, 2)))
        self.over.wait(self.rng.random() * DEAF_S)
        for end in ends:
            end.close()

    def unfinished_messages(self):
        """Messages as large as are taken, all but their last byte."""
        ends, size = self.together(8), 1 << 20
        begin = http2.message(1, bytes(size), compressed=False)[:-1]
        for end in ends:
            try:
                end.settimeout(FLOOD_S)
                end.sendall(http2.greeting() + b"".join(
                    http2.call(stream, COMPENSATE) for stream in range(1, 64, 2)) + begin)
            except OSError:
                pass
        self.over.wait(self.rng.random() * DEAF_S)
        for end in ends:
            end.close()

    def half_handshake(self):
        """Begins TLS and says no more."""
        for _ in range(10):
            end = self.connect(self.rng.choice([self.server.port, self.server.http]))
            self.held.append(end)
            end.sendall(b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + self.rng.randbytes(self.rng.randrange(200)))

    def deaf(self):
        """A client that has asked, and stands still with its connection open."""
        case = self.rng.choice(self.cases)
        process = subprocess.Popen(case.line(self.trc, "compensate", self.server.port, self.authority),
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(self.rng.random())
        process.send_signal(signal.SIGSTOP)
        self.over.wait(DEAF_S)
        process.kill()
        process.wait()

    # --- at the port of HTTP --------------------------------------------------------------------

    def deaf_http(self):
        with open(self.rng.choice(self.cases).source, "rb") as file:
            text = file.read()
        with self.connect_tls(self.server.http, "http/1.1") as end:
            end.sendall(POST + b"Content-Length: %d\r\n\r\n" % len(text) + text)
            self.over.wait(DEAF_S)

    def endless_head(self):
        with self.connect_tls(self.server.http, "http/1.1") as end:
            end.sendall(POST)
            stop = time.monotonic() + FLOOD_S
            while time.monotonic() < stop:
                end.sendall(b"X-%d: %s\r\n" % (self.rng.randrange(10**9), b"x" * self.rng.choice([8, 4000])))

    def slow_head(self):
        with self.connect_tls(self.server.http, "http/1.1") as end:
            for byte in POST:
                end.sendall(bytes([byte]))
                if self.over.wait(0.1):
                    break

    def half_body(self):
        with self.connect_tls(self.server.http, "http/1.1") as end:
            end.sendall(POST + b"Content-Length: 1000000\r\n\r\n" + b"G1 X1\n" * self.rng.randrange(100000))
            self.over.wait(self.rng.random() * DEAF_S)
