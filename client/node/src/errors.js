import { status } from "@grpc/grpc-js";
import protobuf from "protobufjs/minimal.js";

const refusals = new Set([
  status.INVALID_ARGUMENT,
  status.FAILED_PRECONDITION,
  status.OUT_OF_RANGE,
]);

/** The program, the path or the setup was refused; `diagnostics` holds what was raised, `record`
 * that of the job, where it was asked for. */
export class TrcError extends Error {
  constructor(message, diagnostics = [], record = undefined) {
    super(message);
    this.name = "TrcError";
    this.diagnostics = diagnostics;
    this.record = record;
  }
  /** The error that stopped the stream. */
  get cause() {
    return this.diagnostics.findLast((raised) => raised.severity === "ERROR");
  }
}

/** No answer: the server is not reachable or lost, a limit or the deadline has passed. */
export class ServerError extends Error {
  constructor(code, details, { reason = "", retryAfter } = {}) {
    super(`${status[code]}: ${details}`);
    this.name = "ServerError";
    this.code = code;
    this.reason = reason;
    this.retryAfter = retryAfter;
  }
}

/** The stream ended with OK, but what came may be half of it. */
export function noSummary() {
  return new ServerError(status.INTERNAL,
    "the server ended the stream without a summary, the path may be incomplete",
    { reason: "SUMMARY_MISSING" });
}

/** What a caller gets for a call that failed. */
export function raisedBy(error, diagnostics, record) {
  if (!refusals.has(error.code))
    return new ServerError(error.code ?? status.UNKNOWN, error.details ?? error.message, detailsOf(error));
  const refusal = new TrcError(error.details, diagnostics, record);
  const { cause } = refusal;
  // The status is in English, whatever the setup asks for.
  if (cause?.language === "de")
    refusal.message = `${cause.line ? `Zeile ${cause.line}: ` : ""}Fehler ${cause.code}: ${cause.text}`;
  return refusal;
}

/** Reason and wait of the google.rpc.Status that travels with a status. */
function detailsOf(error) {
  const found = { reason: "" };
  try {
    for (const packed of error.metadata?.get("grpc-status-details-bin") ?? []) {
      for (const any of fields(packed).get(3) ?? []) {
        const [kind, content] = [fields(any).get(1)?.[0], fields(any).get(2)?.[0]];
        if (String(kind).endsWith(".ErrorInfo"))
          found.reason = String(fields(content).get(1)?.[0] ?? "");
        if (String(kind).endsWith(".RetryInfo")) {
          const delay = fields(fields(content).get(1)?.[0] ?? Buffer.alloc(0));
          found.retryAfter = (delay.get(1)?.[0] ?? 0) + (delay.get(2)?.[0] ?? 0) * 1e-9;
        }
      }
    }
  } catch {
    // What cannot be read takes nothing from code and message.
  }
  return found;
}

/** The fields of a message without its type: numbers, and bytes of what has a length. */
function fields(message) {
  const reader = protobuf.Reader.create(message);
  const found = new Map();
  while (reader.pos < reader.len) {
    const tag = reader.uint32();
    const kind = tag & 7;
    if (kind !== 0 && kind !== 2) {
      reader.skipType(kind);
      continue;
    }
    const value = kind === 0 ? Number(reader.uint64()) : Buffer.from(reader.bytes());
    found.set(tag >>> 3, [...(found.get(tag >>> 3) ?? []), value]);
  }
  return found;
}
