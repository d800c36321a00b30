// Khronos' glTF validator on files: node validate_gltf.mjs FILES...
// Ends with 1 on any error or warning. Told as information only, and so allowed: the validator does not know MSFT_lod, and
// calls the nodes behind it unused. Finds gltf-validator from here upwards or in GLCAST_NODE_MODULES.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { join } from 'node:path';

function loadValidator() {
  const folders = [import.meta.url];
  if (process.env.GLCAST_NODE_MODULES) folders.unshift(join(process.env.GLCAST_NODE_MODULES, 'none.js'));
  for (const from of folders) {
    try {
      return createRequire(from)('gltf-validator');
    } catch (error) {
      if (error.code !== 'MODULE_NOT_FOUND') throw error;
    }
  }
  console.error('validate_gltf: gltf-validator is missing; run "npm ci" in the source folder');
  process.exit(2);
}

const validator = loadValidator();
const files = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node validate_gltf.mjs FILES...');
  process.exit(2);
}
const allowedInfos = new Set(['UNSUPPORTED_EXTENSION', 'UNUSED_OBJECT']);
let bad = 0;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), { uri: file, maxIssues: 100 });
  const { numErrors, numWarnings, messages } = report.issues;
  const odd = messages.filter((m) => m.severity < 2 || !allowedInfos.has(m.code));
  if (odd.length > 0 || numErrors > 0 || numWarnings > 0) ++bad;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${messages.length - numErrors - numWarnings} other`);
  for (const m of odd) console.log(`  ${m.code} at ${m.pointer ?? m.offset ?? '?'}: ${m.message}`);
}
process.exit(bad ? 1 : 0);
