// node mikktspace.mjs NODE_MODULES IN OUT: tangents of unindexed triangles by three.js's MikkTSpace, turned as glTF wants
// them (three.js, computeMikkTSpaceTangents: "the .w component must be flipped to use" glTF's coordinates).
// IN: positions, normals (3 floats a corner) and coordinates (2); OUT: 4 floats a corner.
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [modules, from, to] = process.argv.slice(2);
const mikk = await import(pathToFileURL(`${modules}/three/examples/jsm/libs/mikktspace.module.js`));
await mikk.ready;
const bytes = readFileSync(from);
const all = new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4);
const corners = all.length / 8;
const tangents = mikk.generateTangents(all.slice(0, 3 * corners), all.slice(3 * corners, 6 * corners), all.slice(6 * corners));
for (let i = 3; i < tangents.length; i += 4) tangents[i] *= -1;
writeFileSync(to, Buffer.from(tangents.buffer, tangents.byteOffset, tangents.byteLength));
