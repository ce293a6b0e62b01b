import { status } from "@grpc/grpc-js";

const refusals = new Set([
  status.INVALID_ARGUMENT,
  status.FAILED_PRECONDITION,
  status.OUT_OF_RANGE,
]);

/** The program, the path or the setup was refused; `diagnostics` holds what was raised. */
export class TrcError extends Error {
  constructor(message, diagnostics = []) {
    super(message);
    this.name = "TrcError";
    this.diagnostics = diagnostics;
  }
  /** The error that stopped the stream. */
  get cause() {
    return this.diagnostics.findLast((raised) => raised.severity === "ERROR");
  }
}

/** No answer: the server is not reachable or lost, a limit or the deadline has passed. */
export class ServerError extends Error {
  constructor(code, details) {
    super(`${status[code]}: ${details}`);
    this.name = "ServerError";
    this.code = code;
  }
}

/** What a caller gets for a call that failed. */
export function raisedBy(error, diagnostics) {
  return refusals.has(error.code)
    ? new TrcError(error.details, diagnostics)
    : new ServerError(error.code ?? status.UNKNOWN, error.details ?? error.message);
}
