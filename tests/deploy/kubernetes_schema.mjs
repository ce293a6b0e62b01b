// Usage: kubernetes_schema.mjs FILE…
//
// Validates the objects of YAML files against the schemas of Kubernetes in two ways: kubernetes-models
// knows required fields and formats, the classes of the official client every field there is, so that
// a misspelt one is found. Says what is wrong and ends with 1.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const packages = path.join(here, '../../.ci/schemas/');
const require = createRequire(path.join(packages, 'package.json'));
const YAML = require('yaml');
// Its entry point needs a newer Node than Debian's; the models alone do not.
const models = await import(
  pathToFileURL(path.join(packages, 'node_modules/@kubernetes/client-node/dist/gen/models/all.js')));

const faults = [];

function classOf(apiVersion, kind) {
  const version = apiVersion.split('/').pop();
  return models[version[0].toUpperCase() + version.slice(1) + kind];
}

const plain = { string: 'string', number: 'number', boolean: 'boolean', Date: 'string' };

function walk(value, type, place) {
  if (type === 'any' || type === 'object' || type === 'IntOrString' || value === null) return;
  const list = /^(?:Array|Set)<(.*)>$/.exec(type);
  if (list) {
    if (!Array.isArray(value)) return void faults.push(`${place}: must be a list`);
    return value.forEach((item, index) => walk(item, list[1], `${place}[${index}]`));
  }
  const map = /^\{ \[key: string\]: (.*?);? \}$/.exec(type);
  if (map) {
    if (typeof value !== 'object' || Array.isArray(value)) return void faults.push(`${place}: must be a map`);
    return Object.entries(value).forEach(([key, item]) => walk(item, map[1], `${place}.${key}`));
  }
  if (plain[type]) {
    if (typeof value !== plain[type]) faults.push(`${place}: must be a ${plain[type]}`);
    return;
  }
  const model = models[type];
  if (!model) return void faults.push(`${place}: no schema for ${type}`);
  if (typeof value !== 'object' || Array.isArray(value)) return void faults.push(`${place}: must be an object`);
  const fields = new Map(model.getAttributeTypeMap().map((field) => [field.baseName, field.type]));
  for (const [key, item] of Object.entries(value)) {
    if (!fields.has(key)) faults.push(`${place}.${key}: there is no such field`);
    else walk(item, fields.get(key), `${place}.${key}`);
  }
}

async function strict(object, place) {
  const group = object.apiVersion.includes('/') ? object.apiVersion : object.apiVersion;
  let model;
  try {
    model = require(`kubernetes-models/${group}`)[object.kind];
  } catch {
    model = undefined;
  }
  if (!model) return void faults.push(`${place}: ${object.apiVersion} ${object.kind} is not known`);
  try {
    await new model(object).validate();
  } catch (fault) {
    faults.push(`${place}: ${fault.message}`);
  }
}

let objects = 0;
for (const file of process.argv.slice(2)) {
  for (const document of YAML.parseAllDocuments(fs.readFileSync(file, 'utf8'))) {
    for (const error of document.errors) faults.push(`${file}: ${error.message}`);
    const object = document.toJS();
    const place = `${path.basename(file)}: ${object.kind} ${object.metadata?.name}`;
    const type = classOf(object.apiVersion, object.kind);
    if (!type) faults.push(`${place}: ${object.apiVersion} is not known`);
    else walk(object, type.name, place);
    await strict(object, place);
    objects += 1;
  }
}
for (const fault of faults) console.error(fault);
if (faults.length > 0 || objects === 0) process.exit(1);
console.log(`${objects} objects`);
