"""Prints everything that a table's HDF5 file says, as JSON: what a collaborator sees with h5py and nothing else.

Numbers are printed as the hexadecimal digits of their 64 bits, so that no digit is lost.
"""

import json
import sys
import zlib

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


def path(axis):
    """The path of an axis in its group: `axis.name` may be its link in the root."""
    return next(data.name for data in axis.file["axes"].values() if data == axis)


def dataset(data):
    return {
        "dtype": str(data.dtype),
        "shape": data.shape,
        "chunks": data.chunks,
        "shuffle": data.shuffle,
        "compression": data.compression,
        "fletcher32": data.fletcher32,
        "fillvalue": str(data.fillvalue),
        "is_scale": data.is_scale,
        "scales": [[path(scale) for scale in dimension.values()] for dimension in data.dims],
        "labels": [list(dimension.keys()) for dimension in data.dims],
        "attributes": attributes(data),
        "bits": bits(data[...]),
    }


with h5py.File(sys.argv[1], "r") as file:
    groups = {name: group for name, group in file.items() if isinstance(group, h5py.Group)}
    contents = {name: {key: dataset(data) for key, data in group.items()} for name, group in groups.items()}
    # The datasets of the groups that the root has too, under the same names.
    links = [data.name for group in groups.values() for key, data in group.items() if file.get(key) == data]
    extra = [name for name in file if name not in groups and not any(name in group for group in groups.values())]
    numbers = [a for name, a in sorted(file.attrs.items()) if name != "checksum" and not isinstance(a, str)]
    numbers += [data[:] for group in ("axes", "values") for data in file[group].values()]
    numbers = b"".join(np.asarray(n, "<f8").tobytes() for n in numbers)
    checksum = zlib.crc32(file.attrs["scene"].encode() + numbers)
    parts = {"groups": contents, "links": links, "extra": extra, "crc32": checksum}
    json.dump({"attributes": attributes(file), **parts}, sys.stdout)
