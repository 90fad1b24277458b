"""The errors. Each message names the value, the values allowed and the next step.

A file that cannot be read or written is an ``OSError`` (such as ``FileNotFoundError``) with its
name, and an argument of another type a ``TypeError``. The sections ``Raises`` of functions name
only what the classes below do not say.
"""

from __future__ import annotations


class ContactError(ValueError):
    """A value or a table that cannot be used.

    Attributes
    ----------
    axis : str or None
        The name of the parameter that is refused, where there is one.
    value : float or None
        Its value.
    range : tuple of float or None
        The smallest and the largest value allowed, where they are two numbers.
    allowed : str or None
        The values allowed in words, where they are no range.
    index : tuple of int or None
        The position of the first point with an error, where a function was evaluated at arrays.
    """

    def __init__(
        self,
        message: str,
        *,
        axis: str | None = None,
        value: float | None = None,
        range: tuple[float, float] | None = None,  # noqa: A002
        allowed: str | None = None,
        index: tuple[int, ...] | None = None,
    ) -> None:
        super().__init__(message)
        self.axis = axis
        self.value = value
        self.range = range
        self.allowed = allowed
        self.index = index


class InputError(ContactError):
    """An argument that no physical system has, or that the question does not take.

    A negative modulus, a contact radius beyond the sphere, a layer that a stack cannot have, a
    question that makes no sense for the shape of the probe, a derivative that is not known.
    """


class OutsideTableError(ContactError):
    """A table that does not hold what is asked for: another material, a/t, quantity or body.

    Another table or a direct solve answers it.
    """


class NoContactError(ContactError):
    """A state that the contact does not have, or that is outside its ``contact_radius_range``."""


class SolveError(ContactError):
    """A solve beyond the reach of the solver, or a tolerance that it does not meet.

    Where double precision does not allow the tolerance, ``range`` begins at the error reached.
    """


class TableError(ContactError):
    """A file that is no sound table, a scene that cannot be used, a table that cannot be made."""


class FitError(ContactError):
    """A fit that cannot be made: points, parameters or options that cannot be used."""
