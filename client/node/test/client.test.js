// The installed package against a trcd: TRC_TRCD names the program, TRC_CLI the command line.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { connect, createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";

import {
  Client, compensate, compensatePath, ServerError, surveyRadii, TrcError, version,
} from "trc-client";

const pocket = `%POCKET
N10 G17 G90 G0 X0 Y0
N20 G41 G1 X10 Y0 F800
N30 X50
M8
N40 Y40
N50 G40 X0 Y60
M30
`;

function longProgram(blocks) {
  const wave = Array.from({ length: blocks }, (_, i) => (
    `G1 X${(2 + i * 0.5).toFixed(3)} Y${((i % 2) * 0.05).toFixed(3)}`));
  return ["N10 G17 G90 G0 X0 Y0", "N20 G41 G1 X1 Y0 F900", ...wave, "G40 G1 Y-20", "M30", ""]
    .join("\n");
}

test("a program gets the text of the command line", async () => {
  const folder = mkdtempSync(join(tmpdir(), "trc-test-"));
  const part = join(folder, "part.nc");
  writeFileSync(part, pocket);
  const expected = execFileSync(process.env.TRC_CLI,
    ["compensate", part, "--set", "tool_radius=5"], { encoding: "utf8" });
  assert.equal((await compensate(pocket, { radius: 5 })).text, expected);
});

test("a refused program throws its diagnostics", async () => {
  await assert.rejects(compensate("N10 G41 V.G.WZ_AKT.R=5 G1 X10\nN20 X30\nN30 X\n"), (error) => {
    assert.ok(error instanceof TrcError);
    assert.equal(error.cause.code, 900008);
    assert.equal(error.cause.line, 3);
    assert.equal(error.cause.sourceNumber, 30);
    assert.equal(error.cause.place.line, 3);
    assert.match(error.cause.text, /number is missing/);
    return error.cause.remedy.length > 0;
  });
});

test("diagnostics are in the language that is asked for", async () => {
  await assert.rejects(compensate("N10 G1 X10,5\n", { language: "de" }), (error) => {
    assert.equal(error.cause.language, "de");
    assert.match(error.message, /^Zeile 1: Fehler 900008: eine Zahl/);
    return error.cause.help === "Dezimalpunkt statt Komma schreiben: X10.5.";
  });
});

test("a tool table serves D words", async () => {
  const { text } = await compensate(pocket.replace("F800", "F800 D7"), { tools: { 7: 5 } });
  assert.equal(text.replace(" D7", ""), (await compensate(pocket, { radius: 5 })).text);
});

test("subprograms are texts or bytes", async () => {
  const { text } = await compensate("G0 Y1.\nM98 P7\nM98 P8\nM30\n", {
    dialect: "FANUC",
    variables: { "#500": 4.5 },
    subprograms: {
      "O7.nc": "O7\nG0 X#500\nM99\n",
      "O8.nc": Buffer.from("O8\n(fr\xe4sen)\nG0 X9.\nM99\n", "latin1"),
    },
  });
  assert.match(text, /^G0 Y1\.\n\(O0007\)\nG0 X4\.5\n\(O0008\)\n\(fr.sen\)\nG0 X9\.\nM30\n$/);
  await assert.rejects(compensate(pocket, { variables: [4.5] }), /variables/);
});

test("a setting that is none is named", async () => {
  await assert.rejects(compensate(pocket, { radus: 5 }), /radus/);
});

test("no server there", async () => {
  await assert.rejects(compensate(pocket, { server: "127.0.0.1:1", timeout: 2 }), ServerError);
});

test("blocks of a program are the path of its text", async () => {
  const { text, blocks } = await compensate(pocket, { radius: 5, blocks: true });
  assert.equal(text, (await compensate(pocket, { radius: 5 })).text);
  assert.deepEqual(blocks.map(({ origin }) => origin), ["UNCOMPENSATED", "APPROACH", "PROGRAMMED",
    "PASSTHROUGH", "PROGRAMMED", "RETRACT", "PASSTHROUGH"]);
  assert.deepEqual(blocks.slice(1, 3).map(({ line }) => [line.end.x, line.end.y]),
    [[10, 5], [45, 5]]);
  assert.equal((await compensate(pocket, { radius: 5 })).blocks, undefined);
  await assert.rejects(compensate(pocket, { radius: 5, output: "BLOCKS" }), /blocks: true/);
});

test("a path of blocks", async () => {
  const blocks = [
    { command: { side: "COMPENSATION_SIDE_LEFT" } },
    { linear: { end: { x: 10, y: 0 } } }, { linear: { end: { x: 50 } } },
    { linear: { end: { y: 40 } } },
    { command: { side: "COMPENSATION_SIDE_OFF" } }, { linear: { end: { x: 0, y: 60 } } },
  ];
  const result = await compensatePath(blocks, { radius: 5, transition: "G26" });
  assert.deepEqual(result.blocks.map(({ line }) => [line.end.x, line.end.y]),
    [[10, 5], [45, 5], [45, 40], [0, 60]]);
});

// Two walls, 8 mm apart.
const slot = `N10 G17 G90 G0 X-20 Y4
N20 G138 G41 G1 X-10 Y0 F500
N30 X30
N40 Y8
N50 X-10
N60 G40 X-20 Y4
M30
`;

test("a clearance of zero is told", async () => {
  // The path beside N30 runs through the wall N70, after a change of side.
  const through = ["N10 G00 X-20 Y0 F1000", "N20 G138 G26 G141", "N25 G41 G01 X0 Y0", "N30 X60",
    "N40 G42 X70 Y20", "N50 Y40", "N60 X30", "N70 Y3", "N80 X20", "N90 Y40", "N100 X0",
    "N110 G40 X-20", "N120 M30", ""].join("\n");
  const { summary } = await compensate(through, { radius: 5, verify: "report" });
  assert.equal(summary.path.certificate.clearance, 0);
  assert.equal(summary.path.minClearance.distance, 0);
});

test("a survey tells of radii that fit and of one that does not", async () => {
  const { radii: [large, small] } = await surveyRadii(slot, { radii: [5, 3], uncut: true });
  assert.deepEqual([large.radius, large.accepted, large.certificate], [5, false, undefined]);
  assert.equal(large.refusal.severity, "ERROR");
  assert.ok(large.refusal.point);
  assert.equal(large.compensatedLength, undefined);
  assert.ok(small.accepted && small.reachesEveryWall);
  assert.equal(small.refusal, undefined);
  assert.ok(Math.abs(small.certificate.clearance - 3) < 1e-4);
  assert.ok(Math.abs(small.uncutLength - 12) < 1e-6);
  assert.ok(Math.abs(small.wallLength - 88) < 1e-6);
  // The corners at X30, from which the tool stays away by its radius.
  assert.deepEqual(small.uncut.map(({ place }) => place.line), [3, 4, 4, 5]);
  assert.ok(Math.abs(small.uncut[0].start.x - 27) < 1e-6);
});

test("the largest radius is that of the command line", async () => {
  const part = join(mkdtempSync(join(tmpdir(), "trc-test-")), "part.nc");
  writeFileSync(part, slot);
  const told = JSON.parse(execFileSync(process.env.TRC_CLI,
    ["radii", part, "--radii", "3", "--json"], { encoding: "utf8" }));
  const { radii, largest } = await surveyRadii(slot, { radii: [3] });
  assert.equal(largest.radius, told.summary.largest.radius);
  assert.ok(largest.isLimited);
  assert.deepEqual(largest.limits.map(({ line }) => line), [3, 5]);
  assert.equal(largest.limits[1].sourceNumber, 50);
  const single = await compensate(slot, { radius: 3 });
  assert.equal(radii[0].compensatedLength, single.summary.path.compensatedLength);
  assert.equal((await surveyRadii(slot, { radii: [3], largest: false })).largest, undefined);
});

test("a survey of a path is that of its program", async () => {
  const to = (x, y) => ({ linear: { end: { x, y } } });
  const blocks = [
    { linear: { end: { x: -20, y: 4 }, rapid: true } },
    { command: { side: "COMPENSATION_SIDE_LEFT" } },
    to(-10, 0), to(30, 0), to(30, 8), to(-10, 8),
    { command: { side: "COMPENSATION_SIDE_OFF" } }, to(-20, 4),
  ];
  const ofPath = await surveyRadii(blocks, { radii: [3], selectionMode: "G138" });
  const ofText = await surveyRadii(slot, { radii: [3] });
  assert.equal(ofPath.largest.radius, ofText.largest.radius);
  assert.equal(ofPath.radii[0].compensatedLength, ofText.radii[0].compensatedLength);
  assert.equal(ofPath.largest.limits[0].line, undefined);
});

test("what is wrong with every radius is thrown", async () => {
  await assert.rejects(surveyRadii("N10 G1 X10 F100\nN20 G999\n", { radii: [3] }), (error) => {
    assert.ok(error instanceof TrcError);
    return error.cause.code === 900002 && error.cause.line === 2;
  });
  await assert.rejects(surveyRadii(slot, { radii: [3, 3] }), /radii/);
});

test("the record of a job holds, done or refused", async () => {
  const folder = mkdtempSync(join(tmpdir(), "trc-test-"));
  const part = join(folder, "part.nc");
  const filed = join(folder, "record.json");
  writeFileSync(part, pocket);
  const { text, record } = await compensate(pocket, { radius: 5, record: true });
  assert.equal(JSON.parse(record).output.bytes, String(text.length));
  writeFileSync(filed, record);
  const said = execFileSync(process.env.TRC_CLI, ["verify", part, "--record", filed],
    { encoding: "utf8" });
  assert.match(said, /the record holds/);
  assert.equal((await compensate(pocket, { radius: 5 })).record, undefined);
  await assert.rejects(compensate("N10 G999\n", { record: true }), (error) => (
    JSON.parse(error.record).outcome === "REFUSED"));
});

test("a stream that is lost goes on", async () => {
  const text = longProgram(30_000);
  const whole = await compensate(text, { radius: 0.2 });
  let cuts = 0;
  const proxy = createServer((client) => {
    const server = connect(Number(process.env.TRC_TEST_PORT), "127.0.0.1");
    const isFirst = cuts === 0;
    let passed = 0;
    server.on("data", (data) => {
      passed += data.length;
      if (isFirst && passed > 300_000 && cuts === 0) {
        cuts += 1;
        client.destroy();
        server.destroy();
      } else {
        client.write(data);
      }
    });
    client.on("data", (data) => server.write(data));
    for (const end of [client, server]) {
      end.on("error", () => {});
      end.on("close", () => { client.destroy(); server.destroy(); });
    }
  });
  await new Promise((resolve) => proxy.listen(0, "127.0.0.1", resolve));
  try {
    const resumed = await compensate(text,
      { radius: 0.2, server: `127.0.0.1:${proxy.address().port}` });
    assert.equal(cuts, 1);
    assert.equal(resumed.text, whole.text);
  } finally {
    proxy.close();
  }
});

test("the version is that of the server", async () => {
  const client = new Client();
  assert.equal((await client.info()).version, version);
  client.close();
});

test("the page of the interface has all of it", () => {
  const file = (name) => readFileSync(
    new URL(`../${name}`, import.meta.resolve("trc-client")), "utf8");
  const names = [...file("src/index.d.ts").matchAll(/^export \w+ (\w+)/gm)].map(([, name]) => name);
  const page = file("API.md");
  assert.deepEqual([...page.matchAll(/^## (\w+)$/gm)].map(([, name]) => name), names);
  assert.equal(page.match(/[};]\n```$/gm).length, names.length);
  assert.match(page, /summary, and nothing may be machined before/);
});

test("the examples of the README run", () => {
  const folder = mkdtempSync(join(tmpdir(), "trc-test-"));
  writeFileSync(join(folder, "part.nc"), pocket);
  const examples = readFileSync(process.env.TRC_NODE_README, "utf8").split("```js\n").slice(1);
  assert.ok(examples.length >= 2);
  for (const [at, example] of examples.entries()) {
    const file = new URL(`example${at}.mjs`, import.meta.url);
    writeFileSync(file, example.split("```")[0]);
    const said = execFileSync(process.execPath, [file.pathname], { cwd: folder, encoding: "utf8" });
    assert.notEqual(said, "");
  }
});
