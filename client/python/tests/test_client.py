"""The installed package against a trcd: TRC_TRCD names the program."""

import asyncio
import hashlib
import json
import os
import socket
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path as File

import numpy as np

import trc
import trc.aio
from trc import local

POCKET = """%POCKET
N10 G17 G90 G0 X0 Y0
N20 G41 G1 X10 Y0 F800
N30 X50
M8
N40 Y40
N50 G40 X0 Y60
M30
"""
REFUSED = "N10 G41 V.G.WZ_AKT.R=5 G1 X10\nN20 X30\nN30 X\n"


def long_program(blocks):
    """A wave, long enough for many responses."""
    lines = ["N10 G17 G90 G0 X0 Y0", "N20 G41 G1 X1 Y0 F900"]
    lines += [f"G1 X{2 + i * 0.5:.3f} Y{(i % 2) * 0.05:.3f}" for i in range(blocks)]
    return "\n".join([*lines, "G40 G1 Y-20", "M30", ""])


class CuttingProxy:
    """Hands bytes on to a server, and cuts the first connection after so many answered bytes."""

    def __init__(self, server_path, cut_after):
        self._server_path = server_path
        self._cut_after = cut_after
        self.cuts = 0
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.address = "127.0.0.1:%d" % self._listener.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self):
        while True:
            try:
                client, _ = self._listener.accept()
            except OSError:
                return
            server = socket.socket(socket.AF_UNIX)
            server.connect(self._server_path)
            limit = self._cut_after if self.cuts == 0 else None
            threading.Thread(target=self._pump, args=(client, server, None), daemon=True).start()
            threading.Thread(target=self._pump, args=(server, client, limit), daemon=True).start()

    def _pump(self, source, target, limit):
        passed = 0
        try:
            while data := source.recv(4096):
                passed += len(data)
                if limit is not None and passed > limit:
                    self.cuts += 1
                    break
                target.sendall(data)
        except OSError:
            pass
        for end in (source, target):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
        source.close()

    def close(self):
        self._listener.close()


class Compensate(unittest.TestCase):
    def test_program_gets_the_text_of_the_command_line(self):
        trc_program = os.environ.get("TRC_CLI")
        if trc_program is None:
            self.fail("TRC_CLI names the command-line client")
        with tempfile.NamedTemporaryFile("w", suffix=".nc") as part:
            part.write(POCKET)
            part.flush()
            expected = subprocess.run(
                [trc_program, "compensate", part.name, "--set", "tool_radius=5"],
                check=True, capture_output=True, text=True).stdout
        result = trc.compensate(POCKET, radius=5)
        self.assertEqual(result.text, expected)
        self.assertEqual(result.summary.path.blocks_in, 7)

    def test_refused_program_raises_its_diagnostics(self):
        with self.assertRaises(trc.TrcError) as caught:
            trc.compensate(REFUSED)
        cause = caught.exception.cause
        self.assertEqual((cause.code, cause.line, cause.severity), (900008, 3, trc.Severity.ERROR))
        self.assertTrue(cause.remedy)
        self.assertEqual((cause.place.line, cause.place.column), (cause.line, cause.column))
        self.assertTrue(cause.text.startswith(cause.title))

    def test_diagnostics_are_in_the_language_that_is_asked_for(self):
        with self.assertRaises(trc.TrcError) as caught:
            trc.compensate("N10 G1 X10,5\n", language="de")
        cause = caught.exception.cause
        self.assertEqual(cause.help, "Dezimalpunkt statt Komma schreiben: X10.5.")
        self.assertEqual(cause.remedy, "Write a decimal point: X10.5.")
        self.assertEqual(cause.language, "de")
        self.assertTrue(str(caught.exception).startswith("Zeile 1: Fehler 900008: eine Zahl"),
                        str(caught.exception))
        self.assertEqual(str(cause), str(caught.exception))

    def test_tool_table_serves_d_words(self):
        result = trc.compensate(POCKET.replace("F800", "F800 D7"), tools={7: 5.0})
        self.assertEqual(result.text.replace(" D7", ""), trc.compensate(POCKET, radius=5).text)

    def test_subprograms_are_texts_or_bytes(self):
        result = trc.compensate(
            "G0 Y1.\nM98 P7\nM98 P8\nM30\n", dialect="FANUC", variables={"#500": 4.5},
            subprograms={"O7.nc": "O7\nG0 X#500\nM99\n", "O8.nc": b"O8\n(fr\xe4sen)\nM99\n"})
        self.assertEqual(result.text,
                         "G0 Y1.\n(O0007)\nG0 X4.5\n(O0008)\n(fr\udce4sen)\nM30\n")
        with self.assertRaisesRegex(TypeError, "variables"):
            trc.compensate(POCKET, variables=[4.5])

    def test_setting_that_is_none_is_named(self):
        with self.assertRaisesRegex(TypeError, "radus"):
            trc.compensate(POCKET, radus=5)

    def test_setting_out_of_range_is_refused_with_its_name(self):
        with self.assertRaisesRegex(trc.TrcError, "tool_radius"):
            trc.compensate(POCKET, radius=1e9)

    def test_no_server_there(self):
        with self.assertRaises(trc.ServerError):
            trc.compensate(POCKET, server="127.0.0.1:1", timeout=2)

    def test_bytes_that_are_no_utf8_are_refused_with_their_place(self):
        with self.assertRaises(trc.TrcError) as caught:
            trc.compensate(b"N10 G0 X0\n\xff\n")
        self.assertEqual(caught.exception.cause.line, 2)

    def test_stream_that_is_lost_goes_on(self):
        text = long_program(30_000)
        with trc.Client() as client:
            whole = client.compensate(text, radius=0.2)
        proxy = CuttingProxy(local.address().removeprefix("unix:"), cut_after=300_000)
        try:
            with trc.Client(proxy.address) as client:
                resumed = client.compensate(text, radius=0.2)
        finally:
            proxy.close()
        self.assertEqual(proxy.cuts, 1)
        self.assertEqual(resumed.text, whole.text)

    def test_record_of_the_job(self):
        with tempfile.TemporaryDirectory() as folder:
            part, record = File(folder, "part.nc"), File(folder, "record.json")
            part.write_text(POCKET)
            result = trc.compensate(POCKET, radius=5, verify="REPORT", record=True)
            self.assertIsNone(trc.compensate(POCKET, radius=5).record)
            filed = json.loads(result.record)
            self.assertEqual(filed["output"]["sha256"],
                             hashlib.sha256(result.text.encode()).hexdigest())
            self.assertEqual(filed["summary"]["path"]["certificate"]["toolRadius"], 5)
            record.write_text(result.record)
            verify = [os.environ["TRC_CLI"], "verify", part, "--record", record]
            subprocess.run(verify, check=True, capture_output=True)
            part.write_text(POCKET.replace("X50", "X51"))
            self.assertEqual(subprocess.run(verify, check=False, capture_output=True).returncode, 1)
        with self.assertRaises(trc.TrcError) as refused:
            trc.compensate(REFUSED, record=True)
        filed = json.loads(refused.exception.record)
        self.assertEqual(filed["outcome"], "REFUSED")
        self.assertEqual(filed["diagnostics"][-1]["code"], refused.exception.cause.code)

    def test_record_of_a_stream_that_was_lost_is_that_of_the_whole(self):
        text = "#TRC [STRETCH_FACTOR=30]\n" + long_program(30_000)

        def record_of(client):
            filed = json.loads(client.compensate(text, radius=0.2, record=True).record)
            for own in ("started", "seconds", "sha256"):
                del filed[own]
            for own in ("wallTimeSeconds", "cpuTimeSeconds"):
                del filed["summary"]["path"][own]
            return filed

        with trc.Client() as client:
            whole = record_of(client)
        self.assertEqual(whole["input"]["sha256"], hashlib.sha256(text.encode()).hexdigest())
        self.assertEqual(whole["allDiagnostics"]["count"], "1")
        proxy = CuttingProxy(local.address().removeprefix("unix:"), cut_after=300_000)
        try:
            with trc.Client(proxy.address) as client:
                self.assertEqual(record_of(client), whole)
        finally:
            proxy.close()
        self.assertEqual(proxy.cuts, 1)

    def test_asyncio_twin_gives_the_same(self):
        async def all_of_them():
            async with trc.aio.Client() as client:
                return await asyncio.gather(
                    *(client.compensate(POCKET, radius=radius) for radius in (1, 2, 5)))

        for radius, result in zip((1, 2, 5), asyncio.run(all_of_them())):
            self.assertEqual(result.text, trc.compensate(POCKET, radius=radius).text)

    def test_blocks_are_the_path_of_the_text(self):
        async def awaited():
            async with trc.aio.Client() as client:
                return await client.compensate(POCKET, radius=5, blocks=True)

        for result in (trc.compensate(POCKET, radius=5, blocks=True), asyncio.run(awaited())):
            self.assertEqual(result.text, trc.compensate(POCKET, radius=5).text)
            self.assertEqual([(block.kind, block.origin) for block in result.blocks],
                             [("rapid", "UNCOMPENSATED"), ("linear", "APPROACH"),
                              ("linear", "PROGRAMMED"), ("text", "PASSTHROUGH"),
                              ("linear", "PROGRAMMED"), ("linear", "RETRACT"),
                              ("text", "PASSTHROUGH")])
            np.testing.assert_allclose(result.blocks.end[1:3, :2], [[10, 5], [45, 5]], atol=1e-9)
        self.assertIsNone(trc.compensate(POCKET, radius=5).blocks)
        with self.assertRaisesRegex(TypeError, "blocks=True"):
            trc.compensate(POCKET, radius=5, output="BLOCKS")


class Paths(unittest.TestCase):
    def test_corner_inside_left_of_the_contour(self):
        path = trc.Path().left().line(10, 0).line(50).line(y=40).off().line(0, 60)
        result = trc.compensate_path(path, radius=5)
        np.testing.assert_allclose(
            result.path.end[:, :2], [[10, 5], [45, 5], [45, 40], [0, 60]], atol=1e-9)
        np.testing.assert_array_equal(result.path.start[1:], result.path.end[:-1])

    def test_columns_give_what_blocks_give(self):
        blocks = trc.Path().left().line(10, 0).line(50).line(y=40).off().line(0, 60)
        nan = np.nan
        columns = trc.Path.of_columns(
            [5, 1, 1, 1, 5, 1], x=[nan, 10, 50, nan, nan, 0], y=[nan, 0, nan, 40, nan, 60],
            commands={0: "left", 4: "off"})
        one, other = (trc.compensate_path(path, radius=5).path for path in (blocks, columns))
        np.testing.assert_array_equal(one.end, other.end)
        np.testing.assert_array_equal(one.kinds, other.kinds)

    def test_outside_corner_gets_an_arc(self):
        path = trc.Path().left().line(10, 0).line(50).line(y=-40).off().line(20)
        result = trc.compensate_path(path, radius=5, transition="G26")
        arcs = [block for block in result.path if block.kind == "arc"]
        self.assertEqual([block.origin for block in arcs], ["TRANSITION", "RETRACT"])
        np.testing.assert_allclose(arcs[0].center, [50, 0, 0], atol=1e-12)
        self.assertAlmostEqual(arcs[0].sweep, -np.pi / 2)

    def test_text_keeps_its_place(self):
        path = trc.Path().left().line(10, 0).line(50).text("M8").line(y=40).off().line(0, 60)
        result = trc.compensate_path(path, radius=5)
        self.assertEqual(result.path.texts, {2: "M8"})

    def test_many_blocks_come_in_many_batches(self):
        count = 50_000
        angle = np.linspace(0, 200 * np.pi, count)
        kinds = np.concatenate([[5], np.ones(count, np.uint8), [5, 1]])
        nan = [np.nan]
        x = np.concatenate([nan, 100 + angle * np.cos(angle), nan, [0]])
        y = np.concatenate([nan, angle * np.sin(angle), nan, [-900]])
        path = trc.Path.of_columns(kinds, x=x, y=y, commands={0: "left", count + 1: "off"})
        result = trc.compensate_path(path, radius=0.01, start_position={"x": 90, "y": -1})
        np.testing.assert_array_equal(result.path.start[1:], result.path.end[:-1])
        self.assertEqual(result.summary.blocks_out, len(result.path))

    def test_columns_of_different_length_are_named(self):
        with self.assertRaisesRegex(ValueError, "column y"):
            trc.Path.of_columns([1, 1], x=[1, 2], y=[1])


SLOT = """N10 G17 G90 G0 X-20 Y4
N20 G138 G41 G1 X-10 Y0 F500
N30 X30
N40 Y8
N50 X-10
N60 G40 X-20 Y4
M30
"""

# The path beside N30 runs through the wall N70, after a change of side.
THROUGH_A_WALL = """N10 G00 X-20 Y0 F1000
N20 G138 G26 G141
N25 G41 G01 X0 Y0
N30 X60
N40 G42 X70 Y20
N50 Y40
N60 X30
N70 Y3
N80 X20
N90 Y40
N100 X0
N110 G40 X-20
N120 M30
"""


class Measuring(unittest.TestCase):
    def test_a_clearance_of_zero_is_told(self):
        with trc.Client() as client:
            measured = client.compensate(THROUGH_A_WALL, radius=5, verify="report")
        certificate = measured.summary.path.certificate
        self.assertTrue(certificate.HasField("clearance"))
        self.assertEqual(certificate.clearance, 0)
        self.assertTrue(measured.summary.path.min_clearance.HasField("distance"))


class Surveys(unittest.TestCase):
    def test_radii_that_fit_and_one_that_does_not(self):
        survey = trc.survey_radii(SLOT, [5, 3], uncut=True)
        large, small = survey.radii
        self.assertEqual((large.radius, large.accepted, large.clearance), (5, False, None))
        self.assertEqual(large.refusal.severity, trc.Severity.ERROR)
        self.assertIsNotNone(large.refusal.point)
        self.assertIsNone(large.compensated_length)
        self.assertTrue(small.accepted and small.reaches_every_wall)
        self.assertEqual(small.refusal, None)
        self.assertAlmostEqual(small.clearance.distance, 3, places=4)
        self.assertAlmostEqual(small.uncut_length, 12)
        self.assertAlmostEqual(small.wall_length, 88)
        # The corners at X30, from which the tool stays away by its radius.
        self.assertEqual([wall.place.line for wall in small.uncut], [3, 4, 4, 5])
        self.assertAlmostEqual(small.uncut[0].start[0], 27)
        self.assertEqual(small.uncut[0].end, (30, 0, 0))

    def test_largest_radius_is_that_of_the_command_line(self):
        with tempfile.NamedTemporaryFile("w", suffix=".nc") as part:
            part.write(SLOT)
            part.flush()
            told = json.loads(subprocess.run(
                [os.environ["TRC_CLI"], "radii", part.name, "--radii", "3", "--json"],
                check=True, capture_output=True, text=True).stdout)
        survey = trc.survey_radii(SLOT, [3])
        self.assertEqual(survey.largest.radius, told["summary"]["largest"]["radius"])
        self.assertTrue(survey.largest.is_limited)
        self.assertEqual([place.line for place in survey.largest.limits], [3, 5])
        self.assertEqual(survey.largest.limits[1].source_number, 50)
        with trc.Client() as client:
            single = client.compensate(SLOT, radius=survey.radii[0].radius)
        self.assertEqual(survey.radii[0].compensated_length, single.summary.path.compensated_length)

    def test_path_stands_for_its_program(self):
        path = (trc.Path().rapid(-20, 4).left().line(-10, 0).line(30).line(y=8).line(-10).off()
                .line(-20, 4))
        survey = trc.survey_radii(path, [3], selection_mode="G138")
        of_text = trc.survey_radii(SLOT, [3])
        self.assertEqual(survey.largest.radius, of_text.largest.radius)
        self.assertEqual(survey.radii[0].clearance, of_text.radii[0].clearance)
        self.assertIsNone(survey.largest.limits[0].line)

    def test_asyncio_twin_gives_the_same(self):
        async def survey():
            async with trc.aio.Client() as client:
                return await client.survey_radii(SLOT, [5, 3], uncut=True)

        one, other = asyncio.run(survey()), trc.survey_radii(SLOT, [5, 3], uncut=True)
        self.assertEqual((one.radii, one.largest), (other.radii, other.largest))

    def test_what_is_wrong_with_every_radius_is_raised(self):
        with self.assertRaises(trc.TrcError) as caught:
            trc.survey_radii("N10 G1 X10 F100\nN20 G999\n", [3])
        self.assertEqual((caught.exception.cause.code, caught.exception.cause.line), (900002, 2))
        with self.assertRaisesRegex(trc.TrcError, "radii"):
            trc.survey_radii(SLOT, [3, 3])

    def test_largest_is_left_out_where_it_is_not_asked_for(self):
        self.assertIsNone(trc.survey_radii(SLOT, [3], largest=False).largest)

    def test_survey_that_is_lost_begins_anew(self):
        text = long_program(20_000)
        with trc.Client() as client:
            whole = client.survey_radii(text, [1, 2], uncut=True, largest=False)
        proxy = CuttingProxy(local.address().removeprefix("unix:"), cut_after=30_000)
        try:
            with trc.Client(proxy.address) as client:
                again = client.survey_radii(text, [1, 2], uncut=True, largest=False)
        finally:
            proxy.close()
        self.assertEqual(proxy.cuts, 1)
        self.assertEqual(again.radii, whole.radii)


class Package(unittest.TestCase):
    def test_version_is_that_of_the_server(self):
        with trc.Client() as client:
            self.assertEqual(client.info().version, trc.__version__)

    def test_page_of_the_interface_has_all_of_it(self):
        page = File(trc.__file__).with_name("API.md").read_text()
        for name in set(trc.__all__) - {"__version__"}:
            self.assertIn(f"\n### {name}\n", page)
        for said in ("Client.stream(", "await Client.compensate(", "`radius: float`: Of the tool, mm."):
            self.assertIn(said, page)

    def test_examples_of_the_readme_run(self):
        readme = File(os.environ["TRC_PYTHON_README"]).read_text()
        blocks = readme.split("```python\n")[1:]
        self.assertGreaterEqual(len(blocks), 3)
        for block in blocks:
            code = block.split("```")[0]
            with tempfile.TemporaryDirectory() as folder:
                File(folder, "part.nc").write_text(POCKET)
                ran = subprocess.run([sys.executable, "-c", code], cwd=folder,
                                     capture_output=True, text=True)
                self.assertEqual(ran.returncode, 0, code + ran.stderr)
                self.assertTrue(ran.stdout, code)


if __name__ == "__main__":
    unittest.main()
