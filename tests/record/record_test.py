"""Records of jobs: each kind of run writes one that fits the schema, and no change of one, of the
program or of the result goes unseen."""
import copy
import datetime
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import jsonschema

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path += [os.path.join(TOP, "tests/http"), os.path.join(TOP, "tests/record")]

import schema  # noqa: E402
from server import BUILD, NOTCH, SQUARE, THROUGH_A_WALL, Server  # noqa: E402

CHECKED = jsonschema.Draft202012Validator(json.loads(schema.filed()))

# With a warning (22007), a tool of the table, and coordinates that one decimal less would change.
PART = """N10 G00 X-20 Y-20
N15 #TRC [STRETCH_FACTOR=30]
N20 D1 G41 G01 X0 Y0 F500
N30 G01 X0 Y50.1234
N40 G01 X50 Y50.1234
N50 G01 X50.4321 Y0
N60 G01 X0 Y0
N70 G40 G01 X-20 Y-20
N80 M30
"""
TOOLS = "number,radius,wear,name\n1,5.2,-0.0123,mill\n"


def number(value):
    """A number as ECMAScript prints it, of the digits that Python prints."""
    if value == 0:
        return "0"
    digits, _, exponent = repr(abs(float(value))).partition("e")
    whole, _, fraction = digits.partition(".")
    before = len(whole) + int(exponent or 0)
    digits = whole + fraction
    before -= len(digits) - len(digits.lstrip("0"))
    digits = digits.strip("0")
    sign = "-" if value < 0 else ""
    if before > 21 or before <= -6:
        return sign + digits[0] + ("." + digits[1:] if digits[1:] else "") + f"e{before - 1:+d}"
    if before <= 0:
        return sign + "0." + "0" * -before + digits
    if before < len(digits):
        return sign + digits[:before] + "." + digits[before:]
    return sign + digits + "0" * (before - len(digits))


def canonical(value):
    """RFC 8785, made anew here as a judge."""
    if isinstance(value, dict):
        members = sorted(value.items(), key=lambda member: member[0].encode("utf-16-be"))
        return "{" + ",".join(canonical(k) + ":" + canonical(v) for k, v in members) + "}"
    if isinstance(value, list):
        return "[" + ",".join(map(canonical, value)) + "]"
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return number(value)
    return json.dumps(value, ensure_ascii=False)


def digest(record):
    content = {name: value for name, value in record.items() if name != "sha256"}
    return hashlib.sha256(canonical(content).encode()).hexdigest()


def leaves(value, path=()):
    """Where the values of a record are that hold no others."""
    if isinstance(value, (dict, list)) and value:
        for key, held in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(held, (*path, key))
    else:
        yield path


def name_of(path):
    return ".".join(map(str, path))


OTHER_NAMES = {"DONE": "REFUSED", "REFUSED": "DONE", "nc": "listing", "ERROR": "WARNING",
               "WARNING": "NOTE", "PROGRAMMED": "MASKED", "APPROACH": "MASKED",
               "RETRACT": "MASKED", "TRANSITION": "MASKED", "PASSTHROUGH": "MASKED",
               "UNCOMPENSATED": "MASKED", "VERIFICATION_REPORT": "VERIFICATION_OFF",
               "PROGRAM_OUTPUT_NC": "PROGRAM_OUTPUT_BLOCKS", "SHAPE_LINE": "SHAPE_QUARTER_CIRCLE",
               "SHAPE_QUARTER_CIRCLE": "SHAPE_LINE", "PLANE_XY": "PLANE_ZX"}


def changed(value):
    """Another value of the same kind."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, (int, float)):
        return value + 1
    if value in OTHER_NAMES:
        return OTHER_NAMES[value]
    if not value:
        return "x"
    # Of a number in digits the last one, of anything else the first sign.
    if re.fullmatch("[0-9]+", value):
        return value[:-1] + ("1" if value[-1] != "1" else "2")
    return ("b" if value[0] != "b" else "c") + value[1:]


class Records(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.write("part.nc", PART)
        self.write("tools.csv", TOOLS)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        mode, encoding = ("wb", None) if isinstance(text, bytes) else ("w", "utf-8")
        with open(self.path(name), mode, encoding=encoding) as file:
            file.write(text)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def trc(self, *arguments, text=None):
        """Exit code, standard output and standard error."""
        done = subprocess.run([BUILD + "/bin/trc", *arguments], input=text, capture_output=True,
                              cwd=self.folder.name, timeout=60, check=False,
                              env={**os.environ, "LC_ALL": "C", "TRC_SERVER": ""})
        return done.returncode, done.stdout.decode(), done.stderr.decode()

    def compensated(self, *arguments, name="part.nc", expected=0, text=None):
        """The record of such a run, which must be one in every respect."""
        began = datetime.datetime.now(datetime.timezone.utc).replace(microsecond=0)
        code, _, said = self.trc("compensate", name, "-o", "out.nc", "--record", "record.json",
                                 *arguments, text=text)
        self.assertEqual(code, expected, said)
        record = json.loads(self.read("record.json"))
        self.is_one(record)
        started = datetime.datetime.fromisoformat(record["started"].replace("Z", "+00:00"))
        ended = datetime.datetime.now(datetime.timezone.utc)
        self.assertTrue(began <= started <= ended, record["started"])
        self.assertTrue(0 < record["seconds"] < 60, record["seconds"])
        self.assertEqual(record["outcome"], "DONE" if expected == 0 else "REFUSED")
        return record

    def is_one(self, record):
        faults = [f"{name_of(fault.absolute_path)}: {fault.message}"
                  for fault in CHECKED.iter_errors(record)]
        self.assertEqual(faults, [])
        self.assertEqual(record["sha256"], digest(record))
        release = self.trc("--version")[1].split()
        for who in ("client", "server"):
            self.assertEqual([record[who + "Version"], "(" + record[who + "Commit"] + ")"],
                             release[1:3])

    def verified(self, record, *arguments):
        """What `trc verify` says of a record that was written so."""
        self.write("record.json", json.dumps(record, ensure_ascii=False))
        return self.trc("verify", *arguments, "--record", "record.json")

    def test_the_schema_is_made_of_the_messages(self):
        self.assertEqual(schema.filed(), schema.text(), "tests/record/schema.py --fix")
        CHECKED.check_schema(CHECKED.schema)
        for wrong in ({}, {"format": "trc-job-record-1"}):
            self.assertFalse(CHECKED.is_valid(wrong))

    def test_of_programs(self):
        for output in ("nc", "jsonl", "listing"):
            record = self.compensated("--format", output, "--tools", "tools.csv")
            self.assertEqual(record["outputFormat"], output)
            made = self.read("out.nc")
            if output == "jsonl":
                made = made[:made.rindex(b'{"summary"')]
            self.assertEqual(record["output"], {
                "name": "out.nc", "bytes": str(len(made)),
                "sha256": hashlib.sha256(made).hexdigest()})
            self.assertEqual(record["input"]["sha256"], hashlib.sha256(PART.encode()).hexdigest())
            self.assertEqual(record["diagnostics"][0]["code"], 22007)
            self.assertEqual(self.trc("verify", "--record", "record.json")[0], 0)

    def test_of_what_comes_through_a_pipe(self):
        code, made, _ = self.trc("compensate", "-", "--set", "tool_radius=5", "--record",
                                 "record.json", text=SQUARE.encode())
        self.assertEqual(code, 0)
        record = json.loads(self.read("record.json"))
        self.is_one(record)
        self.assertEqual(record["output"]["sha256"], hashlib.sha256(made.encode()).hexdigest())
        self.write("square.nc", SQUARE)
        self.assertEqual(self.trc("verify", "square.nc", "--record", "record.json")[0], 0)

    def test_of_wear(self):
        record = self.compensated("--tools", "tools.csv")
        path = record["summary"]["path"]
        self.assertAlmostEqual(path["effectiveRadius"], 5.1877)
        self.assertAlmostEqual(path["wear"], -0.0123)
        self.assertAlmostEqual(path["certificate"]["toolRadius"], 5.1877)
        self.assertEqual(record["setup"]["tools"][0]["name"], "MILL")
        self.write("square.nc", SQUARE)
        path = self.compensated("--set", "nominal_radius=5", "--wear=-0.1", "--set",
                                "allowance=0.3", name="square.nc")["summary"]["path"]
        self.assertEqual((path["nominalRadius"], path["wear"], path["allowance"]), (5, -0.1, 0.3))
        self.assertEqual(self.trc("verify", "--record", "record.json")[0], 0)

    def test_of_a_clearance_of_zero(self):
        self.write("through.nc", THROUGH_A_WALL)
        path = self.compensated("--radius", "5", "--set", "verify=report",
                                name="through.nc")["summary"]["path"]
        self.assertEqual(path["certificate"]["clearance"], 0)
        self.assertEqual(path["minClearance"]["distance"], 0)
        self.assertEqual(self.trc("verify", "--record", "record.json")[0], 0)

    def test_of_refused_programs(self):
        self.write("notch.nc", NOTCH)
        record = self.compensated("--radius", "5", name="notch.nc", expected=1)
        self.assertEqual(record["diagnostics"][-1]["severity"], "ERROR")
        self.assertNotIn("summary", record)
        self.assertEqual(self.trc("verify", "--record", "record.json")[0], 0)

    def test_of_very_many_messages(self):
        warnings = 5000
        self.write("many.nc", "N10 G00 X-20 Y-20\n" + "#TRC [STRETCH_FACTOR=30]\n" * warnings +
                   "G999\n")
        record = self.compensated("-q", "--format", "jsonl", name="many.nc", expected=1)
        _, made, _ = self.trc("compensate", "-q", "many.nc", "--format", "jsonl")
        told = [line for line in made.splitlines() if line.startswith('{"diagnostic"')]
        self.assertEqual(len(told), warnings + 1)
        self.assertEqual(record["allDiagnostics"], {
            "count": str(warnings + 1),
            "sha256": hashlib.sha256("".join(line + "\n" for line in told).encode()).hexdigest()})
        self.assertEqual([json.loads(line)["diagnostic"] for line in [*told[:1000], told[-1]]],
                         record["diagnostics"])
        self.assertEqual(self.trc("verify", "-q", "--record", "record.json")[0], 0)
        record["allDiagnostics"]["count"] = str(warnings)
        record["sha256"] = digest(record)
        code, _, said = self.verified(record, "-q")
        self.assertEqual(code, 1)
        self.assertIn("diagnostics: ", said)

    def test_of_servers(self):
        here = self.compensated("--tools", "tools.csv")
        with Server() as first, Server() as second:
            for servers in (first.grpc_address, f"{first.grpc_address},{second.grpc_address}"):
                record = self.compensated("--tools", "tools.csv", "--server", servers)
                self.assertEqual(record["server"], servers)
                for part in ("input", "output", "setup", "diagnostics"):
                    self.assertEqual(record[part], here[part], part)
                self.assertEqual(
                    self.trc("verify", "--record", "record.json", "--server", servers)[0], 0)
                self.assertEqual(self.trc("verify", "--record", "record.json")[0], 0)

    def test_of_http(self):
        with Server() as server:
            for name in ("", "&name=square.nc"):
                status, record = server.ask_json(
                    "POST", "/v1/programs:record?tool_radius=5" + name, SQUARE,
                    {"Content-Type": "text/plain"})
                self.assertEqual(status, 200)
                self.is_one(record)
                self.write("square.nc", SQUARE)
                self.assertEqual(self.verified(record, "square.nc")[0], 0)
                if name:
                    self.assertEqual(self.verified(record)[0], 0)

    def test_of_what_a_setup_asks_for(self):
        """As any client of the RPCs gets it: here through their JSON, in one request."""
        rpc = "/trc.v1.TrcService/CompensateProgramOnce"
        kind = {"Content-Type": "application/json"}
        setup = {"path": {"verify": "VERIFICATION_REPORT"}, "fileName": "part.nc", "record": True,
                 "tools": [{"number": 1, "radius": 5.2, "wear": -0.0123, "name": "mill"}]}
        with Server() as server:
            for output, text_format in (("PROGRAM_OUTPUT_NC", "nc"),
                                        ("PROGRAM_OUTPUT_BLOCKS", "jsonl")):
                asked = {"setup": {**setup, "output": output}, "text": PART}
                status, once = server.ask_json("POST", rpc, json.dumps(asked), kind)
                self.assertEqual(status, 200)
                record = json.loads(once["record"])
                self.is_one(record)
                self.assertEqual(record["outputFormat"], text_format)
                self.assertEqual(record["outcome"], "DONE")
                self.assertNotIn("record", record["setup"])
                self.assertEqual(record["diagnostics"], once["diagnostics"])
                self.assertEqual(record["summary"], once["summary"])
                here = self.compensated("--tools", "tools.csv", "--format", text_format)
                for part in ("bytes", "sha256"):
                    self.assertEqual(record["output"][part], here["output"][part])
                    self.assertEqual(record["input"][part], here["input"][part])
                os.remove(self.path("out.nc"))
                self.write("record.json", once["record"])
                self.assertEqual(self.trc("verify", "--record", "record.json")[0], 0)
                self.write("part.nc", PART.replace("50.1234", "50.1233"))
                self.assertEqual(self.trc("verify", "--record", "record.json")[0], 1)
                self.write("part.nc", PART)
            setup["record"] = False
            _, once = server.ask_json("POST", rpc, json.dumps({"setup": setup, "text": PART}), kind)
            self.assertNotIn("record", once)

    def test_of_folders(self):
        self.write("square.nc", SQUARE)
        code, _, said = self.trc("compensate", "part.nc", "square.nc", "--tools", "tools.csv",
                                 "--set", "tool_radius=5", "--output-dir", "out")
        self.assertEqual(code, 0, said)
        for name in ("part", "square"):
            self.is_one(json.loads(self.read(f"out/{name}.nc.json")))
            self.assertEqual(self.trc("verify", "--record", f"out/{name}.nc.json")[0], 0)

    def records_to_change(self):
        yield self.compensated("--tools", "tools.csv", "--set", "allowance=0.1")
        self.write("notch.nc", NOTCH)
        yield self.compensated("--radius", "5", name="notch.nc", expected=1)
        # Refused with proposals of another way to the contour.
        with open(TOP + "/tests/programs/bad/d03_selection_block_too_short.nc", "rb") as file:
            self.write("entry.nc", file.read())
        record = self.compensated(name="entry.nc", expected=1)
        self.assertTrue(record["diagnostics"][-1]["entryHelp"]["proposals"])
        yield record

    def with_each_value_altered(self, record, ways):
        """Where it was, and the record with that value another one, or without it."""
        for path in leaves(record):
            for alter in ways:
                other = copy.deepcopy(record)
                owner = other
                for key in path[:-1]:
                    owner = owner[key]
                if alter:
                    owner[path[-1]] = alter(owner[path[-1]])
                else:
                    del owner[path[-1]]
                with self.subTest(name_of(path), taken_away=not alter, outcome=record["outcome"]):
                    yield path, other

    def test_every_change_of_a_value_is_seen(self):
        for record in self.records_to_change():
            for _, other in self.with_each_value_altered(record, (changed, None)):
                code, _, said = self.verified(other)
                self.assertIn(code, (1, 2), said)
                self.assertRegex(said, "it has been changed|it is no record of a job")

    def test_what_a_forger_could_change_is_what_a_second_run_cannot_know(self):
        # With a digest that fits again. Times, versions and names are free: a run later, elsewhere
        # and by another version is to give the same.
        free = (r"output\.name|(client|server)(Version|Commit)|server|started|seconds"
                r"|summary\.path\.(wall|cpu)TimeSeconds")
        # So are settings that change nothing of what this run gave.
        free += r"|setup\.(fileName|output|tools\.0\.name)"
        for record in self.records_to_change():
            free_here = free
            if record["outcome"] == "REFUSED":
                free_here += r"|setup\.(decimals|path\.verify)"
            unseen = set()
            for path, other in self.with_each_value_altered(record, (changed,)):
                if path == ("sha256",):
                    continue
                other["sha256"] = digest(other)
                code, _, said = self.verified(other)
                if code == 0:
                    unseen.add(name_of(path))
                else:
                    self.assertTrue(said)
            self.assertEqual([name for name in sorted(unseen)
                              if not re.fullmatch(free_here, name)], [])

    def test_changed_bytes_of_program_and_result_are_seen(self):
        for output in ("nc", "jsonl"):
            self.compensated("--tools", "tools.csv", "--format", output)
            for name, told in (("part.nc", "input: SHA-256"), ("out.nc", "does not hold")):
                whole = self.read(name)
                # What is measured anew of times is not compared.
                end = whole.index(b'{"summary"') if b'{"summary"' in whole else len(whole)
                altered = [whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:]
                           for at in range(0, end, end // 50)]
                for other in (*altered, whole[1:], whole[:end - 1], whole + b"\n", b""):
                    self.write(name, other)
                    code, _, said = self.trc("verify", "--record", "record.json")
                    self.assertEqual(code, 1, other)
                    self.assertIn(told, said)
                self.write(name, whole)
            self.assertEqual(self.trc("verify", "--record", "record.json")[0], 0)

    def test_another_version_is_said_and_no_fault(self):
        record = self.compensated("--tools", "tools.csv")
        for who in ("client", "server"):
            other = {**record, who + "Commit": "0123456789ab"}
            other["sha256"] = digest(other)
            code, _, said = self.verified(other)
            self.assertEqual(code, 0, said)
            if who == "server":
                self.assertIn("made by version", said)
        os.remove(self.path("out.nc"))
        code, told, _ = self.verified(record)
        self.assertEqual(code, 0)
        self.assertIn("is not here", told)

    def test_changes_of_the_layout_are_none(self):
        record = self.compensated("--tools", "tools.csv")
        backwards = dict(reversed(record.items()))
        self.assertEqual(self.verified(backwards)[0], 0)


if __name__ == "__main__":
    unittest.main()
