#!/usr/bin/env python3
"""Writes docs/levels.md, and its pictures, of what picture-table measured.

Usage: levels_page.py PROGRAMS.txt FOLDER DOCS
"""
import json
import subprocess
import sys
from pathlib import Path

HOWS = ["vertex colours", "textured", "OpenMesh", "meshoptimizer", "CGAL"]
TARGETS = [10_000, 2_000, 500]
WANTED_DB = 35

HEAD = """# What levels of detail look like

Written by `tests/pictures/make-table BUILD OUT`. Each program was cast at n = {n} and the same frame drawn from {views} further sides
(`GLCAST_REFERENCE_VIEWS`, [capture-format.md](capture-format.md)): no pixel of them took part in making the cast. Each level is drawn into the same
pixels, both are lit by one function (ambient .3, .45 from the camera, .25 from its upper left, with the normals that were drawn) on light grey,
and compared as 8-bit pictures.

*Error*: the larger of the mean distances there and back (`glcast compare`), in samples; against the program's own mesh where that is known (points
that nobody can see left out), else against the full surface of the cast. *dB*: PSNR over all pixels of all views, background too; *inside*: over
the pixels alone that both original and level cover, so colour and light without the outline; *SSIM*: Wang et al. 2004, mean of the views. OpenMesh (DecimaterT, ModQuadricT), meshoptimizer
(meshopt_simplify) and CGAL (edge_collapse, Lindstrom-Turk) simplify the program's own mesh, to the same count, with normals and colours of the nearest
point of the original. In bold: {wanted} dB and more.

"""


def rows_of(folder, names):
    for name in names:
        path = folder / f"{name}.json"
        if path.exists():
            yield name, json.loads(path.read_text())


def cells(row):
    if row is None:
        return " – | – | – | – |"
    decibels = f"{row['psnr']:.1f}"
    if row["psnr"] >= WANTED_DB:
        decibels = f"**{decibels}**"
    return f" {row['meanError'] / row['sample']:.3f} | {decibels} | {row['psnrInside']:.1f} | {row['ssim']:.4f} |"


def table(rows):
    find = {(row["how"], row["target"]): row for row in rows}
    lines = ["| |" + "".join(f" {t:,}: error | dB | inside | SSIM |" for t in TARGETS),
             "|---|" + "---|---|---|---|" * len(TARGETS)]
    for how in HOWS:
        if any((how, target) in find for target in TARGETS):
            lines.append(f"| {how} |" + "".join(cells(find.get((how, target))) for target in TARGETS))
    if rows[0]["against"] == "the program's mesh" and ("CGAL", TARGETS[-1]) not in find:
        lines.append("\nOther simplifiers of the program's mesh were not measured in this run.")
    return "\n".join(lines)


def limits(rows):
    """What no level can be better than: the full surface, and the original in our own rasteriser."""
    parts = []
    for row in rows:
        if row["how"] in ("full surface", "original"):
            name = "the full surface" if row["how"] == "full surface" else "the original mesh itself"
            parts.append(f"{name} ({row['triangles']:,} triangles) {row['psnr']:.1f} dB, SSIM {row['ssim']:.4f}")
    background = rows[0]["backgroundShare"]
    return (f"Drawn the same way: {'; '.join(parts)}. {100 * background:.0f} % of the pixels are background; errors are against {rows[0]['against']}.")


def picture(folder, name, docs):
    """Original, vertex colours and textured at 500 triangles."""
    parts = [folder / f"{name}-{what}.png" for what in ("original", "vertex-500", "textured-500")]
    parts = [part for part in parts if part.exists()]
    if not parts:
        return ""
    target = docs / "images" / f"levels-{name}.jpg"
    subprocess.run(["convert", *parts, "-resize", "300x300", "+append", "-quality", "88", "-strip", target], check=True)
    shown = ["original", "vertex colours", "textured"][: len(parts)]
    return f"![{name}: {', '.join(shown)} at 500 triangles](images/{target.name})\n"


def main():
    programs, folder, docs = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3])
    names, commands = [], {}
    for line in programs.read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            name, _, command = (part.strip() for part in line.split("|"))
            names.append(name)
            commands[name] = command
    sections, first = [], None
    for name, rows in rows_of(folder, names):
        first = first or rows[0]
        sections.append(f"## {name}\n\n`{commands[name].replace('DATA/', '').replace('FIXTURES/', '').replace('SAVERS/', '')}`. "
                        f"{limits(rows)}\n\n{table(rows)}\n\n{picture(folder, name, docs)}")
    if not sections:
        sys.exit("levels_page.py: nothing was measured")
    head = HEAD.format(n=first["n"], views=first["views"], wanted=WANTED_DB)
    if any("textured-500" in part.name for part in folder.glob("*.png")):
        head += "Pictures: original; 500 triangles with colours of vertices; 500 triangles textured.\n\n"
    (docs / "levels.md").write_text(head + "\n".join(sections))


main()
