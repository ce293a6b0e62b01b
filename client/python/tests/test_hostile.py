"""The installed package in wrong and rough hands: TRC_TRCD names the program."""

import asyncio
import atexit
import gc
import multiprocessing
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from concurrent import futures
from pathlib import Path as File

import grpc
import numpy as np

import trc
import trc.aio
from trc import local, settings
from trc.v1 import setup_pb2, trc_service_pb2

POCKET = """%POCKET
N10 G17 G90 G0 X0 Y0
N20 G41 G1 X10 Y0 F800
N30 X50
N40 Y40
N50 G40 X0 Y60
M30
"""
NAN = np.nan
KINDS = [5, 1, 1, 1, 5, 1]
X = [NAN, 10, 50, NAN, NAN, 0]
Y = [NAN, 0, NAN, 40, NAN, 60]
SIDES = {0: "left", 4: "off"}


def wave(blocks):
    """A program that takes the server a while."""
    points = "".join(f"G1 X{2 + i * 0.5:.3f} Y{i % 2 * 0.05:.3f}\n" for i in range(blocks))
    return f"N10 G17 G90 G0 X0 Y0\nN20 G41 G1 X1 Y0 F900\n{points}G40 G1 Y-20\nM30\n"


def is_gone(pid):
    """Whether a process has ended, within a few seconds."""
    for _ in range(500):
        try:
            state = File(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except (FileNotFoundError, ProcessLookupError):
            return True
        if state == "Z":
            return True
        time.sleep(0.01)
    return False


class Server:
    """A trcd of the test's own."""

    def __init__(self, *settings):
        self._folder = tempfile.TemporaryDirectory()
        self.address = f"unix:{self._folder.name}/socket"
        log = File(self._folder.name, "log")
        with log.open("wb") as said:
            self.process = subprocess.Popen(
                [os.environ["TRC_TRCD"], "--listen", self.address, *settings],
                stdout=said, stderr=subprocess.DEVNULL)
        # On all addresses, not on the first one alone.
        while b'"event":"started"' not in log.read_bytes():
            assert self.process.poll() is None, "trcd has ended"
            time.sleep(0.01)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.process.kill()
        self.process.wait()
        self._folder.cleanup()

    def is_taken(self):
        """A stream that lies open: the function that ends it."""
        end = threading.Event()

        def requests():
            yield trc_service_pb2.CompensateProgramRequest(
                setup=setup_pb2.ProgramSetup()).SerializeToString()
            end.wait()

        channel = grpc.insecure_channel(self.address)
        call = channel.stream_stream("/trc.v1.TrcService/CompensateProgram")(requests())
        next(call)

        def give_up():
            end.set()
            call.cancel()
            channel.close()

        return give_up


class LosesItsStreams:
    """Answers a program with these parts and the summary, and then is lost, but for the last time."""

    def __init__(self, parts, times):
        self._parts, self._left = parts, times
        self._server = grpc.server(futures.ThreadPoolExecutor(4))
        handler = grpc.stream_stream_rpc_method_handler(
            self._answer, trc_service_pb2.CompensateProgramRequest.FromString,
            trc_service_pb2.CompensateProgramResponse.SerializeToString)
        self._server.add_generic_rpc_handlers([grpc.method_handlers_generic_handler(
            "trc.v1.TrcService", {"CompensateProgram": handler})])
        self.address = f"127.0.0.1:{self._server.add_insecure_port('127.0.0.1:0')}"

    def _answer(self, requests, context):
        response = trc_service_pb2.CompensateProgramResponse
        yield response(accepted={})
        for part in self._parts:
            yield response(nc_text=part)
        yield response(summary={})
        self._left -= 1
        if self._left > 0:
            context.abort(grpc.StatusCode.UNAVAILABLE, "lost")

    def __enter__(self):
        self._server.start()
        return self

    def __exit__(self, *error):
        self._server.stop(None).wait()


class WrongArguments(unittest.TestCase):
    def is_refused(self, kind, words, call, *arguments, **keywords):
        """The error is of the caller's making, and names what is wrong."""
        with self.assertRaisesRegex(kind, words):
            call(*arguments, **keywords)

    def test_program_of_another_type(self):
        for program in (None, 5, File("part.nc"), POCKET.splitlines(), trc.Path()):
            self.is_refused(TypeError, "text or bytes", trc.compensate, program, radius=5)
        self.is_refused(TypeError, "trc.Path", trc.compensate_path, POCKET, radius=5)
        for program in (bytearray(POCKET.encode()), memoryview(POCKET.encode())):
            self.assertEqual(trc.compensate(program, radius=5).text,
                             trc.compensate(POCKET, radius=5).text)

    def test_radius_that_is_none(self):
        for radius in ("5", "5,5", True, [5], np.array([5.0]), 5j):
            self.is_refused(TypeError, "tool_radius takes a number", trc.compensate, POCKET,
                            radius=radius)
        for radius in (NAN, np.inf, np.float32(NAN)):
            self.is_refused(ValueError, "finite", trc.compensate, POCKET, radius=radius)
        self.assertEqual(trc.compensate(POCKET, radius=np.float32(5)).text,
                         trc.compensate(POCKET, radius=5).text)

    def test_tools_without_a_radius(self):
        for tools in ({1: None}, {1: NAN}, {"1": 5}, "1:5", 7, [{"number": 1}], [{"nr": 1}], [1]):
            with self.subTest(tools=tools), self.assertRaises((TypeError, ValueError)):
                trc.compensate(POCKET, tools=tools)

    def test_words_that_an_enum_has_not(self):
        self.is_refused(ValueError, "transition takes G25, G26, LINEAR, CIRCULAR, not 'G27'",
                        trc.compensate, POCKET, radius=5, transition="G27")
        self.is_refused(TypeError, "True or False", trc.compensate, POCKET, radius=5,
                        remove_masked_blocks="no")
        self.is_refused(TypeError, "did you mean 'transition'", trc.compensate, POCKET, radius=5,
                        transitions="G26")
        self.is_refused(TypeError, "did you mean 'radius'", trc.compensate, POCKET, radiuss=5)

    def test_setting_under_two_names(self):
        two = {"radius": 5, "tool_radius": 4}
        nested = {"options": {"reverse": True}, "reverse": False}
        path = trc.Path().left().line(10, 0).line(50).off().line(60, -20)
        for given, words in (two, "radius and tool_radius"), (nested, r"reverse and options\["):
            for order in given, dict(reversed(given.items())):
                for call, *of in ((trc.compensate, POCKET), (trc.compensate_path, path),
                                  (trc.survey_radii, POCKET, [3]), (trc.survey_radii, path, [3])):
                    with self.subTest(call=call, given=order):
                        self.is_refused(TypeError, words, call, *of, **order)
        self.is_refused(TypeError, "subprograms.*and subprogram_files", trc.compensate, POCKET,
                        radius=5, dialect="FANUC", subprograms={"O7.nc": b"O7\nM99\n"},
                        subprogram_files={"O7.nc": b"O7\nG4\nM99\n"})

    def test_options_of_both_forms_are_joined(self):
        both = {"options": {"reverse": True}, "stretch_factor": 2}
        for order in both, dict(reversed(both.items())):
            self.assertEqual(settings.path_setup(order),
                             settings.path_setup({"reverse": True, "stretch_factor": 2}))
        self.assertEqual(trc.compensate(POCKET, radius=5, tool_radius=None).text,
                         trc.compensate(POCKET, radius=5).text)

    def test_computed_coordinate_that_is_no_number(self):
        self.is_refused(ValueError, "x is nan", trc.Path().left().line, NAN, 0)
        self.is_refused(ValueError, "i is inf", trc.Path().arc, 1, i=np.inf)
        for value in ("10", [1, 2], True, 1j):
            self.is_refused(TypeError, "y takes a number", trc.Path().line, 0, value)
        self.is_refused(TypeError, "takes text", trc.Path().text, 5)
        self.is_refused(TypeError, "no field of a command", trc.Path().left, foo=1)

    def test_block_that_is_refused_leaves_the_path_as_it_was(self):
        path = trc.Path().left()
        for wrong in (lambda: path.line(NAN), lambda: path.text(5), lambda: path.command(foo=1)):
            self.assertRaises((TypeError, ValueError), wrong)
        path.line(10, 0).line(50).line(y=40).off().line(0, 60)
        np.testing.assert_allclose(trc.compensate_path(path, radius=5).path.end[:, :2],
                                   [[10, 5], [45, 5], [45, 40], [0, 60]], atol=1e-9)

    def test_words_of_the_control_in_a_command(self):
        path = (trc.Path().left(selection_mode="G237", transition="G26").line(10, 0).line(50)
                .line(y=-40).off().line(20))
        origins = [block.origin for block in trc.compensate_path(path, radius=5).path]
        self.assertIn("TRANSITION", origins)

    def test_servers_that_are_none(self):
        for server in ("box", "box:99999", ":::", "http://127.0.0.1:1", "127.0.0.1", "a:1,b:2",
                       "127.0.0.1:1,[::1]:2"):
            with self.subTest(server=server), self.assertRaises(ValueError):
                trc.Client(server)
        self.is_refused(TypeError, "server", trc.Client, 5)
        self.is_refused(ValueError, "belong together", trc.Client, "box:1",
                        tls=trc.Tls(certificate=__file__))
        for timeout in (0, -1, NAN):
            self.is_refused(ValueError, "timeout", trc.Client, "box:1", timeout=timeout)
        self.is_refused(TypeError, "timeout", trc.Client, "box:1", timeout="1")

    def test_closed_client(self):
        client = trc.Client()
        client.close()
        self.is_refused(ValueError, "closed", client.compensate, POCKET, radius=5)
        self.is_refused(ValueError, "closed", client.info)


class Columns(unittest.TestCase):
    def assert_same(self, kinds, x, y):
        path = trc.Path.of_columns(kinds, x=x, y=y, commands=SIDES)
        np.testing.assert_allclose(trc.compensate_path(path, radius=5).path.end[:, :2],
                                   [[10, 5], [45, 5], [45, 40], [0, 60]], atol=1e-9)

    def test_of_any_layout(self):
        both = np.array([X, Y]).T
        self.assert_same(KINDS, both[:, 0], both[:, 1])
        self.assert_same(np.array(KINDS[::-1])[::-1], np.array(X[::-1])[::-1], Y)
        for kind in (np.float32, ">f8", np.longdouble):
            self.assert_same(np.array(KINDS, ">i4"), np.array(X, kind), np.array(Y, kind))

    def test_masked_values_are_not_there(self):
        x = np.ma.array([9, 10, 50, 9, 9, 0], mask=[1, 0, 0, 1, 1, 0])
        self.assert_same(KINDS, x, Y)

    def test_of_another_type_or_shape(self):
        for x in (np.array([X, X]).T, 5, np.array(X, complex), [str(x) for x in X], [True] * 6):
            with self.subTest(x=x), self.assertRaisesRegex((TypeError, ValueError), "column x"):
                trc.Path.of_columns(KINDS, x=x, y=Y, commands=SIDES)
        for kinds in ([5, 1, 1, 257, 5, 1], [5, 1, 1, -255, 5, 1], [5, 1, 1.5, 1, 5, 1],
                      np.array([KINDS, KINDS])):
            with self.subTest(kinds=kinds), self.assertRaisesRegex((TypeError, ValueError),
                                                                   "kinds"):
                trc.Path.of_columns(kinds, x=X, y=Y, commands=SIDES)
        for commands in ({0: "lft", 4: "off"}, {0: 7, 4: "off"}, {0: "left"}):
            with self.subTest(commands=commands), self.assertRaises((TypeError, ValueError)):
                trc.Path.of_columns(KINDS, x=X, y=Y, commands=commands)

    def test_infinite_values_reach_the_server_which_names_them(self):
        path = trc.Path.of_columns(KINDS, x=[NAN, np.inf, 50, NAN, NAN, 0], y=Y, commands=SIDES)
        with self.assertRaisesRegex(trc.TrcError, r"columns.x\[0\] is infinite"):
            trc.compensate_path(path, radius=5)


class Streams(unittest.TestCase):
    def test_parts_are_the_whole(self):
        text = wave(100_000)
        with trc.Client() as client:
            parts = list(client.stream(text, radius=0.2))
            whole = client.compensate(text, radius=0.2)
        self.assertGreater(len(parts), 3)
        self.assertEqual("".join(part.text for part in parts), whole.text)
        self.assertEqual([part for part in parts if part.summary is not None], parts[-1:])

    def test_parts_of_a_path_are_the_whole(self):
        count = 50_000
        path = trc.Path.of_columns(np.r_[5, np.ones(count, np.uint8), 5, 1],
                                   x=np.r_[NAN, np.arange(count) * 0.5, NAN, 0.0],
                                   y=np.r_[NAN, np.arange(count) % 2 * 0.05, NAN, -9.0],
                                   commands={0: "left", count + 1: "off"})
        with trc.Client() as client:
            parts = list(client.stream_path(path, radius=0.2))
            whole = client.compensate_path(path, radius=0.2).path
        np.testing.assert_array_equal(np.concatenate([part.path.end for part in parts]), whole.end)
        np.testing.assert_array_equal(np.concatenate([part.path.start for part in parts]),
                                      whole.start)

    def test_refusal_comes_out_of_the_iteration_behind_what_was_certain(self):
        told = []
        with trc.Client() as client, self.assertRaises(trc.TrcError) as caught:
            told.extend(client.stream("N10 G0 X5\nN20 X\n"))
        self.assertEqual(caught.exception.cause.line, 2)
        self.assertFalse(any(part.summary for part in told))

    def test_what_is_lost_behind_its_summary_comes_once(self):
        async def awaited(address):
            async with trc.aio.Client(address) as client:
                return [part async for part in client.stream(POCKET, radius=5)]

        def waited_for(address):
            with trc.Client(address) as client:
                return list(client.stream(POCKET, radius=5))

        for ask in (waited_for, lambda address: asyncio.run(awaited(address))):
            with LosesItsStreams([b"N10\n", b"N20\n"], times=2) as server:
                parts = ask(server.address)
            self.assertEqual("".join(part.text for part in parts), "N10\nN20\n")
            self.assertEqual([part for part in parts if part.summary is not None], parts[-1:])

    def test_dropped_stream_is_given_up(self):
        with Server("--max-streams", "1") as server, trc.Client(server.address) as client:
            stream = client.stream(wave(300_000), radius=0.2)
            self.assertTrue(next(stream).text)
            del stream
            gc.collect()
            # The one place is free again.
            self.assertTrue(client.compensate(POCKET, radius=5).text)

    def test_dropped_asyncio_stream_is_given_up(self):
        async def some_of_it():
            async with trc.aio.Client(server.address) as client:
                async for part in client.stream(wave(300_000), radius=0.2):
                    if part.text:
                        break
                return (await client.compensate(POCKET, radius=5)).text

        with Server("--max-streams", "1") as server:
            self.assertEqual(asyncio.run(some_of_it()), trc.compensate(POCKET, radius=5).text)

    def test_cancelled_task_gives_its_place_back(self):
        async def cancelled():
            async with trc.aio.Client(server.address) as client:
                at_work = asyncio.Event()

                async def read():
                    async for _ in client.stream(wave(300_000), radius=0.2):
                        at_work.set()

                task = asyncio.create_task(read())
                await at_work.wait()
                task.cancel()
                with self.assertRaises(asyncio.CancelledError):
                    await task
                return (await client.compensate(POCKET, radius=5)).text

        with Server("--max-streams", "1") as server:
            self.assertEqual(asyncio.run(cancelled()), trc.compensate(POCKET, radius=5).text)


class Servers(unittest.TestCase):
    def test_that_is_full_is_waited_for(self):
        with Server("--max-streams", "1") as server:
            give_up = server.is_taken()
            with self.assertRaises(trc.ServerError) as caught:
                trc.compensate(POCKET, server=server.address, radius=5, timeout=0.2)
            self.assertEqual(caught.exception.status, grpc.StatusCode.RESOURCE_EXHAUSTED)
            self.assertTrue(caught.exception.reason)
            self.assertGreater(caught.exception.retry_after, 0)
            threading.Timer(0.3, give_up).start()
            self.assertTrue(trc.compensate(POCKET, server=server.address, radius=5).text)

    def test_that_was_never_there_is_not(self):
        begin = time.monotonic()
        with self.assertRaises(trc.ServerError) as caught:
            trc.compensate(POCKET, server="unix:/nonexistent/socket", radius=5)
        self.assertEqual(caught.exception.status, grpc.StatusCode.UNAVAILABLE)
        self.assertLess(time.monotonic() - begin, 30)

    def test_that_is_killed_under_a_stream(self):
        with Server() as server, trc.Client(server.address, timeout=3) as client:
            stream = client.stream(wave(300_000), radius=0.2)
            next(stream)
            server.process.kill()
            with self.assertRaises(trc.ServerError):
                list(stream)

    def test_of_this_machine_that_was_killed_is_started_again(self):
        with trc.Client() as client:
            before = client.compensate(POCKET, radius=5).text
            os.kill(local._running._process.pid, signal.SIGKILL)
            self.assertTrue(is_gone(local._running._process.pid))
            self.assertEqual(client.compensate(POCKET, radius=5).text, before)

    def test_of_this_machine_that_was_killed_is_started_again_for_asyncio(self):
        async def twice():
            async with trc.aio.Client() as client:
                before = await client.compensate(POCKET, radius=5)
                os.kill(local._running._process.pid, signal.SIGKILL)
                self.assertTrue(is_gone(local._running._process.pid))
                return before, await client.compensate(POCKET, radius=5), await client.info()

        before, behind, info = asyncio.run(twice())
        self.assertEqual(behind.text, before.text)
        self.assertEqual(info.version, trc.__version__)

    def test_deadline(self):
        with self.assertRaises(trc.ServerError) as caught:
            trc.compensate(wave(300_000), radius=0.2, timeout=0.05)
        self.assertEqual(caught.exception.status, grpc.StatusCode.DEADLINE_EXCEEDED)

    def test_many_threads_and_two_servers(self):
        expected = trc.compensate(POCKET, radius=5).text
        wrong = []

        def work(client):
            for _ in range(20):
                if client.compensate(POCKET, radius=5).text != expected:
                    wrong.append(client)

        with Server() as a, Server() as b, trc.Client(a.address) as one, \
                trc.Client(b.address) as other:
            threads = [threading.Thread(target=work, args=(client,))
                       for client in (one, other) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        self.assertEqual(wrong, [])

    def test_encrypted_is_reached_with_its_certificate_alone(self):
        with tempfile.TemporaryDirectory() as folder, socket.socket() as free:
            for name in ("server", "other"):
                subprocess.run(
                    ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2",
                     "-subj", "/CN=localhost", "-addext", "subjectAltName=IP:127.0.0.1",
                     "-keyout", f"{folder}/{name}.key", "-out", f"{folder}/{name}.pem"],
                    check=True, capture_output=True)
            free.bind(("127.0.0.1", 0))
            address = "127.0.0.1:%d" % free.getsockname()[1]
            free.close()
            with Server("--listen", address, "--tls-cert-file", f"{folder}/server.pem",
                        "--tls-key-file", f"{folder}/server.key"):
                right = trc.Tls(ca=f"{folder}/server.pem")
                self.assertEqual(trc.compensate(POCKET, server=address, tls=right, radius=5).text,
                                 trc.compensate(POCKET, radius=5).text)
                for tls in (None, trc.Tls(ca=f"{folder}/other.pem"), trc.Tls()):
                    with self.subTest(tls=tls), self.assertRaises(trc.ServerError) as caught:
                        trc.compensate(POCKET, server=address, tls=tls, radius=5)
                    self.assertEqual(caught.exception.status, grpc.StatusCode.UNAVAILABLE)

    def test_nothing_is_left_open(self):
        trc.compensate(POCKET, radius=5)
        before = len(os.listdir("/proc/self/fd")), threading.active_count()
        for _ in range(30):
            trc.compensate(POCKET, radius=5)
            self.assertRaises(trc.TrcError, trc.compensate, "N10 X")
            self.assertRaises(trc.ServerError, trc.compensate, POCKET,
                              server="unix:/nonexistent/socket", timeout=0.01)
        gc.collect()
        for _ in range(500):
            after = len(os.listdir("/proc/self/fd")), threading.active_count()
            if after <= before:
                break
            time.sleep(0.01)
        self.assertLessEqual(after, before)


class Processes(unittest.TestCase):
    def test_forked_child_has_a_server_of_its_own_and_leaves_that_of_its_parent(self):
        expected = trc.compensate(POCKET, radius=5).text
        parents = local.address()

        def child(queue):
            queue.put((trc.compensate(POCKET, radius=5).text, local.address()))

        context = multiprocessing.get_context("fork")
        queue = context.Queue()
        process = context.Process(target=child, args=(queue,))
        process.start()
        text, address = queue.get(timeout=30)
        process.join(30)
        self.assertEqual(text, expected)
        self.assertNotEqual(address, parents)
        # A child that ends as a script does runs what was registered for the end.
        if (pid := os.fork()) == 0:
            atexit._run_exitfuncs()
            os._exit(0)
        os.waitpid(pid, 0)
        self.assertTrue(local.is_alive(parents))
        self.assertEqual(trc.compensate(POCKET, radius=5).text, expected)

    def test_server_ends_with_its_process_however_that_ends(self):
        for ending in ("os.kill(os.getpid(), signal.SIGKILL)", "os._exit(0)", "sys.exit(0)"):
            said = subprocess.run(
                [sys.executable, "-c",
                 "import os, signal, sys, trc\nfrom trc import local\n"
                 "trc.compensate('N10 G1 X1 F1\\n')\n"
                 f"print(local._running._process.pid, flush=True)\n{ending}"],
                capture_output=True, text=True).stdout
            self.assertTrue(is_gone(int(said)), ending)


if __name__ == "__main__":
    unittest.main()
