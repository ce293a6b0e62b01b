// The installed package sends its first input with the setup, without an answer between.
import assert from "node:assert/strict";
import test from "node:test";

import grpc from "@grpc/grpc-js";
import { Client } from "trc-client";

const program = "N10 G1 X10 F100\nM30\n";
const blocks = [{ command: { side: "LEFT" } }, { linear: { end: { x: 10, y: 0 } } },
  { linear: { end: { x: 50 } } }, { command: { side: "OFF" } }, { linear: { end: { x: 60, y: -20 } } }];

// Responses: `accepted`, and a summary with nothing in it.
const accepted = Buffer.from([1 << 3 | 2, 0]);
const summaries = { CompensateProgram: 4, CompensatePath: 4, SurveyRadii: 3 };
const bytes = (message) => message;

/** What has come to a server that says nothing before two requests are there, as the numbers of
 * their fields, when `use` has ended. Who waits for `accepted` waits for ever. */
async function cameTo(use) {
  const came = [];
  const server = new grpc.Server();
  for (const [method, summary] of Object.entries(summaries)) {
    server.addService({ [method]: {
      path: `/trc.v1.TrcService/${method}`, requestStream: true, responseStream: true,
      requestSerialize: bytes, requestDeserialize: bytes,
      responseSerialize: bytes, responseDeserialize: bytes,
    } }, { [method]: (call) => call.on("data", (request) => {
      came.push(request[0] >> 3);
      if (came.length !== 2) return;
      call.write(accepted);
      call.write(Buffer.from([summary << 3 | 2, 0]));
      call.end();
    }) });
  }
  const port = await new Promise((resolve, reject) => {
    server.bindAsync("127.0.0.1:0", grpc.ServerCredentials.createInsecure(),
      (error, bound) => (error ? reject(error) : resolve(bound)));
  });
  // The deadline ends a call that waits.
  const client = new Client({ server: `127.0.0.1:${port}`, timeout: 30 });
  await use(client).finally(() => {
    client.close();
    server.forceShutdown();
  });
  return came;
}

test("a text comes with its setup", async () => {
  assert.deepEqual(await cameTo((client) => client.compensate(program, { radius: 5 })), [1, 2]);
});

test("blocks come with their setup", async () => {
  assert.deepEqual(await cameTo((client) => client.compensatePath(blocks, { radius: 5 })), [1, 2]);
});

test("a survey comes with its setup", async () => {
  const questions = { radii: [5] };
  assert.deepEqual(await cameTo((client) => client.surveyRadii(program, questions)), [1, 2]);
  assert.deepEqual(await cameTo((client) => client.surveyRadii(blocks, questions)), [1, 3]);
});
