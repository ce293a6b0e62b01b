"""The installed package sends its first input with the setup, without an answer between."""

import asyncio
import unittest
from concurrent import futures

import grpc

import trc
import trc.aio
from trc.v1 import trc_service_pb2

PROGRAM = "N10 G1 X10 F100\nM30\n"
PATH = trc.Path().left().line(10, 0).line(50).off().line(60, -20)
METHODS = ("CompensateProgram", "CompensatePath", "SurveyRadii")


class InputFirst:
    """A server that says nothing before the setup and the first input are there: who waits for
    `accepted` waits for ever."""

    def __init__(self):
        self.came = []
        self._server = grpc.server(futures.ThreadPoolExecutor(4))
        self._server.add_generic_rpc_handlers([grpc.method_handlers_generic_handler(
            "trc.v1.TrcService", {method: self._handler(method) for method in METHODS})])
        self.address = f"127.0.0.1:{self._server.add_insecure_port('127.0.0.1:0')}"
        self._server.start()

    def _handler(self, method):
        request = getattr(trc_service_pb2, f"{method}Request")
        response = getattr(trc_service_pb2, f"{method}Response")

        def answer(requests, _context):
            self.came = [next(requests).WhichOneof("request") for _ in range(2)]
            yield response(accepted={})
            yield response(summary={})

        return grpc.stream_stream_rpc_method_handler(
            answer, request.FromString, response.SerializeToString)

    def close(self):
        self._server.stop(None).wait()


class FirstInput(unittest.TestCase):
    def setUp(self):
        self.server = InputFirst()
        self.addCleanup(self.server.close)

    def comes_with_the_setup(self, name, call):
        """The deadline ends a call that waits."""
        with trc.Client(self.server.address, timeout=30) as client:
            call(client)
        self.assertEqual(self.server.came, ["setup", name])
        self.server.came = []

        async def awaited():
            async with trc.aio.Client(self.server.address, timeout=30) as client:
                await call(client)

        asyncio.run(awaited())
        self.assertEqual(self.server.came, ["setup", name])

    def test_text(self):
        self.comes_with_the_setup("text", lambda client: client.compensate(PROGRAM, radius=5))

    def test_blocks(self):
        self.comes_with_the_setup("columns", lambda client: client.compensate_path(PATH, radius=5))

    def test_of_a_survey(self):
        self.comes_with_the_setup("text", lambda client: client.survey_radii(PROGRAM, [5]))
        self.comes_with_the_setup("columns", lambda client: client.survey_radii(PATH, [5]))


if __name__ == "__main__":
    unittest.main()
