// Options of a call as the setup of the protocol. Each field of ProgramSetup, PathSetup and
// TrcOptions has its own name, in camel case; enums also by the word of the control.

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

/** The fields of a message type: name in camel case → values of its enum, or null. */
function fieldsOf(type, definition) {
  return new Map(type.type.field.map((field) => {
    const name = field.name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
    const enumType = field.type === "TYPE_ENUM"
      ? definition[`trc.v1.${field.typeName.split(".").pop()}`] : undefined;
    return [name, enumType ? enumType.type.value.map((value) => value.name) : null];
  }));
}

/** Splits the options of calls into the messages of the protocol they belong to. */
export class Settings {
  constructor(definition) {
    this.program = fieldsOf(definition["trc.v1.ProgramSetup"], definition);
    this.path = fieldsOf(definition["trc.v1.PathSetup"], definition);
    this.options = fieldsOf(definition["trc.v1.TrcOptions"], definition);
  }

  pathSetup(given) {
    const setup = {};
    for (const [name, value] of Object.entries(given)) {
      const field = name === "radius" ? "toolRadius" : name;
      if (value === undefined) continue;
      if (this.path.has(field)) {
        setup[field] = enumValue(field, this.path.get(field), value);
      } else if (this.options.has(field)) {
        setup.options = { ...setup.options, [field]: value };
      } else {
        const known = [...this.path.keys(), ...this.options.keys()].sort().join(", ");
        throw new TypeError(`"${name}" is no setting; there are ${known}`);
      }
    }
    return setup;
  }

  programSetup(given) {
    const setup = {};
    const path = {};
    for (const [name, value] of Object.entries(given)) {
      const isOwn = this.program.has(name) && name !== "path";
      if (isOwn) setup[name] = enumValue(name, this.program.get(name), value);
      else path[name] = value;
    }
    if (setup.tools && !Array.isArray(setup.tools))
      setup.tools = Object.entries(setup.tools).map(([number, radius]) => (
        { number: Number(number), radius }));
    return { ...setup, path: this.pathSetup(path) };
  }

  surveySetup(given, isPath) {
    const { radii = [], uncut = false, largest = true, ...settings } = given;
    const input = isPath ? { path: this.pathSetup(settings) }
      : { program: this.programSetup(settings) };
    return { ...input, radii, wantUncut: uncut, withoutLargest: !largest };
  }
}

function enumValue(field, names, value) {
  if (names === null || typeof value !== "string") return value;
  const word = words[field]?.[value.toUpperCase()] ?? value.toUpperCase();
  return names.find((name) => name === word || name.endsWith(`_${word}`)) ?? value;
}
