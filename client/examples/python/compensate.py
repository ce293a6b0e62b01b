#!/usr/bin/python3
"""compensate.py ADDRESS FILE: the program with TRC resolved on standard output, diagnostics on
standard error.

With Debian's python3-grpcio and python3-protobuf. The modules are generated from the protos:

    protoc -I proto --python_out=OUT --grpc_python_out=OUT \\
        --plugin=protoc-gen-grpc_python="$(command -v grpc_python_plugin)" proto/trc/v1/*.proto
    PYTHONPATH=OUT client/examples/python/compensate.py 127.0.0.1:50051 part.nc
"""

import sys

import grpc
from trc.v1 import setup_pb2, trc_service_pb2, trc_service_pb2_grpc

CHUNK = 64 * 1024


def requests(text):
    """The setup, then the program in pieces; the last one says that nothing follows."""
    yield trc_service_pb2.CompensateProgramRequest(setup=setup_pb2.ProgramSetup())
    for first in range(0, len(text), CHUNK):
        piece = text[first : first + CHUNK]
        yield trc_service_pb2.CompensateProgramRequest(
            text=trc_service_pb2.ProgramText(first_byte=first, text=piece))
    yield trc_service_pb2.CompensateProgramRequest(
        text=trc_service_pb2.ProgramText(first_byte=len(text), final=True))


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: compensate.py ADDRESS FILE")
    with open(sys.argv[2], "rb") as file:
        text = file.read()
    with grpc.insecure_channel(sys.argv[1]) as channel:
        stub = trc_service_pb2_grpc.TrcServiceStub(channel)
        try:
            for response in stub.CompensateProgram(requests(text)):
                sys.stdout.buffer.write(response.nc_text)
                for raised in response.diagnostics:
                    print(f"line {raised.line}: {raised.code} {raised.message}", file=sys.stderr)
        except grpc.RpcError as error:
            sys.exit(error.details())


if __name__ == "__main__":
    main()
