// node transform_gltf.mjs FILES...
// What glTF-Transform makes of .glb files, as one JSON array: of each level its counts and bounds, and of each texture
// its size.
import { Logger, NodeIO, getBounds } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { MeshoptDecoder } from 'meshoptimizer';

await MeshoptDecoder.ready;
const io = new NodeIO().setLogger(new Logger(Logger.Verbosity.ERROR)).registerExtensions(ALL_EXTENSIONS)
  .registerDependencies({ 'meshopt.decoder': MeshoptDecoder });

const level = (node) => {
  const [primitive, ...more] = node.getMesh().listPrimitives();
  if (more.length) throw new Error('more than one primitive');
  const indices = primitive.getIndices().getArray(), position = primitive.getAttribute('POSITION');
  if (indices.some((i) => i >= position.getCount())) throw new Error('an index beyond the vertices');
  const { min, max } = getBounds(node);
  return { triangles: indices.length / 3, vertices: position.getCount(), lo: min, hi: max, attributes: primitive.listSemantics() };
};

const found = [];
for (const file of process.argv.slice(2)) {
  const root = (await io.read(file)).getRoot();
  found.push({ levels: root.listNodes().filter((node) => node.getMesh()).map(level),
    textures: root.listTextures().map((texture) => texture.getSize()) });
}
console.log(JSON.stringify(found));
