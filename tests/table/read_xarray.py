"""Opens a table with xarray by both of its libraries, runs the example of tables/README.md, and prints what they find as JSON.

Arguments: the table, the README, a file with points in JSON, `[{"a_over_t": 65, ...}, ...]`, and the methods to interpolate
by. The example runs as it stands, on the table that it names or, where that is the one given, on the table given.
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
        places = {axis: xarray.DataArray([at[axis] for at in points], dims="point") for axis in values.dims}
        return values.interp(places).values.tolist()


path, readme, places, *methods = sys.argv[1:]
with open(places, encoding="utf-8") as file:
    points = json.load(file)
with open(readme, encoding="utf-8") as file:
    [example] = [block for block in file.read().split("```python\n") if "make_interp_spline" in block.split("```")[0]]
example = example.split("```")[0]
shown = example.split("print(")[0]
quantities = list(xarray.open_dataset(path).data_vars)
by = {
    "degree 9": lambda quantity: looked_up(shown, quantity),
    "degree 3": lambda quantity: looked_up(shown.replace("k=9", "k=3"), quantity),
    "linear": linear,
}
found = {method: {quantity: by[method](quantity) for quantity in quantities} for method in methods}
json.dump({engine: by_xarray(engine) for engine in ("h5netcdf", "netcdf4")} | found, sys.stdout)
