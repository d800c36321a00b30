#!/usr/bin/env python3
"""Writes docs/measured/levels.md, and its pictures, of what picture-table measured.

Usage: levels_page.py PROGRAMS.txt FOLDER DOCS KEY SIZES_KEY

Only what KEY made is in the page (FOLDER/NAME.json.by), so that all numbers are of the same binaries; SIZES_KEY: of the
default levels at their own sizes (sizes_page.py).
"""
import json
import subprocess
import sys
from pathlib import Path

import sizes_page

OURS = ["vertex colours", "textured"]
PEERS = ["meshoptimizer, attributes", "meshoptimizer, update", "CGAL, Garland and Heckbert", "CGAL, Lindstrom and Turk",
         "Blender, collapse", "OpenMesh"]
SURFACES = {"cast": "the cast's full surface", "own mesh": "the program's own mesh"}
TARGETS = [10_000, 2_000, 500]
WANTED_DB = 35

HEAD = """# What levels of detail look like

Written by `tests/pictures/make-table BUILD OUT`, all numbers by the same binaries. Each program was cast at n = {n} and the same frame drawn
from {views} further sides at n = {fine} (`GLCAST_REFERENCE_VIEWS`, `GLCAST_REFERENCE_N`, [capture-format.md](../reference/capture-format.md)): no pixel of them
took part in making the cast. Each level is drawn at the same {fine} x {fine} places. Both are lit by one function (ambient .3, .45 from the camera,
.25 from its upper left, with the normals that were drawn) on light grey. Both become 8-bit pictures of {width} x {width} pixels in the same two ways:

- *dB*, *SSIM*: antialiased. A pixel is the mean of its {samples} x {samples} samples, after light, as viewers show it.
- *one sample*: a pixel is one of these samples. Whole pixels flip where the outline moves by a small part of one, and that is most of this error.

*dB* and *one sample* are PSNR over all pixels of all views, background too. *inside*: PSNR over the samples alone that both original and level
cover, not averaged: colour and light without the outline. *SSIM*: Wang et al. 2004, mean of the views. *Error*: the larger of the mean distances
there and back (`glcast compare`), in samples of the cast. It is taken against the program's own mesh where that is known, without points that nobody
can see; else against the full surface of the cast. In bold: {wanted} dB and more.

The peers simplify the program's own mesh, where it is known, and the cast's full surface, each to the same count:

- meshoptimizer of npm ({meshoptimizer}): `simplifyWithAttributes` and `simplifyWithUpdate`, normals and colours of weight .1, the surface split where its
  triangles meet at more than 35 degrees; with `Permissive` where the count is not reached without;
- CGAL `edge_collapse`, Garland-Heckbert (with bounded change of normals) and Lindstrom-Turk, at their defaults;
- Blender's decimate modifier, collapse; OpenMesh DecimaterT with ModQuadricT.

The last three know positions alone. They get normals and colours of the nearest point of the surface that faces as their triangles do, split at 35
degrees too.

## Which levels there are by default

`glcast mesh` makes levels for four sizes on the screen, as the paper argues (n = 2 w): level k is for an object n / 2^(k+1) pixels wide, k = 0 to 3.
99.9 % of its surface is at most an eighth of such a pixel from the full surface, both ways: 2^k / 4 samples. The certificate says what was measured.
The mean is at most a 43rd of a pixel, by estimate; the smooth surface of a sphere would else be far off everywhere, but nowhere very far. It is less
in pictures below 32 pixels, where more of the pixels lie on outlines. It is a 200th at n / 2 pixels and more, where the full surface can be matched,
and more below 64 pixels, where that is coarse itself.
`--pixels P` makes the level for P pixels by the same rule.

The count is looked for in one run of collapses (`tools/pipeline/sized_levels.h`). Errors of bare levels at some eight counts are estimated from 10,000
points a side; between two counts the error falls as a power of the count. At the count that they give a level is fitted and estimated again, and given
more triangles until it is within. The fit is a short one, and levels of more than 10,000 triangles get none: it would not lessen their 99.9 % error. The
certificate, over 100,000 points a side, decides: a level that exceeds its limit there is made again with a fifth more.

A level with more than 90 % of the triangles of the finer one is left out, and a line says so.

{own_sizes}

One level falls short: level 0 of osgviewer's t.obj, by 2.2 dB of 57.3. Its outline is off by 56.1 dB, where nobody sees a difference. More
triangles would mend it; the mean error, by which the count is chosen, has reached its limit before.

Level 0 of glxgears is its only one: what the others would need is hardly less.

### What they cost

CPU seconds of `glcast mesh` at n = 512, capture to files, of one run on two cores shared with others. *Before*: the default levels of
commit 8eba374 (full surface, a tenth, a hundredth; no textures), run in turn with today's.

| | before | today | today / before | today, when each try was fitted in full |
|---|---|---|---|---|
| glxgears | 8.0 | 7.6 | 0.94 | 10.5 |
| osgviewer | 7.8 | 8.4 | 1.08 | 14.2 |
| teapot | 8.9 | 11.8 | 1.32 | 22.5 |
| spheres | 8.3 | 12.3 | 1.47 | 20.5 |
| bouncingcow | 8.4 | 11.1 | 1.32 | 18.5 |
| glplanet | 10.7 | 13.9 | 1.30 | 21.1 |

Only glxgears is as fast as before. What is new costs 3 to 4 s where a level needs it: textures 1 to 1.5 s, four certificates instead of two, normals
by corner and outlines, and collapses down to 1,000 triangles instead of 10,000.

## Textured at 2,000 triangles

The target is {wanted} dB.

"""


def met(decibels):
    return f"{decibels:.1f}, {'met' if decibels >= WANTED_DB else 'not met'}"


def summary(sections):
    lines = ["| | antialiased | one sample a pixel | full surface with colours of vertices | inside |", "|---|---|---|---|---|"]
    for name, rows in sections:
        row = next(row for row in rows if row["how"] == "textured" and row["target"] == 2_000)
        full = next(row for row in rows if row["how"] == "full surface")
        lines.append(f"| {name} | {met(row['psnr'])} | {met(row['psnrOneSample'])} | {full['psnr']:.1f} | {row['psnrInside']:.1f} |")
    return "\n".join(lines)


def rows_of(folder, names, key):
    for name in names:
        path = folder / f"{name}.json"
        by = folder / f"{name}.json.by"
        if path.exists() and by.exists() and by.read_text().strip() == key:
            yield name, json.loads(path.read_text())


def cells(row):
    if row is None:
        return " – | – | – | – | – |"
    def shown(decibels):
        return f"**{decibels:.1f}**" if decibels >= WANTED_DB else f"{decibels:.1f}"
    return (f" {row['meanError'] / row['sample']:.3f} | {shown(row['psnr'])} | {shown(row['psnrOneSample'])} | {row['psnrInside']:.1f} | "
            f"{row['ssim']:.4f} |")


def table(rows):
    find = {(row["how"], row["of"], row["target"]): row for row in rows}
    lines = ["| |" + "".join(f" {t:,}: error | dB | one sample | inside | SSIM |" for t in TARGETS),
             "|---|" + "---|---|---|---|---|" * len(TARGETS)]
    for of, surface in SURFACES.items():
        hows = (OURS if of == "cast" else []) + PEERS
        hows = [how for how in hows if any((how, of, target) in find for target in TARGETS)]
        if hows and of != "cast":
            lines.append(f"| *of {surface}* |" + " | | | | |" * len(TARGETS))
        for how in hows:
            lines.append(f"| {how} |" + "".join(cells(find.get((how, of, target))) for target in TARGETS))
    return "\n".join(lines)


def beside_peers(sections):
    """At each count the best peer on the cast's surface, and ours: is ours as good, in dB and in SSIM?"""
    lines = ["| | triangles | vertex colours | textured | best peer of the cast: dB | SSIM | at least as good | best peer of the program's mesh |",
             "|---|---|---|---|---|---|---|---|"]
    for name, rows in sections:
        for target in TARGETS:
            there = [row for row in rows if row["target"] == target]
            ours = {row["how"]: row for row in there if row["how"] in OURS}
            peers = {of: [row for row in there if row["how"] in PEERS and row["of"] == of] for of in SURFACES}
            if not peers["cast"]:
                continue
            best, alike = max(peers["cast"], key=lambda row: row["psnr"]), max(peers["cast"], key=lambda row: row["ssim"])
            good = [how for how in OURS if how in ours and ours[how]["psnr"] >= best["psnr"] and ours[how]["ssim"] >= alike["ssim"]]
            shown = [f"{ours[how]['psnr']:.1f} ({ours[how]['ssim']:.4f})" if how in ours else "–" for how in OURS]
            own = max(peers["own mesh"], key=lambda row: row["psnr"], default=None)
            verdict = "both" if len(good) == 2 else good[0] if good else "no"
            beside = f"{own['psnr']:.1f} ({own['ssim']:.4f}), {own['how']}" if own else "–"
            lines.append(f"| {name} | {target:,} | {shown[0]} | {shown[1]} | {best['psnr']:.1f}, {best['how']} | "
                         f"{alike['ssim']:.4f}, {alike['how']} | {verdict} | {beside} |")
    return "\n".join(lines)


def limits(rows):
    """What no level can be better than: the full surface, and the original in our own rasteriser."""
    parts = []
    for row in rows:
        if row["how"] in ("full surface", "original"):
            name = "the full surface" if row["how"] == "full surface" else "the original mesh itself"
            parts.append(f"{name} ({row['triangles']:,} triangles) {row['psnr']:.1f} dB (one sample {row['psnrOneSample']:.1f}, inside {row['psnrInside']:.1f}), SSIM "
                         f"{row['ssim']:.4f}")
    background = rows[0]["backgroundShare"]
    return (f"Drawn the same way: {'; '.join(parts)}. {100 * background:.0f} % of the samples are background; errors are against {rows[0]['against']}.")


def picture(folder, name, docs):
    """Original, vertex colours and textured at 500 triangles."""
    parts = [folder / f"{name}-{what}.png" for what in ("original", "vertex-500", "textured-500")]
    parts = [part for part in parts if part.exists()]
    if not parts:
        return ""
    target = docs / "images" / f"levels-{name}.jpg"
    subprocess.run(["convert", *parts, "-resize", "300x300", "+append", "-quality", "88", "-strip", target], check=True)
    shown = ["original", "vertex colours", "textured"][: len(parts)]
    return f"![{name}: {', '.join(shown)} at 500 triangles](../images/{target.name})\n"


def npm_version():
    package = json.loads((Path(__file__).parents[2] / "package.json").read_text())
    return package["devDependencies"]["meshoptimizer"]


def main():
    programs, folder, docs, key = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]), sys.argv[4]
    names, commands = [], {}
    for line in programs.read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            name, _, command = (part.strip() for part in line.split("|"))
            names.append(name)
            commands[name] = command
    measured = list(rows_of(folder, names, key))
    if not measured:
        sys.exit("levels_page.py: nothing was measured")
    first = measured[0][1][0]
    sections = [f"## {name}\n\n`{commands[name].replace('DATA/', '').replace('FIXTURES/', '').replace('SAVERS/', '')}`. "
                f"{limits(rows)}\n\n{table(rows)}\n\n{picture(folder, name, docs)}" for name, rows in measured]
    own_sizes = sizes_page.table(programs, folder, sys.argv[5])
    head = HEAD.format(own_sizes=own_sizes, n=first["n"], views=first["views"], wanted=WANTED_DB, samples=first["samples"], width=first["width"],
                       fine=first["samples"] * first["width"], meshoptimizer=npm_version())
    notes = Path(__file__).with_name("levels_notes.md")
    (docs / "measured/levels.md").write_text(f"{head}{summary(measured)}\n\n## Beside other simplifiers\n\ndB, and SSIM in brackets.\n\n{beside_peers(measured)}\n\n{notes.read_text()}\n" + "\n".join(sections))


main()
