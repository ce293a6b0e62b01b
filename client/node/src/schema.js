// What callers give, checked against the protocol before it is sent: the encoder drops members it
// does not know and makes numbers of anything, and a misspelled or misread one would be another path.

// The words of the control for values of enums.
const words = {
  selectionMode: {
    G138: "DIRECT", G139: "INDIRECT", G236: "ON_PATH", G237: "PERPENDICULAR",
    G238: "INSIDE_CORNER", G239: "WITHOUT_BLOCK",
  },
  transition: { G25: "LINEAR", G26: "CIRCULAR" },
  contourMasking: { G140: "OFF", G141: "ON" },
  feedAdaptation: { G10: "OFF", G11: "ON" },
  plane: { G17: "XY", G18: "ZX", G19: "YZ" },
};

const ranges = {
  TYPE_UINT32: [0, 2 ** 32 - 1],
  TYPE_INT32: [-(2 ** 31), 2 ** 31 - 1],
  TYPE_UINT64: [0, Number.MAX_SAFE_INTEGER],
};

/** What a value is, in an error. */
function shown(value) {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value === "bigint") return `${value}n`;
  return value !== null && typeof value === "object"
    ? (value.constructor?.name ?? "an object") : String(value);
}

function fault(name, takes, value) {
  return new TypeError(`${name} takes ${takes}, not ${shown(value)}`);
}

/** The message types of the protocol. */
export class Schema {
  #types = new Map();
  #definition;

  constructor(definition) {
    this.#definition = definition;
  }

  /** The fields of a message type by name in camel case. */
  fieldsOf(name) {
    if (!this.#types.has(name)) {
      const { type } = this.#definition[`trc.v1.${name}`];
      const fields = type.field.map((field) => [
        field.name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase()),
        { ...field, values: this.#valuesOf(field, type), content: contentOf(field, type) },
      ]);
      this.#types.set(name, new Map(fields));
    }
    return this.#types.get(name);
  }

  #valuesOf(field, owner) {
    if (field.type !== "TYPE_ENUM") return undefined;
    const own = owner.enumType.find(({ name }) => name === field.typeName) ??
      this.#definition[`trc.v1.${field.typeName}`].type;
    return own.value.map(({ name }) => name);
  }

  /** A message of a plain object, whose members are all known; `path` names it in errors. */
  message(name, given, path) {
    if (given === null || typeof given !== "object" || Array.isArray(given))
      throw fault(path, "an object", given);
    const known = this.fieldsOf(name);
    const made = {};
    for (const [member, value] of Object.entries(given)) {
      if (value === undefined) continue;
      const field = known.get(member);
      if (!field)
        throw new TypeError(`${path} has no "${member}"; there are ${[...known.keys()].sort().join(", ")}`);
      made[member] = this.value(field, value, path ? `${path}.${member}` : member);
    }
    return made;
  }

  /** What a field is given. */
  value(field, value, path) {
    if (field.content) {
      if (value === null || typeof value !== "object" || Array.isArray(value))
        throw fault(path, "an object of names", value);
      return Object.fromEntries(Object.entries(value).map(([name, each]) => (
        [name, this.#single(field.content, each, `${path}["${name}"]`)])));
    }
    if (field.label !== "LABEL_REPEATED") return this.#single(field, value, path);
    if (!Array.isArray(value) && !ArrayBuffer.isView(value)) throw fault(path, "an array", value);
    return Array.from(value, (each, at) => this.#single(field, each, `${path}[${at}]`));
  }

  #single(field, value, path) {
    switch (field.type) {
      case "TYPE_MESSAGE": return this.message(field.typeName, value, path);
      case "TYPE_ENUM": return enumValue(field, value, path);
      case "TYPE_BOOL":
        if (typeof value !== "boolean") throw fault(path, "true or false", value);
        return value;
      case "TYPE_STRING":
        if (typeof value !== "string") throw fault(path, "text", value);
        return value;
      case "TYPE_BYTES":
        if (!ArrayBuffer.isView(value)) throw fault(path, "bytes", value);
        return value;
      default: return number(field, value, path);
    }
  }
}

/** Of a map what its names stand for. */
function contentOf(field, owner) {
  const entry = owner.nestedType?.find(({ name, options }) => (
    name === field.typeName && options?.mapEntry));
  return entry?.field.find(({ name }) => name === "value");
}

function number(field, value, path) {
  const range = ranges[field.type];
  if (typeof value !== "number") throw fault(path, range ? "a whole number" : "a number", value);
  if (!Number.isFinite(value)) throw new RangeError(`${path} is ${value}; it takes a finite number`);
  if (range && !Number.isInteger(value)) throw fault(path, "a whole number", value);
  if (range && (value < range[0] || value > range[1]))
    throw new RangeError(`${path} is ${value}; it takes ${range[0]} to ${range[1]}`);
  return value;
}

/** By the spelling of the protocol, its last words or the word of the control. */
function enumValue({ name: field, values }, value, path) {
  if (typeof value === "number" && Number.isInteger(value)) return value;
  if (typeof value !== "string") throw fault(path, "a word", value);
  const ofControl = words[field] ?? {};
  const word = ofControl[value.toUpperCase()] ?? value.toUpperCase();
  const found = values.filter((name) => name === word || name.endsWith(`_${word}`));
  if (found.length === 1) return found[0];
  const said = values.filter((name) => !name.endsWith("_UNSPECIFIED"));
  throw new TypeError(`${path} takes ${[...Object.keys(ofControl), ...said].join(", ")}, ` +
    `not "${value}"`);
}
