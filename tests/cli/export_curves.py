"""Exports the curves of all files in a folder to columns of text, with afmformats.

usage: export_curves.py FOLDER OUTPUT

Prints one line for each curve: file, number of the curve, stiffness of the cantilever (N/m; empty if
the file does not name it) and exported file; or for a file that afmformats refuses: file, an empty
field, the name of the error and an empty field.
"""

import logging
import sys
import warnings
from pathlib import Path

import afmformats

warnings.simplefilter("ignore")
logging.disable(logging.CRITICAL)

folder, output = map(Path, sys.argv[1:])
for path in sorted(folder.iterdir()):
    try:
        for number, curve in enumerate(afmformats.load_data(path)):
            exported = output / f"{path.name}.{number}.tab"
            curve.export_data(exported, metadata=True)
            stiffness = curve.metadata.get("spring constant") or ""
            print(path.name, number, stiffness, exported, sep="\t")
    # The errors of afmformats derive from BaseException.
    except BaseException as error:
        print(path.name, "", type(error).__name__, "", sep="\t")
