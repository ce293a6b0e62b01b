#!/usr/bin/python3
"""compensate.py ADDRESS FILE: the program with TRC resolved on standard output, diagnostics on
standard error. With the package of client/python."""

import sys

import trc


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: compensate.py ADDRESS FILE")
    with open(sys.argv[2], "rb") as file:
        program = file.read()
    try:
        result = trc.compensate(program, server=sys.argv[1])
    except trc.TrcError as error:
        for raised in error.diagnostics:
            print(raised, file=sys.stderr)
        sys.exit(str(error))
    except trc.ServerError as error:
        sys.exit(str(error))
    for raised in result.diagnostics:
        print(raised, file=sys.stderr)
    sys.stdout.write(result.text)


if __name__ == "__main__":
    main()
