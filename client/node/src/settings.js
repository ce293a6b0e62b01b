// Options of a call as the setup of the protocol. Each field of ProgramSetup, PathSetup and
// TrcOptions has its own name, in camel case; enums also by the word of the control.

/** Of a setting given under both names: which of the values is meant is not guessed. */
function twoNames(one, other) {
  return new TypeError(`${one} and ${other} are one setting; give it under one of these names`);
}

/** With those `subprograms` that are bytes, as a file has them, in `subprogramFiles`. */
function withFilesOfBytes({ subprograms, ...given }) {
  if (subprograms === null || typeof subprograms !== "object") return { subprograms, ...given };
  const [files, texts] = [true, false].map((isBytes) => Object.fromEntries(
    Object.entries(subprograms).filter(([, text]) => ArrayBuffer.isView(text) === isBytes)));
  const named = given.subprogramFiles ?? {};
  for (const name of Object.keys(files)) {
    if (named[name] !== undefined)
      throw twoNames(`subprograms["${name}"]`, `subprogramFiles["${name}"]`);
  }
  return { ...given, subprograms: texts, subprogramFiles: { ...named, ...files } };
}

/** In how many letters two names differ: one more, one less or another. */
function distance(one, other) {
  let before = [...Array(other.length + 1).keys()];
  for (let i = 0; i < one.length; ++i) {
    const row = [i + 1];
    for (let j = 0; j < other.length; ++j)
      row.push(Math.min(before[j] + (one[i] !== other[j]), before[j + 1] + 1, row[j] + 1));
    before = row;
  }
  return before[other.length];
}

/** What was meant perhaps, or what there is. */
function likely(name, known) {
  const [nearest] = [...known].sort((a, b) => distance(name, a) - distance(name, b));
  return distance(name, nearest) * 3 <= nearest.length
    ? `did you mean "${nearest}"?` : `there are ${[...new Set(known)].sort().join(", ")}`;
}

/** Splits the options of calls into the messages of the protocol they belong to. */
export class Settings {
  #schema;

  constructor(schema) {
    this.#schema = schema;
  }

  pathSetup(given) {
    const path = this.#schema.fieldsOf("PathSetup");
    const options = this.#schema.fieldsOf("TrcOptions");
    const setup = {};
    const short = {};
    for (const [name, value] of Object.entries(given)) {
      const field = name === "radius" ? "toolRadius" : name;
      if (value === undefined) continue;
      if (setup[field] !== undefined) throw twoNames("radius", "toolRadius");
      if (path.has(field)) {
        setup[field] = this.#schema.value(path.get(field), value, name);
      } else if (options.has(field)) {
        short[field] = this.#schema.value(options.get(field), value, name);
      } else {
        const own = this.#schema.fieldsOf("ProgramSetup").keys();
        const known = ["radius", ...path.keys(), ...options.keys(), ...own];
        throw new TypeError(`"${name}" is no setting; ${likely(name, known)}`);
      }
    }
    for (const name of Object.keys(short))
      if (setup.options?.[name] !== undefined) throw twoNames(name, `options.${name}`);
    if (Object.keys(short).length) setup.options = { ...setup.options, ...short };
    return setup;
  }

  programSetup({ tools, ...given }) {
    for (const name of ["output", "responseLayout"]) {
      if (given[name] !== undefined)
        throw new TypeError(`${name} is no setting here: text comes out, and with blocks: true of ` +
          "compensate() the blocks too");
    }
    const own = this.#schema.fieldsOf("ProgramSetup");
    const setup = {};
    const path = {};
    for (const [name, value] of Object.entries(withFilesOfBytes(given))) {
      if (value === undefined) continue;
      const isOwn = own.has(name) && name !== "path";
      if (isOwn) setup[name] = this.#schema.value(own.get(name), value, name);
      else path[name] = value;
    }
    if (tools !== undefined) setup.tools = this.#toolTable(tools);
    return { ...setup, path: this.pathSetup(path) };
  }

  #toolTable(tools) {
    if (tools === null || typeof tools !== "object")
      throw new TypeError(`tools takes { number: radius }, or an array of Tool messages, not ${tools}`);
    const table = Array.isArray(tools) ? tools : Object.entries(tools).map(([number, radius]) => (
      { number: Number(number), radius }));
    return table.map((tool, at) => {
      const made = this.#schema.message("Tool", tool, `tools[${at}]`);
      if (made.number === undefined || made.radius === undefined)
        throw new TypeError(`tools[${at}] has no ${made.number === undefined ? "number" : "radius"}`);
      return made;
    });
  }

  surveySetup(given, isPath) {
    const { radii = [], uncut = false, largest = true, ...settings } = given;
    const own = this.#schema.fieldsOf("SurveySetup");
    const input = isPath ? { path: this.pathSetup(settings) }
      : { program: this.programSetup(settings) };
    return {
      ...input,
      radii: this.#schema.value(own.get("radii"), radii, "radii"),
      wantUncut: this.#schema.value(own.get("wantUncut"), uncut, "uncut"),
      withoutLargest: !largest,
    };
  }

  /** Block messages, checked. */
  blocks(given) {
    if (!Array.isArray(given)) throw new TypeError("a path is an array of Block messages");
    return given.map((block, at) => {
      const made = this.#schema.message("Block", block, `blocks[${at}]`);
      const kinds = Object.keys(made).filter((name) => name !== "sourceNumber");
      if (kinds.length === 1) return made;
      throw new TypeError(`blocks[${at}] is ${kinds.join(" and ") || "nothing"}; it takes one of ` +
        "linear, circular, command, passthrough");
    });
  }
}
