// A `trcd` of this machine, for who names no server.
import { spawn } from "node:child_process";
import { accessSync, constants, mkdtempSync, rmSync, statSync } from "node:fs";
import { connect } from "node:net";
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

function inPath(name) {
  return (process.env.PATH ?? "").split(delimiter).filter(Boolean)
    .map((folder) => join(folder, name)).find((file) => {
      try {
        accessSync(file, constants.X_OK);
        return statSync(file).isFile();
      } catch {
        return false;
      }
    });
}

function program() {
  const trcd = process.env.TRC_TRCD || inPath("trcd");
  if (trcd) return trcd;
  throw new ServerError(status.UNAVAILABLE,
    "no server was given and there is no trcd here: pass { server: \"HOST:PORT\" }, install the " +
    "package trcd, or name the program in TRC_TRCD");
}

// The file is there a moment before the server listens at it.
function listens(socket) {
  return new Promise((resolve) => {
    const connection = connect(socket, () => { connection.destroy(); resolve(true); });
    connection.on("error", () => resolve(false));
  });
}

async function start() {
  const trcd = program();
  const folder = mkdtempSync(join(tmpdir(), "trc-"));
  const socket = join(folder, "trcd.sock");
  // The kernel ends the server with this process, however that ends.
  const setpriv = inPath("setpriv");
  const command = [...(setpriv ? [setpriv, "--pdeathsig", "TERM"] : []), trcd,
    "--listen", `unix:${socket}`];
  const child = spawn(command[0], command.slice(1), { stdio: ["ignore", "ignore", "pipe"] });
  let said = "";
  child.stderr.on("data", (data) => { said = (said + data).slice(-4096); });
  child.on("error", (error) => { said += error.message; });
  let ended = false;
  const remove = () => rmSync(folder, { recursive: true, force: true });
  const stop = () => { child.kill(); remove(); };
  child.on("error", () => { ended = true; });
  child.on("exit", () => {
    ended = true;
    running = undefined;
    process.off("exit", stop);
    remove();
  });
  process.once("exit", stop);
  // Neither keeps the process alive.
  child.unref();
  child.stderr.unref();
  for (const begin = Date.now(); !await listens(socket);) {
    if (ended || Date.now() - begin > startMilliseconds) {
      stop();
      throw new ServerError(status.UNAVAILABLE, `${trcd} did not start: ${said.trim()}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  return `unix:${socket}`;
}
