/** The version of this package: that of the server it is released with. */
export const version: string;

export interface Connection {
  /** "HOST:PORT", several of one key with commas between, or "unix:/path". None: a trcd of this
   * machine is started (in PATH, or named by TRC_TRCD). */
  server?: string;
  /** Certificates, as names of PEM files; none: plain text. */
  tls?: { ca?: string; certificate?: string; key?: string };
  /** Seconds of each call; none: no end. */
  timeout?: number;
}

/** Fields of PathSetup and TrcOptions in camel case, enums also by the word of the control. */
export interface PathSettings {
  /** mm */
  radius?: number;
  selectionMode?: "G138" | "G139" | "G236" | "G237" | "G238" | "G239" | string;
  transition?: "G25" | "G26" | string;
  contourMasking?: "G140" | "G141" | string;
  feedAdaptation?: "G10" | "G11" | string;
  plane?: "G17" | "G18" | "G19" | string;
  removeMaskedBlocks?: boolean;
  /** Of the texts of diagnostics: "en", "de". */
  language?: string;
  [field: string]: unknown;
}

/** Those of ProgramSetup too. */
export interface ProgramSettings extends PathSettings {
  /** D number → radius in mm, or Tool messages. */
  tools?: Record<number, number> | object[];
}

/** A place in a program. */
export interface ProgramPlace {
  /** 1-based line of the NC text. */
  line?: number;
  /** 1-based byte of that line. */
  column?: number;
  /** N number of the block. */
  sourceNumber?: number;
  /** 0-based position of the input block. */
  sourceIndex?: number;
}

/** Another block that a diagnostic speaks of. */
export interface RelatedPlace {
  /** Which one it is: "first", "last", "other". */
  name: string;
  /** The same in words, in the language of the diagnostic. */
  text: string;
  place: ProgramPlace;
}

export interface Diagnostic {
  /** Stable public number; proto/README.md lists all of them. */
  code: number;
  severity: "NOTE" | "WARNING" | "ERROR";
  /** One sentence with the values in it. */
  message: string;
  /** What the operator or programmer can do. */
  remedy: string;
  /** 1-based line of the NC text. */
  line?: number;
  /** 1-based byte of that line. */
  column?: number;
  /** N number of the block. */
  sourceNumber?: number;
  /** 0-based position of the input block. */
  sourceIndex?: number;
  /** Where it happens, mm. */
  point?: { x: number; y: number; z: number };
  /** The numbers behind the message; lengths in mm. */
  values: Record<string, number>;
  /** What kind of thing it is, in the language that the setup asks for. */
  title: string;
  /** The title with the word at fault and the values, in the unit of the program. */
  text: string;
  /** What the operator or programmer can do, in that language. */
  help: string;
  /** Where it was found. */
  place: ProgramPlace;
  /** Other blocks it speaks of, in the order of the text. */
  relatedPlaces: RelatedPlace[];
  /** Of `title`, `text` and `help`: "en" or "de". */
  language: string;
  /** The program counts in inches there. */
  inch: boolean;
}

export interface ProgramResult {
  /** NC text with tool radius compensation resolved, G40 throughout. */
  text: string;
  /** Notes and warnings, in the order they were raised. */
  diagnostics: Diagnostic[];
  /** The ProgramSummary of the protocol. */
  summary: object;
}

export interface PathResult {
  /** CompensatedBlock messages, in path order. */
  blocks: object[];
  diagnostics: Diagnostic[];
  /** The PathSummary of the protocol. */
  summary: object;
}

/** The program, the path or the setup was refused. Nothing of it may be machined. */
export class TrcError extends Error {
  diagnostics: Diagnostic[];
  /** The error that stopped the stream; none where the call itself was wrong. */
  get cause(): Diagnostic | undefined;
}

/** No answer: the server is not reachable or lost, a limit or the deadline has passed. */
export class ServerError extends Error {
  /** A status code of gRPC. */
  code: number;
}

/** A connection to a server, for many calls. */
export class Client {
  constructor(connection?: Connection);
  compensate(text: string | Uint8Array, settings?: ProgramSettings): Promise<ProgramResult>;
  /** `blocks`: Block messages of the protocol, as { linear: { end: { x: 10 } } }. */
  compensatePath(blocks: object[], settings?: PathSettings): Promise<PathResult>;
  /** GetServerInfoResponse: version, limits, options, functions and diagnostics. */
  info(): Promise<object>;
  /** Ends the connection. */
  close(): void;
}

/** Client.compensate() over a connection of its own. */
export function compensate(text: string | Uint8Array,
  options?: Connection & ProgramSettings): Promise<ProgramResult>;

/** Client.compensatePath() over a connection of its own. */
export function compensatePath(blocks: object[],
  options?: Connection & PathSettings): Promise<PathResult>;
