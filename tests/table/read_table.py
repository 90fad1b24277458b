"""Prints everything that a table's HDF5 file says, as JSON: what a collaborator sees with h5py and nothing else.

Numbers are printed as the hexadecimal digits of their 64 bits, so that no digit is lost.
"""

import json
import sys

import h5py
import numpy as np


def bits(values):
    return [f"{word:016x}" for word in np.ascontiguousarray(values, "=f8").ravel().view("=u8")]


def attribute(value):
    """The type and the value: text, or a scalar of numpy's type."""
    if isinstance(value, str):
        return ["text", value]
    return [str(value.dtype), bits(value)[0] if value.dtype.kind == "f" else int(value)]


def attributes(thing):
    hidden = {"CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST"}  # HDF5's own, of dimension scales
    return {name: attribute(value) for name, value in thing.attrs.items() if name not in hidden}


def dataset(data):
    return {
        "dtype": str(data.dtype),
        "shape": data.shape,
        "chunks": data.chunks,
        "shuffle": data.shuffle,
        "compression": data.compression,
        "fletcher32": data.fletcher32,
        "is_scale": data.is_scale,
        "scales": [[scale.name for scale in dimension.values()] for dimension in data.dims],
        "labels": [list(dimension.keys()) for dimension in data.dims],
        "attributes": attributes(data),
        "bits": bits(data[...]),
    }


with h5py.File(sys.argv[1], "r") as file:
    groups = {name: {key: dataset(data) for key, data in group.items()} for name, group in file.items()}
    json.dump({"attributes": attributes(file), "groups": groups}, sys.stdout)
