// The Connect protocol, spoken by @connectrpc/connect-web over HTTP/1.1, from Node and in a browser:
// what comes is what comes over gRPC, byte for byte.
//
//   connect_test.mjs TRC_BUILD_FOLDER
import assert from 'node:assert/strict';
import {execFileSync, spawn, spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
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

function descriptors() {
  const folder = mkdtempSync(join(tmpdir(), 'trc-connect-'));
  const file = join(folder, 'descriptors');
  execFileSync('protoc', ['-I', join(top, 'proto'), '--include_imports',
    `--descriptor_set_out=${file}`, 'trc/v1/trc_service.proto']);
  const bytes = readFileSync(file);
  rmSync(folder, {recursive: true});
  return bytes;
}

const described = descriptors();
const service = createFileRegistry(fromBinary(FileDescriptorSetSchema, described)).getService('trc.v1.TrcService');

// A page of another origin, the one that the server lets in.
const origin = 'http://127.0.0.1:8099';
const server = spawn(`${build}/bin/trcd`, ['--listen', '127.0.0.1:0', '--http-listen', '127.0.0.1:0',
  '--http-cors-origins', origin], {stdio: ['ignore', 'pipe', 'inherit']});

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

/** Of more than one message. */
function longPath() {
  const linear = end => ({block: {case: 'linear', value: {end}}});
  const zigzag = Array.from({length: 3000}, (_, i) => linear({x: 10 + i, y: i % 2 ? 40 : 0}));
  return {
    setup: {toolRadius: 0.25},
    path: {case: 'batch', value: {blocks: [
      {block: {case: 'command', value: {side: 2}}}, linear({x: 5, y: 0}), ...zigzag,
      {block: {case: 'command', value: {side: 1}}}, linear({x: 4000, y: 80})]}},
  };
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
    const request = create(method.input, longPath());
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

/** The modules as they are installed: no bundler is between them and the browser. */
const modules = {
  '@bufbuild/protobuf': 'index', '@bufbuild/protobuf/wkt': 'wkt/index', '@bufbuild/protobuf/wire': 'wire/index',
  '@bufbuild/protobuf/reflect': 'reflect/index', '@bufbuild/protobuf/codegenv1': 'codegenv1/index', '@bufbuild/protobuf/codegenv2': 'codegenv2/index',
  '@connectrpc/connect': 'index', '@connectrpc/connect/protocol': 'protocol/index',
  '@connectrpc/connect/protocol-connect': 'protocol-connect/index', '@connectrpc/connect/protocol-grpc-web': 'protocol-grpc-web/index',
  '@connectrpc/connect-web': 'index',
};
const packageOf = name => name.split('/').slice(0, 2).join('/');

async function pageOf(browser, from) {
  const page = await (await browser.newContext()).newPage();
  const imports = Object.fromEntries(Object.entries(modules).map(([name, file]) => [name, `/${packageOf(name)}/dist/esm/${file}.js`]));
  await page.route(`${from}/**`, route => {
    const {pathname} = new URL(route.request().url());
    if (pathname !== '/') return route.fulfill({path: join(top, '.ci/node/node_modules', pathname), contentType: 'text/javascript'});
    return route.fulfill({contentType: 'text/html', body: `<!DOCTYPE html><script type="importmap">${JSON.stringify({imports})}</script>`});
  });
  await page.goto(`${from}/`);
  return page;
}

// What a page of a shop would do, given the descriptors and the requests as JSON.
async function asked({baseUrl, useBinaryFormat, described, text, path}) {
  const {createFileRegistry, fromBinary, toBinary} = await import('@bufbuild/protobuf');
  const {FileDescriptorSetSchema} = await import('@bufbuild/protobuf/wkt');
  const {Code, createClient} = await import('@connectrpc/connect');
  const {createConnectTransport} = await import('@connectrpc/connect-web');
  const bytes = Uint8Array.from(atob(described), character => character.charCodeAt(0));
  const service = createFileRegistry(fromBinary(FileDescriptorSetSchema, bytes)).getService('trc.v1.TrcService');
  const client = createClient(service, createConnectTransport({baseUrl, useBinaryFormat}));
  const shown = (method, message) => Array.from(toBinary(method.output, message), byte => byte.toString(16).padStart(2, '0')).join('');
  const whole = await client.compensateProgramOnce({text, setup: {path: {toolRadius: 5}}});
  const messages = [];
  for await (const message of client.previewPath(path)) messages.push(shown(service.method.previewPath, message));
  const refused = await client.compensateProgramOnce({text: 'N10 G1 X10,5\n'}).catch(error => error);
  return {whole: shown(service.method.compensateProgramOnce, whole), messages, code: Code[refused.code], said: refused.message};
}

const hasBrowser = existsSync('/usr/bin/chromium') && existsSync(join(top, '.ci/node/node_modules/playwright-core'));
test('in a browser: the bytes of gRPC, from the origin that is let in alone', {skip: !hasBrowser && process.env.CI !== 'true'}, async () => {
  const {chromium} = require('playwright-core');
  // A page that comes from no network at all would have to ask its user for leave to call this machine.
  const browser = await chromium.launch({executablePath: '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-dev-shm-usage', '--disable-features=LocalNetworkAccessChecks']});
  try {
    const page = await pageOf(browser, origin);
    const once = service.method.compensateProgramOnce, preview = service.method.previewPath;
    const path = longPath();
    const there = {
      whole: await overGrpc(once, create(once.input, {text, setup: {path: {toolRadius: 5}}})),
      messages: await overGrpc(preview, create(preview.input, path)),
    };
    for (const useBinaryFormat of [false, true]) {
      const call = {baseUrl: `http://127.0.0.1:${ports.http}`, useBinaryFormat, described: described.toString('base64'), text, path};
      const found = await page.evaluate(asked, call);
      const bytesOf = (method, hex) => timeless(method, fromBinary(method.output, Buffer.from(hex, 'hex')));
      assert.deepEqual([bytesOf(once, found.whole)], there.whole);
      assert.ok(found.messages.length > 2);
      assert.deepEqual(found.messages.map(message => bytesOf(preview, message)), there.messages);
      assert.equal(found.code, 'InvalidArgument');
      assert.match(found.said, /line 1: error 900008/);
      const stranger = await pageOf(browser, 'http://127.0.0.1:8098');
      await assert.rejects(stranger.evaluate(asked, call), /Failed to fetch/);
    }
  } finally { await browser.close(); }
});
