"""python_client.py PORT CA PROGRAM: the program compensated by the package of client/python; its exit
codes are those of `trc`."""

import sys

import trc


def main():
    _, port, authority, source = sys.argv
    with open(source, "rb") as file:
        program = file.read()
    try:
        result = trc.compensate(program, server=f"127.0.0.1:{port}", tls=trc.Tls(ca=authority), timeout=60)
    except trc.TrcError as error:
        print(error, file=sys.stderr)
        sys.exit(1)
    except trc.ServerError as error:
        print(error, error.reason, file=sys.stderr)
        sys.exit(4 if error.status.name == "RESOURCE_EXHAUSTED" else 3)
    # With PYTHONUNBUFFERED a write to sys.stdout that a signal cuts short is not gone on with: the rest
    # of the text would be lost without an error.
    with open(sys.stdout.fileno(), "wb", closefd=False) as output:
        output.write(result.text.encode())


if __name__ == "__main__":
    main()
