// node compensate.js ADDRESS FILE: the program with TRC resolved on standard output, diagnostics on
// standard error. Run `npm install` here first.

const fs = require("fs");
const path = require("path");
const grpc = require("@grpc/grpc-js");
const loader = require("@grpc/proto-loader");

const chunk = 64 * 1024;
const protos = path.join(__dirname, "..", "..", "..", "proto");

const [address, file] = process.argv.slice(2);
if (!file) {
  console.error("usage: node compensate.js ADDRESS FILE");
  process.exit(2);
}

const definition = loader.loadSync("trc/v1/trc_service.proto", {
  includeDirs: [protos],
  longs: Number,
  defaults: true,
});
const { TrcService } = grpc.loadPackageDefinition(definition).trc.v1;
const client = new TrcService(address, grpc.credentials.createInsecure());
const stream = client.CompensateProgram();

stream.on("data", (response) => {
  process.stdout.write(response.ncText);
  for (const raised of response.diagnostics)
    console.error(`line ${raised.line}: ${raised.code} ${raised.message}`);
});
stream.on("error", (error) => {
  console.error(error.details);
  process.exitCode = 1;
});
stream.on("end", () => client.close());

const text = fs.readFileSync(file);

// Waits where the server does not take more for now.
function send(first) {
  while (first < text.length) {
    const piece = text.subarray(first, first + chunk);
    const goesOn = stream.write({ text: { firstByte: first, text: piece } });
    first += piece.length;
    if (!goesOn) return stream.once("drain", () => send(first));
  }
  stream.end({ text: { firstByte: text.length, final: true } });
}

stream.write({ setup: {} });
send(0);
