"""blender -b --python blender.py -- MESH OUT ENGINE: what Blender makes of a mesh file.

Prints one line "found: {...}" and renders OUT.png by CYCLES or BLENDER_EEVEE (which needs a display).
"""
import json
import math
import os
import sys

import bpy
import numpy
from mathutils import Vector

file, out, engine = sys.argv[sys.argv.index("--") + 1:]
if not hasattr(numpy, "bool"):
    numpy.bool = bool  # Debian 12: the importer of Blender 3.4 is older than its numpy

bpy.ops.wm.read_factory_settings(use_empty=True)
IMPORTERS = {
    ".glb": lambda: bpy.ops.import_scene.gltf(filepath=file),
    ".obj": lambda: bpy.ops.wm.obj_import(filepath=file),
    ".ply": lambda: bpy.ops.import_mesh.ply(filepath=file),
    ".stl": lambda: bpy.ops.import_mesh.stl(filepath=file),
}
IMPORTERS[os.path.splitext(file)[1]]()
shown = [o for o in bpy.context.view_layer.objects if o.type == "MESH" and o.visible_get()]


def colour_attribute(mesh):
    return mesh.color_attributes[0].name if mesh.color_attributes else None


def show_colours(item):
    """An importer that makes no material leaves the colours to whoever renders."""
    name = colour_attribute(item.data)
    if item.data.materials or not name:
        return
    material = bpy.data.materials.new("colours")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    colours = nodes.new("ShaderNodeVertexColor")
    colours.layer_name = name
    links.new(colours.outputs[0], nodes["Principled BSDF"].inputs["Base Color"])
    item.data.materials.append(material)


def shaders():
    for item in shown:
        for material in item.data.materials:
            shader = material and material.use_nodes and material.node_tree.nodes.get("Principled BSDF")
            if shader:
                yield shader


def has_shown_colours():
    """Of materials, as the importer left them; without materials, colours that wait for one."""
    if not any(o.data.materials for o in shown):
        return any(colour_attribute(o.data) for o in shown)
    inputs = [shader.inputs["Base Color"] for shader in shaders()]
    return any(i.is_linked for i in inputs) or len({tuple(i.default_value) for i in inputs}) > 1


def corner_normals(mesh):
    mesh.calc_normals_split()
    normals = numpy.empty(3 * len(mesh.loops), numpy.float32)
    mesh.loops.foreach_get("normal", normals)
    return normals.reshape(-1, 3)


def has_creases(mesh):
    """Is there a vertex whose corners have normals more than 20 degrees apart?"""
    normals, vertex = corner_normals(mesh), numpy.empty(len(mesh.loops), numpy.int64)
    mesh.loops.foreach_get("vertex_index", vertex)
    sums = numpy.zeros((len(mesh.vertices), 3))
    numpy.add.at(sums, vertex, normals)
    lengths = numpy.maximum(numpy.linalg.norm(sums, axis=1), 1e-9)
    return bool((numpy.sum(normals * sums[vertex], axis=1) / lengths[vertex] < math.cos(math.radians(10))).any())


points = [o.matrix_world @ Vector(c) for o in shown for c in o.bound_box]
low = [min(p[k] for p in points) for k in range(3)]
high = [max(p[k] for p in points) for k in range(3)]
images = sorted(tuple(i.size) for i in bpy.data.images if i.size[0] > 0 and i.type == "IMAGE")
print("found: " + json.dumps({
    "names": [o.name for o in shown],
    "triangles": sum(len(p.vertices) - 2 for o in shown for p in o.data.polygons),
    "hidden": sum(o.type == "MESH" for o in bpy.data.objects) - len(shown),
    "textures": [list(size) for size in images],
    "colours": has_shown_colours(),
    "normals": all(o.data.has_custom_normals for o in shown) if shown else False,
    "creases": any(has_creases(o.data) for o in shown),
}))
for item in shown:
    show_colours(item)

centre, size = (Vector(low) + Vector(high)) / 2, (Vector(high) - Vector(low)).length
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.type, camera.data.ortho_scale = "ORTHO", size * 0.95
camera.data.clip_end = 10 * size
camera.location = centre + size * 2 * Vector((0.5, -0.7, 0.5)).normalized()
camera.rotation_euler = (centre - camera.location).to_track_quat("-Z", "Y").to_euler()
sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy, sun.rotation_euler = 3, (0.7, 0.2, 0.4)
world = bpy.data.worlds.new("sky")
world.use_nodes = True
world.node_tree.nodes["Background"].inputs[0].default_value = (0.5, 0.5, 0.5, 1)
scene = bpy.context.scene
scene.world, scene.camera = world, camera
for item in (camera, sun):
    scene.collection.objects.link(item)
scene.render.engine = engine
scene.cycles.samples, scene.cycles.use_denoising = 16, False
scene.eevee.taa_render_samples = 4
scene.view_settings.view_transform = "Standard"
scene.render.resolution_x = scene.render.resolution_y = 320
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
