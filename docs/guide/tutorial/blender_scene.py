"""docs/guide/tutorial.md: three casts in Blender, rendered by Cycles.

Usage: blender -b --python blender_scene.py -- A.glb B.glb C.glb OUT.png
"""
import math
import sys

import bpy
import numpy
from mathutils import Euler, Vector

*files, out = sys.argv[sys.argv.index("--") + 1:]
if not hasattr(numpy, "bool"):
    numpy.bool = bool  # Debian 12: the importer of Blender 3.4 is older than its numpy

TURNS = [(0, 0, 0.5), (math.pi, 0, 0.4), (0, 0, -0.6)]  # z is up here: the importer turns y up into it

bpy.ops.wm.read_factory_settings(use_empty=True)


def first_level():
    """What the scene of the file shows: the importer leaves nodes of other levels outside the scene, or hides them."""
    meshes = [item for item in bpy.context.selected_objects if item.type == "MESH"]
    meshes.sort(key=lambda item: len(item.data.polygons))
    for other in meshes[:-1]:
        bpy.data.objects.remove(other)
    return meshes[-1]


for k, (file, turn) in enumerate(zip(files, TURNS)):
    bpy.ops.import_scene.gltf(filepath=file)
    cast = first_level()
    print(f"{file}: {len(cast.data.polygons)} triangles, {len(cast.data.materials)} material")
    cast.rotation_mode = "XYZ"
    cast.rotation_euler = Euler(turn)
    bpy.context.view_layer.update()
    corners = [cast.matrix_world @ Vector(corner) for corner in cast.bound_box]
    low = Vector(min(c[i] for c in corners) for i in range(3))
    high = Vector(max(c[i] for c in corners) for i in range(3))
    scale = 2 / max(high - low)
    cast.scale = (scale,) * 3
    cast.location = Vector((2.3 * (k - 1), 0, 0)) - Vector(((low.x + high.x) / 2, (low.y + high.y) / 2, low.z)) * scale

bpy.ops.mesh.primitive_plane_add(size=60)
floor = bpy.data.materials.new("floor")
floor.use_nodes = True
floor.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.6, 0.65, 0.68, 1)
bpy.context.object.data.materials.append(floor)

sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy, sun.data.angle, sun.rotation_euler = 2.2, 0.05, Euler((0.7, -0.4, 0))
bpy.context.collection.objects.link(sun)
world = bpy.data.worlds.new("sky")
world.use_nodes = True
world.node_tree.nodes["Background"].inputs[0].default_value = (0.45, 0.48, 0.52, 1)
bpy.context.scene.world = world

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location, camera.data.lens = (0, -8.6, 4), 45
camera.rotation_euler = (Vector((0, 0, 0.8)) - camera.location).to_track_quat("-Z", "Y").to_euler()
bpy.context.collection.objects.link(camera)

scene = bpy.context.scene
scene.camera = camera
scene.render.engine = "CYCLES"
scene.cycles.samples, scene.cycles.use_denoising = 12, False
scene.view_settings.view_transform = "Standard"
scene.render.resolution_x, scene.render.resolution_y = 800, 340
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
