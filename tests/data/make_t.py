#!/usr/bin/env python3
"""Make the test object, one torus and two spheres, in every format (README.md).

Usage: make_t.py OUT_DIR
"""
import math
import sys
from pathlib import Path

TORUS = dict(major=1.0, minor=0.4, around=48, across=24, colour=(220, 60, 40))
SPHERES = [dict(centre=(1.0, 0, 0.55), radius=0.35, colour=(40, 90, 220)),
           dict(centre=(0, -1.3, 0.2), radius=0.3, colour=(40, 200, 80))]


def torus(major, minor, around, across):
    vertices, normals, faces = [], [], []
    for i in range(around):
        for j in range(across):
            a, b = 2 * math.pi * i / around, 2 * math.pi * j / across
            normals.append((math.cos(b) * math.cos(a), math.cos(b) * math.sin(a), math.sin(b)))
            ring = major + minor * math.cos(b)
            vertices.append((ring * math.cos(a), ring * math.sin(a), minor * math.sin(b)))
    for i in range(around):
        for j in range(across):
            i1, j1 = (i + 1) % around, (j + 1) % across
            p, q, s, t = i * across + j, i1 * across + j, i1 * across + j1, i * across + j1
            faces += [(p, q, s), (p, s, t)]
    return vertices, normals, faces


def sphere(centre, radius, around=24, down=12):
    vertices, normals, faces = [], [], []
    for j in range(down + 1):
        for i in range(around):
            a, b = 2 * math.pi * i / around, math.pi * j / down
            d = (math.sin(b) * math.cos(a), math.sin(b) * math.sin(a), math.cos(b))
            normals.append(d)
            vertices.append(tuple(centre[k] + radius * d[k] for k in range(3)))
    for j in range(down):
        for i in range(around):
            i1 = (i + 1) % around
            p, q, s, t = j * around + i, (j + 1) * around + i, (j + 1) * around + i1, j * around + i1
            if j < down - 1:
                faces.append((p, q, s))
            if j > 0:
                faces.append((p, s, t))
    return vertices, normals, faces


def build():
    part = dict(TORUS)
    colour = part.pop("colour")
    vertices, normals, faces = torus(**part)
    colours = [colour] * len(vertices)
    for part in SPHERES:
        v, n, f = sphere(part["centre"], part["radius"])
        faces += [tuple(corner + len(vertices) for corner in face) for face in f]
        vertices += v
        normals += n
        colours += [part["colour"]] * len(v)
    return vertices, normals, colours, faces


def lines(template, rows):
    return "".join(template % tuple(row) for row in rows)


def obj(vertices, normals, colours, faces):
    return (lines("v %f %f %f\n", vertices) + lines("vn %f %f %f\n", normals)
            + "".join("f %d//%d %d//%d %d//%d\n" % (a + 1, a + 1, b + 1, b + 1, c + 1, c + 1) for a, b, c in faces))


def off(vertices, normals, colours, faces):
    return ("OFF\n%d %d 0\n" % (len(vertices), len(faces)) + lines("%f %f %f\n", vertices)
            + lines("3 %d %d %d\n", faces))


def ply(vertices, normals, colours, faces):
    header = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}"]
    header += [f"property float {k}" for k in "xyz"] + [f"property uchar {k}" for k in ("red", "green", "blue")]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    return ("\n".join(header) + "\n" + lines("%f %f %f %d %d %d\n", (v + c for v, c in zip(vertices, colours)))
            + lines("3 %d %d %d\n", faces))


def facet_normal(a, b, c):
    u, w = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
    n = (u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0])
    length = math.sqrt(sum(x * x for x in n)) or 1
    return tuple(x / length for x in n)


def stl(vertices, normals, colours, faces):
    text = "solid t\n"
    for face in faces:
        corners = [vertices[i] for i in face]
        text += " facet normal %f %f %f\n  outer loop\n" % facet_normal(*corners)
        text += lines("   vertex %f %f %f\n", corners) + "  endloop\n endfacet\n"
    return text + "endsolid t\n"


def wrl(vertices, normals, colours, faces):
    points = ", ".join("%f %f %f" % v for v in vertices)
    indices = ", ".join("%d %d %d -1" % f for f in faces)
    material = "diffuseColor 0.9 0.3 0.2 specularColor 0.5 0.5 0.5"
    return ("#VRML V2.0 utf8\nShape { appearance Appearance { material Material { %s } }\n"
            " geometry IndexedFaceSet { coord Coordinate { point [ %s ] } coordIndex [ %s ] creaseAngle 1.0 } }\n"
            % (material, points, indices))


def main():
    out = Path(sys.argv[1])
    mesh = build()
    for write in (obj, off, ply, stl, wrl):
        (out / f"t.{write.__name__}").write_text(write(*mesh))


if __name__ == "__main__":
    main()
