"""The likelihood of the parameters of measured contacts, for samplers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, get_args

import numpy as np
from numpy.typing import ArrayLike

from . import _adapters, _core
from ._arrays import labels_of, real, scalar_or_array
from ._columns import Array
from ._errors import FitError
from ._experiment import Experiment, Free, ParameterName, one_of
from ._fit import free_of, told_apart
from ._model import BranchName
from ._table import Table, native_table
from ._values import Native, OneLine, set_field


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class LogLikelihood(Native, OneLine):
    """The logarithm of the likelihood of flat vectors of parameters: see :func:`log_likelihood`.

    Calling it with values, SI units, in the order of ``names``, returns a float; with an array
    whose last axis is the parameters, an array over the others. It can be pickled, as pools of
    processes need.

    Attributes
    ----------
    experiments : tuple of Experiment
        The measurements.
    free : tuple of Free
        The parameters.
    branches : list of list of str, optional
        The branch of each point of each experiment; None reads them from the data.
    table : Table, optional
        The table; None is the embedded one.
    """

    experiments: tuple[Experiment, ...]
    free: tuple[Free, ...]
    branches: list[list[str]] | None = None
    table: Table | None = None

    def __post_init__(self) -> None:
        table = native_table(self.table)
        made = _core.NativeLikelihood(table, list(self.experiments), list(self.free), self.branches)
        set_field(self, "_native", made)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the parameters; ``contact_point[1]`` is that of the second experiment."""
        alone = len(self.experiments) == 1
        return tuple(
            name if own is None or alone else f"{name}[{own}]"
            for name, own in self._native.parameters
        )

    def __call__(self, values: ArrayLike) -> Any:
        """Return the logarithm of the likelihood.

        It is ``-inf`` where there is none: outside the bounds, for a value that is not positive and
        must be, for one that is not finite, and where there is no contact, such as outside the
        table.
        """
        rows = self._rows(values)
        return scalar_or_array(self._native.values(rows.reshape(-1)).reshape(rows.shape[:-1]))

    def value_and_gradient(self, values: ArrayLike) -> tuple[Any, Array]:
        """Return the logarithm of the likelihood, and its derivatives by the values.

        They are exact; on stacks, and of a contact stiffness, they are central differences. They
        are NaN where the likelihood is 0.
        """
        rows = self._rows(values)
        found, gradients = self._native.values_and_gradients(rows.reshape(-1))
        return scalar_or_array(found.reshape(rows.shape[:-1])), gradients.reshape(rows.shape)

    def gradient(self, values: ArrayLike) -> Array:
        """Return the derivatives of the logarithm of the likelihood by the values."""
        return self.value_and_gradient(values)[1]

    def jax(self) -> Callable[..., Any]:
        """Return it as a function of JAX, which ``grad``, ``jvp``, ``jit`` and ``vmap`` take.

        It needs float64: ``jax.config.update("jax_enable_x64", True)``. Needs jax.
        """
        return _adapters.jax(self)

    def torch(self) -> Callable[..., Any]:
        """Return it as a function of tensors of PyTorch, with its gradient; needs torch.

        The last axis of the tensor, of float64, is the parameters. Second derivatives are an error.
        """
        return _adapters.torch(self)

    def pytensor(self) -> Any:
        """Return it as an ``Op`` of PyTensor, with its gradient; needs pytensor.

        In a model of PyMC: ``pymc.Potential("contact", likelihood.pytensor()(values))``.
        """
        return _adapters.pytensor(self)

    def _rows(self, values: ArrayLike) -> Array:
        """Return values as rows of numbers, one for each parameter."""
        rows = real("values", values)
        if rows.ndim == 0 or rows.shape[-1] != len(self._native.parameters):
            raise FitError(
                f"values has the shape {rows.shape}: give one value for each of "
                f"{', '.join(self.names)} along the last axis",
                axis="values",
            )
        labels = [None, *(own for _, own in labels_of(values))][-1]
        is_named = labels is not None and all(isinstance(one, str) for one in labels)
        if is_named and tuple(labels) != self.names:
            raise FitError(
                f"values has the labels {', '.join(labels)} along its last axis, and the "
                f"parameters are {', '.join(self.names)}: bring the values into this order",
                axis="values",
            )
        return np.ascontiguousarray(rows)


def log_likelihood(
    experiments: Experiment | Iterable[Experiment],
    free: Iterable[ParameterName | Free],
    *,
    branches: Sequence[Sequence[BranchName | str]] | None = None,
    table: Table | None = None,
) -> LogLikelihood:
    """Return the logarithm of the likelihood as a function of the free parameters.

    ``ln L = -1/2 sum(((model - ordinate) / sigma)^2) - sum(ln(sqrt(2 pi) sigma))``, for normal
    noise that is known. Of a contact stiffness they are ``ln(model)`` and ``ln(ordinate)``, with
    the relative noise: the density of the logarithm. A prior of a :class:`Free` is one term more,
    of a normal density; outside its bounds the likelihood is 0. Other priors are added by the
    sampler. Errors of the abscissae count by the slope of the model at the values of the
    experiments, and these weights stay.

    Parameters
    ----------
    experiments : Experiment or iterable of Experiment
        The measurements with their ``noise``, which each needs.
    free : iterable of str or Free
        The parameters. Those that are each experiment's own follow one another.
    branches : sequence of sequence of str, optional
        For each experiment the branch of each point. By default they are read from the data, as
        :func:`branches` does. Those of a fit, ``[one.branch for one in found.experiments]``, also
        leave out the points near the end of a branch, as it did.
    table : Table, optional
        The table; by default the embedded one, of films.

    Returns
    -------
    LogLikelihood
        A function of a flat vector of values in SI units, which emcee, zeus and dynesty take as it
        is, with its gradient, and with adapters for JAX, PyTorch and PyMC.

    Examples
    --------
    >>> from coated_contact import Elastic, HalfSpace
    >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
    >>> system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=glass)
    >>> lens = Experiment(kind="load-radius", abscissa=[5e-5, 8e-5, 1e-4],
    ...                   ordinate=[-1.69e-4, 4.17e-4, 1.249e-3], system=system, noise=1e-6)
    >>> likelihood = log_likelihood(lens, ["sphere_modulus", "work_of_adhesion"])
    >>> likelihood.names
    ('sphere_modulus', 'work_of_adhesion')
    >>> round(likelihood([2e6, 0.04]), 1) > round(likelihood([2e6, 0.05]), 1)
    True
    """
    return LogLikelihood(
        experiments=tuple(told_apart(experiments)),
        free=tuple(free_of(free)),
        branches=None if branches is None else [_names(of_one) for of_one in branches],
        table=table,
    )


def _names(branches: Sequence[BranchName | str]) -> list[str]:
    """Return the names of the branches of an experiment; refuse others."""
    if isinstance(branches, str):
        raise TypeError(f"branches must be a list of names for each experiment: [[{branches!r}]]")
    for name in branches:
        one_of("branch", name, get_args(BranchName))
    return list(branches)
