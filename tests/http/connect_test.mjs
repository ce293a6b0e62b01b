// The Connect protocol, spoken by @connectrpc/connect-web over HTTP/1.1 as in a browser: what comes is
// what comes over gRPC, byte for byte.
//
//   connect_test.mjs TRC_BUILD_FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawn, spawnSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, test} from 'node:test';
import {pathToFileURL} from 'node:url';

const top = join(import.meta.dirname ?? new URL('.', import.meta.url).pathname, '../..');
const require = createRequire(join(top, '.ci/node/'));
// Modules of theirs must be those that they import themselves: the ones for `import`.
const load = name => import(pathToFileURL(require.resolve(name).replace('/cjs/', '/esm/')));
const {create, createFileRegistry, fromBinary, toBinary} = await load('@bufbuild/protobuf');
const {FileDescriptorSetSchema} = await load('@bufbuild/protobuf/wkt');
const {Code, ConnectError, createClient} = await load('@connectrpc/connect');
const {createConnectTransport} = await load('@connectrpc/connect-web');
const grpc = require('@grpc/grpc-js');
const build = process.argv[2];

const text = readFileSync(join(top, 'client/samples/bracket.nc'), 'utf8');

function described() {
  const folder = mkdtempSync(join(tmpdir(), 'trc-connect-'));
  const file = join(folder, 'descriptors');
  execFileSync('protoc', ['-I', join(top, 'proto'), '--include_imports',
    `--descriptor_set_out=${file}`, 'trc/v1/trc_service.proto']);
  const set = fromBinary(FileDescriptorSetSchema, readFileSync(file));
  rmSync(folder, {recursive: true});
  return createFileRegistry(set).getService('trc.v1.TrcService');
}

const service = described();

const server = spawn(`${build}/bin/trcd`, ['--listen', '127.0.0.1:0', '--http-listen', '127.0.0.1:0'],
  {stdio: ['ignore', 'pipe', 'inherit']});

const ports = await new Promise((resolve, reject) => {
  let said = '';
  server.stdout.on('data', data => {
    const found = /"ports":"(\d+)".*"http_port":(\d+)/.exec(said += data);
    if (found) resolve({grpc: found[1], http: found[2]});
  });
  server.on('exit', () => reject(new Error('trcd did not start')));
});
const channel = new grpc.Client(`127.0.0.1:${ports.grpc}`, grpc.credentials.createInsecure());
after(() => {
  channel.close();
  server.kill();
});

const kinds = [false, true].map(binary => ({
  name: binary ? 'binary' : 'JSON',
  client: createClient(service, createConnectTransport(
    {baseUrl: `http://127.0.0.1:${ports.http}`, useBinaryFormat: binary})),
}));

/** All messages that gRPC answers, in the bytes it has them in, without the times it took. */
function overGrpc(method, request) {
  const call = channel.makeServerStreamRequest(`/trc.v1.TrcService/${method.name}`,
    message => Buffer.from(toBinary(method.input, message)), bytes => bytes, request);
  return new Promise((resolve, reject) => {
    const messages = [];
    call.on('data', bytes => messages.push(timeless(method, fromBinary(method.output, bytes))));
    call.on('error', reject);
    call.on('end', () => resolve(messages));
  });
}

/** Bytes of an answer; how long it took is another one each time. */
function timeless(method, message) {
  const summary = message.summary ?? (message.response?.case === 'summary' ? message.response.value : undefined);
  for (const part of [summary, summary?.path]) {
    if (part?.wallTimeSeconds !== undefined) part.wallTimeSeconds = 0;
    if (part?.cpuTimeSeconds !== undefined) part.cpuTimeSeconds = 0;
  }
  return Buffer.from(toBinary(method.output, message)).toString('hex');
}

for (const {name, client} of kinds) {
  test(`${name}: a whole program gives the text of the command line and the bytes of gRPC`, async () => {
    const method = service.method.compensateProgramOnce;
    const request = create(method.input, {text, setup: {path: {toolRadius: 5}}});
    const answer = await client.compensateProgramOnce(request);
    const there = spawnSync(`${build}/bin/trc`, ['compensate', '-', '--radius', '5', '-q'], {input: text});
    assert.equal(there.status, 0, String(there.stderr));
    assert.equal(answer.ncText, String(there.stdout));
    assert.ok(answer.summary.path.blocksOut > 0n);
    assert.deepEqual([timeless(method, answer)], await overGrpc(method, request));
  });

  test(`${name}: a stream of a path gives the messages of gRPC`, async () => {
    const method = service.method.previewPath;
    const linear = end => ({block: {case: 'linear', value: {end}}});
    // More than one message.
    const zigzag = Array.from({length: 3000}, (_, i) => linear({x: 10 + i, y: i % 2 ? 40 : 0}));
    const request = create(method.input, {
      setup: {toolRadius: 0.25},
      path: {case: 'batch', value: {blocks: [
        {block: {case: 'command', value: {side: 2}}}, linear({x: 5, y: 0}), ...zigzag,
        {block: {case: 'command', value: {side: 1}}}, linear({x: 4000, y: 80})]}},
    });
    const messages = [];
    for await (const message of client.previewPath(request)) messages.push(timeless(method, message));
    assert.ok(messages.length > 2, `${messages.length} messages`);
    assert.deepEqual(messages, await overGrpc(method, request));
  });

  test(`${name}: a refused program is an error with its code and its place`, async () => {
    await assert.rejects(client.compensateProgramOnce({text: 'N10 G1 X10,5\n'}), error => {
      assert.ok(error instanceof ConnectError);
      assert.equal(error.code, Code.InvalidArgument);
      assert.match(error.message, /line 1: error 900008/);
      assert.ok(error.details.some(detail => detail.type === 'google.rpc.ErrorInfo'));
      return true;
    });
  });

  test(`${name}: a deadline that is over ends the call`, async () => {
    const slow = {text: 'G1 X1 F100\n'.repeat(200_000)};
    await assert.rejects(client.compensateProgramOnce(slow, {timeoutMs: 1}),
      error => error.code === Code.DeadlineExceeded);
  });

  test(`${name}: what the server is`, async () => {
    const info = await client.getServerInfo({});
    assert.ok(info.limits.maxBlocksPerBatch >= 1024);
    assert.ok(info.diagnostics.length > 50);
  });
}
