// One stream, from the setup to the summary: what is sent, what has come, where to go on. A stream
// that is lost goes on from the last resume token, on any server of the same version and key; what
// came after the token comes again and is dropped here, so that the joined answer is that of an
// unbroken stream.
import { StringDecoder } from "node:string_decoder";

import { noSummary } from "./errors.js";

const textBytes = 64 * 1024;
const batchBlocks = 1024;

/** All text from a byte on, in messages. */
function* textRequests(text, position) {
  for (let first = position; ; first += textBytes) {
    const piece = text.subarray(first, first + textBytes);
    const final = first + piece.length === text.length;
    yield { text: { firstByte: first, text: piece, final } };
    if (final) return;
  }
}

/** All blocks from one on, in messages. */
function* pathRequests(blocks, position) {
  for (let first = position; ; first += batchBlocks) {
    const batch = blocks.slice(first, first + batchBlocks);
    const final = first + batch.length === blocks.length;
    yield { batch: { firstBlock: first, blocks: batch, final } };
    if (final) return;
  }
}

class Exchange {
  #token = Buffer.alloc(0);
  #certain = { parts: 0, diagnostics: 0 };
  position = 0;
  parts = [];
  diagnostics = [];
  summary = undefined;

  /** `setup`: the PathSetup of the stream. */
  constructor(setup) {
    this.pathSetup = setup;
    setup.wantResumeTokens = true;
  }

  /** The stream was lost: back to what the last token holds. */
  goOn() {
    this.parts.length = this.#certain.parts;
    this.diagnostics.length = this.#certain.diagnostics;
    this.summary = undefined;
    this.pathSetup.resumeToken = this.#token;
  }

  absorbPart(part, response, consumed) {
    if (part !== undefined) this.parts.push(part);
    for (const raised of response.diagnostics ?? []) this.diagnostics.push(plain(raised));
    if (response.resumeToken?.length > 0 && consumed !== undefined) {
      this.#token = response.resumeToken;
      this.position = consumed;
      this.#certain = { parts: this.parts.length, diagnostics: this.diagnostics.length };
    }
    if (response.summary) this.summary = response.summary;
  }

  /** What has come since it was asked last and will not come again; none: nothing. With the summary
   * alone a stream may be lost still, and comes again then. */
  take() {
    const { parts, diagnostics } = this.#certain;
    if (parts === 0 && diagnostics === 0) return undefined;
    this.#certain = { parts: 0, diagnostics: 0 };
    return this.#first(parts, diagnostics);
  }

  /** The rest, with the summary; the stream has ended with OK. */
  result() {
    if (this.summary === undefined) throw noSummary();
    return {
      ...this.#first(this.parts.length, this.diagnostics.length), ...this.atEnd(),
      summary: this.summary,
    };
  }

  #first(parts, diagnostics) {
    return {
      ...this.joined(this.parts.splice(0, parts)),
      diagnostics: this.diagnostics.splice(0, diagnostics),
    };
  }
}

/** NC text to NC text. */
export class ProgramExchange extends Exchange {
  static method = "compensateProgram";
  record = undefined;
  // A character may lie across two parts.
  #decoder = new StringDecoder("utf8");

  constructor(text, setup) {
    super(setup.path);
    this.setup = setup;
    this.text = text;
  }

  *requests() {
    yield { setup: this.setup };
    yield* textRequests(this.text, this.position);
  }

  absorb(response) {
    const part = response.ncText?.length > 0 ? response.ncText : undefined;
    this.record = response.record || this.record;
    this.absorbPart(part, response, Number(response.consumedBytes ?? 0));
  }

  joined(parts) {
    return { text: this.#decoder.write(Buffer.concat(parts)) };
  }

  /** The same program with the same setup once more, for its blocks. */
  forBlocks() {
    return new ProgramBlocksExchange(this.text, this.setup);
  }

  atEnd() {
    return { record: this.record };
  }
}

/** NC text to compensated blocks: those whose text ProgramExchange has. */
export class ProgramBlocksExchange extends ProgramExchange {
  constructor(text, { record, ...setup }) {
    super(text, {
      ...setup, output: "PROGRAM_OUTPUT_BLOCKS",
      path: { ...setup.path, responseLayout: "RESPONSE_LAYOUT_BLOCKS" },
    });
  }

  absorb(response) {
    this.absorbPart(response.batch?.blocks, response, Number(response.consumedBytes ?? 0));
  }

  joined(parts) {
    return { blocks: parts.flat() };
  }
}

/** Motion blocks to compensated blocks. */
export class PathExchange extends Exchange {
  static method = "compensatePath";

  constructor(blocks, setup) {
    super(setup);
    this.blocks = blocks;
  }

  *requests() {
    yield { setup: this.pathSetup };
    yield* pathRequests(this.blocks, this.position);
  }

  absorb(response) {
    const consumed = response.consumedThroughBlock;
    this.absorbPart(response.batch?.blocks, response,
      consumed === undefined ? 0 : Number(consumed) + 1);
  }

  joined(parts) {
    return { blocks: parts.flat() };
  }

  atEnd() {
    return {};
  }
}

/** One program or path and many radii. One that is lost begins anew. */
export class SurveyExchange {
  static method = "surveyRadii";
  #radii = [];
  #summary = undefined;
  diagnostics = [];

  /** `source`: text as bytes, or blocks. */
  constructor(source, setup) {
    this.source = source;
    this.setup = setup;
  }

  *requests() {
    yield { setup: this.setup };
    if (Array.isArray(this.source)) yield* pathRequests(this.source, 0);
    else yield* textRequests(this.source, 0);
  }

  absorb(response) {
    for (const raised of response.diagnostics ?? []) this.diagnostics.push(plain(raised));
    if (response.radius) this.#radii.push(surveyed(response.radius));
    if (response.summary) this.#summary = response.summary;
  }

  goOn() {
    this.#radii = [];
    this.#summary = undefined;
    this.diagnostics = [];
  }

  result() {
    if (this.#summary === undefined) throw noSummary();
    const { largest, ...summary } = this.#summary;
    return {
      radii: this.#radii,
      largest: largest ? limited(largest) : undefined,
      diagnostics: this.diagnostics,
      summary,
    };
  }
}

/** A SurveyedRadius whose members are there also where they are 0, false or empty. */
function surveyed(found) {
  return {
    ...limited(found),
    accepted: found.accepted ?? false,
    reachesEveryWall: found.reachesEveryWall ?? false,
    maskedShare: found.maskedShare ?? 0,
    warnings: found.warnings ?? 0,
    uncutByRemoval: found.uncutByRemoval ?? false,
    uncut: (found.uncut ?? []).map((wall) => ({ ...wall, place: placeOf(wall.place) })),
    uncutLeftOut: found.uncutLeftOut ?? 0,
  };
}

/** What surveyed radii and the largest one have in common. */
function limited(found) {
  return {
    ...found,
    radius: found.radius ?? 0,
    refusal: found.refusal ? plain(found.refusal) : undefined,
    limits: (found.limits ?? []).map(placeOf),
  };
}

/** A line of 0 stands for none. */
function placeOf(place) {
  return { ...place, sourceIndex: place.sourceIndex ?? 0, line: place.line || undefined };
}

function plain(raised) {
  return {
    ...raised,
    sourceNumber: raised.sourceNumber === undefined ? undefined : Number(raised.sourceNumber),
    place: raised.place ?? {},
    relatedPlaces: raised.relatedPlaces ?? [],
  };
}
