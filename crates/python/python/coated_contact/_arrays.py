"""Numbers and arrays as the native part takes them: real, flat, of float64."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import prod
from typing import Any, Literal

import numpy as np

# Imported here, because numpy imports it at its first use, which a fork may interrupt.
from numpy import ma
from numpy.typing import ArrayLike, NDArray

from ._errors import ContactError, InputError
from ._magnitudes import warn_of_work

Errors = Literal["raise", "nan"]
# The units that datasets of this package and others name, and that need no factor, by the unit of
# this package; quotients also as products with negative exponents, as netCDF has them.
SI = {
    "1": ("", "1", "None", "dimensionless"),
    "m": ("m", "meter", "metre", "meters", "metres"),
    "N": ("N", "newton", "newtons"),
    "Pa": ("Pa", "pascal", "pascals", "N/m^2", "N/m2", "N m-2", "N m^-2"),
    "s": ("s", "second", "seconds"),
    "N/m or J/m^2": ("J/m^2", "J/m2", "J m-2", "J m^-2", "N/m", "N m-1", "N m^-1"),
    "m/V": ("m/V", "m V-1", "m/N", "m N-1"),
    "Pa/m": ("Pa/m", "Pa m-1", "N/m^3", "N m-3"),
    "others": ("rad", "radian", "radians", "V", "volt", "volts", "Hz", "hertz", "m^2", "m2"),
}
# The unit of an argument by the last word of its name, where nobody states it.
UNIT_OF: dict[str, str] = {
    "radius": "m",
    "thickness": "m",
    "penetration": "m",
    "height": "m",
    "modulus": "Pa",
}
UNIT_OF |= {"load": "N", "adhesion": "N/m or J/m^2", "time": "s"}


def number(name: str, value: float) -> float:
    """Return a real number as a float; refuse all else, text included."""
    array = real(name, value)
    if array.ndim != 0:
        raise TypeError(f"{name} must be one number, it has the shape {array.shape}")
    return float(array)


def integer(name: str, value: int, least: int, end: int) -> int:
    """Return an integer from ``least`` to ``end - 1``; refuse all else."""
    whole = operator.index(value)
    if not least <= whole < end:
        raise InputError(
            f"{name} = {whole} cannot be used: it must be from {least} to {end - 1}",
            axis=name,
            value=float(whole),
            range=(float(least), float(end - 1)),
        )
    return whole


def real(name: str, value: ArrayLike, wanted: str | None = None) -> NDArray[np.float64]:
    """Return real numbers as an aligned array of float64; refuse what would lose a part.

    A unit that they know of must be that which is ``wanted``, by default that of the name.
    """
    # An array of xarray may hold quantities with a unit, or know of one.
    held = type(getattr(value, "data", None) if hasattr(value, "dims") else value)
    if hasattr(held, "units") or hasattr(held, "unit"):
        raise TypeError(f"{name} = {value!r} has a unit of its own: give its value in SI units")
    attributes = getattr(value, "attrs", {})
    unit = attributes.get("units", attributes.get("unit", "1"))
    unit = unit.decode() if isinstance(unit, bytes) else str(unit)
    plain = unit.replace("²", "^2").strip()
    found = next((one for one, names in SI.items() if plain in names), None)
    if found is None:
        raise TypeError(f"{name} has the unit {unit!r} of its own: give its value in SI units")
    wanted = wanted or UNIT_OF.get(name.replace(" ", "_").rpartition("_")[2], found)
    if found not in ("1", wanted):
        raise TypeError(f"{name} has the unit {unit!r}, but is in {wanted}: give this quantity")
    array = np.asarray(value)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be real numbers, not of the type {array.dtype}")
    if ma.is_masked(value):
        raise TypeError(f"{name} is masked: leave out these points, or fill them with numbers")
    array = np.asarray(array, dtype=np.float64)
    # A field of a packed record is not aligned, nor are numbers behind the header of a file.
    return array if array.flags.aligned else array.copy()


def paired(inputs: dict[str, Any]) -> None:
    """Refuse arrays of pandas or xarray whose labels do not pair numbers as their places do."""
    paired_labels({name: labels_of(value) for name, value in inputs.items()})


def paired_labels(inputs: dict[str, list[tuple[Any, Any]]]) -> None:
    """Refuse the labels of arrays, see ``labels_of``, that do not pair numbers as places do."""
    labels = {name: found for name, found in inputs.items() if found}
    if not labels:
        return
    first = max(labels, key=lambda name: len(labels[name]))
    for name, found in labels.items():
        # From the last dimension on, as numpy broadcasts.
        for (axis, own), (of, other) in zip(found[::-1], labels[first][::-1], strict=False):
            is_known = own is not None and other is not None
            if axis != of or (is_known and not own.equals(other)):
                raise ValueError(
                    f"{first} and {name} have other labels, and numbers are paired by their place: "
                    "bring both into one order, or give the numbers alone, without labels"
                )


def labels_of(value: Any) -> list[tuple[Any, Any]]:
    """Return the name and the labels of each dimension of an array of xarray or pandas."""
    if hasattr(value, "dims") and hasattr(value, "indexes"):
        return [(dimension, value.indexes.get(dimension)) for dimension in value.dims]
    # The dimensions of pandas have no names.
    axes = [getattr(value, "index", None), getattr(value, "columns", None)]
    return [("pandas", labels) for labels in axes if hasattr(labels, "equals")]


def fixed(array: ArrayLike) -> NDArray[Any]:
    """Return a contiguous copy that does not change."""
    copy = np.array(array, order="C")
    copy.setflags(write=False)
    return copy


def evaluate(
    function: Callable[..., Any], errors: Errors, /, **inputs: ArrayLike
) -> list[NDArray[np.float64]]:
    """Broadcast the inputs, evaluate them in the native part, and return arrays of their shape."""
    results, shape = evaluate_flat(function, errors, **inputs)
    return [result.reshape(shape) for result in results]


def evaluate_flat(
    function: Callable[..., Any], errors: Errors, /, **inputs: ArrayLike
) -> tuple[Any, tuple[int, ...]]:
    """Broadcast the inputs, and return what the native part does and their shape.

    ``function`` takes the number of points with the choice for errors, and flat arrays.
    """
    if errors not in ("raise", "nan"):
        raise ValueError(f'errors = {errors!r} cannot be used: give "raise" or "nan"')
    arrays = [real(name, value) for name, value in inputs.items()]
    paired(inputs)
    for name, array in zip(inputs, arrays, strict=True):
        if name == "work_of_adhesion":
            warn_of_work(array.max(initial=0.0))
    shape = np.broadcast_shapes(*(array.shape for array in arrays))
    flat = [
        array.reshape(1)
        if array.size == 1
        else np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1)
        for array in arrays
    ]
    try:
        results = function((prod(shape), errors == "nan"), *flat)
    except ContactError as error:
        _locate(error, shape)
        raise
    return results, shape


def _locate(error: ContactError, shape: tuple[int, ...]) -> None:
    """Give the place of the point that failed as an index of the broadcast shape."""
    flat: Any = error.index
    if flat is None:
        return
    error.index = tuple(int(i) for i in np.unravel_index(flat, shape)) if shape else None
    if error.index is not None:
        error.add_note(f'at index {error.index}; errors="nan" gives NaN at such points')


@contextmanager
def located(axis: str, array: NDArray[np.float64]) -> Iterator[None]:
    """Give an error about a number of ``array`` the index of the first such number."""
    try:
        yield
    except ContactError as error:
        if error.axis == axis and error.value is not None and array.ndim > 0:
            same = (array == error.value) | (np.isnan(array) & np.isnan(error.value))
            if same.any():
                error.index = tuple(np.argwhere(same)[0].tolist())
                error.add_note(f"at index {error.index}")
        raise


def scalar_or_array(array: NDArray[np.float64]) -> Any:
    """Return a float for an array without dimensions, else the array."""
    return float(array) if array.ndim == 0 else array
