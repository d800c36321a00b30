"""picture.py FOLDER READER=FILE...: what a reader draws of a mesh file in FOLDER, beside it as NAME.png."""
import pathlib
import sys

from readers import READERS

folder = pathlib.Path(sys.argv[1]).resolve()
for wish in sys.argv[2:]:
    reader, name = wish.rsplit("=", 1)
    file = folder / name
    READERS[reader](file, file.with_suffix(".png"), folder)
