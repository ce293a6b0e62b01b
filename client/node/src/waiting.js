// How long to wait for a server that is lost or full, and whether to.
import { status } from "@grpc/grpc-js";

const patience = 60_000; // ms without an answer
const firstWait = 100;
const longestWait = 5_000;
const triesUnanswered = 3;

/** The stream was lost, or not taken: nothing says that the program or the server has a fault.
 * Balancers report a server that died as CANCELLED or INTERNAL, gRPC itself some resets as UNKNOWN,
 * and RESOURCE_EXHAUSTED where its buffers are full; what the server itself says has a reason. */
function isLost({ code, reason, message }, answered) {
  if (code === status.UNAVAILABLE || reason === "STREAM_IDLE") return true;
  if (reason || (code === status.RESOURCE_EXHAUSTED && message.includes("larger than max")))
    return false;
  if (code === status.CANCELLED || code === status.RESOURCE_EXHAUSTED) return true;
  return answered && (code === status.INTERNAL || code === status.UNKNOWN);
}

/** For one call: waits grow from try to try, with a part of chance in them. */
export class Waiting {
  #heard = Date.now();
  #tries = 0;
  answered = false;

  /** `timeout`: s; none: no end. */
  constructor(timeout) {
    this.deadline = timeout === undefined ? Infinity : Date.now() + timeout * 1000;
  }

  hasAnswered() {
    this.answered = true;
    this.#tries = 0;
    this.#heard = Date.now();
  }

  /** ms to wait before the stream is tried again; none: it is not. A server that was never there is
   * tried a few times, one that was lost as long as there is patience, and one that has no room too,
   * as long as it says each time. */
  beforeNextTry(error) {
    this.#tries += 1;
    if (error.retryAfter === undefined) {
      if (!isLost(error, this.answered)) return undefined;
      if (!this.answered && this.#tries >= triesUnanswered) return undefined;
    }
    const grown = Math.min(firstWait * 2 ** (this.#tries - 1), longestWait) * (1 + Math.random()) / 2;
    const wait = Math.max(grown, (error.retryAfter ?? 0) * 1000);
    const ends = Math.min(this.#heard + patience, this.deadline);
    return Date.now() + wait < ends ? wait : undefined;
  }
}
