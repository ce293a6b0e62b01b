// The package carries the protos it was made with.
import { cpSync, existsSync, rmSync } from "node:fs";
import { fileURLToPath } from "node:url";

const inTree = fileURLToPath(new URL("../../proto/trc/v1", import.meta.url));
const packed = fileURLToPath(new URL("proto/trc/v1", import.meta.url));
if (existsSync(inTree)) {
  rmSync(packed, { recursive: true, force: true });
  cpSync(inTree, packed, { recursive: true });
}
