#!/usr/bin/env python3
"""The part of docs/measured/levels.md on the default levels at their own sizes, of what picture-sizes measured.

Usage: sizes_page.py PROGRAMS.txt FOLDER LEVELS.md KEY

Replaces what stands between the two marks in the page. Only what KEY made is in it (FOLDER/NAME-sizes.json.by).
"""
import json
import re
import sys
from pathlib import Path

BEGIN, END = "<!-- own sizes: make-table --sizes -->", "<!-- /own sizes -->"
GOOD_DB = 40

HEAD = f"""Each default level, drawn as large as it is made for, against the frame drawn the same way from 36 sides that were not captured. A level
looks right with {GOOD_DB} dB, or within 1 dB of the full surface where that has less; level 0 within 1 dB of the full surface anyway. *Error*: 99.9 % of
the surface, samples. *Validator*: errors / warnings of Khronos' on the .glb. Closed: a closed two-manifold; crossings: pairs of triangles that meet
where they are not joined.

| | pixels | triangles | texture | error | dB | SSIM | full surface, dB | SSIM | looks right | closed | crossings | validator |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
"""


def names_of(programs):
    lines = (line for line in programs.read_text().splitlines() if line.strip() and not line.startswith("#"))
    return [line.split("|")[0].strip() for line in lines]


def verdicts(path):
    """Of the files in the order of the levels: "0 / 0"."""
    found = re.findall(r"^\S+: (\d+) errors, (\d+) warnings", path.read_text(), re.MULTILINE) if path.exists() else []
    return [f"{errors} / {warnings}" for errors, warnings in found]


def lines_of(name, rows, validator):
    for k, row in enumerate(rows):
        yield (f"| {name if k == 0 else ''} | {row['pixels']} | {row['triangles']:,} | {row['texture'] or '–'} | {row['p999Samples']:.2f} | "
               f"{row['psnr']:.1f} | {row['ssim']:.4f} | {row['fullPsnr']:.1f} | {row['fullSsim']:.4f} | {'yes' if row['right'] else '**no**'} | "
               f"{'yes' if row['closedManifold'] else '**no**'} | {row['selfIntersections']} | {validator[k] if k < len(validator) else '–'} |")


def table(programs, folder, key):
    """Empty where nothing was measured."""
    lines = []
    for name in names_of(programs):
        path, by = folder / f"{name}-sizes.json", folder / f"{name}-sizes.json.by"
        if path.exists() and by.exists() and by.read_text().strip() == key:
            lines += lines_of(name, json.loads(path.read_text()), verdicts(folder / f"{name}-sizes.validator"))
    return f"{BEGIN}\n\n{HEAD}" + "\n".join(lines) + f"\n\n{END}" if lines else ""


def main():
    programs, folder, page, key = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3]), sys.argv[4]
    made, text = table(programs, folder, key), page.read_text()
    if not made or BEGIN not in text or END not in text:
        sys.exit("sizes_page.py: nothing was measured" if not made else f"sizes_page.py: no marks in {page}")
    page.write_text(text[: text.index(BEGIN)] + made + text[text.index(END) + len(END):])


if __name__ == "__main__":
    main()
