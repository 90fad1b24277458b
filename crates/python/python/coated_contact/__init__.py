"""Adhesive contact of a sphere, or another probe, on a coated substrate.

A sphere (body 2) touches a film (1) bonded to a substrate (0) and adheres to it, in Barthel's
model (*Adhesive contact of a compliant sphere to an elastic coated substrate: the thin film limit*,
2007). All units are SI. Loads are positive in compression; penetrations are positive when the
sphere is below the undeformed surface.

Examples
--------
A sphere of 1 mm with E2* = 2 MPa, an incompressible film of 10 um, a stiff substrate:

>>> from coated_contact import Elastic, System, Table
>>> system = System(
...     sphere_radius=1e-3,
...     sphere_modulus=2e6,
...     film=Elastic(young_modulus=3.5e6, poisson_ratio=0.5),
...     film_thickness=1e-5,
...     substrate=Elastic(young_modulus=2e11, poisson_ratio=0.25),
... )
>>> contact = Table.embedded().contact(system)
>>> print(f"{contact.load(65e-6, 0.040):.3e} N")
-3.415e-05 N
>>> print(f"{contact.pull_off(0.040).load:.4e} N")
-1.9353e-04 N

The names are those of the Rust crate ``interp``, and so are the numbers, bit for bit.
"""

from ._afm import read_afm
from ._bodies import Elastic, HalfSpace, System
from ._cohesive import Cohesive
from ._cohesive_zone import ShortZone
from ._contact import Contact, SolvedCurve
from ._control import Spring
from ._core import __version__
from ._design import Design, design
from ._equilibria import Equilibria
from ._errors import (
    ContactError,
    FitError,
    InputError,
    NoContactError,
    OutsideTableError,
    SolveError,
    TableError,
)
from ._experiment import Experiment, Free
from ._fit import fit, fit_map
from ._fit_map import FitMap
from ._fit_results import (
    Estimate,
    Fit,
    FittedExperiment,
    FitWarning,
    FixedValue,
    Forecast,
    WithoutFilm,
)
from ._force_map import ForceMap
from ._generate import generate
from ._history import HistoryStates, Relaxation
from ._indentation import Indentation
from ._likelihood import LogLikelihood, log_likelihood
from ._line import ContactLine, Hysteresis, RateDependent, TimedStates
from ._magnitudes import MagnitudeWarning
from ._model import Prediction, branches, forecast, predict, simulate
from ._probe import (
    Cone,
    FlatEndedCone,
    FlatPunch,
    Paraboloid,
    PowerLaw,
    Probe,
    Profile,
    RoundedCone,
    Sphere,
)
from ._read import read_experiment
from ._results import (
    CohesiveEquilibrium,
    CohesiveState,
    CohesiveStates,
    Derivatives,
    Equilibrium,
    ForceDisplacement,
    Gradient,
    Jump,
    State,
    States,
)
from ._solve import Solution, solve, solve_stack
from ._stack import Layer, Springs, Stack, StackSystem
from ._stick import StickPunch, solve_stick_punch, stick_stiffening
from ._table import Table
from ._validity import Validity, ZoneSize

__all__ = [
    "Cohesive",
    "CohesiveEquilibrium",
    "CohesiveState",
    "CohesiveStates",
    "Cone",
    "Contact",
    "ContactError",
    "ContactLine",
    "Derivatives",
    "Design",
    "Elastic",
    "Equilibria",
    "Equilibrium",
    "Estimate",
    "Experiment",
    "Fit",
    "FitError",
    "FitMap",
    "FitWarning",
    "FittedExperiment",
    "FixedValue",
    "FlatEndedCone",
    "FlatPunch",
    "ForceDisplacement",
    "ForceMap",
    "Forecast",
    "Free",
    "Gradient",
    "HalfSpace",
    "HistoryStates",
    "Hysteresis",
    "Indentation",
    "InputError",
    "Jump",
    "Layer",
    "LogLikelihood",
    "MagnitudeWarning",
    "NoContactError",
    "OutsideTableError",
    "Paraboloid",
    "PowerLaw",
    "Prediction",
    "Probe",
    "Profile",
    "RateDependent",
    "Relaxation",
    "RoundedCone",
    "ShortZone",
    "Solution",
    "SolveError",
    "SolvedCurve",
    "Sphere",
    "Spring",
    "Springs",
    "Stack",
    "StackSystem",
    "State",
    "States",
    "StickPunch",
    "System",
    "Table",
    "TableError",
    "TimedStates",
    "Validity",
    "WithoutFilm",
    "ZoneSize",
    "__version__",
    "branches",
    "design",
    "fit",
    "fit_map",
    "forecast",
    "generate",
    "log_likelihood",
    "predict",
    "read_afm",
    "read_experiment",
    "simulate",
    "solve",
    "solve_stack",
    "solve_stick_punch",
    "stick_stiffening",
]
