"""The first mesh of a .3mf as .off, for commands that do not read .3mf. Faces have the colour of their first corner.

Usage: python3 off_of_3mf.py IN.3mf OUT.off
"""
import sys
import xml.etree.ElementTree
import zipfile

source, target = sys.argv[1:]
model = xml.etree.ElementTree.fromstring(zipfile.ZipFile(source).read("3D/3dmodel.model"))
colours = [colour.get("color") for colour in model.findall(".//{*}color")]
mesh = model.find(".//{*}mesh")
vertices, triangles = mesh.findall(".//{*}vertex"), mesh.findall(".//{*}triangle")


def colour_of(triangle):
    if triangle.get("p1") is None:
        return ""
    text = colours[int(triangle.get("p1"))].lstrip("#")
    return " " + " ".join(str(int(text[k:k + 2], 16)) for k in (0, 2, 4))


with open(target, "w", encoding="ascii") as out:
    print("OFF", file=out)
    print(len(vertices), len(triangles), 0, file=out)
    for vertex in vertices:
        print(*(vertex.get(axis) for axis in "xyz"), file=out)
    for triangle in triangles:
        print(3, *(triangle.get(f"v{k}") for k in (1, 2, 3)), end=colour_of(triangle) + "\n", file=out)
