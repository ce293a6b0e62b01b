// node compensate.mjs ADDRESS FILE: the program with TRC resolved on standard output, diagnostics on
// standard error. With the package of client/node.
import { readFileSync } from "node:fs";

import { compensate, TrcError } from "trc-client";

const [server, file] = process.argv.slice(2);
if (!file) {
  console.error("usage: node compensate.mjs ADDRESS FILE");
  process.exit(2);
}

const show = (raised) => console.error(`line ${raised.line}: ${raised.code} ${raised.message}`);
try {
  const { text, diagnostics } = await compensate(readFileSync(file), { server });
  diagnostics.forEach(show);
  process.stdout.write(text);
} catch (error) {
  if (error instanceof TrcError) error.diagnostics.forEach(show);
  console.error(error.message);
  process.exitCode = 1;
}
