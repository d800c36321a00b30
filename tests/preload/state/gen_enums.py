#!/usr/bin/env python3
"""Every value of gl.xml's enums that is no bit mask, once each, under its first name.

Usage: gen_enums.py GL_XML OUT_FILE   writes lines `{"GL_NAME", 0xVALUE},`
"""
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

names = {}
for group in ElementTree.parse(sys.argv[1]).getroot().iter("enums"):
    if group.get("type") == "bitmask":
        continue
    for enum in group.iter("enum"):
        value = int(enum.get("value"), 0)
        if enum.get("api") in (None, "gl") and 0 < value < 0x10000:
            names.setdefault(value, enum.get("name"))
Path(sys.argv[2]).write_text("".join(f'{{"{name}", {value:#06x}}},\n' for value, name in sorted(names.items())))
