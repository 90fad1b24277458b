"""Opens a table with xarray by both of its libraries, runs the example of tables/README.md, and prints what they find as JSON.

Arguments: the table, the README, and a file with points in JSON, `[{"a_over_t": 65, ...}, ...]`. The example runs as it stands,
on the table that it names or, where that is the one given, on the table given.
"""

import json
import sys

import numpy as np
import xarray


def bits(values):
    return [f"{word:016x}" for word in np.ascontiguousarray(values, "=f8").ravel().view("=u8")]


def variable(data):
    return {"dimensions": list(data.dims), "bits": bits(data.values), "long_name": data.attrs["long_name"]}


def by_xarray(engine):
    with xarray.open_dataset(path, engine=engine) as table:
        return {
            "title": table.attrs["title"],
            "coordinates": {name: variable(table[name]) for name in table.coords},
            "quantities": {name: variable(table[name]) for name in table.data_vars},
        }


def looked_up(source, quantity):
    example = {}
    exec(source.replace("tables/paper.h5", path), example)
    dimensions = example["table"][quantity].dims
    return [float(example["lookup"](quantity, **{axis: at[axis] for axis in dimensions})) for at in points]


def linear(quantity):
    with xarray.open_dataset(path) as table:
        values = table[quantity].squeeze()
        return [float(values.interp({axis: at[axis] for axis in values.dims})) for at in points]


path, readme, places = sys.argv[1:]
with open(places, encoding="utf-8") as file:
    points = json.load(file)
with open(readme, encoding="utf-8") as file:
    [example] = [block for block in file.read().split("```python\n") if "make_interp_spline" in block.split("```")[0]]
example = example.split("```")[0]
shown = example.split("print(")[0]
quantities = list(xarray.open_dataset(path).data_vars)
json.dump(
    {
        "h5netcdf": by_xarray("h5netcdf"),
        "netcdf4": by_xarray("netcdf4"),
        "degree 9": {quantity: looked_up(shown, quantity) for quantity in quantities},
        "degree 3": {quantity: looked_up(shown.replace("k=9", "k=3"), quantity) for quantity in quantities},
        "linear": {quantity: linear(quantity) for quantity in quantities},
    },
    sys.stdout,
)
