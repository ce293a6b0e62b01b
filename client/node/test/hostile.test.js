// The installed package in wrong and rough hands: TRC_TRCD names the program.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";

import grpc from "@grpc/grpc-js";
import { Client, compensate, compensatePath, ServerError, surveyRadii, TrcError } from "trc-client";

const pocket = `N10 G17 G90 G0 X0 Y0
N20 G41 G1 X10 Y0 F800
N30 X50
N40 Y40
N50 G40 X0 Y60
M30
`;
const left = { command: { side: "COMPENSATION_SIDE_LEFT" } };
const off = { command: { side: "OFF" } };
const to = (x, y) => ({ linear: { end: { x, y } } });

/** A program that takes the server a while. */
function wave(blocks) {
  const points = Array.from({ length: blocks }, (_, i) => (
    `G1 X${(2 + i * 0.5).toFixed(3)} Y${((i % 2) * 0.05).toFixed(3)}`));
  return ["N10 G17 G90 G0 X0 Y0", "N20 G41 G1 X1 Y0 F900", ...points, "G40 G1 Y-20", "M30", ""]
    .join("\n");
}

const pause = (ms) => new Promise((resolve) => { setTimeout(resolve, ms); });

async function until(isTrue) {
  for (let tries = 0; !isTrue(); ++tries) {
    assert.ok(tries < 1000, "it does not become true");
    await pause(10);
  }
}

/** A trcd of the test's own, while `use` runs. */
async function withServer(settings, use) {
  const folder = mkdtempSync(join(tmpdir(), "trc-test-"));
  const socket = join(folder, "socket");
  const server = spawn(process.env.TRC_TRCD, ["--listen", `unix:${socket}`, ...settings],
    { stdio: "ignore" });
  try {
    await until(() => existsSync(socket));
    return await use(`unix:${socket}`, server);
  } finally {
    server.kill("SIGKILL");
    rmSync(folder, { recursive: true, force: true });
  }
}

/** A program of Node that imports the package, from the folder this test is in. */
const script = (text) => ["--input-type=module", "-e",
  `import { compensate } from ${JSON.stringify(import.meta.resolve("trc-client"))};\n${text}`];

/** The error is of the caller's making, and names what is wrong. */
async function isRefused(call, words) {
  await assert.rejects(call, (error) => {
    assert.ok(error instanceof TypeError || error instanceof RangeError, String(error));
    assert.match(error.message, words);
    return true;
  });
}

test("a program of another type", async () => {
  for (const program of [undefined, null, 5, ["G1"], {}])
    await isRefused(compensate(program, { radius: 5 }), /text or bytes/);
  const { text } = await compensate(new TextEncoder().encode(pocket), { radius: 5 });
  assert.equal(text, (await compensate(pocket, { radius: 5 })).text);
});

test("settings of another type", async () => {
  for (const radius of ["5", NaN, Infinity, true, null, [5], 5n])
    await isRefused(compensate(pocket, { radius }), /radius/);
  await isRefused(compensate(pocket, { radius: 5, transition: "G27" }), /G25, G26/);
  await isRefused(compensate(pocket, { radius: 5, removeMaskedBlocks: "false" }), /true or false/);
  await isRefused(compensate(pocket, { radius: 5, split: { measure: "by" } }), /MEASURE_PATH/);
  for (const tools of [{ 1: null }, { 1: NaN }, { 1: "5" }, { a: 5 }, "1:5", [{ number: 1 }],
    [{ nr: 1 }], null])
    await isRefused(compensate(pocket, { tools }), /tools/);
});

test("a setting under two names", async () => {
  const path = [left, to(10, 0), to(50, 0), off, to(60, -20)];
  const calls = [(setup) => compensate(pocket, setup), (setup) => compensatePath(path, setup),
    (setup) => surveyRadii(pocket, { radii: [3], ...setup }),
    (setup) => surveyRadii(path, { radii: [3], ...setup })];
  for (const [given, words] of [
    [{ radius: 5, toolRadius: 4 }, /radius and toolRadius/],
    [{ options: { reverse: true }, reverse: false }, /reverse and options\.reverse/]]) {
    for (const order of [given, Object.fromEntries(Object.entries(given).reverse())])
      for (const call of calls) await isRefused(call(order), words);
  }
  await isRefused(compensate(pocket, {
    radius: 5, dialect: "FANUC", subprograms: { "O7.nc": Buffer.from("O7\nM99\n") },
    subprogramFiles: { "O7.nc": Buffer.from("O7\nG4\nM99\n") },
  }), /subprograms\["O7.nc"\] and subprogramFiles/);
});

test("options of both forms are joined", async () => {
  const both = { stretchFactor: 20, options: { reverse: true } };
  for (const order of [both, Object.fromEntries(Object.entries(both).reverse())])
    await assert.rejects(compensate(pocket, { radius: 5, toolRadius: undefined, ...order }),
      /stretch_factor is 20/);
});

test("blocks whose members are misspelled or of another type", async () => {
  for (const block of [{ linear: { end: { X: 10 } } }, { lineer: {} }, { linear: { end: { x: "1" } } },
    to(NaN, 0), null, 5, {}, { ...to(1, 2), circular: {} }, { passthrough: { text: 5 } },
    { ...to(1, 2), sourceNumber: -1 }, { command: { side: "lft" } }]) {
    const path = [left, to(10, 0), block, to(50, 0), off, to(0, 60)];
    await isRefused(compensatePath(path, { radius: 5 }), /blocks\[2\]/);
  }
  await isRefused(compensatePath(pocket, { radius: 5 }), /array/);
  const { blocks } = await compensatePath(
    [{ command: { side: "LEFT", transition: "G26" } }, to(10, 0), to(50, 0), off, to(60, -20)],
    { radius: 5 });
  assert.deepEqual([blocks[0].line.end.x, blocks[0].line.end.y], [10, 5]);
});

test("radii of another type", async () => {
  for (const radii of ["abc", 5, [NaN], ["3"]]) await isRefused(surveyRadii(pocket, { radii }), /radii/);
  assert.equal((await surveyRadii(pocket, { radii: new Float32Array([1, 2]) })).radii.length, 2);
});

test("servers and timeouts that are none", async () => {
  for (const server of ["box", "box:99999", ":::", "http://a:1", "127.0.0.1", "a:1,b:2",
    "127.0.0.1:1,[::1]:2", 5])
    assert.throws(() => new Client({ server }), TypeError);
  for (const timeout of [0, -1, NaN, "1"])
    assert.throws(() => new Client({ server: "a:1", timeout }), /timeout/);
  assert.throws(() => new Client({ server: "a:1", tls: { key: "key.pem" } }), /belong together/);
  const client = new Client();
  client.close();
  await assert.rejects(client.compensate(pocket, { radius: 5 }), /closed/);
});

test("parts are the whole", async () => {
  const client = new Client();
  const parts = [];
  for await (const part of client.stream(wave(100_000), { radius: 0.2 })) parts.push(part);
  assert.ok(parts.length > 3);
  assert.deepEqual(parts.filter(({ summary }) => summary), parts.slice(-1));
  const { text } = await client.compensate(wave(100_000), { radius: 0.2 });
  assert.ok(parts.map((part) => part.text).join("") === text);
  client.close();
});

test("what is lost after its summary comes once", async () => {
  const field = (number, bytes) => Buffer.from([number << 3 | 2, bytes.length, ...bytes]);
  const [accepted, text, summary] = [field(1, []), field(5, Buffer.from("N10\n")), field(4, [])];
  const answered = [
    Object.assign(new Error(), { code: grpc.status.UNAVAILABLE, details: "lost" }), undefined];
  const bytes = (message) => message;
  const lossy = new grpc.Server();
  lossy.addService({ compensateProgram: {
    path: "/trc.v1.TrcService/CompensateProgram", requestStream: true, responseStream: true,
    requestSerialize: bytes, requestDeserialize: bytes,
    responseSerialize: bytes, responseDeserialize: bytes,
  } }, { compensateProgram: (call) => {
    for (const message of [accepted, text, summary]) call.write(message);
    const error = answered.shift();
    // The messages are on their way before the status is.
    setTimeout(() => (error ? call.emit("error", error) : call.end()), 100);
  } });
  const port = await new Promise((resolve, reject) => {
    lossy.bindAsync("127.0.0.1:0", grpc.ServerCredentials.createInsecure(),
      (error, bound) => (error ? reject(error) : resolve(bound)));
  });
  const client = new Client({ server: `127.0.0.1:${port}` });
  const parts = [];
  for await (const part of client.stream(pocket, { radius: 5 })) parts.push(part);
  assert.equal(answered.length, 0);
  assert.equal(parts.map((part) => part.text).join(""), "N10\n");
  assert.deepEqual(parts.filter((part) => part.summary), parts.slice(-1));
  client.close();
  lossy.forceShutdown();
});

test("a loop that is left, and an aborted call, give the stream up", async () => {
  await withServer(["--max-streams", "1"], async (server) => {
    const client = new Client({ server });
    for await (const { text } of client.stream(wave(300_000), { radius: 0.2 }))
      if (text.length > 0) break;
    assert.ok((await client.compensate(pocket, { radius: 5 })).text);
    const signal = AbortSignal.timeout(100);
    await assert.rejects(client.compensate(wave(300_000), { radius: 0.2, signal }),
      { name: "TimeoutError" });
    assert.ok((await client.compensate(pocket, { radius: 5 })).text);
    client.close();
  });
});

test("a server that is full is waited for", async () => {
  await withServer(["--max-streams", "1"], async (server) => {
    const other = new grpc.Client(server, grpc.credentials.createInsecure());
    const open = other.makeBidiStreamRequest("/trc.v1.TrcService/CompensateProgram",
      (bytes) => bytes, (bytes) => bytes);
    open.on("error", () => {});
    open.write(Buffer.from([0x0a, 0x00]));  // an empty setup
    await once(open, "data");
    await assert.rejects(compensate(pocket, { server, radius: 5, timeout: 0.2 }), (error) => {
      assert.ok(error instanceof ServerError && error.reason !== "");
      return error.retryAfter > 0;
    });
    setTimeout(() => open.cancel(), 300);
    assert.ok((await compensate(pocket, { server, radius: 5 })).text);
    other.close();
  });
});

test("a server that is killed under a stream", async () => {
  await withServer([], async (server, process) => {
    const stream = new Client({ server, timeout: 3 }).stream(wave(300_000), { radius: 0.2 });
    await stream.next();
    process.kill("SIGKILL");
    await assert.rejects(async () => { for await (const _ of stream); }, ServerError);
  });
});

test("an encrypted server is reached with its certificate alone", async () => {
  const folder = mkdtempSync(join(tmpdir(), "trc-test-"));
  for (const name of ["server", "other"]) {
    const made = spawnSync("openssl", ["req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2",
      "-subj", "/CN=localhost", "-addext", "subjectAltName=IP:127.0.0.1",
      "-keyout", join(folder, `${name}.key`), "-out", join(folder, `${name}.pem`)]);
    assert.equal(made.status, 0, String(made.stderr));
  }
  const server = spawn(process.env.TRC_TRCD, ["--listen", "127.0.0.1:0",
    "--tls-cert-file", join(folder, "server.pem"), "--tls-key-file", join(folder, "server.key")],
  { stdio: ["ignore", "pipe", "ignore"] });
  try {
    let said = "";
    server.stdout.on("data", (data) => { said += data; });
    await until(() => said.includes('"event":"started"'));
    const address = `127.0.0.1:${/"ports":"(\d+)"/.exec(said)[1]}`;
    const call = (tls) => compensate(pocket, { server: address, tls, radius: 5, timeout: 20 });
    const right = await call({ ca: join(folder, "server.pem") });
    assert.equal(right.text, (await compensate(pocket, { radius: 5 })).text);
    for (const wrong of [undefined, { ca: join(folder, "other.pem") }, {}])
      await assert.rejects(call(wrong), ServerError);
  } finally {
    server.kill("SIGKILL");
    rmSync(folder, { recursive: true });
  }
});

test("a deadline", async () => {
  await assert.rejects(compensate(wave(300_000), { radius: 0.2, timeout: 0.05 }), { code: 4 });
});

test("refusals come out of the iteration", async () => {
  const client = new Client();
  await assert.rejects(async () => {
    for await (const part of client.stream("N10 G0 X5\nN20 X\n")) assert.equal(part.summary, undefined);
  }, (error) => error instanceof TrcError && error.cause.line === 2);
  client.close();
});

test("the server of a process ends with it, however that ends", async () => {
  for (const ending of ["process.kill(process.pid, 'SIGKILL')", "process.kill(process.pid, 'SIGTERM')",
    "process.exit(0)"]) {
    const { stdout, stderr } = spawnSync(process.execPath, script(`
      import { execFileSync } from "node:child_process";
      await compensate("N10 G1 X1 F1\\n");
      const children = execFileSync("ps", ["--ppid", process.pid, "-o", "pid=,comm="]).toString();
      process.stdout.write(/(\\d+) trcd/.exec(children)[1]);
      await new Promise((resolve) => { setTimeout(resolve, 20); });
      ${ending}; setTimeout(() => {}, 5000);`), { encoding: "utf8" });
    assert.match(stdout, /^\d+$/, stderr);
    await until(() => !existsSync(`/proc/${stdout}`));
  }
});

test("a process without a trcd says so", () => {
  const { stderr, status } = spawnSync(process.execPath, script(
    'await compensate("N10 G1 X1 F1\\n");'),
  { encoding: "utf8", env: { PATH: "/nowhere" } });
  assert.equal(status, 1);
  assert.match(stderr, /there is no trcd here/);
});
