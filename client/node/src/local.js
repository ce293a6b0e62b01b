// A `trcd` of this machine, for who names no server.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";

import { status } from "@grpc/grpc-js";

import { ServerError } from "./errors.js";

const startMilliseconds = 10_000;

let running;

/** The address of the local server of this process, which is started with the first call. */
export function localAddress() {
  running ??= start().catch((error) => {
    running = undefined;
    throw error;
  });
  return running;
}

function program() {
  if (process.env.TRC_TRCD) return process.env.TRC_TRCD;
  const folder = (process.env.PATH ?? "").split(delimiter)
    .find((each) => existsSync(join(each, "trcd")));
  if (folder) return join(folder, "trcd");
  throw new ServerError(status.UNAVAILABLE,
    "no server was given and there is no trcd here: pass { server: \"HOST:PORT\" }, install the " +
    "package trcd, or name the program in TRC_TRCD");
}

async function start() {
  const trcd = program();
  const folder = mkdtempSync(join(tmpdir(), "trc-"));
  const socket = join(folder, "trcd.sock");
  const child = spawn(trcd, ["--listen", `unix:${socket}`], {
    stdio: ["ignore", "ignore", "pipe"],
  });
  let said = "";
  child.stderr.on("data", (data) => { said = (said + data).slice(-4096); });
  child.on("error", (error) => { said += error.message; });
  let ended = false;
  child.on("exit", () => { ended = true; running = undefined; });
  process.once("exit", () => {
    child.kill();
    rmSync(folder, { recursive: true, force: true });
  });
  // Neither keeps the process alive.
  child.unref();
  child.stderr.unref();
  for (const begin = Date.now(); !existsSync(socket);) {
    if (ended || Date.now() - begin > startMilliseconds) {
      child.kill();
      throw new ServerError(status.UNAVAILABLE, `${trcd} did not start: ${said.trim()}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  return `unix:${socket}`;
}
