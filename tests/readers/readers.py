"""The programs that the table asks: how each is run on a mesh file, and what it says it found.

A reader takes (file, picture, place) and returns a dict: names and triangles of what it shows, textures as sizes,
colours and normals as true or false. It returns None for a file that it does not read, and raises on a file that it refuses.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parents[1]
SECONDS = 300


class Refused(Exception):
    pass


def run(command, place, display=False):
    """Output of a command, which gets a home of its own and, where it draws, an X server with software GL."""
    home = place / "home"
    home.mkdir(mode=0o700, exist_ok=True)
    # Blender takes the modules of the first python3 in the path, and needs numpy of Debian's.
    path = "/usr/bin:" + os.environ["PATH"]
    environment = dict(os.environ, PATH=path, HOME=str(home), XDG_RUNTIME_DIR=str(home), LIBGL_ALWAYS_SOFTWARE="1", LC_ALL="C.UTF-8")
    if display:
        command = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24 -noreset", *command]
    try:
        done = subprocess.run([str(part) for part in command], cwd=place, env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired as late:
        raise Refused(f"no answer in {SECONDS} s") from late
    return done.returncode, done.stdout


def found_line(output):
    for line in output.splitlines():
        if line.startswith("found: "):
            return json.loads(line.removeprefix("found: "))
    raise Refused("\n".join(output.strip().splitlines()[-4:]) or "said nothing")


def blender(engine):
    def read(file, picture, place):
        if file.suffix not in (".glb", ".obj", ".ply", ".stl"):
            return None
        script = ["blender", "-b", "--python", HERE / "blender.py", "--", file, picture, engine]
        return found_line(run(script, place, display=engine == "BLENDER_EEVEE")[1])
    return read


def godot(file, picture, place):
    if file.suffix not in (".glb", ".obj"):
        return None
    project = place / "godot"
    shutil.rmtree(project, ignore_errors=True)
    shutil.copytree(HERE / "godot", project)
    shutil.copy(file, project / f"model{file.suffix}")
    for beside in file.parent.glob(f"{file.stem}.*"):
        if beside.suffix in (".mtl", ".png"):
            shutil.copy(beside, project)
    # Godot's server imports what is new and then does not end by itself: it is done when the scene runs.
    importer = subprocess.Popen(["godot3-server", "--path", project, "--editor"], stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, env=dict(os.environ, HOME=str(place / "home")))
    try:
        wait_for_import(importer, project)
    finally:
        importer.kill()
        importer.wait()
    found = found_line(run(["godot3", "--path", project, "--video-driver", "GLES2", "--audio-driver", "Dummy"], place, display=True)[1])
    shutil.copy(project / "out.png", picture)
    return found


def wait_for_import(importer, project):
    import time
    end = time.monotonic() + SECONDS
    while not list((project / ".import").glob("model.*.md5")):
        if time.monotonic() > end or importer.poll() is not None:
            raise Refused("Godot imported nothing")
        time.sleep(0.2)


def meshlab(file, picture, place):
    if file.suffix not in (".obj", ".ply", ".stl", ".off"):
        return None
    again = place / "meshlab.ply"
    again.unlink(missing_ok=True)
    status, output = run(["meshlabserver", "-i", file, "-o", again, "-m", "vc", "vn", "wt", "wn"], place, display=True)
    loaded = re.search(r"loaded has (\d+) vn (\d+) fn", output)
    if status != 0 or not loaded:
        lines = [line for line in output.splitlines() if "ssert" in line or "rror" in line]
        raise Refused(lines[-1] if lines else f"ended with {status}")
    header = again.read_bytes().split(b"end_header")[0].decode()
    names = re.findall(r"comment TextureFile (.*)", header)
    return {"names": [file.stem], "triangles": int(loaded[2]), "textures": [[0, 0] for _ in names], "hidden": 0,
            "colours": "property uchar red" in header, "normals": "property float nx" in header}


def assimp(file, picture, place):
    status, output = run(["assimp", "info", file], place)
    faces = re.search(r"^Faces:\s+(\d+)", output, re.M)
    if status != 0 or not faces:
        raise Refused(output.strip().splitlines()[-1])
    shown = re.findall(r"^(.*) \(mesh [\d, ]+\)$", output.split("Node hierarchy:")[-1], re.M)
    textures = re.findall(r"\$tex\.file\).*\| (Diffuse|Normals)\]", output)
    status, dump = run(["assimp", "export", file, place / "assimp.ply", "-fplyb"], place)
    header = (place / "assimp.ply").read_bytes().split(b"end_header")[0].decode() if status == 0 else ""
    return {"names": shown, "triangles": int(faces[1]), "textures": [[0, 0] for _ in textures],
            "hidden": 0, "colours": "red" in header or assimp_materials(file, place) > 1, "normals": "property float nx" in header}


def assimp_materials(file, place):
    """How many different colours the materials have."""
    xml = place / "assimp.xml"
    run(["assimp", "dump", file, xml], place)
    return len(set(re.findall(r'key="\$clr.diffuse"[^>]*>\s*([\d. ]+)', xml.read_text(errors="replace")))) if xml.exists() else 0


def f3d(file, picture, place):
    status, output = run(["f3d", "--verbose", file, f"--output={picture}", "--resolution=320,320", "--bg-color=.73,.73,.73",
                          "--camera-azimuth-angle=35", "--camera-elevation-angle=30",
                          *(["--scalars=RGB", "--comp=-2"] if file.suffix == ".ply" else [])], place, display=True)
    if status != 0 or not picture.exists():
        raise Refused((output.strip().splitlines() or [f"ended with {status}"])[-1])
    counts = [int(count) for count in re.findall(r"Number of polygons: (\d+)", output)]
    materials = set(re.findall(r"diffuse color \(([^)]*)\)", output))
    if not counts:  # of an .obj it tells nothing but materials: the picture shows it
        return {"names": None, "triangles": None, "textures": None, "hidden": 0, "colours": len(materials) > 1 or None, "normals": None}
    parts = re.findall(r"^(.*) Primitive Geometry:", output, re.M)
    return {"names": sorted(set(parts)) or [file.stem], "triangles": sum(counts),
            "textures": [[0, 0]] if "TEXCOORD" in output else [], "hidden": 0,
            # Of materials' colours it tells nothing: a part for each is what the picture shows.
            "colours": bool(re.search(r"RGB :|COLOR", output)) or len(parts) > 1,
            "normals": bool(re.search(r"normals? :", output, re.I))}


def web(reader, endings):
    def read(file, picture, place):
        if file.suffix not in endings:
            return None
        return found_line(run(["node", HERE / "web.mjs", shutil.which("chromium"), ROOT / "node_modules", reader, file, picture], place)[1])
    return read


def gltf_transform(file, picture, place):
    if file.suffix != ".glb":
        return None
    return found_line(run(["node", HERE / "transform.mjs", file], place)[1])


READERS = {
    "Blender 3.4, Cycles": blender("CYCLES"),
    "Blender 3.4, EEVEE": blender("BLENDER_EEVEE"),
    "Godot 3.2": godot,
    "MeshLab 2020.09": meshlab,
    "assimp 5.2": assimp,
    "f3d 1.3": f3d,
    "three.js": web("three", (".glb", ".obj", ".ply")),
    "model-viewer": web("model-viewer", (".glb",)),
    "glTF-Transform": gltf_transform,
}
