// node transform.mjs MESH.glb: what glTF-Transform makes of a mesh file, as one line "found: {...}".
import { Logger, NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { MeshoptDecoder } from 'meshoptimizer';

await MeshoptDecoder.ready;
const io = new NodeIO().setLogger(new Logger(Logger.Verbosity.ERROR)).registerExtensions(ALL_EXTENSIONS)
  .registerDependencies({ 'meshopt.decoder': MeshoptDecoder });
const root = (await io.read(process.argv[2])).getRoot(), names = [], primitives = [];
(root.getDefaultScene() ?? root.listScenes()[0]).traverse((node) => {
  if (!node.getMesh()) return;
  names.push(node.getName());
  primitives.push(...node.getMesh().listPrimitives());
});
const colours = new Set(root.listMaterials().map((material) => material.getBaseColorFactor().join()));
const has = (semantic) => primitives.some((p) => p.listSemantics().includes(semantic));
console.log(`found: ${JSON.stringify({ names, hidden: root.listMeshes().length - names.length,
  triangles: primitives.reduce((n, p) => n + p.getIndices().getCount() / 3, 0),
  textures: root.listTextures().map((texture) => texture.getSize()), colours: has('COLOR_0') || colours.size > 1, normals: has('NORMAL') })}`);
