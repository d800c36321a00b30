// Simplifies by meshoptimizer of npm: meshoptimizer.mjs IN OUT TRIANGLES attributes|update
//
// IN and OUT, little-endian: number of vertices, number of triangles (uint32); positions, then normal and colour of
// each vertex (float32); corners (uint32). Normals and colours weigh .1, as in the library's own tools.
import { readFileSync, writeFileSync } from 'node:fs';
import { MeshoptSimplifier } from 'meshoptimizer/simplifier';

const weights = [0.1, 0.1, 0.1, 0.1, 0.1, 0.1];
const enough = 1.05; // of the triangles asked for

function read(path) {
    const bytes = readFileSync(path);
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
    const [vertices, triangles] = new Uint32Array(buffer, 0, 2);
    return {
        positions: new Float32Array(buffer, 8, 3 * vertices),
        attributes: new Float32Array(buffer, 8 + 12 * vertices, 6 * vertices),
        corners: new Uint32Array(buffer, 8 + 36 * vertices, 3 * triangles),
    };
}

function write(path, { positions, attributes, corners }) {
    const head = new Uint32Array([positions.length / 3, corners.length / 3]);
    writeFileSync(path, Buffer.concat([head, positions, attributes, corners].map((part) =>
        Buffer.from(part.buffer, part.byteOffset, part.byteLength))));
}

function simplified(mesh, triangles, how, flags) {
    const positions = mesh.positions.slice(), attributes = mesh.attributes.slice(), corners = mesh.corners.slice();
    const wanted = Math.min(3 * triangles, corners.length), anyError = 1e9;
    if (how === 'update') {
        const [count] = MeshoptSimplifier.simplifyWithUpdate(
            corners, positions, 3, attributes, 6, weights, null, wanted, anyError, flags);
        return { positions, attributes, corners: corners.slice(0, count) };
    }
    const [left] = MeshoptSimplifier.simplifyWithAttributes(
        corners, positions, 3, attributes, 6, weights, null, wanted, anyError, flags);
    return { positions, attributes, corners: left };
}

await MeshoptSimplifier.ready;
const [input, output, triangles, how] = process.argv.slice(2);
const mesh = read(input);
let made = simplified(mesh, Number(triangles), how, []);
// Seams of normals and colours hold a mesh; the library's own answer is to let collapses go over them.
if (made.corners.length > enough * 3 * Number(triangles))
    made = simplified(mesh, Number(triangles), how, ['Permissive']);
write(output, made);
