import { fileURLToPath } from "node:url";
import { existsSync, readFileSync } from "node:fs";

import grpc from "@grpc/grpc-js";
import loader from "@grpc/proto-loader";

import { raisedBy, ServerError, TrcError } from "./errors.js";
import { PathExchange, ProgramExchange, SurveyExchange } from "./exchange.js";
import { localAddress } from "./local.js";
import { Schema } from "./schema.js";
import { Settings } from "./settings.js";
import { channelOptions, targetOf } from "./target.js";
import { Waiting } from "./waiting.js";

export { ServerError, TrcError };

const own = new URL("../", import.meta.url);
export const { version } = JSON.parse(readFileSync(new URL("package.json", own)));

// Beside the sources in a package, where they are from in a checkout.
const protos = ["proto/", "../../proto/"].map((folder) => fileURLToPath(new URL(folder, own)))
  .find((folder) => existsSync(`${folder}trc/v1`));
const definition = loader.loadSync("trc/v1/trc_service.proto", {
  includeDirs: [protos], longs: Number, enums: String,
});
const { TrcService } = grpc.loadPackageDefinition(definition).trc.v1;
const settings = new Settings(new Schema(definition));

export class Client {
  #server;
  #credentials;
  #timeout;
  #stub;
  #address;
  #isClosed = false;

  constructor({ server, tls, timeout } = {}) {
    if (server) this.#address = targetOf(server);
    this.#server = server;
    this.#timeout = secondsOf(timeout);
    this.#credentials = tls ? credentialsOf(tls) : grpc.credentials.createInsecure();
  }

  close() {
    this.#isClosed = true;
    this.#stub?.close();
  }

  async compensate(text, { signal, blocks = false, ...setup } = {}) {
    const exchange = programExchange(text, setup);
    const ofBlocks = blocks ? exchange.forBlocks() : undefined;
    const result = await this.#run(exchange, signal);
    if (ofBlocks) result.blocks = (await this.#run(ofBlocks, signal)).blocks;
    return result;
  }

  async compensatePath(blocks, { signal, ...setup } = {}) {
    return this.#run(pathExchange(blocks, setup), signal);
  }

  stream(text, { signal, ...setup } = {}) {
    return this.#parts(programExchange(text, setup), signal);
  }

  streamPath(blocks, { signal, ...setup } = {}) {
    return this.#parts(pathExchange(blocks, setup), signal);
  }

  async surveyRadii(program, { signal, ...questions } = {}) {
    const isPath = Array.isArray(program);
    const source = isPath ? settings.blocks(program) : bytesOf(program);
    return this.#run(new SurveyExchange(source, settings.surveySetup(questions, isPath)), signal);
  }

  async info() {
    const stub = await this.#service();
    const { deadline } = new Waiting(this.#timeout);
    return new Promise((resolve, reject) => {
      stub.getServerInfo({}, { deadline }, (error, answer) => (
        error ? reject(raisedBy(error, [])) : resolve(answer)));
    });
  }

  // Without a server that of this machine, which is another one where the one there was has ended.
  async #service() {
    if (this.#isClosed) throw new Error("this client is closed");
    const address = this.#server ? this.#address : await localAddress();
    if (!this.#stub || address !== this.#address) {
      this.#stub?.close();
      this.#address = address;
      this.#stub = new TrcService(address, this.#credentials, channelOptions);
    }
    return this.#stub;
  }

  async #run(exchange, signal) {
    const messages = this.#messages(exchange, signal);
    while (!(await messages.next()).done);
    return exchange.result();
  }

  async *#parts(exchange, signal) {
    for await (const _ of this.#messages(exchange, signal)) {
      const part = exchange.take();
      if (part !== undefined) yield part;
    }
    yield exchange.result();
  }

  /** Drives an exchange to its end, and stops after each message it has absorbed. */
  async *#messages(exchange, signal) {
    const waiting = new Waiting(this.#timeout);
    for (;;) {
      signal?.throwIfAborted();
      const stub = await this.#service();
      const address = this.#address;
      const stream = stub[exchange.constructor.method]({ deadline: waiting.deadline });
      const cancel = () => stream.cancel();
      signal?.addEventListener("abort", cancel);
      try {
        send(stream, exchange.requests());
        for await (const response of stream) {
          waiting.hasAnswered();
          exchange.absorb(response);
          yield;
        }
        return;
      } catch (error) {
        signal?.throwIfAborted();
        if (typeof error.code !== "number") throw error;
        const raised = raisedBy(error, exchange.diagnostics, exchange.record);
        const wait = this.#isClosed || raised instanceof TrcError
          ? undefined : waiting.beforeNextTry(raised);
        if (wait === undefined) throw raised;
        await new Promise((resolve) => setTimeout(resolve, wait));
        // Another server of this machine does not take the streams of the one there was.
        if (waiting.answered && !this.#server && await localAddress() !== address) throw raised;
        exchange.goOn();
      } finally {
        signal?.removeEventListener("abort", cancel);
        stream.cancel();
      }
    }
  }
}

/** Waits where the server does not take more for now. */
function send(stream, requests) {
  // Who reads the stream is told as well.
  stream.on("error", () => {});
  const more = () => {
    while (!stream.destroyed) {
      const { value, done } = requests.next();
      if (done) return stream.end();
      if (!stream.write(value)) return stream.once("drain", more);
    }
    return undefined;
  };
  more();
}

function programExchange(text, setup) {
  return new ProgramExchange(bytesOf(text), settings.programSetup(setup));
}

function pathExchange(blocks, setup) {
  return new PathExchange(settings.blocks(blocks), settings.pathSetup(setup));
}

function bytesOf(text) {
  if (typeof text === "string") return Buffer.from(text);
  if (text instanceof Uint8Array) return text;
  throw new TypeError("an NC program is text or bytes, not " +
    `${text?.constructor?.name ?? text}; of a file: readFileSync("part.nc")`);
}

function secondsOf(timeout) {
  if (timeout === undefined || timeout === Infinity) return undefined;
  if (typeof timeout !== "number" || !(timeout > 0))
    throw new TypeError(`timeout takes seconds, more than 0, not ${timeout}`);
  return timeout;
}

function credentialsOf({ ca, certificate, key }) {
  if ((certificate === undefined) !== (key === undefined))
    throw new TypeError("a client certificate and its key belong together");
  const content = (file) => (file === undefined ? null : readFileSync(file));
  return grpc.credentials.createSsl(content(ca), content(key), content(certificate));
}

async function withClient({ server, tls, timeout, ...setup }, call) {
  const client = new Client({ server, tls, timeout });
  try {
    return await call(client, setup);
  } finally {
    client.close();
  }
}

export function compensate(text, options = {}) {
  return withClient(options, (client, setup) => client.compensate(text, setup));
}

export function compensatePath(blocks, options = {}) {
  return withClient(options, (client, setup) => client.compensatePath(blocks, setup));
}

export function surveyRadii(program, options = {}) {
  return withClient(options, (client, questions) => client.surveyRadii(program, questions));
}
