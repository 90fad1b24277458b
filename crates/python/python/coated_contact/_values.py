"""Frozen objects: how they are made, pickled and shown."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

from ._arrays import number
from ._magnitudes import unchecked


class Remade:
    """An instance that is pickled and copied by its values, from which it is made again."""

    __slots__ = ()

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the class and the values."""
        values = {one.name: getattr(self, one.name) for one in fields(self) if one.init}  # type: ignore[arg-type]
        return (_again, (type(self), values))


class Native(Remade):
    """An instance that holds an object of the native part beside its values."""

    __slots__ = ("_native",)
    _native: Any


class OneLine:
    """An instance of a dataclass that shows itself on one line, arrays by their shape.

    What is None unless given is not shown where it was not given.
    """

    __slots__ = ()

    def __repr__(self) -> str:
        """Return the class and the values, arrays by their shape."""
        given = ((one, getattr(self, one.name)) for one in fields(self) if one.repr)  # type: ignore[arg-type]
        shown = [
            (one.name, value)
            for one, value in given
            if one.default is not None or value is not None
        ]
        values = ", ".join(f"{name}={short(value)}" for name, value in shown)
        return f"{type(self).__name__}({values})"


# The number of values of a list or a dictionary that are shown.
MOST_SHOWN = 4


def short(value: object) -> str:
    """Return a value on one line."""
    if isinstance(value, np.ndarray) and value.ndim > 0:
        return f"<{' x '.join(map(str, value.shape))} values>"
    if isinstance(value, tuple | list):
        items = [short(one) for one in value[:MOST_SHOWN]]
        more = [f"... {len(value)} in all"] if len(value) > MOST_SHOWN else []
        if isinstance(value, list):
            return f"[{', '.join(items + more)}]"
        return f"({', '.join(items + more)}{',' if len(value) == 1 else ''})"
    if isinstance(value, dict):
        items = [f"{key!r}: {short(one)}" for key, one in list(value.items())[:MOST_SHOWN]]
        more = [f"... {len(value)} in all"] if len(value) > MOST_SHOWN else []
        return "{" + ", ".join(items + more) + "}"
    return repr(value)


def _again(cls: Any, values: dict[str, Any]) -> Any:
    # What is warned of was so when the values were given.
    with unchecked():
        return cls(**values)


def set_field(instance: object, name: str, value: object) -> None:
    """Set a field of a frozen instance that is being made."""
    object.__setattr__(instance, name, value)


def set_number(instance: object, name: str, value: float) -> float:
    """Set a field of a frozen instance that is being made to a real number, and return it."""
    whole = value if type(value) is float else number(name, value)
    object.__setattr__(instance, name, whole)
    return whole


def set_numbers(instance: object, *names: str) -> None:
    """Turn fields of a frozen instance that is being made into floats; refuse all but numbers."""
    for name in names:
        set_number(instance, name, getattr(instance, name))


def set_flags(instance: object, *names: str) -> None:
    """Turn fields of a frozen instance that is being made into bool; refuse all but True, False."""
    for name in names:
        value = getattr(instance, name)
        if not isinstance(value, bool | np.bool_):
            raise TypeError(f"{name} must be True or False, not {value!r}")
        set_field(instance, name, bool(value))
