// Usage: cyclonedx.js FILE. Validates a bill of materials against the JSON schema of CycloneDX 1.5.
const fs = require('fs');
const path = require('path');
const { createRequire } = require('module');

const packages = createRequire(path.join(__dirname, '../../.ci/schemas/package.json'));
const { Validation, Spec } = packages('@cyclonedx/cyclonedx-library');

const validator = new Validation.JsonStrictValidator(Spec.Version.v1dot5);
validator.validate(fs.readFileSync(process.argv[2], 'utf8')).then((fault) => {
  if (fault !== null) {
    console.error(JSON.stringify(fault, null, 2));
    process.exit(1);
  }
}, (error) => {
  console.error(error.message);
  process.exit(1);
});
