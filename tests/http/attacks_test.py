"""Who means harm over HTTP is bounded, and gRPC does not notice."""
import json
import math
import os
import random
import socket
import ssl
import subprocess
import tempfile
import threading
import time
import unittest

from server import BUILD, SQUARE, TOP, HalfSent, Server, trc

TEXT = {"Content-Type": "text/plain"}
TEXT_HEAD = b"Content-Type: text/plain\r\n"
HEAD = b"POST /v1/programs:compensate?tool_radius=5 HTTP/1.1\r\nHost: localhost\r\n"


def answer_to(server, request, timeout=20):
    """What comes until the server closes; empty when it says nothing."""
    with server.connect(timeout) as connection:
        try:
            connection.sendall(request)
            got = b""
            while True:
                piece = connection.recv(65536)
                if not piece:
                    return got
                got += piece
        except ConnectionError:
            return b""


def status_of(answer):
    return int(answer.split(b" ")[1]) if answer.startswith(b"HTTP/1.1 ") else 0


def mutated(request, dice):
    """The request with one to four changes somewhere."""
    changed = bytearray(request)
    for _ in range(dice.randint(1, 4)):
        at = dice.randrange(len(changed) + 1)
        piece = slice(at, at + dice.choice((1, 1, 2, 8, 64)))
        kind = dice.randrange(6)
        if kind == 0:
            changed[piece] = bytes(dice.randrange(256) for _ in range(dice.randint(1, 4)))
        elif kind == 1:
            del changed[piece]
        elif kind == 2:
            changed[at:at] = changed[piece] * dice.choice((1, 2, 50))
        elif kind == 3:
            changed[at:at] = dice.choice((b"\r\n", b"\n", b"\0", b" ", b":", b"%", b"&", b"18446744073709551616",
                                          b"-1", b"Transfer-Encoding: chunked\r\n", b"Content-Length: 7\r\n"))
        elif kind == 4:
            lines = bytes(changed).split(b"\r\n")
            dice.shuffle(lines)
            changed = bytearray(b"\r\n".join(lines))
        else:
            del changed[at:]
    return bytes(changed)


class Attacks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Server("--http-timeout-s", "2", "--http-max-connections", "64",
                            "--http-max-body-mib", "4", "--http-max-memory-mib", "16")

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def setUp(self):
        self.before = self.server.grpc_works()
        self.stream = HalfSent(self.server.grpc_address, SQUARE, "--set", "tool_radius=5")

    def tearDown(self):
        # A stream that was open all the time goes on as if nothing had been.
        self.assertEqual(self.stream.finish(), trc("compensate", "-", "--set", "tool_radius=5",
                                                   text=SQUARE.encode()))
        self.assertLess(self.server.grpc_works(), self.before + 5)
        self.assertEqual(self.server.ask("GET", "/v1/info")[0], 200)

    def test_what_is_no_http_is_refused(self):
        for request in (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"GET\r\n\r\n",
                        b"GET /v1/info HTTP/9.9\r\n\r\n", b"\r\n\r\n\x00\xff\r\n",
                        b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
                        b"GET * HTTP/1.1\r\nHost: localhost\r\n\r\n",
                        b"GET http:///v1/info HTTP/1.1\r\nHost: localhost\r\n\r\n",
                        b"GET http://localhost:x/v1/info HTTP/1.1\r\nHost: localhost\r\n\r\n",
                        b"GET http://a@localhost/v1/info HTTP/1.1\r\nHost: localhost\r\n\r\n",
                        b"CONNECT localhost:80 HTTP/1.1\r\nHost: localhost\r\n\r\n",
                        b"GET /%zz HTTP/1.1\r\nHost: localhost\r\n\r\n",
                        b"GET /a\x01b HTTP/1.1\r\nHost: localhost\r\n\r\n"):
            self.assertIn(status_of(answer_to(self.server, request)), (0, 400, 404, 505), request)

    def test_the_host_of_an_absolute_target_is_the_one_that_counts(self):
        info = b"/v1/info HTTP/1.1\r\nConnection: close\r\nHost: %s\r\n"
        port = str(self.server.port).encode()
        for target, host, status in ((b"http://127.0.0.1:" + port, b"evil.example", 200),
                                     (b"HTTP://LOCALHOST:" + port, b"localhost", 200),
                                     (b"http://[::1]", b"localhost", 200),
                                     (b"http://evil.example", b"localhost", 421),
                                     (b"http://127.0.0.1.evil.example", b"localhost", 421),
                                     (b"https://localhost", b"localhost", 421),
                                     (b"ftp://localhost", b"localhost", 421)):
            answer = answer_to(self.server, b"GET " + target + info % host + b"\r\n")
            self.assertEqual(status_of(answer), status, target)
        # An origin is that of the page when it is that of the target.
        for origin, status in ((b"http://localhost:" + port, 200), (b"http://evil.example", 403)):
            answer = answer_to(self.server, b"GET http://localhost:" + port + info % b"evil.example" +
                               b"Origin: " + origin + b"\r\n\r\n")
            self.assertEqual(status_of(answer), status, origin)
        answer = answer_to(self.server, b"GET http://localhost/v1/info HTTP/1.1\r\n\r\n")
        self.assertEqual(status_of(answer), 400)

    def test_an_end_of_the_connection_is_no_end_of_an_answer(self):
        answer = answer_to(self.server, b"GET /v1/info HTTP/1.0\r\nHost: localhost\r\n\r\n")
        self.assertEqual(status_of(answer), 505)

    def test_two_lengths_are_refused(self):
        for lengths in (b"Content-Length: 3\r\nContent-Length: 4\r\n",
                        b"Content-Length: 3\r\nTransfer-Encoding: chunked\r\n",
                        b"Content-Length: -1\r\n", b"Content-Length: 99999999999999999999\r\n"):
            answer = answer_to(self.server, HEAD + lengths + b"\r\nabc")
            self.assertIn(status_of(answer), (0, 400, 413), lengths)

    def test_no_request_hides_in_the_body_of_another(self):
        # What follows would be answered as a request of its own: 404.
        hidden = b"GET /hidden HTTP/1.1\r\nHost: localhost\r\n\r\n"
        chunks = b"%x\r\n%s\r\n0\r\n\r\n" % (len(hidden), hidden)
        length = b"Content-Length: %d\r\n" % len(chunks)
        for headers in (b"Transfer-Encoding: xchunked\r\n", b"Transfer-Encoding: identity\r\n",
                        b"Transfer-Encoding: chunked, chunked\r\n",
                        b"Transfer-Encoding: gzip, chunked\r\n",
                        b"Transfer-Encoding: chunked\r\nTransfer-Encoding: identity\r\n",
                        b"Transfer-Encoding: chunked\r\n" + length,
                        length + b"Transfer-Encoding: chunked\r\n",
                        b"Transfer-Encoding : chunked\r\n", length + length,
                        b"Transfer-Encoding:\r\n", b"Transfer-Encoding: \r\n" + length,
                        b"Transfer-Encoding:\r\n chunked\r\n", b"X: y\r\n " + length,
                        length + b"X: y\r\n\tz\r\n", b"X:\r\n y\r\n" + length,
                        b"Content-Length: %d, %d\r\n" % (len(chunks), len(chunks)),
                        b"X: y\nTransfer-Encoding: chunked\r\n"):
            answer = answer_to(self.server, HEAD + TEXT_HEAD + headers + b"\r\n" + chunks)
            self.assertIn(status_of(answer), (400, 501), headers)
            self.assertEqual(answer.count(b"HTTP/1.1 "), 1, headers)

    def test_a_head_says_one_thing(self):
        get = b"GET /v1/info HTTP/1.1\r\n"
        for head, status in ((get, 400), (get + b"Host:\r\n", 400),
                             (get + b"Host: localhost\r\nHost: evil.example\r\n", 400),
                             (get + b"Host: evil.example\r\nHost: localhost\r\n", 400),
                             (HEAD + TEXT_HEAD + b"Content-Type: application/json\r\n", 400),
                             (HEAD + b"Origin: http://localhost\r\nOrigin: http://localhost\r\n", 400),
                             (get + b"Host: localhost\r\n .evil.example\r\n", 400),
                             (get + b"Host: localhost\r\nAccept: text/plain,\r\n\ttext/html\r\n", 400),
                             (HEAD + TEXT_HEAD + b"Expect: miracles\r\n", 417)):
            self.assertEqual(status_of(answer_to(self.server, head + b"\r\n")), status, head)

    def test_requests_one_behind_the_other_are_answered_in_their_order(self):
        body = SQUARE.encode()
        post = HEAD + TEXT_HEAD + b"Content-Length: %d\r\n\r\n" % len(body) + body
        get = b"GET /nothing HTTP/1.1\r\nHost: localhost\r\nConnection: %s\r\n\r\n"
        answer = answer_to(self.server, post + get % b"keep-alive" + post + get % b"close")
        statuses = [part[:3] for part in answer.split(b"HTTP/1.1 ")[1:]]
        self.assertEqual(statuses, [b"200", b"404", b"200", b"404"])

    def test_what_is_no_http_ends_the_connection_behind_a_request_too(self):
        get = b"GET /v1/info HTTP/1.1\r\nHost: localhost\r\n\r\n"
        for nonsense in (b"nonsense\r\n\r\n", get[:-2] + b"X: " + b"a" * 40_000):
            answer = answer_to(self.server, get + nonsense + get)
            statuses = [part[:3] for part in answer.split(b"HTTP/1.1 ")[1:]]
            self.assertEqual((statuses[0], len(statuses)), (b"200", 2), statuses)

    def test_changed_requests_never_make_the_server_fail(self):
        body = SQUARE.encode()
        path = json.dumps({"setup": {"toolRadius": 5}, "batch": {"blocks": [
            {"linear": {"end": {"x": 10, "y": 0}}}]}}).encode()
        sized = b"Content-Length: %d\r\n\r\n%s"
        where = b" HTTP/1.1\r\nHost: localhost\r\n"
        requests = [
            HEAD + TEXT_HEAD + sized % (len(body), body),
            HEAD + TEXT_HEAD + b"Transfer-Encoding: chunked\r\n\r\n%x\r\n%s\r\n0\r\n\r\n" % (len(body), body),
            b"POST /v1/views?tool_radius=5&name=a%20b&shown_plane=zx" + where + TEXT_HEAD +
            sized % (len(body), body),
            b"POST /v1/paths:compensate" + where + b"Accept: application/x-ndjson;q=0.5\r\n"
            b"Content-Type: application/json; charset=utf-8\r\n" + sized % (len(path), path),
            b"POST /trc.v1.TrcService/PreviewPath" + where + b"Connect-Timeout-Ms: 1000\r\n"
            b"Content-Type: application/connect+json\r\n" +
            sized % (len(path) + 5, b"\0" + len(path).to_bytes(4, "big") + path),
            b"GET /v1/views/0/lines?from=1&count=7" + where + b"Origin: null\r\n\r\n"]
        seed = int(os.environ.get("TRC_SEED", "20260"))
        dice = random.Random(seed)
        for i in range(3000 if os.environ.get("TRC_TEST_LONG") else 300):
            request = mutated(dice.choice(requests), dice)
            with self.server.connect(10) as connection:
                got = b""
                try:
                    connection.sendall(request)
                    connection.shutdown(socket.SHUT_WR)
                    while piece := connection.recv(65536):
                        got += piece
                except ConnectionError:
                    pass
            failed = [part[:3] for part in got.split(b"HTTP/1.1 ")[1:] if part.startswith(b"500")]
            self.assertEqual(failed, [], f"seed {seed}, request {i}: {request}")

    def test_a_name_that_begins_like_this_machine_is_another_one(self):
        for host in (b"127.0.0.1.evil.example", b"127.evil.example", b"localhost.evil.example",
                     b"[::1", b"[::1]evil", b"[::1].evil.example", b"localhost:80@evil.example",
                     b"localhost:evil", b"localhost@evil.example", b"127.0.0.1:80/evil"):
            request = b"GET /v1/info HTTP/1.1\r\nConnection: close\r\nHost: " + host + b"\r\n\r\n"
            answer = answer_to(self.server, request)
            self.assertEqual(status_of(answer), 421, host)
            self.assertIn(b"http-listen has to be an address that other machines can reach", answer)

    def test_a_flood_of_parameters_costs_no_more_than_one(self):
        # The threads that move bytes read them: what takes long there holds up everybody.
        for query in ("&".join(f"b{i}" for i in range(2500)), "a&" * 7900, "b" * 16000,
                      "&".join(f"tool_radi{i}=1" for i in range(250))):
            for path in ("/v1/programs:compensate?", "/v1/info?"):
                begin = time.monotonic()
                method = "GET" if path == "/v1/info?" else "POST"
                status, problem = self.server.ask_json(method, path + query)
                self.assertLess(time.monotonic() - begin, 1, query[:20])
                self.assertEqual(status, 400)
                self.assertLessEqual(len(problem.get("fields", [])), 20)

    def test_json_of_many_small_things_is_refused_before_it_is_read(self):
        json_type = {"Content-Type": "application/json"}
        for many in ("{}," * 1_300_000 + "{}", "{" + '"linear":{},' * 300_000 + "}"):
            body = '{"batch":{"blocks":[' + many + "]}}"
            begin = time.monotonic()
            status, problem = self.server.ask_json("POST", "/v1/paths:compensate", body, json_type)
            self.assertLess(time.monotonic() - begin, 2)
            self.assertEqual((status, problem["reason"]), (413, "BATCH_TOO_LARGE"))
            self.assertIn("divide the path", problem["detail"])
            status, error = self.server.ask_json("POST", "/trc.v1.TrcService/CompensateProgramOnce",
                                                 body, json_type)
            self.assertEqual((status, error["code"]), (429, "resource_exhausted"))
        # Letters in texts count for nothing.
        body = json.dumps({"setup": {"path": {"toolRadius": 5}}, "text": '; (,{["\n' * 50_000 + SQUARE})
        status, _ = self.server.ask_json("POST", "/trc.v1.TrcService/CompensateProgramOnce", body,
                                         json_type)
        self.assertEqual(status, 200)

    def test_a_flood_of_header_is_refused(self):
        self.assertEqual(status_of(answer_to(self.server, HEAD + b"X: " + b"a" * 40000)), 431)
        many = b"".join(b"X-%d: 1\r\n" % i for i in range(5000))
        self.assertEqual(status_of(answer_to(self.server, HEAD + many)), 431)

    def test_a_trailer_is_bounded_as_a_head_is(self):
        chunks = b"Transfer-Encoding: chunked\r\n\r\n%x\r\n%s\r\n0\r\n" % (len(SQUARE), SQUARE.encode())
        request = HEAD + TEXT_HEAD + chunks
        for trailer, status in ((b"X: y\r\n", 200), (b"X: " + b"y" * 16_000 + b"\r\n", 200),
                                (b"X: " + b"y" * 17_000 + b"\r\n", 431),
                                (b"X: " + b"y" * 66_000 + b"\r\n", 431),
                                (b"X" * 66_000 + b": y\r\n", 431), (b"X: y\r\n" * 3000, 431),
                                (b"X: " + b"y" * 200_000 + b"\r\n", 431),
                                (b"X: y\r\n z\r\n", 400),
                                (b"Transfer-Encoding: chunked\r\n", 400), (b"no field\r\n", 400)):
            with self.server.connect() as connection:
                connection.sendall(request + trailer + b"\r\n")
                self.assertEqual(status_of(connection.recv(65536)), status, trailer[:20])
                if status != 200:
                    connection.settimeout(10)
                    while connection.recv(65536):
                        pass

    def test_bodies_are_bounded(self):
        length = b"Content-Length: %d\r\n\r\n" % (5 << 20)
        self.assertEqual(status_of(answer_to(self.server, HEAD + length)), 413)
        chunk = b"10000\r\n" + b"a" * 65536 + b"\r\n"
        chunks = HEAD + b"Transfer-Encoding: chunked\r\n\r\n" + chunk * 80
        self.assertEqual(status_of(answer_to(self.server, chunks)), 413)
        # Refused when they are announced, not when they have come.
        for announced in (b"FFFFFFFFFFFFFFFF", b"7FFFFFFFFFFFFFFF", b"%x" % ((4 << 20) + 1),
                          b"1\r\na\r\n%x" % (4 << 20)):
            begin = time.monotonic()
            answer = answer_to(self.server, HEAD + b"Transfer-Encoding: chunked\r\n\r\n" +
                               announced + b"\r\nN10 G01")
            self.assertEqual(status_of(answer), 413, announced)
            self.assertIn(b"BODY_TOO_LARGE", answer)
        packed = b"Content-Encoding: gzip\r\nContent-Length: 20\r\n\r\n" + b"\x1f\x8b" * 10
        self.assertEqual(status_of(answer_to(self.server, HEAD + packed)), 415)

    def test_json_as_deep_as_can_be_is_refused(self):
        for deep in ('{"setup":' * 20000 + "{}" + "}" * 20000, "[" * 100_000, '{"setup":' * 100_000):
            status, problem = self.server.ask_json("POST", "/v1/paths:compensate", deep,
                                                   {"Content-Type": "application/json"})
            self.assertEqual((status, problem["reason"]), (400, "JSON_INVALID"), deep[:20])

    def test_memory_is_bounded_by_all_bodies_together(self):
        length = b"Content-Length: %d\r\n\r\n" % (4 << 20)
        held = [self.server.connect() for _ in range(4)]
        for connection in held:
            connection.sendall(HEAD + length)
        time.sleep(0.3)
        answer = answer_to(self.server, HEAD + length)
        self.assertEqual(status_of(answer), 503)
        self.assertIn(b"http-max-memory-mib", answer)
        for connection in held:
            connection.close()
        time.sleep(0.3)

    def test_a_byte_now_and_then_ends_the_connection(self):
        begin = time.monotonic()
        with self.server.connect() as connection:
            with self.assertRaises(OSError):
                for byte in HEAD * 20:
                    connection.sendall(bytes([byte]))
                    time.sleep(0.2)
                    connection.setblocking(False)
                    try:
                        if connection.recv(1) == b"":
                            raise ConnectionError
                    except BlockingIOError:
                        pass
                    connection.setblocking(True)
        self.assertLess(time.monotonic() - begin, 8)
        # A body that comes byte by byte is waited for no longer than such a head.
        begin = time.monotonic()
        with self.server.connect() as connection:
            connection.sendall(HEAD + b"Content-Length: 100000\r\n\r\n")
            with self.assertRaises(OSError):
                while True:
                    connection.sendall(b"a")
                    time.sleep(0.2)
                    connection.setblocking(False)
                    try:
                        if connection.recv(1) == b"":
                            raise ConnectionError
                    except BlockingIOError:
                        pass
                    connection.setblocking(True)
        self.assertLess(time.monotonic() - begin, 8)

    def test_who_does_not_read_holds_back_only_himself(self):
        text = SQUARE.replace("N80 M30", "\n".join(f"G01 X{i % 90} Y{i % 70}" for i in range(150000)))
        request = HEAD + TEXT_HEAD + b"Content-Length: %d\r\n\r\n" % len(text) + text.encode()
        slow = []
        for _ in range(3):
            connection = socket.socket()
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            connection.settimeout(20)
            connection.connect(("127.0.0.1", self.server.port))
            connection.sendall(request)
            slow.append(connection)
        ports = [connection.getsockname()[1] for connection in slow]
        time.sleep(1)
        self.assertLess(self.server.grpc_works(), self.before + 5)
        time.sleep(4)
        # By now they have been given up: what is left in the pipe is not a whole answer.
        for connection in slow:
            got = b""
            try:
                while True:
                    piece = connection.recv(1 << 20)
                    if not piece:
                        break
                    got += piece
            except OSError:
                pass
            self.assertFalse(got.endswith(b"0\r\n\r\n") or b"Trc-Status: OK" in got)
            connection.close()
        # One line each, which says so.
        peers = {f"127.0.0.1:{connection_port}" for connection_port in ports}
        self.server.said_soon(r'"event":"http".*"ended":"broken_off"')
        time.sleep(1)
        lines = [json.loads(line) for line in self.server.said().splitlines()
                 if '"event":"http"' in line]
        ended = [line.get("ended") for line in lines if line["peer"] in peers]
        self.assertEqual(ended, ["broken_off"] * 3)

    def test_a_thousand_idle_connections(self):
        idle = []
        try:
            for _ in range(1000):
                idle.append(self.server.connect())
            self.assertLess(self.server.grpc_works(), self.before + 5)
            # Those who wait longest make room.
            self.assertEqual(self.server.ask("GET", "/v1/info")[0], 200)
        finally:
            for connection in idle:
                connection.close()

    def test_who_was_refused_holds_no_place(self):
        refused = [self.server.connect() for _ in range(64)]
        try:
            for connection in refused:
                connection.sendall(b"nonsense\r\n\r\n")
            for connection in refused:
                self.assertTrue(connection.recv(1))
            self.assertEqual(self.server.ask("GET", "/v1/info")[0], 200)
        finally:
            for connection in refused:
                connection.close()

    def test_clients_that_go_away_leave_nothing_behind(self):
        text = SQUARE.replace("N80 M30", "\n".join(f"G01 X{i % 90} Y{i % 70}" for i in range(50000)))
        request = HEAD + TEXT_HEAD + b"Content-Length: %d\r\n\r\n" % len(text) + text.encode()

        def leave():
            with self.server.connect() as connection:
                connection.sendall(request)
                time.sleep(0.01)
        threads = [threading.Thread(target=leave) for _ in range(12)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        time.sleep(1)
        # The memory of all of them has been given back: four such bodies fit at once.
        status, _, _ = self.server.ask("POST", "/v1/programs:compensate?tool_radius=5",
                                       SQUARE + "\n" * (3 << 20), TEXT)
        self.assertEqual(status, 200)

    def test_views_give_way_to_new_ones(self):
        lines = "\n".join(f"G01 X{i % 90} Y{i % 70}" for i in range(20000))
        views = [self.server.ask_json("POST", "/v1/views", lines, TEXT) for _ in range(12)]
        self.assertEqual({status for status, _ in views}, {201})
        self.assertEqual(self.server.ask("GET", "/v1/views/" + views[0][1]["id"])[0], 404)
        self.assertEqual(self.server.ask("GET", "/v1/views/" + views[-1][1]["id"])[0], 200)
        for _, view in views:
            self.server.ask("DELETE", "/v1/views/" + view["id"])

    def test_views_nobody_asks_for_leave_room_for_bodies(self):
        lines = "\n".join(f"G01 X{i % 90} Y{i % 70}" for i in range(20000))
        views = [self.server.ask_json("POST", "/v1/views", lines, TEXT)[1] for _ in range(4)]
        status, _, _ = self.server.ask("POST", "/v1/programs:compensate?tool_radius=5",
                                       SQUARE + "\n" * (3 << 20), TEXT)
        self.assertEqual(status, 200)
        for view in views:
            self.server.ask("DELETE", "/v1/views/" + view["id"])

    def test_memory_stays(self):
        self.assertLess(self.server.resident_mib(), 400)


class Peers(unittest.TestCase):
    """One address leaves a share to the others."""
    INFO = b"GET /v1/info HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"

    @staticmethod
    def begun(server, length=10):
        """A request of which the body does not come."""
        connection = server.connect()
        connection.sendall(HEAD + b"Expect: 100-continue\r\nContent-Length: %d\r\n\r\n" % length)
        return connection, connection.recv(4096)

    @staticmethod
    def from_another(server, request):
        with socket.create_connection(("127.0.0.1", server.port), timeout=20,
                                      source_address=("127.0.0.2", 0)) as connection:
            connection.sendall(request)
            got = b""
            while piece := connection.recv(65536):
                got += piece
            return got

    def test_connections_at_work_leave_room_for_others(self):
        with Server("--http-max-connections", "8", "--http-max-connections-per-peer", "6") as server:
            held = [self.begun(server) for _ in range(6)]
            try:
                self.assertEqual({said[:12] for _, said in held}, {b"HTTP/1.1 100"})
                # One more of the same address is closed, and the log says why.
                with server.connect() as connection:
                    self.assertEqual(connection.recv(1), b"")
                closed = '"connection_closed".*"http_connections_of_peer"'
                self.assertRegex(server.said_soon(closed), closed)
                self.assertEqual(status_of(self.from_another(server, self.INFO)), 200)
            finally:
                for connection, _ in held:
                    connection.close()

    def test_those_that_wait_make_room_for_their_own(self):
        with Server("--http-max-connections", "8", "--http-max-connections-per-peer", "2") as server:
            # The other's waits longest, and stays.
            other = socket.create_connection(("127.0.0.1", server.port), timeout=20,
                                             source_address=("127.0.0.2", 0))
            time.sleep(0.2)
            own = [server.connect() for _ in range(2)]
            time.sleep(0.2)
            self.assertEqual(server.ask("GET", "/v1/info")[0], 200)
            self.assertEqual(own[0].recv(1), b"")
            other.sendall(self.INFO)
            self.assertEqual(status_of(other.recv(16)), 200)
            for connection in (other, *own):
                connection.close()

    def test_bodies_leave_memory_for_others(self):
        with Server("--http-max-memory-mib", "16", "--http-max-memory-per-peer-mib", "12") as server:
            held = [self.begun(server, 4 << 20) for _ in range(3)]
            try:
                self.assertEqual({said[:12] for _, said in held}, {b"HTTP/1.1 100"})
                refused = HEAD + b"Content-Length: %d\r\n\r\n" % (4 << 20)
                answer = answer_to(server, refused)
                self.assertEqual(status_of(answer), 503)
                self.assertIn(b"http-max-memory-per-peer-mib", answer)
                text = SQUARE.encode() + b"\n" * (3 << 20)
                answer = self.from_another(server, HEAD + TEXT_HEAD + b"Connection: close\r\n" +
                                           b"Content-Length: %d\r\n\r\n" % len(text) + text)
                self.assertEqual(status_of(answer), 200)
            finally:
                for connection, _ in held:
                    connection.close()

    def test_where_only_this_machine_gets_in_nothing_is_kept_for_others(self):
        with Server("--http-max-connections", "8") as server:
            held = [self.begun(server) for _ in range(8)]
            self.assertEqual({said[:12] for _, said in held}, {b"HTTP/1.1 100"})
            for connection, _ in held:
                connection.close()


class Idle(unittest.TestCase):
    def test_a_thousand_that_are_kept_take_little(self):
        with Server("--http-max-connections", "1100") as server:
            server.ask("GET", "/v1/info")
            before, resident = server.grpc_works(), server.resident_mib()
            idle = [server.connect() for _ in range(1000)]
            try:
                for connection in idle:
                    connection.sendall(b"GET /v1/info HTTP/1.1\r\nHost: localhost\r\n\r\n")
                for connection in idle:
                    self.assertTrue(connection.recv(16).startswith(b"HTTP/1.1 200"))
                self.assertLess(server.grpc_works(), before + 5)
                self.assertLess(server.resident_mib(), resident + 100)
            finally:
                for connection in idle:
                    connection.close()


class Views(unittest.TestCase):
    def test_what_nobody_looks_at_any_more_is_not_measured(self):
        # A hole hardly larger than the tool, where each block is near to many.
        count = 400_000
        radius = 5.001
        wall = [f"G01 X{radius * math.cos(2 * math.pi * i / count):.10f} "
                f"Y{radius * math.sin(2 * math.pi * i / count):.10f}" for i in range(count + 1)]
        text = "\n".join(["G00 X0 Y0", f"G41 G01 X{radius} Y0 F500", *wall, "G40 G01 X0 Y0", "M30", ""])

        def cpu_seconds(server):
            with open(f"/proc/{server.process.pid}/stat", encoding="ascii") as stat:
                fields = stat.read().rsplit(")", 1)[1].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

        with Server() as server:
            status, view = server.ask_json("POST", "/v1/views?tool_radius=5", text, TEXT)
            self.assertEqual((status, view.get("measuring")), (201, True), view)
            at = "/v1/views/" + view["id"]
            self.assertEqual(server.ask("DELETE", at)[0], 204)
            time.sleep(0.3)
            before = cpu_seconds(server)
            time.sleep(2)
            self.assertLess(cpu_seconds(server) - before, 0.5)


class Tls(unittest.TestCase):
    FOLDER = os.path.join(TOP, "tests/server/certificates")

    def flags(self, *more):
        return ["--tls-cert-file", self.FOLDER + "/server_cert.pem", "--tls-key-file",
                self.FOLDER + "/server_key.pem", *more]

    def get(self, server, with_certificate=False):
        context = ssl.create_default_context(cafile=self.FOLDER + "/ca_cert.pem")
        context.check_hostname = False
        if with_certificate:
            context.load_cert_chain(self.FOLDER + "/client_cert.pem",
                                    self.FOLDER + "/client_key.pem")
        with context.wrap_socket(server.connect()) as connection:
            connection.sendall(b"GET /v1/info HTTP/1.1\r\nHost: localhost\r\n"
                               b"Connection: close\r\n\r\n")
            got = b""
            while piece := connection.recv(65536):
                got += piece
            return got

    def test_tls_is_spoken_where_there_is_a_certificate(self):
        with Server(*self.flags()) as server:
            self.assertEqual(status_of(self.get(server)), 200)
            self.assertEqual(status_of(answer_to(server, b"GET / HTTP/1.1\r\n\r\n")), 0)

    def test_clients_need_a_certificate_where_authorities_are_named(self):
        authority = ["--tls-client-ca-file", self.FOLDER + "/ca_cert.pem"]
        with Server(*self.flags(*authority)) as server:
            self.assertEqual(status_of(self.get(server, with_certificate=True)), 200)
            with self.assertRaises(OSError):
                self.get(server)
        with Server(*self.flags(*authority, "--tls-allowed-clients", "somebody.else")) as server:
            answer = self.get(server, with_certificate=True)
            self.assertEqual(status_of(answer), 403)
            self.assertEqual(json.loads(answer.partition(b"\r\n\r\n")[2])["reason"],
                             "CLIENT_NOT_ALLOWED")

    def made(self, folder, name, extension, issuer=None):
        """A certificate with its key in one file, of its own or of an issuer."""
        file = f"{folder}/{name}.pem"
        command = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                   "ec_paramgen_curve:P-256", "-nodes", "-days", "2", "-subj", "/CN=" + name,
                   "-addext", "basicConstraints=critical," + extension, "-keyout", file + ".key",
                   "-out", file + ".crt"]
        if issuer:
            command += ["-CA", issuer + ".crt", "-CAkey", issuer + ".key"]
        subprocess.run(command, check=True, capture_output=True, timeout=60)
        return file

    def served(self, server, client):
        """Over HTTP and over gRPC."""
        context = ssl.create_default_context(cafile=self.FOLDER + "/ca_cert.pem")
        context.check_hostname = False
        context.load_cert_chain(client + ".crt", client + ".key")
        try:
            with context.wrap_socket(server.connect()) as connection:
                connection.sendall(b"GET /v1/info HTTP/1.1\r\nHost: localhost\r\n"
                                   b"Connection: close\r\n\r\n")
                over_http = status_of(connection.recv(65536)) == 200
        except OSError:
            over_http = False
        info = subprocess.run(
            [BUILD + "/bin/trc", "info", "--server", server.grpc_address, "--tls-ca",
             self.FOLDER + "/ca_cert.pem", "--tls-cert", client + ".crt", "--tls-key",
             client + ".key"], capture_output=True, timeout=60, check=False)
        return over_http, info.returncode == 0

    def test_what_vouches_for_clients_is_trusted_as_it_stands(self):  # D-165
        with tempfile.TemporaryDirectory() as folder:
            root = self.made(folder, "root", "CA:TRUE")
            between = self.made(folder, "between", "CA:TRUE", root)
            pinned = self.made(folder, "pinned", "CA:FALSE")
            clients = {name: self.made(folder, name, "CA:FALSE", issuer) for name, issuer in (
                ("of_root", root), ("of_between", between), ("of_pinned", pinned))}
            for authority, served in ((between, {"of_between"}), (clients["of_root"], {"of_root"}),
                                      (pinned, {"pinned"})):
                flags = self.flags("--tls-client-ca-file", authority + ".crt")
                with Server(*flags) as server:
                    for name, client in {**clients, "pinned": pinned}.items():
                        self.assertEqual(self.served(server, client), (name in served,) * 2,
                                         (authority, name))

    def test_plain_text_for_other_machines_must_be_allowed(self):
        done = subprocess.run([BUILD + "/bin/trcd", "--listen", "127.0.0.1:0", "--http-listen", "0.0.0.0:0"],
                              capture_output=True, timeout=30, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn(b"insecure-http", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
