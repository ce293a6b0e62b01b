// One stream, from the setup to the summary: what is sent, what has come, where to go on. A stream
// that is lost goes on from the last resume token, on any server of the same version and key; what
// came behind the token comes again and is dropped here, so that the joined answer is that of an
// unbroken stream.

const textBytes = 64 * 1024;
const batchBlocks = 1024;

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
}

/** NC text to NC text. */
export class ProgramExchange extends Exchange {
  static method = "compensateProgram";

  constructor(text, setup) {
    super(setup.path);
    this.setup = setup;
    this.text = text;
  }

  *requests() {
    yield { setup: this.setup };
    for (let first = this.position; ; first += textBytes) {
      const piece = this.text.subarray(first, first + textBytes);
      const final = first + piece.length === this.text.length;
      yield { text: { firstByte: first, text: piece, final } };
      if (final) return;
    }
  }

  absorb(response) {
    const part = response.ncText?.length > 0 ? response.ncText : undefined;
    this.absorbPart(part, response, Number(response.consumedBytes ?? 0));
  }

  result() {
    const { diagnostics, summary } = this;
    return { text: Buffer.concat(this.parts).toString(), diagnostics, summary };
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
    for (let first = this.position; ; first += batchBlocks) {
      const blocks = this.blocks.slice(first, first + batchBlocks);
      const final = first + blocks.length === this.blocks.length;
      yield { batch: { firstBlock: first, blocks, final } };
      if (final) return;
    }
  }

  absorb(response) {
    const consumed = response.consumedThroughBlock;
    this.absorbPart(response.batch?.blocks, response,
      consumed === undefined ? 0 : Number(consumed) + 1);
  }

  result() {
    const { diagnostics, summary } = this;
    return { blocks: this.parts.flat(), diagnostics, summary };
  }
}

function plain(raised) {
  return {
    ...raised,
    sourceNumber: raised.sourceNumber === undefined ? undefined : Number(raised.sourceNumber),
    place: raised.place ?? {},
    relatedPlaces: raised.relatedPlaces ?? [],
  };
}
