"""Numbers that no contact experiment has: a unit was probably wrong, and a warning says so."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from . import _core

_unchecked = ContextVar("_unchecked", default=False)


class MagnitudeWarning(UserWarning):
    """A length, a modulus or a work of adhesion that no contact experiment has.

    All numbers are in SI units. Where such a number is meant, as in units of one's own,
    ``warnings.simplefilter("ignore", MagnitudeWarning)`` turns the warning off. A fit refuses these
    numbers unless ``allow=("magnitudes",)`` is given.
    """


@contextmanager
def unchecked() -> Iterator[None]:
    """Do not warn of the numbers of trials, which nobody gave, nor where a fit checks them."""
    token = _unchecked.set(True)
    try:
        yield
    finally:
        _unchecked.reset(token)


def warn_of(found: Iterable[str]) -> None:
    """Warn of what was found, at the line that called this package."""
    if _unchecked.get():
        return
    for text in found:
        level, frame = 1, sys._getframe()
        # `dataclasses.replace` makes another one.
        while frame.f_back and frame.f_globals["__name__"].startswith((__package__, "dataclasses")):
            level, frame = level + 1, frame.f_back
        warnings.warn(f"{text}; all numbers are in SI units", MagnitudeWarning, stacklevel=level)


def warn_of_work(work_of_adhesion: float) -> None:
    """Warn of a work of adhesion, J/m^2, that no two solids have."""
    warn_of(_core.magnitudes_of_work(work_of_adhesion))
