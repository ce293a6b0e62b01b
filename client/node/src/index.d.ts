/** The version of this package: that of the server it is released with. */
export const version: string;

export interface Connection {
  /** "HOST:PORT", several of one key with commas between, or "unix:/path". None: a trcd of this
   * machine is started (in PATH, or named by TRC_TRCD). */
  server?: string;
  /** Certificates, as names of PEM files; none: plain text. */
  tls?: { ca?: string; certificate?: string; key?: string };
  /** Seconds of each call, more than 0; none: no end. A server that is lost, or has no room, is
   * waited for up to a minute. */
  timeout?: number;
}

/** What ends a call before its time: the promise is rejected with the reason of the signal. */
export interface Abortable {
  signal?: AbortSignal;
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
  /** What variables hold that a program does not set itself: `#500`. */
  variables?: Record<string, number>;
  /** Texts of subprograms, or the bytes of their files, by name: `O1001.nc`. */
  subprograms?: Record<string, string | Uint8Array>;
  /** Asks for the record of the job. */
  record?: boolean;
}

/** What the result of a program is to have besides its text. */
export interface Wanted {
  /** The compensated blocks, for which the program is sent once more. None: false. */
  blocks?: boolean;
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
  /** With `record`: the record of the job as JSON, to be filed as it is. */
  record?: string;
  /** With `blocks`: the path of the text, CompensatedBlock messages. */
  blocks?: object[];
}

export interface PathResult {
  /** CompensatedBlock messages, in path order. */
  blocks: object[];
  diagnostics: Diagnostic[];
  /** The PathSummary of the protocol. */
  summary: object;
}

/** A part of a compensated program, in the order of the program. */
export interface ProgramPart {
  /** The next lines, or a piece of one; may be empty. */
  text: string;
  /** What was told since the part before. */
  diagnostics: Diagnostic[];
  /** Of the last part: the ProgramSummary of the protocol. */
  summary?: object;
}

/** A part of a compensated path, in path order. */
export interface PathPart {
  /** The next CompensatedBlock messages; may be empty. */
  blocks: object[];
  /** What was told since the part before. */
  diagnostics: Diagnostic[];
  /** Of the last part: the PathSummary of the protocol. */
  summary?: object;
}

/** What is asked of a survey, besides the settings of the program or the path. */
export interface SurveyQuestions extends ProgramSettings {
  /** mm, 0.0001 to 107374, each at most once, 64 at most; each takes the place of every radius that
   * settings and program give. */
  radii?: number[];
  /** Names the stretches of wall that each radius leaves uncut. None: false. */
  uncut?: boolean;
  /** Looks for the largest radius that reaches every wall. None: true. */
  largest?: boolean;
}

/** A block of the program. */
export interface SurveyPlace {
  /** 0-based position of the input block. */
  sourceIndex: number;
  /** 1-based line of the NC text; none: a path. */
  line?: number;
  /** N number of the block. */
  sourceNumber?: number;
}

export interface Point { x?: number; y?: number; z?: number }

/** A stretch of a wall that the path does not touch; points in the plane, mm. A coordinate that is
 * absent is 0. */
export interface UncutWall {
  place: SurveyPlace;
  start: Point;
  end: Point;
  /** Of an arc. */
  center?: Point;
  /** Of an arc: rad, positive: counter-clockwise. */
  sweep?: number;
}

/** What becomes of the program with one radius. */
export interface SurveyedRadius {
  /** Of the tool, mm. */
  radius: number;
  /** It is compensated, and the path is nowhere nearer than the tool radius. */
  accepted: boolean;
  /** Why it is not accepted. */
  refusal?: Diagnostic;
  /** It is accepted, nothing is left out, and it comes nowhere too near. */
  reachesEveryWall: boolean;
  /** Share of the wall length in masked blocks and removed loops, 0 to 1. */
  maskedShare: number;
  /** The Certificate of the protocol; none: it was refused, or nothing is compensated. */
  certificate?: { clearance: number; toolRadius: number; point: Point; [field: string]: unknown };
  /** mm, in the plane; none: it was refused. */
  compensatedLength?: number;
  /** mm, in the plane; none: it was refused. */
  programmedLength?: number;
  /** How many diagnostics are warnings. */
  warnings: number;
  /** Length of all walls, mm; none: not known. */
  wallLength?: number;
  /** Length of the walls that the path does not touch, mm, inside corners too; none: not known. */
  uncutLength?: number;
  /** The radius is refused: both lengths are those of the path that leaves the loops out. */
  uncutByRemoval: boolean;
  /** With `uncut`: the stretches, in the order of the program, 2000 at most. */
  uncut: UncutWall[];
  /** How many more stretches there were. */
  uncutLeftOut: number;
  /** What is in the way where it does not reach every wall: two blocks, or one. */
  limits: SurveyPlace[];
}

/** The largest radius that reaches every wall. */
export interface LargestRadius {
  /** mm, in whole micrometres; 0: there is none. */
  radius: number;
  /** A tool larger by a micrometre does not. Else the search ended, much above the part's size. */
  isLimited?: boolean;
  /** The blocks that limit it: two, or one that is too small by itself. */
  limits: SurveyPlace[];
  /** What a larger tool is refused with; none: it leaves something out. */
  refusal?: Diagnostic;
}

export interface SurveyResult {
  /** In the order asked. */
  radii: SurveyedRadius[];
  /** None: it was not asked for. */
  largest?: LargestRadius;
  /** Notes and warnings of reading, which hold for every radius. */
  diagnostics: Diagnostic[];
  /** The SurveySummary of the protocol, without `largest`. */
  summary: object;
}

/** The program, the path or the setup was refused. Nothing of it may be machined. */
export class TrcError extends Error {
  diagnostics: Diagnostic[];
  /** The error that stopped the stream; none where the call itself was wrong. */
  get cause(): Diagnostic | undefined;
  /** With `record`: the record of the job as JSON. */
  record?: string;
}

/** No answer: the server is not reachable or lost, a limit or the deadline has passed. */
export class ServerError extends Error {
  /** A status code of gRPC. */
  code: number;
  /** The server's own word for it, UPPER_SNAKE and stable; empty where it gave none. */
  reason: string;
  /** Seconds after which it may have room; none: waiting does not help by itself. */
  retryAfter?: number;
}

/** A connection to a server, for many calls. */
export class Client {
  constructor(connection?: Connection);
  /** The NC program with tool radius compensation resolved. Rejects with TrcError where the program
   * is refused, ServerError where there is no answer, TypeError or RangeError where an argument is
   * wrong by itself. */
  compensate(text: string | Uint8Array,
    settings?: ProgramSettings & Wanted & Abortable): Promise<ProgramResult>;
  /** `blocks`: Block messages of the protocol, as { linear: { end: { x: 10 } } }. */
  compensatePath(blocks: object[], settings?: PathSettings & Abortable): Promise<PathResult>;
  /** As compensate(), in parts as they become certain, for `for await`; the last one has the
   * summary, and nothing may be machined before. A loop that is left gives the stream up. */
  stream(text: string | Uint8Array,
    settings?: ProgramSettings & Abortable): AsyncGenerator<ProgramPart, void, void>;
  /** As compensatePath(), in parts: see stream(). */
  streamPath(blocks: object[],
    settings?: PathSettings & Abortable): AsyncGenerator<PathPart, void, void>;
  /** What tools of many radii make of an NC program, or of Block messages. A radius that does not
   * fit is told; TrcError says that the program is wrong with every radius. */
  surveyRadii(program: string | Uint8Array | object[],
    questions?: SurveyQuestions & Abortable): Promise<SurveyResult>;
  /** GetServerInfoResponse: version, limits, options, functions and diagnostics. */
  info(): Promise<object>;
  /** Ends the connection when the calls that run have ended; takes no other ones. */
  close(): void;
}

/** Client.compensate() over a connection of its own. */
export function compensate(text: string | Uint8Array,
  options?: Connection & ProgramSettings & Wanted & Abortable): Promise<ProgramResult>;

/** Client.compensatePath() over a connection of its own. */
export function compensatePath(blocks: object[],
  options?: Connection & PathSettings & Abortable): Promise<PathResult>;

/** Client.surveyRadii() over a connection of its own. */
export function surveyRadii(program: string | Uint8Array | object[],
  options?: Connection & SurveyQuestions & Abortable): Promise<SurveyResult>;
