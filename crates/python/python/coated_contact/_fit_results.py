"""The results of fits, and what is expected of planned ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _html
from ._arrays import number
from ._columns import Array
from ._errors import FitError
from ._fit_plot import PlotKind, draw
from ._values import MOST_SHOWN, OneLine

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True)
class FitWarning:
    """A doubt about the result of a fit.

    Attributes
    ----------
    kind : str
        What it is about, such as ``"undetermined"``.
    text : str
        The doubt in one sentence, with the numbers and the next step.
    """

    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class Estimate:
    """A parameter found.

    Attributes
    ----------
    parameter : str
        Its name.
    experiment : int or None
        The number of the experiment to which it belongs; None if it is shared.
    value : float
        The value, in SI units.
    standard_error : float
        The standard error, in SI units.
    profile : tuple of float or None
        The interval of the profile likelihood, if asked for.
    """

    parameter: str
    experiment: int | None
    value: float
    standard_error: float
    profile: tuple[float, float] | None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FittedExperiment(OneLine):
    """The points of an experiment, as fitted: arrays in the order measured.

    Attributes
    ----------
    name : str
        The name of the measurement.
    kind : str
        What was measured, such as ``"load-radius"``.
    noise : float
        Standard deviation of an ordinate, N or m; of a contact stiffness relative to it.
    noise_is_estimated : bool
        Whether the noise was estimated from the residuals.
    abscissa_noise : float
        Standard deviation of an abscissa, m; 0 if they are exact.
    abscissa, ordinate : numpy.ndarray
        The measured points.
    fit : numpy.ndarray
        The ordinates of the fit; NaN for a point that was left out.
    deviation : numpy.ndarray
        The standard deviations of the residuals: those of the ordinates, with what errors of the
        abscissae add.
    contact_radius : numpy.ndarray
        The contact radii of the fit, m; NaN without a contact.
    without_film : numpy.ndarray
        The ordinates of the fit without the film; NaN where there is none.
    line_speed : numpy.ndarray
        The speeds of the contact line, m/s, positive where it recedes, where adhesion depends on
        them; NaN elsewhere, and where a speed is not known.
    energy_release_rate : numpy.ndarray
        The energy release rates that the ordinates tell at these speeds, J/m^2.
    branch : list of str
        ``"advancing"``, ``"receding"``, ``"pinned"``, ``"baseline"`` or ``"left-out"``.
    outlier : numpy.ndarray
        Whether the residual is more than 5 times its standard deviation.
    left_out : dict of str to int
        The numbers of points left out, by reason: ``"jump"``, ``"no-contact"``, ``"turn"``,
        ``"unknown-speed"``, ``"near-end"``, ``"beyond-end"``.
    retract : numpy.ndarray or None
        Whether each point was measured on retract; None where that is not known.
    loss : dict of str to float or None
        ``angle`` (rad), ``tangent`` and its ``standard_error`` of the complex modulus of the film,
        where phases are measured.
    relaxation : tuple or None
        Where the film relaxes, the times (s) and the Young's moduli (Pa) at them after a step of
        the strain, the largest change (m) of an abscissa that made them one rise and one fall, the
        bound of the error by bodies that do not relax, and the estimated error of the loads by the
        steps in time, both in parts of the largest load.
    """

    name: str
    kind: str
    noise: float
    noise_is_estimated: bool
    abscissa_noise: float
    abscissa: Array
    ordinate: Array
    fit: Array
    deviation: Array
    contact_radius: Array
    without_film: Array
    line_speed: Array
    energy_release_rate: Array
    branch: list[str]
    outlier: NDArray[np.bool_]
    left_out: dict[str, int]
    retract: NDArray[np.bool_] | None
    loss: dict[str, float] | None
    relaxation: tuple[list[float], list[float], float, float, float] | None
    _jkr: tuple[Array, ...] | str = field(repr=False)

    @property
    def residual(self) -> Array:
        """The ordinates measured less those of the fit."""
        return self.ordinate - self.fit

    def jkr(self) -> dict[str, Array]:
        """Return the points in the reduced JKR plot, a straight line for a contact without film.

        Returns
        -------
        dict of str to numpy.ndarray
            ``jkr_abscissa``, a^(3/2) / (sqrt(pi) R) in m^(1/2); ``jkr_ordinate``,
            F / (sqrt(6 pi) a^(3/2)) in N m^(-3/2), ``fit`` and ``without_film``, the same of the
            fits. The load offset is taken from all loads. NaN for a point without contact.

        Raises
        ------
        FitError
            Unless loads were measured at contact radii, by a probe with a radius of curvature.
        """
        if isinstance(self._jkr, str):
            raise FitError(self._jkr)
        names = ("jkr_abscissa", "jkr_ordinate", "fit", "without_film")
        return dict(zip(names, self._jkr, strict=True))

    def to_pandas(self) -> pandas.DataFrame:
        """Return a row for each point, in the order measured; needs pandas."""
        import pandas

        names = ("abscissa", "ordinate", "fit", "residual", "contact_radius", "without_film")
        columns = {name: getattr(self, name) for name in names}
        return pandas.DataFrame({**columns, "branch": self.branch, "outlier": self.outlier})


@dataclass(frozen=True, slots=True)
class FixedValue:
    """What a value that is not free does to the values found.

    Attributes
    ----------
    quantity : str
        Its name, such as ``"film_thickness"`` or ``"sphere_radius"``.
    value : float
        The value, in SI units: that of the first experiment, if they differ.
    values : tuple of float
        The values of all experiments that have one, in their order, if they differ; else empty.
    step : float
        A change of it: 1 %, 0.01 of a Poisson ratio, or of a zero its known error or the noise of a
        reading; to the other side at the end of what is possible, such as a Poisson ratio of 0.5.
    changes : dict of str to float
        The changes of the values found that follow, in SI units and to the first order, by name.
    standard_error : float or None
        The standard error of the value, if it is known.
    """

    quantity: str
    value: float
    values: tuple[float, ...]
    step: float
    changes: dict[str, float]
    standard_error: float | None


@dataclass(frozen=True, slots=True)
class WithoutFilm:
    """The same data, fitted without the film by JKR, or by Hertz without adhesion.

    Attributes
    ----------
    params : dict of str to float
        The parameters found.
    chi_squared : float
        The sum of the squared residuals, in units of the noise of the fit with the film.
    modulus : str or None
        The modulus that is compared; None if none is free.
    relative_error : float or None
        The error of that modulus, relative to the one with the film: 0.041 is +4.1 %.
    standard_errors : float or None
        The same error in standard errors of the modulus with the film.
    film_matters : bool
        Whether that error is above three standard errors.
    """

    params: dict[str, float]
    chi_squared: float
    modulus: str | None
    relative_error: float | None
    standard_errors: float | None
    film_matters: bool


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Fit(OneLine):
    """The result of a fit.

    Attributes
    ----------
    estimates : tuple of Estimate
        The parameters found.
    correlation : numpy.ndarray
        Their correlation matrix; NaN where the data do not determine it.
    converged : bool
        Whether the method found a minimum. If not, the numbers are those of its last step.
    evaluations : int
        The number of times that the model was evaluated at all points.
    chi_squared : float
        The sum of the squared residuals, in units of the noise.
    degrees_of_freedom : int
        The number of points that count, and of priors, less that of the parameters.
    reduced_chi_squared : float or None
        chi_squared over degrees_of_freedom; None if the noise was estimated from the residuals.
    warnings : tuple of FitWarning
        The doubts about the result. An empty tuple is a good sign.
    experiments : tuple of FittedExperiment
        The experiments, in the order given.
    without_film : WithoutFilm or None
        The same data without the film.
    undetermined : tuple of str
        The combinations of parameters that the data do not determine, in words.
    report : str
        The result for people, as the program ``tabulate fit`` prints it: what is fixed, what was
        found, whether the film matters, and the warnings. ``print(fit)`` prints it.
    fixed_values : tuple of FixedValue
        What the values that are not free do to the result.
    """

    estimates: tuple[Estimate, ...]
    correlation: Array
    converged: bool
    evaluations: int
    chi_squared: float
    degrees_of_freedom: int
    reduced_chi_squared: float | None
    warnings: tuple[FitWarning, ...]
    experiments: tuple[FittedExperiment, ...]
    without_film: WithoutFilm | None
    undetermined: tuple[str, ...]
    report: str
    fixed_values: tuple[FixedValue, ...] = ()

    def __str__(self) -> str:
        """Return the report."""
        return self.report

    def __repr__(self) -> str:
        """Return the values with their standard errors on one line."""
        shown = [
            f"{name}={one.value:.6g} +- {one.standard_error:.2g}"
            for name, one in zip(self.names, self.estimates, strict=True)
        ]
        if len(shown) > MOST_SHOWN:
            shown[MOST_SHOWN:] = [f"... {len(shown)} in all"]
        shown += [f"converged={self.converged}", f"warnings={len(self.warnings)}"]
        return f"<Fit {', '.join(shown)}>"

    def young_modulus_of_sphere(self, poisson_ratio: float) -> tuple[Estimate, ...]:
        """Return Young's modulus of the sphere, which is not the ``sphere_modulus`` of a system.

        ``E2 = E2* (1 - nu2^2)``, with ``sphere_modulus`` for E2*.

        Parameters
        ----------
        poisson_ratio : float
            The Poisson ratio of the sphere, above -1 and up to 0.5, taken as exact.

        Returns
        -------
        tuple of Estimate
            One modulus with its errors, or one for each experiment that has its own.

        Raises
        ------
        FitError
            For a Poisson ratio outside its range, or where the sphere's modulus was not free.
        """
        nu2 = number("poisson_ratio", poisson_ratio)
        if not -1 < nu2 <= 0.5:
            raise FitError(
                f"poisson_ratio = {nu2!r} cannot be used: give one above -1 and up to 0.5",
                axis="poisson_ratio",
                value=nu2,
                range=(-1.0, 0.5),
            )
        factor = 1 - nu2**2
        found = tuple(
            replace(
                one,
                parameter="sphere_young_modulus",
                value=factor * one.value,
                standard_error=factor * one.standard_error,
                profile=one.profile and (factor * one.profile[0], factor * one.profile[1]),
            )
            for one in self.estimates
            if one.parameter == "sphere_modulus"
        )
        if not found:
            raise FitError(
                "Young's modulus of the sphere follows from its reduced modulus, which was not "
                'free: free "sphere_modulus"',
                axis="sphere_modulus",
            )
        return found

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the estimates: ``contact_point[1]`` is that of the second experiment.

        With one experiment there are no numbers.
        """
        return tuple(name_of(estimate, len(self.experiments)) for estimate in self.estimates)

    @property
    def params(self) -> dict[str, float]:
        """The values found, in SI units, by name."""
        values = (estimate.value for estimate in self.estimates)
        return dict(zip(self.names, values, strict=True))

    @property
    def stderr(self) -> dict[str, float]:
        """The standard errors, in SI units, by name."""
        errors = (estimate.standard_error for estimate in self.estimates)
        return dict(zip(self.names, errors, strict=True))

    @property
    def covariance(self) -> Array:
        """The covariance matrix, in the order of ``names``."""
        errors = np.array([estimate.standard_error for estimate in self.estimates])
        return self.correlation * np.outer(errors, errors)

    def _repr_html_(self) -> str:
        """Return what a notebook shows: values with standard errors, and the warnings."""
        rows = [
            (name, f"{value:.6g}", f"{self.stderr[name]:.2g}")
            for name, value in self.params.items()
        ]
        found = _html.table(("parameter (SI)", "value", "standard error"), rows)
        return found + _table_of(self.warnings)

    def plot(
        self,
        ax: Axes | None = None,
        *,
        kind: PlotKind = "data",
        experiment: int | None = None,
    ) -> Axes:
        """Draw the points, the fit, and the fit without the film; needs matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default the current axes.
        kind : {"data", "jkr"}
            The data as they were measured, or the reduced JKR plot of loads at contact radii, in
            which a contact without a film is a straight line: see ``FittedExperiment.jkr``.
        experiment : int, optional
            The number of the only experiment to be drawn; by default all.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. Its coordinates are in SI units; the numbers along them have a prefix.

        Raises
        ------
        FitError
            For a JKR plot of other quantities, or of a probe without a radius of curvature.
        ValueError
            For experiments that measure different quantities, where no ``experiment`` is given.
        """
        chosen = self.experiments if experiment is None else (self.experiments[experiment],)
        return draw(chosen, kind, ax)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Forecast(OneLine):
    """What planned experiments would tell.

    Attributes
    ----------
    estimates : tuple of Estimate
        The parameters at their true values, with the standard errors expected.
    correlation : numpy.ndarray
        Their expected correlation matrix; NaN where the experiments would not determine it.
    undetermined : tuple of str
        The combinations of parameters that the experiments would not determine, in words.
    stderr : dict of str to float
        The standard errors, in SI units, by name.
    fixed_values : tuple of FixedValue
        What values that are not free would do, if they are not quite the true ones.
    warnings : tuple of FitWarning
        The assumptions of the model that the contacts would leave: wide contacts, large strains,
        friction.
    """

    estimates: tuple[Estimate, ...]
    correlation: Array
    undetermined: tuple[str, ...]
    stderr: dict[str, float]
    fixed_values: tuple[FixedValue, ...] = field(repr=False)
    warnings: tuple[FitWarning, ...]
    # The names of the parameters in these combinations.
    _undetermined: frozenset[str] = field(repr=False)

    def _repr_html_(self) -> str:
        """Return what a notebook shows: values with the errors expected, and the doubts."""
        rows = [
            (name, f"{estimate.value:.6g}", f"{error:.2g}")
            for estimate, (name, error) in zip(self.estimates, self.stderr.items(), strict=True)
        ]
        found = _html.table(("parameter (SI)", "value", "expected error"), rows)
        doubts = [(words,) for words in self.undetermined]
        found += _html.table(("not determined",), doubts) if doubts else ""
        return found + _table_of(self.warnings)


def _table_of(warnings: tuple[FitWarning, ...]) -> str:
    """Return a table of warnings for a notebook; nothing without any."""
    doubts = [(warning.kind, warning.text) for warning in warnings]
    return _html.table(("warning", "text"), doubts) if doubts else ""


def estimates_of(found: Mapping[str, Any]) -> tuple[Estimate, ...]:
    """Return the estimates in a native result."""
    return tuple(Estimate(*numbers) for numbers in found["estimates"])


def warnings_of(found: Mapping[str, Any]) -> tuple[FitWarning, ...]:
    """Return the warnings in a native result."""
    return tuple(FitWarning(*words) for words in found["warnings"])


def correlation_of(found: Mapping[str, Any]) -> Array:
    """Return the correlation matrix in a native result."""
    count = len(found["estimates"])
    if not found["correlation"]:
        return np.full((count, count), np.nan)
    return np.array(found["correlation"], dtype=np.float64)


def name_of(estimate: Estimate, experiments: int) -> str:
    """Return the name of an estimate: ``contact_point[1]`` is that of the second experiment."""
    if estimate.experiment is None or experiments == 1:
        return estimate.parameter
    return f"{estimate.parameter}[{estimate.experiment}]"


def fixed_values_of(found: Mapping[str, Any], experiments: int) -> tuple[FixedValue, ...]:
    """Return what the values that are not free do, in a native result."""
    names = [name_of(estimate, experiments) for estimate in estimates_of(found)]
    return tuple(
        FixedValue(
            quantity, value, tuple(values), step, dict(zip(names, changes, strict=True)), error
        )
        for quantity, value, values, step, changes, error in found["fixed_values"]
    )


def without_film_of(found: Mapping[str, Any], experiments: int) -> WithoutFilm:
    """Return the fit without the film in a native result."""
    modulus, relative, deviations, matters = found["modulus"] or (None, None, None, False)
    return WithoutFilm(
        params={name_of(one, experiments): one.value for one in estimates_of(found)},
        chi_squared=found["chi_squared"],
        modulus=modulus,
        relative_error=relative,
        standard_errors=deviations,
        film_matters=matters,
    )
