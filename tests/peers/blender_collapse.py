"""Simplifies by Blender's decimate modifier, collapse: blender -b --factory-startup --python-exit-code 1
--python blender_collapse.py -- IN OUT TRIANGLES. Files as in meshoptimizer.mjs; normals and colours of OUT are 0."""
import sys

import bpy
import numpy

source, target, wanted = sys.argv[sys.argv.index("--") + 1 :]
data = open(source, "rb").read()
vertices, triangles = (int(n) for n in numpy.frombuffer(data, "<u4", 2))
positions = numpy.frombuffer(data, "<f4", 3 * vertices, 8)
corners = numpy.frombuffer(data, "<u4", 3 * triangles, 8 + 36 * vertices)

mesh = bpy.data.meshes.new("mesh")
mesh.vertices.add(vertices)
mesh.vertices.foreach_set("co", positions)
mesh.loops.add(3 * triangles)
mesh.loops.foreach_set("vertex_index", corners.astype("i4"))
mesh.polygons.add(triangles)
mesh.polygons.foreach_set("loop_start", numpy.arange(0, 3 * triangles, 3, dtype="i4"))
mesh.polygons.foreach_set("loop_total", numpy.full(triangles, 3, dtype="i4"))
mesh.update(calc_edges=True)
mesh.validate()
thing = bpy.data.objects.new("mesh", mesh)
bpy.context.scene.collection.objects.link(thing)
modifier = thing.modifiers.new("decimate", "DECIMATE")
modifier.ratio = min(1.0, (int(wanted) + 0.5) / triangles)
modifier.use_collapse_triangulate = True
left = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
left.calc_loop_triangles()

out_positions = numpy.empty(3 * len(left.vertices), "f4")
left.vertices.foreach_get("co", out_positions)
out_corners = numpy.empty(3 * len(left.loop_triangles), "i4")
left.loop_triangles.foreach_get("vertices", out_corners)
with open(target, "wb") as file:
    file.write(numpy.array([len(left.vertices), len(left.loop_triangles)], "<u4").tobytes())
    file.write(out_positions.astype("<f4").tobytes())
    file.write(numpy.zeros(6 * len(left.vertices), "<f4").tobytes())
    file.write(out_corners.astype("<u4").tobytes())
