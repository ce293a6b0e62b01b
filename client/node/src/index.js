import { fileURLToPath } from "node:url";
import { existsSync, readFileSync } from "node:fs";

import grpc from "@grpc/grpc-js";
import loader from "@grpc/proto-loader";

import { raisedBy, ServerError, TrcError } from "./errors.js";
import { PathExchange, ProgramExchange, SurveyExchange } from "./exchange.js";
import { localAddress } from "./local.js";
import { Settings } from "./settings.js";

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
const settings = new Settings(definition);

const mostTries = 8;
const firstWait = 100;
const longestWait = 5_000;

export class Client {
  #target;
  #credentials;
  #timeout;
  #stub;

  constructor({ server, tls, timeout } = {}) {
    this.#target = server;
    this.#timeout = timeout;
    this.#credentials = tls ? credentialsOf(tls) : grpc.credentials.createInsecure();
  }

  close() {
    this.#stub?.close();
    this.#stub = undefined;
  }

  async compensate(text, setup = {}) {
    return this.#run(new ProgramExchange(bytesOf(text), settings.programSetup(setup)));
  }

  async compensatePath(blocks, setup = {}) {
    return this.#run(new PathExchange(blocks, settings.pathSetup(setup)));
  }

  async surveyRadii(program, questions = {}) {
    const isPath = Array.isArray(program);
    return this.#run(new SurveyExchange(isPath ? program : bytesOf(program),
      settings.surveySetup(questions, isPath)));
  }

  async info() {
    const stub = await this.#service();
    return new Promise((resolve, reject) => {
      stub.getServerInfo({}, (error, answer) => (
        error ? reject(raisedBy(error, [])) : resolve(answer)));
    });
  }

  async #service() {
    this.#stub ??= new TrcService(target(this.#target ?? await localAddress()), this.#credentials);
    return this.#stub;
  }

  async #run(exchange) {
    const stub = await this.#service();
    const deadline = this.#timeout === undefined ? undefined : Date.now() + this.#timeout * 1000;
    for (let tries = 1; ; ++tries) {
      try {
        await converse(stub, exchange, deadline, () => { tries = 1; });
        return exchange.result();
      } catch (error) {
        const wait = Math.min(firstWait * 2 ** (tries - 1), longestWait) * (1 + Math.random()) / 2;
        const isLost = error.code === grpc.status.UNAVAILABLE && tries < mostTries &&
          (deadline === undefined || Date.now() + wait < deadline);
        if (!isLost) throw "code" in error ? raisedBy(error, exchange.diagnostics) : error;
        await new Promise((resolve) => setTimeout(resolve, wait));
        exchange.goOn();
      }
    }
  }
}

/** One stream to its end. */
function converse(stub, exchange, deadline, hasAnswered) {
  return new Promise((resolve, reject) => {
    const stream = stub[exchange.constructor.method]({ deadline: deadline ?? Infinity });
    const requests = exchange.requests();
    let isOver = false;
    stream.on("data", (response) => {
      hasAnswered();
      exchange.absorb(response);
    });
    stream.on("error", (error) => { isOver = true; reject(error); });
    stream.on("end", () => { isOver = true; resolve(); });
    // Waits where the server does not take more for now.
    const send = () => {
      while (!isOver) {
        const { value, done } = requests.next();
        if (done) return stream.end();
        if (!stream.write(value)) return stream.once("drain", send);
      }
      return undefined;
    };
    send();
  });
}

function bytesOf(text) {
  return typeof text === "string" ? Buffer.from(text) : text;
}

function credentialsOf({ ca, certificate, key }) {
  const content = (file) => (file === undefined ? null : readFileSync(file));
  return grpc.credentials.createSsl(content(ca), content(key), content(certificate));
}

function target(server) {
  return server.includes(",") && !server.includes("://") ? `ipv4:${server}` : server;
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
