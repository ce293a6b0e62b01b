"""What HTTP answers is what gRPC answers, byte for byte; and what it refuses it says why."""
import base64
import http.client
import json
import math
import os
import struct
import subprocess
import tempfile
import time
import unittest
import urllib.request

from server import NOTCH, SQUARE, THROUGH_A_WALL, Server, trc

TEXT = {"Content-Type": "text/plain; charset=utf-8"}
JSON = {"Content-Type": "application/json"}


def laps(count):
    """Laps of one circle with each block near those of all laps: much to be computed."""
    blocks = [(20 * math.cos(2 * math.pi * i / 100), 20 * math.sin(2 * math.pi * i / 100)) for i in range(100)]
    lap = "".join(f"X{x:.4f} Y{y:.4f}\n" for x, y in blocks)
    return "G141\nG1 G41 V.G.WZ_AKT.R=0.5 X20 Y0 F800\n" + lap * count + "G40\nX0 Y0\nM30\n"


def program_of(lines):
    """A zigzag of so many lines, compensated."""
    text = ["N1 G00 X-20 Y-20", "N2 G41 G01 X0 Y0 F500"]
    text += [f"G01 X{i % 7 + i / 10:.1f} Y{10 + i}" for i in range(lines)]
    return "\n".join(text + ["G40 G01 X-50 Y-50", "M30", ""])


class Programs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Server("--log-level", "info").__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def url(self, path):
        return f"http://127.0.0.1:{self.server.port}{path}"

    def expected(self, *arguments, text=SQUARE):
        code, out = trc("compensate", "-", *arguments, text=text.encode())
        self.assertEqual(code, 0)
        return out

    def test_urllib_gets_the_text_of_the_command_line(self):
        request = urllib.request.Request(self.url("/v1/programs:compensate?tool_radius=5"),
                                         SQUARE.encode(), TEXT)
        with urllib.request.urlopen(request, timeout=60) as answer:
            self.assertEqual(answer.read(), self.expected("--set", "tool_radius=5"))
            self.assertEqual(answer.headers["Trc-Status"], "OK")

    def test_lines_of_the_log_say_who_asked_and_are_joined_by_their_trace(self):
        trace = "4bf92f3577b34da6a3ce929d0e0e4736"
        for given in ({"traceparent": f"00-{trace}-00f067aa0ba902b7-01"}, {}):
            path = f"/v1/programs:compensate?tool_radius=5&client_tag=joined{len(given)}"
            self.assertEqual(self.server.ask("POST", path, SQUARE, {**TEXT, **given})[0], 200)
            said = self.server.said_soon(rf'"rpc".*"client_tag":"joined{len(given)}"')
            rpc = [json.loads(line) for line in said.splitlines()
                   if f'"client_tag":"joined{len(given)}"' in line][-1]
            self.assertRegex(rpc["peer"], r"^127\.0\.0\.1:\d+$")
            said = self.server.said_soon(rf'"event":"http".*"trace_id":"{rpc["trace_id"]}"')
            http_line = [json.loads(line) for line in said.splitlines() if '"event":"http"' in line
                         and rpc["trace_id"] in line][-1]
            self.assertEqual(http_line["peer"], rpc["peer"])
            self.assertEqual(http_line["span_id"], rpc["parent_id"])
            if given:
                self.assertEqual((rpc["trace_id"], http_line["parent_id"]),
                                 (trace, "00f067aa0ba902b7"))

    def test_nc_text_tells_its_warnings_beside_its_status(self):
        clean = self.server.ask("POST", "/v1/programs:compensate?tool_radius=5", SQUARE, TEXT)
        self.assertEqual(clean[1]["Trc-Warnings"], "0")
        self.assertNotIn("Trc-First-Warning", clean[1])
        open_contour = "G00 X0 Y-10\nG42 G01 X0 Y0 F100\nX20\n"
        warned = self.server.ask("POST", "/v1/programs:compensate?tool_radius=2", open_contour,
                                 TEXT)
        self.assertEqual(warned[0], 200)
        self.assertEqual(warned[1]["Trc-Warnings"], "1")
        self.assertRegex(warned[1]["Trc-First-Warning"], r"^900205; line=\d$")

    def test_a_program_that_computes_has_its_variables_and_subprograms(self):
        text = ("O1\nG21 G17 G90\nG0 X-20. Y-20.\nG41 D1 G1 X0. Y0. F500.\nY#500\nX60.\nM98 P2\n"
                "G40 X-20. Y-20.\nM30\nO2\nY0.\nX0.\nM99\n")
        query = "/v1/programs:compensate?dialect=fanuc&tool_radius=5"
        _, problem = self.server.ask_json("POST", query, text, TEXT)
        self.assertEqual(problem["diagnostics"][0]["code"], 900303)
        self.assertIn("variables", problem["diagnostics"][0]["help"])
        status, _, same = self.server.ask("POST", query + "&variables=%23500%3D40", text, TEXT)
        self.assertEqual(status, 200, same)
        self.assertEqual(same, self.expected("--dialect", "fanuc", "--radius", "5", "--variable",
                                             "#500=40", text=text))
        _, problem = self.server.ask_json("POST", query + "&variables=%23500=40&"
                                          "max_executed_lines=5", text, TEXT)
        self.assertEqual(problem["diagnostics"][0]["code"], 900301)

    def test_a_program_in_latin1_is_answered_and_shown(self):
        text = ('0 BEGIN PGM FRÄSEN MM\n1 TOOL CALL "FRÄSER" Z\n2 L X-20 Y-20 R0 FMAX\n'
                '3 L X+0 Y+0 RL F500 ; Öl\n4 L Y+40\n5 L X+40\n6 L X+60 Y+60 R0\n'
                '7 END PGM FRÄSEN MM\n').encode("latin-1")
        query = "?dialect=heidenhain&tool_radius=5"
        _, _, same = self.server.ask("POST", "/v1/programs:compensate" + query, text, TEXT)
        self.assertIn("FRÄSER".encode("latin-1"), same)
        status, _, lines = self.server.ask("POST", "/v1/programs:compensate" + query, text,
                                           {**TEXT, "Accept": "application/x-ndjson"})
        self.assertEqual(status, 200)
        self.assertIn("FRÄSER", lines.decode())
        status, view = self.server.ask_json("POST", "/v1/views" + query, text, TEXT)
        self.assertEqual(status, 201)
        _, shown = self.server.ask_json("GET", f"/v1/views/{view['id']}/lines?from=2&count=1")
        self.assertEqual(shown["lines"], ['1 TOOL CALL "FRÄSER" Z'])
        # A tool that is not in the table is named as it is written.
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:compensate?dialect=heidenhain&tools=7:5", text, TEXT)
        self.assertEqual(status, 422)
        self.assertIn("FRÄSER", problem["diagnostics"][0]["text"])

    def test_blocks_that_come_out_as_text_are_counted_in_the_log(self):
        _, _, lines = self.server.ask("POST", "/v1/programs:compensate?tool_radius=5", SQUARE,
                                      {**TEXT, "Accept": "application/x-ndjson"})
        blocks = int(json.loads(lines.splitlines()[-1])["summary"]["blocksOut"])
        self.assertGreater(blocks, 5)
        self.server.ask("POST", "/v1/programs:compensate?tool_radius=5", SQUARE, TEXT)
        counted = []
        for _ in range(400):  # lines are written after the answers
            calls = [json.loads(line) for line in self.server.said().splitlines()]
            counted = [call["blocks_out"] for call in calls
                       if call.get("method") == "CompensateProgram"]
            if counted[-2:] == [blocks, blocks]:
                break
            time.sleep(0.05)
        self.assertEqual(counted[-2:], [blocks, blocks])

    def test_curl_gets_the_text_of_the_command_line(self):
        done = subprocess.run(
            ["curl", "-sS", "--fail", "--data-binary", "@-", "-H", "Content-Type: text/plain",
             self.url("/v1/programs:compensate?tool_radius=5&selection_mode=G138&decimals=3")],
            input=SQUARE.encode(), capture_output=True, check=True, timeout=60)
        self.assertEqual(done.stdout, self.expected("--set", "tool_radius=5", "--set",
                                                    "selection_mode=G138", "--decimals", "3"))

    def test_curl_calls_an_rpc_with_nothing_but_its_message(self):
        def told(rpc, message):
            done = subprocess.run(["curl", "-sS", "-d", message,
                                   self.url("/trc.v1.TrcService/" + rpc)],
                                  capture_output=True, timeout=60, check=True)
            return json.loads(done.stdout)

        self.assertIn("version", told("GetServerInfo", "{}"))
        once = {"setup": {"path": {"toolRadius": 5}}, "text": SQUARE}
        self.assertEqual(told("CompensateProgramOnce", json.dumps(once))["ncText"],
                         self.expected("--set", "tool_radius=5").decode())

    def test_json_lines_are_those_of_the_command_line(self):
        _, headers, lines = self.server.ask(
            "POST", "/v1/programs:compensate?tool_radius=5", SQUARE,
            {**TEXT, "Accept": "application/x-ndjson"})
        self.assertEqual(headers["Content-Type"], "application/x-ndjson")
        ours = [json.loads(line) for line in lines.splitlines()]
        theirs = [json.loads(line) for line in
                  self.expected("--set", "tool_radius=5", "--set", "verify=off",
                                "--format", "jsonl").splitlines()]
        for last in (ours[-1]["summary"], theirs[-1]["summary"]):
            last.pop("wallTimeSeconds", None)
            last.pop("cpuTimeSeconds", None)
        self.assertEqual(ours, theirs)

    def test_a_long_answer_is_streamed_and_says_at_its_end_that_it_is_whole(self):
        text = program_of(60000)
        done = subprocess.run(
            ["curl", "-sS", "-D", "/dev/stderr", "--data-binary", "@-", "-H",
             "Content-Type: text/plain", self.url("/v1/programs:compensate?tool_radius=0.01")],
            input=text.encode(), capture_output=True, check=True, timeout=60)
        self.assertIn(b"Transfer-Encoding: chunked", done.stderr)
        self.assertIn(b"Trc-Status: OK", done.stderr)
        self.assertEqual(done.stdout, self.expected("--set", "tool_radius=0.01", text=text))

    def test_large_bodies_may_come_one_behind_the_other(self):
        # Of HTTP nothing is taken for frames without messages, which end a connection of gRPC.
        text = SQUARE + "; a comment of forty bytes and its end.\n" * 500_000
        connection = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=60)
        for _ in range(3):
            connection.request("POST", "/v1/programs:verify?tool_radius=5", text, TEXT)
            answer = connection.getresponse()
            self.assertEqual((answer.status, answer.getheader("Connection")), (200, None))
            answer.read()
            time.sleep(1.1)
        connection.close()

    def test_a_refused_program_is_a_problem_with_its_diagnostics(self):
        status, headers, body = self.server.ask(
            "POST", "/v1/programs:compensate?tool_radius=5", NOTCH, TEXT)
        self.assertEqual(status, 422)
        self.assertEqual(headers["Content-Type"], "application/problem+json")
        problem = json.loads(body)
        self.assertEqual(problem["status"], 422)
        self.assertEqual(problem["type"], "urn:trc:" + problem["reason"])
        error = problem["diagnostics"][-1]
        self.assertEqual(error["severity"], "ERROR")
        self.assertGreater(error["line"], 0)
        self.assertTrue(error["remedy"])
        self.assertEqual(error["place"]["line"], error["line"])
        kind, what = error["title"].split(": ")
        self.assertEqual(kind, "the tool does not fit")
        self.assertRegex(
            error["text"], f"^tool ⌀10.000 mm does not fit, the slot is .* wide here: {what}")

    def test_texts_are_in_the_language_that_is_preferred(self):
        def error(query, headers):
            _, _, body = self.server.ask("POST", "/v1/programs:compensate" + query,
                                         b"N10 G1 X10,5\n", {**TEXT, **headers})
            return json.loads(body)["diagnostics"][-1]

        german = error("", {"Accept-Language": "de-DE,de;q=0.9,en;q=0.8"})
        self.assertEqual(german["language"], "de")
        self.assertEqual(german["help"], "Dezimalpunkt statt Komma schreiben: X10.5.")
        self.assertEqual(german["remedy"], "Write a decimal point: X10.5.")
        _, problem = self.server.ask_json("POST", "/v1/programs:compensate", b"N10 G1 X10,5\n",
                                          {**TEXT, "Accept-Language": "de"})
        self.assertEqual(problem["title"], "Das Programm kann nicht korrigiert werden")
        self.assertRegex(problem["detail"], r"^in Zeile 1 .*: .*Dezimalpunkt statt Komma")
        self.assertEqual(error("", {})["help"], "Write a decimal point: X10.5.")
        self.assertEqual(error("?language=en", {"Accept-Language": "de"})["language"], "en")

    def test_requests_in_json_speak_the_language_that_is_preferred(self):
        german = {**JSON, "Accept-Language": "de-DE,de;q=0.9,en;q=0.8"}
        # A side without a radius: 900219.
        path = {"batch": {"blocks": [{"command": {"side": "COMPENSATION_SIDE_LEFT"}},
                                     {"linear": {"end": {"x": 10, "y": 0}}},
                                     {"linear": {"end": {"x": 20, "y": 0}}}]}}

        def told(setup, headers):
            _, problem = self.server.ask_json("POST", "/v1/paths:compensate",
                                              json.dumps({**path, **setup}), headers)
            return problem["diagnostics"][-1]["language"]

        self.assertEqual(told({}, german), "de")
        self.assertEqual(told({}, JSON), "en")
        self.assertEqual(told({"setup": {"language": "en"}}, german), "en")

        def connect(headers):
            # A factor that is out of its range: warning 22007.
            body = json.dumps({"text": "#TRC [STRETCH_FACTOR=30]\nG1 X1 F100\nM30\n"})
            _, answer = self.server.ask_json(
                "POST", "/trc.v1.TrcService/CompensateProgramOnce", body, headers)
            return answer["diagnostics"][0]["language"]

        self.assertEqual(connect(german), "de")
        self.assertEqual(connect(JSON), "en")

    def test_details_of_connect_errors_speak_it_too(self):
        def localized(error):
            for detail in error["details"]:
                if detail["type"] != "google.rpc.LocalizedMessage":
                    continue
                value = detail["value"]
                message = base64.b64decode(value + "=" * (-len(value) % 4))
                # locale = 1, message = 2, which is longer than 127 bytes.
                self.assertEqual(message[:5], b"\x0a\x02de\x12")
                return message[5:].decode(errors="replace")
            return None

        body = json.dumps({"text": "N10 G1 X10,5\n"})
        german = {**JSON, "Accept-Language": "de"}
        status, error = self.server.ask_json(
            "POST", "/trc.v1.TrcService/CompensateProgramOnce", body, german)
        self.assertEqual((status, error["code"]), (400, "invalid_argument"))
        self.assertIn("Dezimalpunkt statt Komma", localized(error))
        for path, asked, said in (("CompensateProgramOnce", '{"setop":{}}',
                                   "setop: dieses Feld gibt es nicht"),
                                  ("GetServerInfo?x=1", "{}", "keine Parameter in der Adresse")):
            _, refused = self.server.ask_json("POST", "/trc.v1.TrcService/" + path, asked, german)
            self.assertIn(said, localized(refused))
            self.assertNotIn("the ", localized(refused))
        # Codes and the message for developers stay as they are.
        self.assertIn("line 1: error 900008", error["message"])
        _, error = self.server.ask_json(
            "POST", "/trc.v1.TrcService/CompensateProgramOnce", body, JSON)
        self.assertIsNone(localized(error))

        # A stream: an arc within the tool.
        path = {"setup": {"toolRadius": 5}, "batch": {"blocks": [
            {"command": {"side": "COMPENSATION_SIDE_LEFT"}},
            {"linear": {"end": {"x": 10, "y": 0}}},
            {"circular": {"end": {"x": 14, "y": 0}, "radius": 2}},
            {"linear": {"end": {"x": 50, "y": 0}}}]}}
        message = json.dumps(path).encode()
        _, _, answer = self.server.ask(
            "POST", "/trc.v1.TrcService/PreviewPath",
            struct.pack(">BI", 0, len(message)) + message,
            {"Content-Type": "application/connect+json", "Accept-Language": "de"})
        end = json.loads(answer[answer.rindex(b'{"error"'):])
        self.assertTrue(localized(end["error"]))

    def test_a_clearance_of_zero_is_told(self):
        # A tool without a radius runs on its walls.
        _, answer = self.server.ask_json("POST", "/v1/programs:verify?tool_radius=0", SQUARE, TEXT)
        certificate = answer["summary"]["certificate"]
        self.assertEqual((certificate["clearance"], certificate["toolRadius"]), (0, 0))
        self.assertEqual(answer["summary"]["minClearance"]["distance"], 0)
        _, view = self.server.ask_json(
            "POST", "/v1/views?tool_radius=5&verify=report", THROUGH_A_WALL, TEXT)
        self.assertEqual(view["summary"]["path"]["minClearance"]["distance"], 0)
        self.server.ask("DELETE", "/v1/views/" + view["id"])

    def test_the_head_of_a_connect_call_is_checked(self):
        def code(**headers):
            status, answer = self.server.ask_json(
                "POST", "/trc.v1.TrcService/GetServerInfo", "{}",
                {**JSON, **{name.replace("_", "-"): value for name, value in headers.items()}})
            return status, answer.get("code")

        self.assertEqual(code(Connect_Protocol_Version="1", Connect_Timeout_Ms="5000")[0], 200)
        for headers in ({"Connect_Protocol_Version": "2"}, {"Connect_Timeout_Ms": "soon"},
                        {"Connect_Timeout_Ms": "1000ms"}, {"Connect_Timeout_Ms": "-1"},
                        {"Connect_Timeout_Ms": "99999999999"}):
            self.assertEqual(code(**headers), (400, "invalid_argument"), headers)
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:verify?tool_radius=5", SQUARE,
            {**TEXT, "Connect-Timeout-Ms": "soon"})
        self.assertEqual((status, problem["reason"]), (400, "TIMEOUT_INVALID"))
        # What takes longer than its client waits ends.
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:verify?tool_radius=0.01", program_of(60_000),
            {**TEXT, "Connect-Timeout-Ms": "1"})
        self.assertEqual((status, problem["reason"]), (504, "DEADLINE_EXCEEDED"))

    def test_a_program_stopped_late_never_looks_whole(self):
        # More than an answer is held back, then an error.
        text = program_of(60000).replace("M30", "G999\nM30")
        done = subprocess.run(
            ["curl", "-sS", "--data-binary", "@-", "-H", "Content-Type: text/plain",
             self.url("/v1/programs:compensate?tool_radius=0.01")],
            input=text.encode(), capture_output=True, check=False, timeout=60)
        self.assertEqual(done.returncode, 18, "curl must see that the transfer is not complete")
        self.assertTrue(done.stdout.splitlines()[-1].startswith(b"!!! TRC STOPPED"))

    def test_wrong_settings_are_named(self):
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:compensate?tool_radios=5&plane=xx", SQUARE, TEXT)
        self.assertEqual(status, 400)
        self.assertEqual([field["field"] for field in problem["fields"]], ["tool_radios", "plane"])
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:compensate?tool_radius=1e9", SQUARE, TEXT)
        self.assertEqual((status, problem["reason"]), (400, "FIELD_INVALID"))

    def test_a_field_of_json_that_is_given_twice_is_refused(self):
        blocks = '"batch":{"blocks":[{"linear":{"end":{"x":1}}}]}'
        for body in ('{"setup":{"toolRadius":5},"setup":{"toolRadius":6},%s}' % blocks,
                     '{"setup":{"toolRadius":5,"tool_radius":6},%s}' % blocks,
                     "{%s,%s}" % (blocks, blocks)):
            status, problem = self.server.ask_json("POST", "/v1/paths:compensate", body, JSON)
            self.assertEqual((status, problem["reason"]), (400, "JSON_INVALID"), body)
            self.assertIn("is given more than once", problem["detail"])

    def test_a_setting_that_is_no_text_is_named(self):
        for name in ("client_tag", "language", "axis_names", "tools", "variables"):
            status, problem = self.server.ask_json(
                "POST", f"/v1/programs:compensate?tool_radius=5&{name}=%FF", SQUARE, TEXT)
            self.assertEqual((status, [field["field"] for field in problem["fields"]]),
                             (400, [name]), problem)
        # Only called so.
        status, _, _ = self.server.ask("POST", "/v1/programs:compensate?tool_radius=5&name=%FF",
                                       SQUARE, TEXT)
        self.assertEqual(status, 200)

    def test_what_is_too_large_in_a_program_is_its_fault(self):
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:compensate?tool_radius=5&wear=5", SQUARE, TEXT)
        self.assertEqual((status, problem["reason"]), (422, "WEAR_TOO_LARGE"))

    def test_there_are_no_tiles_outside(self):
        _, view = self.server.ask_json("POST", "/v1/views?tool_radius=5", SQUARE, TEXT)
        at = f"/v1/views/{view['id']}/tiles"
        for tile, status in (("0/0/0", 200), ("24/16777215/0", 200), ("25/0/0", 404),
                             ("16777215/0/0", 404), ("0/0/1", 404), ("3/8/0", 404),
                             ("18446744073709551616/0/0", 404), ("-1/0/0", 404)):
            self.assertEqual(self.server.ask("GET", f"{at}/{tile}")[0], status, tile)
        self.server.ask("DELETE", "/v1/views/" + view["id"])

    def test_this_machine_has_its_name_in_capitals_too(self):
        self.assertEqual(self.server.ask("GET", "/v1/info", headers={"Host": "LocalHost"})[0], 200)

    def test_a_setting_that_is_given_twice_is_refused(self):
        for query, named in (("tool_radius=5&tool_radius=6", "tool_radius"),
                             ("tool_radius=5&tool%5Fradius=5", "tool_radius"),
                             ("tool_radius=5&Tool-Radius=6", "Tool-Radius"),
                             ("stretch_factor=2&options.stretch_factor=3",
                              "options.stretch_factor"),
                             ("start_position=1,2,3&start_position.x=4", "start_position.x"),
                             ("dialect=isg&dialect=fanuc", "dialect"),
                             ("tools=1:5&tools=1:6", "tools"), ("name=a&name=b", "name")):
            status, problem = self.server.ask_json(
                "POST", "/v1/programs:compensate?" + query, SQUARE, TEXT)
            self.assertEqual((status, problem["fields"][0]["field"]), (400, named), query)
            self.assertIn("more than once", problem["fields"][0]["description"])
        for path in ("programs:surveyRadii?radii=3&radii=5", "views?shown_plane=xy&shown_plane=yz"):
            status, problem = self.server.ask_json("POST", "/v1/" + path, SQUARE, TEXT)
            self.assertEqual((status, problem["reason"]), (400, "QUERY_INVALID"), path)

    def test_a_parameter_where_there_is_none_is_refused(self):
        # A tool radius beside the message would be a path with another radius.
        status, problem = self.server.ask_json("POST", "/v1/paths:compensate?tool_radius=5", "{}",
                                               JSON)
        self.assertEqual((status, problem["reason"]), (400, "QUERY_INVALID"))
        self.assertEqual(problem["fields"][0]["field"], "tool_radius")
        for path in ("/v1/info?x=1", "/v1/openapi.json?x", "/?tool_radius=5", "/page/main.js?v=1"):
            self.assertEqual(self.server.ask("GET", path)[0], 400, path)
        status, error = self.server.ask_json("POST", "/trc.v1.TrcService/GetServerInfo?x=1", "{}",
                                             JSON)
        self.assertEqual((status, error["code"]), (400, "invalid_argument"))
        _, view = self.server.ask_json("POST", "/v1/views?tool_radius=5", SQUARE, TEXT)
        at = "/v1/views/" + view["id"]
        for path in ("/tiles/0/0/0?segments=many", "/tiles/0/0/0?segment=300", "/lines?from=-1",
                     "/output?count=2x", "/blocks?line=", "/blocks?line=3&line=4", "/place?share=2",
                     "/place?share=0.5x", "/place?share=nan", "?x=1"):
            self.assertEqual(self.server.ask("GET", at + path)[0], 400, path)
        self.assertEqual(self.server.ask("DELETE", at)[0], 204)

    def test_media_types_are_read_as_they_are_meant(self):
        def status(kind, path="/v1/programs:compensate?tool_radius=5", body=SQUARE):
            return self.server.ask("POST", path, body, {"Content-Type": kind})[0]

        for kind in ("TEXT/Plain", 'text/plain;charset="UTF-8"', "text/plain; format=flowed",
                     "text/plain; charset=us-ascii", "application/octet-stream"):
            self.assertEqual(status(kind), 200, kind)
        for kind in ("text/plain; charset=utf-16", "text/plain; x=y; Charset=ISO-8859-1",
                     "application/x-www-form-urlencoded", "multipart/form-data; boundary=x"):
            self.assertEqual(status(kind), 415, kind)
        # A view is made of the same text.
        for kind, expected in (("text/plain", 201), ("application/octet-stream", 201),
                               ("application/x-www-form-urlencoded", 415),
                               ("application/json", 415)):
            self.assertEqual(status(kind, "/v1/views?tool_radius=5"), expected, kind)
        path = "/v1/paths:compensate"
        blocks = '{"batch":{"blocks":[{"linear":{"end":{"x":1}}}]}}'
        self.assertEqual(status("Application/JSON; charset=UTF-8", path, blocks), 200)
        self.assertEqual(status("application/json; charset=utf-16", path, "{}"), 415)
        # What `curl -d` calls it.
        form = "application/x-www-form-urlencoded"
        self.assertEqual(status(form, path, blocks), 200)
        self.assertEqual(status("multipart/form-data; boundary=x", path, blocks), 415)
        for accept, kind in (("application/x-ndjson;q=0, text/plain", "text/plain"),
                             ("application/x-ndjson; q=0.5", "application/x-ndjson")):
            _, headers, _ = self.server.ask("POST", "/v1/programs:compensate?tool_radius=5", SQUARE,
                                            {**TEXT, "Accept": accept})
            self.assertTrue(headers["Content-Type"].startswith(kind), accept)

    def test_verify_measures(self):
        status, answer = self.server.ask_json(
            "POST", "/v1/programs:verify?tool_radius=5", SQUARE, TEXT)
        self.assertEqual(status, 200)
        self.assertAlmostEqual(answer["summary"]["minClearance"]["distance"], 5, places=4)
        self.assertNotIn("blocks", answer)

    def test_verify_refuses_or_reports_as_asked(self):
        def verified(how):
            return self.server.ask_json(
                "POST", f"/v1/programs:verify?tool_radius=5{how}", THROUGH_A_WALL, TEXT)

        self.assertEqual(verified("")[0], 422)
        self.assertEqual(verified("&verify=enforce")[0], 422)
        status, answer = verified("&verify=report")
        self.assertEqual(status, 200)
        self.assertEqual(answer["summary"]["minClearance"]["distance"], 0)
        status, problem = verified("&verify=off")
        self.assertEqual((status, problem["reason"]), (400, "SETTING_INVALID"))
        self.assertIn("enforce, report", problem["detail"])

    def test_verify_of_a_path_refuses_or_reports_as_asked(self):
        # A pocket with a neck of 8 mm, which G140 does not see.
        corners = [(0, 25), (0, 0), (100, 0), (100, 50), (60, 50), (60, 8), (40, 8), (40, 50),
                   (0, 50), (0, 25)]
        inside = {"linear": {"end": {"x": 20, "y": 25}}}
        blocks = ([inside, {"command": {"side": "COMPENSATION_SIDE_LEFT"}}] +
                  [{"linear": {"end": {"x": x, "y": y}}} for x, y in corners] +
                  [{"command": {"side": "COMPENSATION_SIDE_OFF"}}, inside])

        def verified(**setup):
            return self.server.ask_json(
                "POST", "/v1/paths:verify",
                json.dumps({"setup": {"toolRadius": 5, **setup}, "batch": {"blocks": blocks}}),
                JSON)

        refused = [verified()[0], verified(verify="VERIFICATION_ENFORCE")[0]]
        self.assertEqual(refused, [422, 422])
        status, answer = verified(verify="VERIFICATION_REPORT")
        self.assertEqual(status, 200, answer)
        self.assertAlmostEqual(answer["summary"]["minClearance"]["distance"], 3)
        status, problem = verified(verify="VERIFICATION_OFF")
        self.assertEqual((status, problem["reason"]), (400, "SETTING_INVALID"))
        self.assertIn("setup.verify: it takes VERIFICATION_ENFORCE, VERIFICATION_REPORT",
                      problem["detail"])

    def test_a_record_is_what_trc_files(self):
        with tempfile.TemporaryDirectory() as folder:
            program, record = (os.path.join(folder, name) for name in ("part.nc", "part.json"))
            with open(program, "w", encoding="ascii") as file:
                file.write(SQUARE)
            code, _ = trc("compensate", program, "--set", "tool_radius=5", "-o",
                          os.path.join(folder, "out.nc"), "--record", record)
            self.assertEqual(code, 0)
            with open(record, encoding="utf-8") as file:
                filed = json.load(file)
        status, told = self.server.ask_json(
            "POST", "/v1/programs:record?tool_radius=5", SQUARE, TEXT)
        self.assertEqual(status, 200)
        self.assertEqual(set(filed) - set(told), set())
        for key in ("format", "outputFormat", "outcome", "serverVersion"):
            self.assertEqual(told[key], filed[key], key)
        for key in ("minClearance", "blocksByOrigin"):
            self.assertEqual(told["summary"]["path"][key], filed["summary"]["path"][key], key)
        for key in ("sha256", "bytes"):
            self.assertEqual(told["input"][key], filed["input"][key])
            self.assertEqual(told["output"][key], filed["output"][key])
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:record", "N10 G999\n", TEXT)
        self.assertEqual((status, problem["diagnostics"][0]["code"]), (422, 900002))

    def test_a_view_is_seen_across_the_plane_that_is_asked_for(self):
        # Down to Z-2 in two steps; from the side a box of 60 by 3.
        program = ("N10 G00 X-20 Y0 Z1\nN20 G41 G01 X0 Y0 Z0 F500\nN30 X40 Z-1\nN40 Y40 Z-2\n"
                   "N50 X0\nN60 G40 X-20\nN70 M30\n")
        seen = {}
        for plane in ("", "xy", "zx", "yz"):
            query = "?tool_radius=5" + (plane and "&shown_plane=" + plane)
            status, seen[plane] = self.server.ask_json("POST", "/v1/views" + query, program, TEXT)
            self.assertEqual(status, 201)
            self.assertEqual(seen[plane]["ownPlane"], "PLANE_XY")
            self.assertEqual(seen[plane]["unit"], "LENGTH_UNIT_MM")
            for same in ("pathBlocks", "contourBlocks"):
                self.assertEqual(seen[plane][same], seen[""][same])
        self.assertEqual(seen[""]["plane"], "PLANE_XY")
        self.assertEqual((seen["xy"]["low"], seen["xy"]["high"]), (seen[""]["low"], seen[""]["high"]))
        # First axis Z, second X; then Y and Z.
        self.assertEqual((seen["zx"]["low"]["x"], seen["zx"]["high"]["x"]), (-2, 1))
        self.assertEqual((seen["yz"]["low"]["y"], seen["yz"]["high"]["y"]), (-2, 1))
        self.assertAlmostEqual(seen["zx"]["low"]["y"], -20)
        status, problem = self.server.ask_json(
            "POST", "/v1/views?shown_plane=xz", program, TEXT)
        self.assertEqual((status, problem["reason"]), (400, "SETTING_INVALID"))
        self.assertIn("xy, zx, yz", problem["detail"])

    def test_a_survey_tells_of_many_radii(self):
        status, answer = self.server.ask_json(
            "POST", "/v1/programs:surveyRadii?radii=2:6:2&uncut=true&selection_mode=G138", SQUARE,
            TEXT)
        self.assertEqual(status, 200)
        self.assertEqual([found["radius"] for found in answer["radii"]], [2, 4, 6])
        self.assertTrue(answer["radii"][0]["accepted"])
        self.assertIn("largest", answer["summary"])
        code, told = trc("radii", "-", "--radii", "2:6:2", "--set", "selection_mode=G138",
                         "--json", text=SQUARE.encode())
        self.assertEqual(code, 0)
        same = json.loads(told)
        self.assertEqual(same["radii"], answer["radii"])
        self.assertEqual(same["summary"]["largest"], answer["summary"]["largest"])

        for query in ("radii=three", "radii=3&uncut=perhaps", "radii=3&tool_radios=5"):
            status, problem = self.server.ask_json(
                "POST", "/v1/programs:surveyRadii?" + query, SQUARE, TEXT)
            self.assertEqual((status, problem["reason"]), (400, "SETTING_INVALID"), query)
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:surveyRadii?radii=-3", SQUARE, TEXT)
        self.assertEqual((status, problem["reason"]), (400, "FIELD_INVALID"))
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:surveyRadii?radii=3", "N10 G999\n", TEXT)
        self.assertEqual((status, problem["diagnostics"][0]["code"]), (422, 900002))

    def test_paths_take_and_give_json(self):
        path = {"setup": {"toolRadius": 5}, "batch": {"blocks": [
            {"command": {"side": "COMPENSATION_SIDE_LEFT"}},
            {"linear": {"end": {"x": 10, "y": 0}}}, {"linear": {"end": {"x": 50}}},
            {"command": {"side": "COMPENSATION_SIDE_OFF"}},
            {"linear": {"end": {"x": 60, "y": -20}}}]}}
        json_type = {"Content-Type": "application/json"}
        status, answer = self.server.ask_json("POST", "/v1/paths:compensate", json.dumps(path),
                                              json_type)
        self.assertEqual(status, 200)
        self.assertEqual(answer["blocks"][0]["origin"], "APPROACH")
        self.assertIn("summary", answer)
        _, _, lines = self.server.ask("POST", "/v1/paths:compensate", json.dumps(path),
                                      {**json_type, "Accept": "application/x-ndjson"})
        blocks = [json.loads(line)["block"] for line in lines.splitlines() if b'"block"' in line]
        self.assertEqual(blocks, answer["blocks"])
        path["batch"]["blocks"][1]["linear"]["end"]["x"] = "NaN"
        status, problem = self.server.ask_json("POST", "/v1/paths:compensate", json.dumps(path),
                                               json_type)
        self.assertEqual((status, problem["fields"][0]["field"]),
                         (400, "batch.blocks[1].linear.end.x"))
        status, problem = self.server.ask_json("POST", "/v1/paths:compensate", '{"setop":{}}',
                                               json_type)
        self.assertEqual((status, problem["reason"]), (400, "JSON_INVALID"))
        self.assertEqual(problem["detail"],
                         "setop: there is no such field; did you mean setup?")
        status, problem = self.server.ask_json(
            "POST", "/v1/paths:compensate", '{"setup":{"toolRadius":"5,5"}}',
            {**json_type, "Accept-Language": "de"})
        self.assertEqual(problem["detail"],
                         'setup.tool_radius: "5,5" ist nicht möglich; es nimmt eine Zahl')

    def test_what_a_tool_differs_by_may_be_said_in_every_way(self):
        at = "/v1/programs:compensate"
        whole = self.server.ask("POST", at + "?tool_radius=5.18", SQUARE, TEXT)[2]
        terms = "?tool_radius=5&wear=0.08&allowance=0.1"
        self.assertEqual(self.server.ask("POST", at + terms, SQUARE, TEXT)[2], whole)
        head = "V.G.WZ_AKT.R = 5\nV.G.WZ_AKT.R = V.G.WZ_AKT.R + 0.18\n"
        written = self.server.ask("POST", at, head + SQUARE, TEXT)[2]
        self.assertTrue(written.endswith(whole), written)

        corners = [(0, 0), (0, 50), (50, 50), (50, 0), (0, 0)]
        blocks = ([{"linear": {"end": {"x": -20, "y": -20}}},
                   {"command": {"side": "COMPENSATION_SIDE_LEFT"}}] +
                  [{"linear": {"end": {"x": x, "y": y}}} for x, y in corners] +
                  [{"command": {"side": "COMPENSATION_SIDE_OFF"}},
                   {"linear": {"end": {"x": -20, "y": -20}}}])
        answers = []
        for setup in ({"toolRadius": 5.18}, {"toolRadius": 5, "wear": 0.08, "allowance": 0.1}):
            status, answer = self.server.ask_json(
                "POST", "/v1/paths:compensate",
                json.dumps({"setup": {**setup, "verify": "VERIFICATION_REPORT"},
                            "batch": {"blocks": blocks}}), JSON)
            self.assertEqual(status, 200, answer)
            answers.append(answer)
        self.assertEqual(answers[0]["blocks"], answers[1]["blocks"])
        said = answers[1]["summary"]
        self.assertEqual((said["effectiveRadius"], said["wear"], said["allowance"]),
                         (5.18, 0.08, 0.1))
        self.assertAlmostEqual(said["certificate"]["clearance"], 5.18)

        # The centre path of a tool of 5 mm, and one that is worn by 0.02 mm.
        centre = ("G00 X-20 Y-20\nG41 G01 X-5 Y-5 F500\nY55\nX55\nY-5\nX-5\n"
                  "G40 X-20 Y-20\nM30\n")
        query = "/v1/programs:compensate?nominal_radius=5&wear="
        worn = self.server.ask("POST", query + "-0.02", centre, TEXT)[2].decode()
        for corner in ("X-4.98 Y54.98", "X54.98 Y54.98", "X54.98 Y-4.98"):
            self.assertIn(corner, worn)
        # It is the program that is at fault, and no request that is too large.
        status, problem = self.server.ask_json("POST", query + "5", centre, TEXT)
        self.assertEqual((status, problem["diagnostics"][0]["code"]), (422, 900222))
        self.assertEqual(problem["title"], "The program cannot be compensated")
        outside = ("G00 X60 Y-40\nG238 G41 G01 X0 Y0 F1000\nY100\nX100\nY0\nX0\n"
                   "G40 X60 Y-40\nM30\n")
        status, problem = self.server.ask_json(
            "POST", "/v1/programs:compensate?tool_radius=5", outside, TEXT)
        self.assertEqual((status, problem["diagnostics"][0]["code"]), (422, 90130), problem)

    def test_a_survey_of_a_path_is_that_of_its_program(self):
        setup = {"radii": [2, 4, 21], "wantUncut": True,
                 "path": {"selectionMode": "SELECTION_MODE_DIRECT"}}
        lines = [(0, -20), (0, 40), (40, 40), (40, 0), (0, 0)]
        kinds, present = bytes([5, 1, 1, 1, 1, 1, 5, 1]), bytes([0, 3, 3, 3, 3, 3, 0, 3])
        ends = lines + [(-20, 0)]
        sides = [{"side": "COMPENSATION_SIDE_LEFT"}, {"side": "COMPENSATION_SIDE_OFF"}]
        blocks = ([{"command": sides[0]}] +
                  [{"linear": {"end": {"x": x, "y": y}}} for x, y in lines] +
                  [{"command": sides[1]}, {"linear": {"end": {"x": ends[-1][0],
                                                              "y": ends[-1][1]}}}])
        columns = {"kinds": base64.b64encode(kinds).decode(),
                   "present": base64.b64encode(present).decode(),
                   "x": [x for x, _ in ends], "y": [y for _, y in ends],
                   "commands": [{"index": 0, "command": sides[0]},
                                {"index": 6, "command": sides[1]}]}
        at = "/v1/paths:surveyRadii"
        answers = []
        for path in ({"batch": {"blocks": blocks}}, {"columns": columns}):
            status, answer = self.server.ask_json("POST", at, json.dumps({"setup": setup, **path}),
                                                  JSON)
            self.assertEqual(status, 200, answer)
            del answer["summary"]["wallTimeSeconds"]
            answers.append(answer)
        self.assertEqual(answers[0], answers[1])
        program = "G17 G90 G138 G41 G1 F500" + "".join(
            f" X{x} Y{y}\n" for x, y in lines) + "G40 X-20 Y0\nM30\n"
        status, same = self.server.ask_json(
            "POST", "/v1/programs:surveyRadii?radii=2,4,21&uncut=true", program, TEXT)
        self.assertEqual(status, 200)
        self.assertEqual([found["radius"] for found in answers[0]["radii"]], [2, 4, 21])
        for found, other in zip(answers[0]["radii"], same["radii"], strict=True):
            for name in ("accepted", "reachesEveryWall", "compensatedLength", "programmedLength",
                         "wallLength", "uncutLength"):
                self.assertEqual(found.get(name), other.get(name), name)
        self.assertEqual(answers[0]["summary"]["largest"]["radius"],
                         same["summary"]["largest"]["radius"])

        # All that is wrong has its place.
        for body, reason, field in (
                ('{"setop":{}}', "JSON_INVALID", None),
                ('{"setup":{"radii":[-3]},"batch":{"blocks":[{"linear":{}}]}}', "FIELD_INVALID",
                 "setup.radii[0]"),
                ('{"setup":{"radii":[3],"program":{}},"batch":{"blocks":[{"linear":{}}]}}',
                 "FIELD_INVALID", "batch"),
                ('{"setup":{"radii":[3]},"batch":{"blocks":[{"linear":{"end":{"x":"NaN"}}}]}}',
                 "FIELD_INVALID", "batch.blocks[0].linear.end.x")):
            status, problem = self.server.ask_json("POST", at, body, JSON)
            self.assertEqual((status, problem["reason"]), (400, reason), body)
            if field:
                self.assertEqual(problem["fields"][0]["field"], field)
        self.assertEqual(self.server.ask("POST", at, "{}", TEXT)[0], 415)

    def test_a_path_of_nothing_is_refused(self):
        for path in ("compensate", "verify", "surveyRadii"):
            for body in ("{}", '{"setup":{}}', '{"batch":{}}', '{"columns":{}}'):
                status, problem = self.server.ask_json("POST", "/v1/paths:" + path, body, JSON)
                self.assertEqual((status, problem["reason"]), (400, "PATH_EMPTY"), path + body)

    def test_a_program_that_can_never_fit_is_not_asked_for_again(self):
        staircase = "G141\nG1 G41 V.G.WZ_AKT.R=0.01 X1 Y1 F800\nG91\n" + "X1\nY1\n" * 50_000
        for reason, setting, value, program in (
                ("MEMORY_LIMIT", "max-session-memory-mib", "16", staircase),
                ("CPU_LIMIT", "max-selection-cpu-s", "1", laps(1000))):
            with Server("--" + setting, value) as server:
                status, headers, body = server.ask("POST", "/v1/programs:compensate", program, TEXT)
            problem = json.loads(body)
            self.assertEqual((status, problem["reason"]), (413, reason), problem)
            self.assertIsNone(headers["Retry-After"])
            self.assertIn(setting, problem["detail"])

    def test_a_path_that_can_never_fit_is_not_asked_for_again(self):
        def lines(count):
            return [{"linear": {"end": {"x": i + 0.12345678, "y": 0.12345678}}}
                    for i in range(count)]

        def ask(blocks, headers):
            body = json.dumps({"batch": {"blocks": blocks}})
            status, answered, problem = self.server.ask("POST", "/v1/paths:compensate", body,
                                                        {**JSON, **headers})
            self.assertEqual((status, answered["Retry-After"]), (413, None))
            return json.loads(problem)

        problem = ask([{"passthrough": {"text": "M8 " * 3000}}] * 200, {})
        self.assertEqual(problem["reason"], "MESSAGE_TOO_LARGE")
        self.assertIn("max-message-bytes", problem["detail"])
        # So many are refused before they are read.
        problem = ask(lines(50_000), {})
        self.assertEqual(problem["reason"], "BATCH_TOO_LARGE")
        problem = ask(lines(4500), {})
        self.assertEqual(problem["reason"], "BATCH_TOO_LARGE")
        self.assertIn("divide the path", problem["detail"])
        self.assertNotIn("smaller batches", problem["detail"])
        self.assertRegex(ask(lines(4500), {"Accept-Language": "de"})["detail"],
                         "^sie hat 4500 Sätze")

    def test_every_problem_is_in_the_language_that_is_preferred(self):
        german = {"Accept-Language": "de-AT, en;q=0.5"}
        compensate = "/v1/programs:compensate"
        for method, path, body, kind, title, detail in (
                ("GET", "/nix", None, {}, "Unter diesem Pfad gibt es nichts",
                 "was es gibt, steht in /v1/openapi.json"),
                ("DELETE", "/v1/info", None, {}, "Diese Methode ist hier nicht möglich",
                 "möglich sind GET, HEAD"),
                ("POST", compensate + "?tool_radius=abc", SQUARE, TEXT,
                 "Ein Parameter der Adresse ist keine mögliche Einstellung",
                 'tool_radius: "abc" ist nicht möglich; es nimmt eine Zahl'),
                ("POST", compensate + "?tool_radius=1e9", SQUARE, TEXT,
                 "Ein Wert der Anfrage ist nicht möglich",
                 "setup.path.tool_radius ist 1e+09, erlaubt ist -214748.3647 bis 214748.3647 mm"),
                ("GET", "/v1/info?x=1", None, {}, "Ein Parameter der Adresse ist nicht möglich",
                 "x ist nicht bekannt: Parameter gibt es hier keine"),
                ("POST", "/v1/paths:compensate", '{"nix":1}', JSON,
                 "Der Inhalt ist kein PreviewPathRequest", "nix: dieses Feld gibt es nicht"),
                ("POST", compensate, SQUARE, JSON, "Der Inhalt muss NC-Text sein",
                 "ihn als text/plain; charset=utf-8 senden")):
            _, problem = self.server.ask_json(method, path, body, {**kind, **german})
            self.assertEqual((problem["title"], problem["detail"]), (title, detail), path)
            _, problem = self.server.ask_json(method, path, body, kind)
            self.assertNotEqual(problem["title"], title)

    def test_every_connect_error_has_a_reason(self):
        def reason(method, body, **headers):
            _, error = self.server.ask_json("POST", "/trc.v1.TrcService/" + method, body,
                                            {**JSON, **headers})
            self.assertEqual(error["details"][0]["type"], "google.rpc.ErrorInfo")
            self.assertNotRegex(error["message"], r"\^|\n|  ")
            value = error["details"][0]["value"]
            message = base64.b64decode(value + "=" * (-len(value) % 4))
            return error["code"], message[2:2 + message[1]].decode()

        once = "CompensateProgramOnce"
        unreadable = ("invalid_argument", "REQUEST_UNREADABLE")
        self.assertEqual(reason(once, '{"nix":1}'), unreadable)
        _, misspelt = self.server.ask_json("POST", "/trc.v1.TrcService/" + once,
                                           '{"setup":{"path":{"toolRadus":1}}}', JSON)
        self.assertEqual(misspelt["message"],
                         "the JSON of the request cannot be taken: setup.path.toolRadus: there is "
                         "no such field; did you mean toolRadius?")
        self.assertEqual(reason(once, "{"), unreadable)
        self.assertEqual(reason(once, "{}", **{"Connect-Protocol-Version": "2"}),
                         ("invalid_argument", "CALL_INVALID"))
        self.assertEqual(reason("CompensateProgram", "{}"),
                         ("unimplemented", "STREAM_NEEDS_GRPC"))
        text = json.dumps({"setup": {"path": {"toolRadius": 0.01}}, "text": program_of(15_000)})
        self.assertEqual(reason(once, text, **{"Connect-Timeout-Ms": "1"}),
                         ("deadline_exceeded", "DEADLINE_EXCEEDED"))

    def test_an_rpc_that_there_is_not_is_told_those_there_are(self):
        for path in ("/trc.v1.TrcService/NoSuch", "/trc.v2.TrcService/PreviewPath"):
            status, problem = self.server.ask_json("POST", path, "{}", JSON)
            self.assertEqual((status, problem["reason"]), (404, "NOT_FOUND"))
            self.assertIn("there is no such RPC; trc.v1.TrcService has CompensatePath, ",
                          problem["detail"])
            self.assertIn("PreviewPath", problem["detail"])

    def test_connect_unary_in_both_codecs(self):
        rpc = "/trc.v1.TrcService/"
        status, info = self.server.ask_json("POST", rpc + "GetServerInfo", "{}",
                                            {"Content-Type": "application/json"})
        self.assertEqual(status, 200)
        self.assertEqual(info, self.server.ask_json("GET", "/v1/info")[1])
        body = {"setup": {"path": {"toolRadius": 5}}, "text": SQUARE}
        status, once = self.server.ask_json("POST", rpc + "CompensateProgramOnce",
                                            json.dumps(body), {"Content-Type": "application/json"})
        self.assertEqual(once["ncText"].encode(), self.expected("--set", "tool_radius=5"))
        status, headers, binary = self.server.ask("POST", rpc + "GetServerInfo", b"",
                                                  {"Content-Type": "application/proto"})
        self.assertEqual((status, headers["Content-Type"]), (200, "application/proto"))
        self.assertIn(info["version"].encode(), binary)
        body["text"] = NOTCH
        status, error = self.server.ask_json("POST", rpc + "CompensateProgramOnce",
                                             json.dumps(body), {"Content-Type": "application/json"})
        self.assertEqual((status, error["code"]), (400, "invalid_argument"))
        self.assertEqual(error["details"][0]["type"], "google.rpc.ErrorInfo")

    def test_connect_streams_in_envelopes(self):
        def envelope(message):
            text = json.dumps(message).encode()
            return struct.pack(">BI", 0, len(text)) + text

        def messages(body):
            while body:
                flags, size = struct.unpack(">BI", body[:5])
                yield flags, json.loads(body[5:5 + size])
                body = body[5 + size:]

        path = {"setup": {"toolRadius": 5}, "batch": {"blocks": [
            {"linear": {"end": {"x": 10, "y": 0}}}]}}
        kind = {"Content-Type": "application/connect+json"}
        _, headers, body = self.server.ask("POST", "/trc.v1.TrcService/PreviewPath",
                                           envelope(path), kind)
        self.assertEqual(headers["Content-Type"], "application/connect+json")
        got = list(messages(body))
        self.assertIn("batch", got[0][1])
        self.assertIn("summary", got[-2][1])
        self.assertEqual(got[-1], (2, {}))
        _, _, body = self.server.ask("POST", "/trc.v1.TrcService/PreviewPath", envelope({}), kind)
        flags, end = list(messages(body))[-1]
        self.assertEqual((flags, end["error"]["code"]), (2, "failed_precondition"))
        status, error = self.server.ask_json("POST", "/trc.v1.TrcService/CompensatePath", "{}",
                                             {"Content-Type": "application/json"})
        self.assertEqual((status, error["code"]), (501, "unimplemented"))

    def test_the_server_says_what_it_can_do(self):
        for target in ("*", f"http://localhost:{self.server.port}"):
            status, headers, body = self.server.ask("OPTIONS", target)
            self.assertEqual((status, body), (204, b""))
            self.assertEqual(headers["Allow"], "POST, GET, HEAD, DELETE, OPTIONS")
        status, headers, _ = self.server.ask("OPTIONS", f"http://localhost:{self.server.port}/v1/info")
        self.assertEqual((status, headers["Allow"]), (204, "GET, HEAD, OPTIONS"))
        self.assertEqual(self.server.ask("OPTIONS", "/nothing")[0], 404)

    def test_the_open_api_document_says_what_is_there(self):
        _, document = self.server.ask_json("GET", "/v1/openapi.json")
        self.assertTrue(document["openapi"].startswith("3."))
        for path, operations in document["paths"].items():
            there = path.replace("{id}", "0").replace("{level}", "0").replace("{x}", "0")
            there = there.replace("{y}", "0").replace("{token}", "0").replace("{file}", "main.js")
            for method in operations:
                status, _, _ = self.server.ask(method.upper(), there, "",
                                               {"Content-Type": "application/json"})
                self.assertNotIn(status, (405, 500, 501), f"{method} {path}")
            status, headers, _ = self.server.ask("PUT", there)
            self.assertEqual(status, 405)
            self.assertIn(list(operations)[0].upper(), headers["Allow"])
            self.assertRegex(headers["Date"], r"^\w{3}, \d\d \w{3} \d{4} \d\d:\d\d:\d\d GMT$")
            self.assertIn(list(operations)[0].upper(),
                          self.server.ask("OPTIONS", there)[1]["Allow"])
        said = [operation["operationId"] for operations in document["paths"].values()
                for operation in operations.values()]
        self.assertEqual(len(said), len(set(said)))

        def answers(method, path):
            return document["paths"][path][method]["responses"]
        for method, path, status in (("post", "/v1/views", "201"), ("get", "/v1/info", "200"),
                                     ("delete", "/v1/views/{id}", "204")):
            self.assertEqual(list(answers(method, path)), [status, "default"])
        for method, path, message in (
                ("get", "/v1/info", "GetServerInfoResponse"), ("post", "/v1/views", "View"),
                ("post", "/v1/programs:verify", "PathAnswer"),
                ("post", "/v1/programs:record", "JobRecord"),
                ("post", "/v1/paths:surveyRadii", "SurveyAnswer")):
            good = next(iter(answers(method, path).values()))
            self.assertEqual(good["content"]["application/json"]["schema"]["$ref"],
                             "#/components/schemas/" + message)
        good = answers("post", "/v1/programs:compensate")["200"]
        self.assertIn("Trc-Status", good["headers"])
        self.assertIn("Retry-After", answers("get", "/v1/info")["default"]["headers"])
        error = answers("post", "/trc.v1.TrcService/CompensateProgramOnce")["default"]
        self.assertEqual(error["content"]["application/json"]["schema"]["$ref"],
                         "#/components/schemas/ConnectError")
        names = {p["name"] for p in
                 document["paths"]["/v1/programs:compensate"]["post"]["parameters"]}
        self.assertLessEqual({"tool_radius", "options.stretch_factor", "decimals"}, names)

        def schema(path, name):
            found = [p for p in document["paths"][path]["post"]["parameters"] if p["name"] == name]
            return {**found[0], **found[0]["schema"]}
        axis = schema("/v1/views", "options.split.axis")
        self.assertEqual((axis["type"], axis["minimum"], axis["maximum"]), ("integer", 1, 3))
        self.assertIn("1 for X, 2 for Y, 3 for Z", axis["description"])
        share = schema("/v1/views", "max_masked_share")
        self.assertEqual((share["minimum"], share["maximum"], share["default"]), (0, 1, 0.5))
        self.assertEqual(schema("/v1/views", "transition")["enum"], ["linear", "circular"])
        self.assertEqual(schema("/v1/views", "closing_tolerance")["x-unit"], "mm")
        self.assertEqual(schema("/v1/views", "verify")["default"], "report")
        verify = schema("/v1/programs:verify", "verify")
        self.assertEqual((verify["default"], verify["enum"]), ("enforce", ["enforce", "report"]))
        self.assertEqual(schema("/v1/programs:compensate", "verify")["default"], "off")
        # A value that is said to be refused is, and one that is said to be taken is.
        for name, taken, refused in (("max_masked_share", "1", "1.001"),
                                     ("decimals", "8", "9"), ("input_resolution", "0.1", "0.101")):
            for value, expected in ((taken, 200), (refused, 400)):
                path = f"/v1/programs:compensate?tool_radius=5&{name}={value}"
                self.assertEqual(self.server.ask("POST", path, SQUARE, TEXT)[0], expected, path)

        def references(node):
            if isinstance(node, dict):
                if "$ref" in node:
                    yield node["$ref"].rpartition("/")[2]
                for value in node.values():
                    yield from references(value)
            elif isinstance(node, list):
                for value in node:
                    yield from references(value)
        self.assertLessEqual(set(references(document)), set(document["components"]["schemas"]))
        for path, message in (("compensate", "PreviewPathRequest"),
                              ("verify", "PreviewPathRequest"),
                              ("surveyRadii", "SurveyPathRequest")):
            content = document["paths"]["/v1/paths:" + path]["post"]["requestBody"]["content"]
            self.assertEqual(list(references(content)), [message])

    @staticmethod
    def segments_of(tile):
        """Line, style with flags and radius of the tool of each segment."""
        return [struct.unpack_from("<IIf", tile, at + 20) for at in range(16, len(tile), 36)]

    def styles_in(self, view, level, point):
        """How many segments of each style the tile around a point has."""
        side = view["tileSize"] / 2 ** level
        low = view["tileLow"]
        x, y = (int((point[i] - low.get("xy"[i], 0)) / side) for i in (0, 1))
        status, _, tile = self.server.ask("GET", f"/v1/views/{view['id']}/tiles/{level}/{x}/{y}")
        self.assertEqual((status, tile[:4]), (200, b"TRCT"))
        styles = {}
        for _, word, _ in self.segments_of(tile):
            styles[word & 0xff] = styles.get(word & 0xff, 0) + 1
        self.assertLessEqual(sum(styles.values()), 2048)
        return styles

    def test_what_matters_is_seen_at_every_zoom(self):
        # A wall of 50 m in 100,000 pieces, and a notch of 0.02 mm that the tool leaves out.
        wall = [f"G01 X{i / 2:.1f} Y{i % 2 * 0.01:.2f}" for i in range(1, 100_001)]
        wall.insert(60_000, "G01 X30000.1 Y0\nG01 Y-0.02\nG01 X30000.12\nG01 Y0")
        text = "\n".join(["G141 G26", "G00 X-20 Y-20", "G41 G01 X0 Y0 F500", *wall,
                          "G40 G01 X50020 Y20", "M30", ""])
        _, view = self.server.ask_json("POST", "/v1/views?tool_radius=0.05", text, TEXT)
        self.assertNotIn("refused", view, view.get("diagnostics"))
        masked, inserted = 1, 3
        for level in range(0, 22, 3):
            styles = self.styles_in(view, level, (30000.11, -0.01))
            self.assertGreater(styles.get(masked, 0), 0, level)
        for level in range(0, 16, 3):
            styles = self.styles_in(view, level, (30000.11, 0.05))
            self.assertGreater(styles.get(inserted, 0), 0, level)
        self.server.ask("DELETE", "/v1/views/" + view["id"])

    def test_walls_are_apart_from_what_leads_to_them(self):
        _, view = self.server.ask_json("POST", "/v1/views?tool_radius=5", SQUARE, TEXT)
        contour, beside = 0, 5
        styles = self.styles_in(view, 0, (25, 25))
        # Four sides; the approach and the retract.
        self.assertEqual((styles[contour], styles[beside]), (4, 2))
        self.server.ask("DELETE", "/v1/views/" + view["id"])

    def test_a_notch_that_kerf_masking_fills_is_not_travelled(self):
        text = ("G00 X-60 Y0 F1000\n#TRC[KERF_MASKING=1]\nG26 G41 G01 X-40\nX-5\nX0 Y-20\nX5 Y0\n"
                "X40\nG40 X60\nM30\n")
        _, view = self.server.ask_json("POST", "/v1/views?tool_radius=10", text, TEXT)
        _, _, tile = self.server.ask("GET", f"/v1/views/{view['id']}/tiles/0/0/0")
        self.server.ask("DELETE", "/v1/views/" + view["id"])
        masked = 1
        lines = {line for line, word, _ in self.segments_of(tile) if word & 0x2ff == masked}
        self.assertEqual(lines, {5, 6})

    def test_an_arc_that_leads_to_a_wall_is_none(self):
        # A hole of 40 mm with a quarter in and a quarter out.
        hole = ("G0 X0 Y0\nG41 G1 X10 Y-10 F600\nG3 X20 Y0 I0 J10\nG3 I-20 J0\n"
                "G3 X10 Y10 I-10 J0\nG40 G1 X0 Y0\nM30\n")

        def contour(query):
            _, view = self.server.ask_json("POST", "/v1/views?tool_radius=6" + query, hole, TEXT)
            _, _, tile = self.server.ask("GET", f"/v1/views/{view['id']}/tiles/0/0/0")
            self.server.ask("DELETE", "/v1/views/" + view["id"])
            return {line: word & 0xff for line, word, _ in self.segments_of(tile)
                    if not word & 1 << 9}

        self.assertEqual(contour(""), {2: 5, 3: 4, 4: 0, 5: 4, 6: 5})
        # The settings say otherwise.
        self.assertEqual(contour("&leads=none"), {2: 5, 3: 0, 4: 0, 5: 0, 6: 5})

    def test_an_arc_stays_one_where_it_is_seen(self):
        hole = ("G0 X0 Y0\nG41 G1 X10 Y-10 F600\nG3 X20 Y0 I0 J10\nG3 I-20 J0\n"
                "G3 X10 Y10 I-10 J0\nG40 G1 X0 Y0\nG0 X%d\nM30\n")

        def wall(text, level):
            """Side of the tile around X20 Y0, and of the wall in it: ends, centres, sweeps."""
            _, view = self.server.ask_json("POST", "/v1/views?tool_radius=6", text, TEXT)
            side = view["tileSize"] / 2 ** level
            low = [view["tileLow"].get(axis, 0) for axis in "xy"]
            at = [int((value - least) / side) for value, least in zip((20, 0), low)]
            low = [least + side * n for least, n in zip(low, at)]
            _, _, tile = self.server.ask("GET", f"/v1/views/{view['id']}/tiles/{level}/{at[0]}/{at[1]}")
            self.server.ask("DELETE", "/v1/views/" + view["id"])
            parts = []
            for begin in range(16, len(tile), 36):
                ax, ay, bx, by, _, line, word, _, sweep = struct.unpack_from("<4f3I2f", tile, begin)
                if line != 4 or word & 1 << 9:
                    continue
                across = 0.5 / math.tan(sweep / 2) if sweep else 0
                parts.append(((ax, ay, bx, by), ((ax + bx) / 2 - across * (by - ay) + low[0],
                                                 (ay + by) / 2 + across * (bx - ax) + low[1]), sweep))
            return side, parts

        _, whole = wall(hole % 0, 0)
        self.assertAlmostEqual(sum(sweep for _, _, sweep in whole), 2 * math.pi, places=4)
        side, near = wall(hole % 0, 6)
        self.assertTrue(near)
        for ends, _, _ in near:
            self.assertTrue(all(-side / 100 <= value <= side * 1.01 for value in ends), ends)
        for _, (x, y), sweep in whole + [part for part in near if part[2]]:  # a dot is a line
            self.assertLess(math.hypot(x, y), 1e-3)
            self.assertTrue(0 < sweep <= math.pi, sweep)
        # Less than a pixel there.
        _, far = wall(hole % 200_000, 0)
        self.assertTrue(far and all(sweep == 0 for _, _, sweep in far), far)

    def test_a_contour_of_many_blocks_is_none_of_what_leads_to_it(self):
        for blocks in (3000, 300_000):
            _, text = trc("generate", "--blocks", str(blocks), "--shape", "random")
            _, view = self.server.ask_json("POST", "/v1/views", text, TEXT)
            _, _, tile = self.server.ask("GET", f"/v1/views/{view['id']}/tiles/0/0/0")
            self.server.ask("DELETE", "/v1/views/" + view["id"])
            of = {path: [word & 0xff for _, word, _ in self.segments_of(tile)
                         if bool(word & 1 << 9) == path] for path in (False, True)}
            self.assertGreater(of[False].count(0), 0.95 * len(of[False]), blocks)
            self.assertLessEqual(of[True].count(4), 2, blocks)
            self.assertGreater(of[True].count(2), 100, blocks)

    def test_the_tool_on_its_way_is_that_of_the_block(self):
        _, view = self.server.ask_json("POST", "/v1/views?tool_radius=5", SQUARE, TEXT)
        at = f"/v1/views/{view['id']}/place?share="
        place = self.server.ask_json("GET", at + "0.5")[1]
        self.assertEqual((place["block"]["toolRadius"], place["position"]["y"]), (5, 55))
        # It is still there on its way out.
        self.assertEqual(self.server.ask_json("GET", at + "1")[1]["block"]["toolRadius"], 5)
        # Before G41 there is none.
        self.assertNotIn("toolRadius", self.server.ask_json("GET", at + "0")[1]["block"])
        self.server.ask("DELETE", "/v1/views/" + view["id"])

    def test_a_worn_tool_on_a_centre_path_is_shown_as_large_as_it_is(self):
        _, view = self.server.ask_json(
            "POST", "/v1/views?nominal_radius=5&wear=-0.02", SQUARE, TEXT)
        self.assertNotIn("refused", view, view.get("diagnostics"))
        self.assertEqual([round(radius, 6) for radius in view["toolRadii"]], [4.98])
        _, blocks = self.server.ask_json("GET", f"/v1/views/{view['id']}/blocks?line=3")
        self.assertAlmostEqual(blocks["blocks"][1]["toolRadius"], 4.98, places=5)

    def test_the_way_from_where_nobody_has_said_is_not_drawn(self):
        # Up to 100, then down to the contour: from X0 Y0 it would lead across the picture.
        text = SQUARE.replace("X-20 Y-20", "X60 Y-20").replace("N20", "N15 G00 X-20\nN20")
        drawn = {}
        for query in ("tool_radius=5", "tool_radius=5&start_position=0.5,90,0"):
            _, view = self.server.ask_json("POST", "/v1/views?" + query, text, TEXT)
            _, _, tile = self.server.ask("GET", f"/v1/views/{view['id']}/tiles/0/0/0")
            drawn[query] = {line for line, _, _ in self.segments_of(tile)}, view["high"]["y"]
        self.assertNotIn(1, drawn["tool_radius=5"][0])
        self.assertIn(2, drawn["tool_radius=5"][0])
        self.assertIn(1, drawn["tool_radius=5&start_position=0.5,90,0"][0])
        self.assertEqual([high for _, high in drawn.values()], [55, 90])

    def test_each_tool_sweeps_its_own_band(self):
        # A square outside with 5 mm, and once more with 3 mm.
        square = ("G00 X-20 Y-20\nG41 D{0} G01 X0 Y0 F500\nY50\nX50\nY0\nX0\nG40 X-20 Y-20\n")
        text = square.format(1) + square.format(2) + "M30\n"
        _, view = self.server.ask_json(
            "POST", "/v1/views?tools=1:5,2:3&start_position=-30,-30", text, TEXT)
        self.assertEqual((view["toolRadius"], view["toolRadii"]), (5, [5, 3]))
        _, _, tile = self.server.ask("GET", f"/v1/views/{view['id']}/tiles/0/0/0")
        path = 1 << 9
        radii = {line: radius for line, word, radius in self.segments_of(tile) if word & path}
        self.assertEqual([radii[line] for line in (2, 3, 4, 5, 6, 7)], [5] * 6)
        self.assertEqual([radii[line] for line in (9, 10, 11, 12, 13, 14)], [3] * 6)
        self.assertEqual(radii[1], 0)
        self.server.ask("DELETE", "/v1/views/" + view["id"])

    def test_a_line_that_is_read_again_has_the_tool_of_each_time(self):
        text = ("O1\nG90 G17 G40 G21\nG0 X-20 Y-20\nD1 M98 P2\nD2 M98 P2\nM30\n"
                "O2\nG41 G1 X0 Y0 F500\nY50\nX50\nY0\nX-10\nG40 X-20 Y-20\nM99\n")
        _, view = self.server.ask_json("POST", "/v1/views?dialect=fanuc&tools=1:5,2:3", text, TEXT)
        for line in (8, 9, 10, 12):
            _, found = self.server.ask_json("GET", f"/v1/views/{view['id']}/blocks?line={line}")
            radii = [block["toolRadius"] for block in found["blocks"] if block.get("onPath")]
            self.assertEqual(radii, [5, 3], line)
        self.server.ask("DELETE", "/v1/views/" + view["id"])

    def test_a_large_program_is_measured_behind_its_first_picture(self):
        text = program_of(100_000)
        self.assertGreater(len(text), 1 << 20)
        status, view = self.server.ask_json("POST", "/v1/views?tool_radius=0.5", text, TEXT)
        self.assertEqual((status, view["measuring"]), (201, True))
        self.assertNotIn("minClearance", view["summary"]["path"])
        at = "/v1/views/" + view["id"]
        for _ in range(200):
            view = self.server.ask_json("GET", at)[1]
            if not view.get("measuring"):
                break
            time.sleep(0.1)
        self.assertNotIn("measuring", view)
        self.assertAlmostEqual(view["summary"]["path"]["minClearance"]["distance"], 0.5, places=4)
        self.server.ask("DELETE", at)
        # Where it is asked for, the first answer says it, and nothing else than what came later.
        _, whole = self.server.ask_json("POST", "/v1/views?tool_radius=0.5&verify=report", text,
                                        TEXT)
        self.assertNotIn("measuring", whole)
        for told in (view, whole):
            for name in ("wallTimeSeconds", "cpuTimeSeconds"):
                told["summary"]["path"].pop(name)
        self.assertEqual(view["summary"], whole["summary"])
        self.assertEqual(view.get("diagnostics"), whole.get("diagnostics"))
        self.server.ask("DELETE", "/v1/views/" + whole["id"])

    def test_a_view_tells_what_the_command_line_tells(self):
        status, view = self.server.ask_json("POST", "/v1/views?tool_radius=5&name=s.nc", SQUARE,
                                            TEXT)
        self.assertEqual(status, 201)
        self.assertEqual((view["name"], view["toolRadius"], view["lines"]), ("s.nc", 5, "8"))
        self.assertAlmostEqual(view["summary"]["path"]["minClearance"]["distance"], 5, places=4)
        at = f"/v1/views/{view['id']}"
        _, _, tile = self.server.ask("GET", at + "/tiles/0/0/0")
        magic, count = struct.unpack("<4sI", tile[:8])
        self.assertEqual((magic, len(tile)), (b"TRCT", 16 + 36 * count))
        self.assertGreaterEqual(count, 10)
        _, view_of_many = self.server.ask_json("POST", "/v1/views?tool_radius=0.1",
                                               program_of(5000), TEXT)
        many = f"/v1/views/{view_of_many['id']}/tiles/0/0/0"
        counts = []
        for query in ("?segments=1", "", "?segments=8000"):
            _, _, tile = self.server.ask("GET", many + query)
            counts.append(struct.unpack("<4sI", tile[:8])[1])
        self.assertLessEqual(counts[0], 256)
        self.assertTrue(counts[1] <= 2048 < counts[2] <= 8000, counts)
        _, lines = self.server.ask_json("GET", at + "/lines?from=2&count=2")
        self.assertEqual(lines["lines"], SQUARE.splitlines()[1:3])
        output = {"pending": True}
        while output.get("pending"):
            _, output = self.server.ask_json("GET", at + "/output")
        self.assertEqual("\n".join(output["lines"]) + "\n",
                         self.expected("--set", "tool_radius=5").decode())
        # Each line that moves says where it comes from.
        for text, source in zip(output["lines"], output["sourceLines"]):
            if text.startswith("N"):
                self.assertIn(source, (0, int(text[1:text.index(" ")]) // 10), text)
        self.assertGreaterEqual(sum(1 for source in output["sourceLines"] if source > 0), 7)
        _, blocks = self.server.ask_json("GET", at + "/blocks?line=3")
        self.assertEqual(blocks["blocks"][0]["end"], {"x": 0, "y": 50, "z": 0})
        self.assertTrue(blocks["blocks"][1]["onPath"])
        _, place = self.server.ask_json("GET", at + "/place?share=1")
        self.assertEqual(place["position"], {"x": -20, "y": -20, "z": 0})
        self.assertEqual(self.server.ask("DELETE", at)[0], 204)
        self.assertEqual(self.server.ask_json("GET", at)[1]["reason"], "VIEW_GONE")

    def test_a_refused_program_can_be_looked_at(self):
        status, view = self.server.ask_json("POST", "/v1/views?tool_radius=5", NOTCH, TEXT)
        self.assertEqual((status, view["refused"]), (201, True))
        self.assertEqual(view["diagnostics"][-1]["severity"], "ERROR")
        self.assertNotIn("summary", view)

    def test_the_page_is_allowed_nothing_from_elsewhere(self):
        status, headers, page = self.server.ask("GET", "/")
        self.assertEqual(status, 200)
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        self.assertNotIn("unsafe", headers["Content-Security-Policy"])
        self.assertNotRegex(page.decode(), r"https?://")


class Origins(unittest.TestCase):
    def test_pages_of_others_are_refused_unless_named(self):
        with Server("--http-cors-origins", "https://mes.example") as server:
            def status(**headers):
                return server.ask("GET", "/v1/info", headers=headers)[0]
            self.assertEqual(status(), 200)
            self.assertEqual(status(Origin=f"http://127.0.0.1:{server.port}"), 200)
            self.assertEqual(status(Origin="https://evil.example"), 403)
            self.assertEqual(status(Origin="null"), 403)
            # A name of somebody else's that was turned to this machine.
            self.assertEqual(status(Host="evil.example"), 421)
            _, headers, _ = server.ask("OPTIONS", "/v1/info",
                                       headers={"Origin": "https://mes.example"})
            self.assertEqual(headers["Access-Control-Allow-Origin"], "https://mes.example")
            _, headers, _ = server.ask("GET", "/v1/info")
            self.assertNotIn("Access-Control-Allow-Origin", headers)

    def test_http_is_off_unless_asked_for(self):
        with Server(listen="") as server:
            self.assertEqual(server.port, 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
