"""Frozen objects that hold a native one: they are pickled by their values."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from ._arrays import number


class Remade:
    """An instance that is pickled and copied by its values, from which it is made again."""

    __slots__ = ()

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the class and the values."""
        values = {one.name: getattr(self, one.name) for one in fields(self) if one.init}  # type: ignore[arg-type]
        return (_again, (type(self), values))


def _again(cls: Any, values: dict[str, Any]) -> Any:
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
