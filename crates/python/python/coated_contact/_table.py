"""Tables of the dimensionless quantities."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any, NoReturn, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Errors
from ._bodies import System
from ._contact import Contact
from ._solve import Solution, solution
from ._stack import Stack, StackSystem

if TYPE_CHECKING:
    import xarray


@final
class Table:
    """A table of the quantities, from which the contact of every system in its box is looked up.

    A table is of films on substrates, or of one stack of layers: see ``stack``.

    Tables are made by :meth:`embedded`, :meth:`read` or :meth:`open`. They do not change. Two
    tables are equal if they hold the same bits.

    Examples
    --------
    >>> Table.embedded().held
    ('gamma',)
    """

    _native: Any

    def __init__(self, native: Any) -> None:
        """Take a native table; use the class methods instead."""
        if not isinstance(native, _core.Table):
            raise TypeError("make a table with Table.embedded, Table.read or Table.open")
        object.__setattr__(self, "_native", native)

    def __setattr__(self, name: str, value: object) -> NoReturn:
        """Refuse changes."""
        raise AttributeError(f"a table does not change: {name} cannot be set")

    @classmethod
    def embedded(cls) -> Table:
        """Return the table that comes with the package.

        It holds every sphere, film and substrate with Poisson ratios from 0 to 0.5, to 1e-6. The
        first contact made from it takes some 20 to 40 ms more, which decode it.
        """
        return _embedded()

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Table:
        """Read a packed table, as :func:`generate` and ``tabulate pack`` write it."""
        return cls(_core.Table.read(path))

    @classmethod
    def open(cls, path: str | os.PathLike[str]) -> Table:
        """Read an HDF5 table, as ``tabulate generate`` writes it."""
        return cls(_core.Table.open(path))

    @classmethod
    def from_packed(cls, packed: bytes) -> Table:
        """Make a table from the bytes of a packed one."""
        return cls(_core.Table.from_packed(packed))

    def to_packed(self) -> bytes:
        """Return the packed form, from which :meth:`from_packed` makes this table bit for bit."""
        return self._native.to_packed()

    def contact(self, system: System | StackSystem) -> Contact:
        """Look up the material of a system, and return its contact.

        In a table of one stack of layers the system is a StackSystem with the stack of the table.
        The modulus of its probe is any in the table. Such a contact has no derivatives, and nothing
        beyond the nodes in a/t.
        """
        return Contact(system=system, table=self)

    @cached_property
    def stack(self) -> Stack | None:
        """The stack of layers that the table is of; None for a table of films on substrates.

        Raises
        ------
        TableError
            For a stack in the scene of the table that is not that of its axes.
        """
        found = self._native.stack()
        return None if found is None else Stack._of_parts(*found)

    @property
    def title(self) -> str:
        """The title of the scene."""
        return self._description["title"]

    @property
    def scene(self) -> str:
        """The scene, as TOML."""
        return self._description["scene"]

    @property
    def tolerance(self) -> float:
        """The relative tolerance of the table."""
        return self._description["tolerance"]

    @property
    def max_error(self) -> float:
        """The certificate: the largest relative error at sampled points, against direct solves."""
        return self._description["max_error"]

    @property
    def median_error(self) -> float:
        """The median relative error at the sampled points."""
        return self._description["median_error"]

    @property
    def held(self) -> tuple[str, ...]:
        """The names of the quantities held. A table of ``gamma`` alone answers all four."""
        return tuple(self._native.quantities())

    def quantities(
        self,
        a_over_t: ArrayLike,
        e1_over_e2: ArrayLike,
        nu1: ArrayLike,
        e0_over_e2: ArrayLike,
        nu0: ArrayLike | None = None,
        *,
        errors: Errors = "raise",
    ) -> Solution:
        """Look up the four dimensionless quantities, on all cores.

        The parameters broadcast as numpy's functions do. A table of ``gamma`` alone, such as the
        embedded one, answers all four: the others are integrals of it along a/t. At an a/t beyond
        the nodes the values are those of the expansion about the limit of a thin or thick film.
        Neighbouring points of one material share its curve, so arrays in which a/t varies last are
        the fastest.

        Parameters
        ----------
        a_over_t : array_like
            Contact radius over film thickness.
        e1_over_e2 : array_like
            Young's modulus of the film over the sphere's reduced modulus E2*; 0 is a rigid sphere:
            then the quantities are in units of the film's reduced modulus, and ``e0_over_e2`` is
            E0/E1.
        nu1 : array_like
            Poisson ratio of the film.
        e0_over_e2 : array_like
            Young's modulus of the substrate over E2*; infinity is a rigid substrate.
        nu0 : array_like, optional
            Poisson ratio of the substrate; by default that of the table, or 0.25 in a table of
            paired Poisson ratios, such as the embedded one.
        errors : {"raise", "nan"}
            What a point with an error gives: an exception, or NaN.

        Returns
        -------
        Solution
            The four quantities in units of E2*, and their relative error: that certified for the
            table, or the estimate of the expansion.

        Raises
        ------
        OutsideTableError
            For an a/t so far beyond the nodes that the expansion is not accurate enough.
            If the table answers some of the quantities only, or is one of a stack of layers.

        Examples
        --------
        >>> found = Table.embedded().quantities([0.1, 1.0, 10.0], 1.75, 0.5, 1e5)
        >>> found.eeq.round(4)
        array([0.7243, 0.8912, 0.9897])
        """
        if nu0 is None:
            own = self._description["nu0"]
            nu0 = 0.25 if own == "paired" else own
        parameters = {
            "a_over_t": a_over_t,
            "e1_over_e2": e1_over_e2,
            "nu1": nu1,
            "e0_over_e2": e0_over_e2,
            "nu0": nu0,
        }
        return solution(self._native.look_up, errors, parameters)

    @property
    def axes(self) -> Mapping[str, NDArray[np.float64]]:
        """The nodes of each axis by its name, in the order of the dimensions."""
        return self._native.axes()

    @property
    def values(self) -> Mapping[str, NDArray[np.float64]]:
        """The values of each quantity at the nodes, with the order of dimensions of ``axes``.

        Those of a low-rank table, such as the embedded one, are computed.
        """
        return self._native.values()

    def to_xarray(self) -> xarray.Dataset:
        """Return the nodes and the values as a Dataset; needs xarray.

        ``dataset.to_netcdf(path)`` writes them as netCDF4, which is HDF5, for other programs; this
        package reads the packed form and the HDF5 files of ``tabulate generate``.

        Examples
        --------
        >>> from coated_contact import generate
        >>> data = generate({
        ...     "title": "Rubber on glass", "tolerance": 1e-2, "a_over_t": {"from": 0.1, "to": 10},
        ...     "e1_over_e2": 1.75, "nu1": 0.5, "e0_over_e2": 1e5}, progress=False).to_xarray()
        >>> float(data["eeq"].sel(a_over_t=0.1, method="nearest").squeeze()).__round__(3)
        0.724
        """
        import xarray

        axes = self.axes
        described = {
            "title": self.title,
            "tolerance": self.tolerance,
            "max_error": self.max_error,
            "units_of_moduli": self._native.unit(),
            "nu0": self._description["nu0"],
        }
        return xarray.Dataset(
            {name: (tuple(axes), values) for name, values in self.values.items()}, axes, described
        )

    @cached_property
    def _description(self) -> dict[str, Any]:
        return self._native.description()

    @cached_property
    def _digest(self) -> bytes:
        return hashlib.sha256(self.to_packed()).digest()

    def __eq__(self, other: object) -> bool:
        """Compare the contents."""
        if not isinstance(other, Table):
            return NotImplemented
        return self._native is other._native or self._digest == other._digest

    def __hash__(self) -> int:
        return hash(self._digest)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the embedded table by its name, any other by its packed form."""
        if self._native.is_embedded:
            return (_embedded, ())
        return (Table.from_packed, (self.to_packed(),))

    def __repr__(self) -> str:
        return f"<Table {self.title!r}, tolerance {self.tolerance:g}>"


@cache
def _embedded() -> Table:
    return Table(_core.Table.embedded())


def native_table(table: Table | None) -> Any:
    """Return the native part of a table, of the embedded one for None."""
    if table is None:
        table = Table.embedded()
    if not isinstance(table, Table):
        raise TypeError(f"table must be a Table, such as Table.read(path), not {table!r}")
    return table._native
