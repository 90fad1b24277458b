"""Models for nanite and PyJibe: a film on a substrate, on approach and on retract.

nanite's ``load_model_from_file`` loads the files :data:`APPROACH` and :data:`RETRACT`, and PyJibe
does under Preferences, Extensions; ``python -m coated_contact.plugins`` prints their paths. They
need lmfit, which nanite brings, and do not import nanite.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from .._bodies import Elastic, System
from .._columns import Array
from .._errors import ContactError, FitError
from .._experiment import Experiment
from .._magnitudes import unchecked
from .._model import branches, predict
from .._table import Table

if TYPE_CHECKING:
    from lmfit import Parameters

APPROACH = Path(__file__).with_name("coated_contact_approach.py")
RETRACT = Path(__file__).with_name("coated_contact_retract.py")

# Key, name, unit, start, bounds and whether the parameter is fitted. The contact point does not
# start at 0: the first step of lmfit would be 10 um, where there is no contact, and it would stay.
PARAMETERS: tuple[tuple[str, str, str, float, tuple[float, float], bool], ...] = (
    ("E", "Young's Modulus of the film", "Pa", 3e3, (0, np.inf), True),
    ("R", "Tip Radius", "m", 10e-6, (0, np.inf), False),
    ("nu", "Poisson's Ratio of the film", "", 0.5, (0, 0.5), False),
    ("thickness", "Film Thickness", "m", 10e-6, (0, np.inf), False),
    ("E_substrate", "Young's Modulus of the substrate", "Pa", 64e9, (0, np.inf), False),
    ("nu_substrate", "Poisson's Ratio of the substrate", "", 0.2, (0, 0.5), False),
    ("E_sphere", "Reduced Modulus of the sphere", "Pa", 66.7e9, (0, np.inf), False),
    ("work_of_adhesion", "Work of Adhesion", "J/m²", 1e-4, (0, np.inf), True),
    ("contact_point", "Contact Point", "m", 1e-12, (-np.inf, np.inf), True),
    ("baseline", "Force Baseline", "N", 0.0, (-np.inf, np.inf), True),
)

# The range of the attraction, m, for Tabor's parameter.
INTERACTION_RANGE = 3e-10


@dataclass(frozen=True, slots=True)
class Plugin:
    """What nanite asks of a model, for one direction.

    Attributes
    ----------
    retract : bool
        Whether the segment is the retract. On approach there is no adhesion unless the user frees
        it.
    """

    retract: bool

    def get_parameter_defaults(self) -> Parameters:
        """Return the parameters with their starts."""
        import lmfit

        parameters = lmfit.Parameters()
        for key, _, _, value, (least, most), fitted in PARAMETERS:
            if key == "work_of_adhesion" and not self.retract:
                value, fitted = 0.0, False
            parameters.add(key, value=value, min=least, max=most, vary=fitted)
        return parameters

    def model_func(
        self,
        delta: ArrayLike,
        E: float,  # noqa: N803
        R: float,  # noqa: N803
        nu: float,
        thickness: float,
        E_substrate: float,  # noqa: N803
        nu_substrate: float,
        E_sphere: float,  # noqa: N803
        work_of_adhesion: float,
        contact_point: float,
        baseline: float,
    ) -> Array:
        """Return the force (N) at tip positions (m)."""
        values = dict(locals())
        del values["self"], values["delta"]
        return predict(self._experiment(delta, None, values)).ordinate

    def residual(
        self, params: Parameters, delta: ArrayLike, force: ArrayLike, weight_cp: float = 0
    ) -> Array:
        """Return the force less that of the model, 0 for points in a jump.

        Which points are in contact is read from the data: those before the jump off; on retract
        those up to the smallest force, because a contact that detaches gradually does not follow
        the model any more. There are no
        weights about the contact point, whatever ``weight_cp`` is: they would play down adhesion.
        Where there is no contact of these values, such as one larger than the sphere, the residuals
        are far larger than any force, so that the method shortens its step.
        """
        experiment = self._experiment(delta, force, params.valuesdict())
        known = [key for key, parameter in params.items() if parameter.vary]
        free = [key for key in ("work_of_adhesion", "contact_point", "baseline") if key in known]
        words = branches(experiment, free)
        if self.retract and params["work_of_adhesion"].value > 0:
            closest = experiment.abscissa[experiment.ordinate.argmin()]
            words = [
                "left-out" if word == "receding" and x < closest else word
                for word, x in zip(words, experiment.abscissa, strict=True)
            ]
        try:
            difference = experiment.ordinate - predict(experiment, branches=words).ordinate
        except FitError:
            raise
        except ContactError:
            return np.full(experiment.ordinate.shape, 1e6 * np.abs(experiment.ordinate).max())
        return np.where(np.isnan(difference), 0.0, difference)

    def compute_ancillaries(self, fd: Any) -> dict[str, float]:
        """Return a start for the work of adhesion and, after a fit, Tabor's parameter.

        The start is that of JKR, from the smallest force. A Tabor parameter below 5, where the
        attraction reaches too far for this model, is a warning.
        """
        known = fd.fit_properties.get("params_initial") or self.get_parameter_defaults()
        found = {"work_of_adhesion": 0.0, "tabor": np.nan}
        if self.retract:
            forces = np.asarray(fd["force"])[np.asarray(fd["segment"]) == 1]
            baseline = float(np.median(forces[-max(len(forces) // 10, 1) :]))
            pull_off = max(baseline - float(forces.min()), 0.0)
            found["work_of_adhesion"] = pull_off / (1.5 * pi * known["R"].value)
        fitted = fd.fit_properties.get("params_fitted")
        if fitted and fitted.get("work_of_adhesion") is not None:
            values = fitted.valuesdict()
            if values["work_of_adhesion"] > 0:
                contact = Table.embedded().contact(system(values))
                found["tabor"] = contact.zone_size(
                    values["work_of_adhesion"], interaction_range=INTERACTION_RANGE
                ).tabor
        if found["tabor"] < 5:
            warnings.warn(
                f"Tabor's parameter is {found['tabor']:.2g} for an attraction over "
                f"{INTERACTION_RANGE:g} m: below 5 the attraction reaches too far for this model, "
                "and the work of adhesion is only of the right order",
                stacklevel=2,
            )
        return found

    def _experiment(
        self, delta: ArrayLike, force: ArrayLike | None, values: Mapping[str, float]
    ) -> Experiment:
        """Return the experiment: the penetration is the contact point less the tip position."""
        tip = np.asarray(delta, dtype=float)
        return Experiment(
            kind="load-penetration",
            abscissa=-tip,
            ordinate=None if force is None else np.asarray(force, dtype=float),
            retract=np.full(tip.shape, self.retract),
            system=system(values),
            work_of_adhesion=values["work_of_adhesion"],
            contact_point=-values["contact_point"],
            baseline=values["baseline"],
        )


def system(values: Mapping[str, float]) -> System:
    """Return the system of the parameters of a model."""
    with unchecked():
        return System(
            sphere_radius=values["R"],
            sphere_modulus=values["E_sphere"],
            film=Elastic(young_modulus=values["E"], poisson_ratio=values["nu"]),
            film_thickness=values["thickness"],
            substrate=Elastic(
                young_modulus=values["E_substrate"], poisson_ratio=values["nu_substrate"]
            ),
        )
