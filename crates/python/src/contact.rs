//! One contact: numbers at contact radii, and states at imposed values.

use std::sync::OnceLock;

use ::contact::{
    ContactGradient, Control, Equilibria, Error, FilmValidity, ForceDisplacement,
    Input as Parameter, Neglected, State, Validity,
};
use ::solve::stick::StickCurves;
use interp::{Curve, System};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{Input, Output, Outputs, Points, add, columns};
use crate::bodies::{NativeCoated, NativeHalfSpace, NativeStack};
use crate::error::{Failure, OrRaise as _, other_stack, unknown};
use crate::table::Table;

/// A contact, with the table that makes its derivatives when they are first asked for.
#[pyclass(frozen, module = "coated_contact._core")]
pub struct Contact {
    pub contact: ::contact::Contact,
    origin: Option<(Table, System)>,
    with_gradient: OnceLock<::contact::Contact>,
}

/// What is imposed: `load`, `displacement` or `spring`, and the stiffness of the spring, N/m.
pub type Imposed<'a> = (&'a str, f64);
/// Contact radius, load and penetration.
pub type StateNumbers = [f64; 3];
/// Contact radii, loads and penetrations.
type StateArrays<'py> = [Output<'py>; 3];
/// Branches on loading and unloading, and the states before and after each jump.
type CurveNumbers<'py> = (
    Vec<StateArrays<'py>>,
    Vec<StateArrays<'py>>,
    Vec<(StateNumbers, Option<StateNumbers>)>,
);

impl Contact {
    /// Takes a contact that no table can make again.
    fn alone(contact: ::contact::Contact) -> Self {
        Self {
            contact,
            origin: None,
            with_gradient: OnceLock::new(),
        }
    }

    /// Makes the contact of a system on a curve of its own.
    fn of_curve(
        py: Python<'_>,
        system: &System,
        curve: impl FnOnce() -> Result<Curve, tabulate::Error> + Send,
    ) -> PyResult<Self> {
        py.detach(|| Ok::<_, tabulate::Error>(::contact::Contact::new(system, curve()?)?))
            .map(Self::alone)
            .or_raise(py)
    }

    /// Returns the contact with derivatives, made at the first call.
    fn gradient_contact(&self) -> Result<&::contact::Contact, Error> {
        let Some((table, system)) = &self.origin else {
            return Ok(&self.contact);
        };
        if let Some(made) = self.with_gradient.get() {
            return Ok(made);
        }
        let made = ::contact::Contact::in_table_with_gradient(table.get(), system)?;
        Ok(self.with_gradient.get_or_init(|| made))
    }
}

/// Returns what is imposed on the contact.
pub fn control((name, stiffness): Imposed<'_>) -> PyResult<Control> {
    match name {
        "load" => Ok(Control::Load),
        "displacement" => Ok(Control::Displacement),
        "spring" => Ok(Control::Spring { stiffness }),
        other => Err(unknown("control", other)),
    }
}

/// Returns the three numbers of a state.
pub fn numbers(state: State) -> StateNumbers {
    [state.contact_radius, state.load, state.penetration]
}

/// Returns the only number of a result.
const fn alone(number: f64) -> [f64; 1] {
    [number]
}

/// Returns the name of an input in Python.
fn key(input: Parameter) -> String {
    input.name().to_lowercase().replace(' ', "_")
}

/// Returns the exception of a derivative that is not known.
#[pyfunction]
pub fn no_derivative(py: Python<'_>, input: &str) -> PyErr {
    let one = Parameter::ALL.into_iter().find(|one| key(*one) == input);
    let name = one.map_or("an unknown input", Parameter::name);
    Failure::from(interp::Error::FixedParameter(name)).raise(py)
}

/// Returns the states of a branch as three arrays.
fn arrays<'py>(py: Python<'py>, states: &[State]) -> StateArrays<'py> {
    let rows: Vec<_> = states.iter().copied().map(numbers).collect();
    columns(py, &rows)
}

#[pymethods]
impl Contact {
    #[staticmethod]
    fn half_space(py: Python<'_>, system: &Bound<'_, NativeHalfSpace>) -> PyResult<Self> {
        ::contact::Contact::half_space(&system.get().0)
            .map(Self::alone)
            .or_raise(py)
    }

    /// Looks up the contact of a film, or of a stack, which is that of the table, `own`.
    #[staticmethod]
    fn in_table(
        py: Python<'_>,
        table: &Bound<'_, Table>,
        bodies: &Bound<'_, NativeCoated>,
        own: Option<&Bound<'_, NativeStack>>,
    ) -> PyResult<Self> {
        let (table, bodies) = (table.get(), bodies.get());
        let system = &bodies.system;
        let Some(stack) = bodies.stack() else {
            return py
                .detach(|| ::contact::Contact::in_table(table.get(), system))
                .map(|contact| Self {
                    origin: Some((table.clone(), system.clone())),
                    ..Self::alone(contact)
                })
                .or_raise(py);
        };
        if own.is_some_and(|own| own.get().0.stack != *stack) {
            return Err(other_stack().raise(py));
        }
        Self::of_curve(py, system, || {
            Ok(stack.curve_in(table.get(), system.sphere_modulus)?)
        })
    }

    /// Solves the contact of bodies along `a/t`.
    #[staticmethod]
    fn solved(
        py: Python<'_>,
        bodies: &Bound<'_, NativeCoated>,
        a_over_t: [f64; 2],
        tolerance: f64,
    ) -> PyResult<Self> {
        let bodies = bodies.get();
        let system = &bodies.system;
        Self::of_curve(py, system, || {
            Ok(match bodies.stack() {
                None => ::solve::curve(&system.material()?, a_over_t, tolerance),
                Some(stack) => {
                    ::solve::stack_curve(stack, system.sphere_modulus, a_over_t, tolerance)
                }
            }?)
        })
    }

    /// Solves the contact of bodies that stick along `a/t`, under a sphere of the Poisson ratio
    /// `nu2`. It has grown with the part `ratio` of the work of adhesion with which it recedes.
    #[staticmethod]
    fn stuck(
        py: Python<'_>,
        bodies: &Bound<'_, NativeCoated>,
        a_over_t: [f64; 2],
        tolerance: f64,
        nu2: f64,
        ratio: f64,
    ) -> PyResult<Self> {
        let bodies = bodies.get();
        Self::of_curve(py, &bodies.system, || {
            let sticking = bodies.sticking(nu2)?;
            Ok(StickCurves::new(&sticking, a_over_t, tolerance)?.receding(ratio)?)
        })
    }

    /// Returns the smallest and the largest contact radius of searches.
    fn contact_radius_range(&self) -> [f64; 2] {
        self.contact.contact_radius_range()
    }

    fn load<'py>(&self, points: Points<'py>, a: Input<'_>, w: Input<'_>) -> Outputs<'py, 1> {
        points.evaluate([&a, &w], |[a, w]| self.contact.load(a, w).map(alone))
    }

    fn load_and_penetration<'py>(
        &self,
        points: Points<'py>,
        a: Input<'_>,
        w: Input<'_>,
    ) -> Outputs<'py, 2> {
        points.evaluate([&a, &w], |[a, w]| {
            self.contact
                .load_and_penetration(a, w)
                .map(<[f64; 2]>::from)
        })
    }

    fn moving_stiffness<'py>(
        &self,
        points: Points<'py>,
        a: Input<'_>,
        w: Input<'_>,
    ) -> Outputs<'py, 1> {
        points.evaluate([&a, &w], |[a, w]| {
            self.contact.moving_stiffness(a, w).map(alone)
        })
    }

    fn stiffness<'py>(&self, points: Points<'py>, a: Input<'_>) -> Outputs<'py, 1> {
        points.evaluate([&a], |[a]| self.contact.stiffness(a).map(alone))
    }

    fn energy_release_rate_at_load<'py>(
        &self,
        points: Points<'py>,
        a: Input<'_>,
        load: Input<'_>,
    ) -> Outputs<'py, 1> {
        points.evaluate([&a, &load], |[a, load]| {
            self.contact.energy_release_rate_at_load(a, load).map(alone)
        })
    }

    fn energy_release_rate_at_penetration<'py>(
        &self,
        points: Points<'py>,
        a: Input<'_>,
        penetration: Input<'_>,
    ) -> Outputs<'py, 1> {
        points.evaluate([&a, &penetration], |[a, penetration]| {
            let found = self
                .contact
                .energy_release_rate_at_penetration(a, penetration);
            found.map(alone)
        })
    }

    /// Returns the fields of `::contact::Validity` by their names, those of a film among them, which are
    /// NaN on a half-space, and under `neglected` whether each effect is neglected though it matters.
    fn validity<'py>(
        &self,
        py: Python<'py>,
        points: Points<'py>,
        a: Input<'_>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let [mut rows] = points.columns::<Option<Validity>, 1>()?;
        points.for_each([&a], |[a]| self.contact.validity(a), |row| rows.push(row))?;
        let fields = PyDict::new(py);
        let number = |name, of: fn(Validity) -> f64| {
            let column = rows.iter().map(|row| row.map_or(f64::NAN, of));
            fields.set_item(name, PyArray1::from_iter(py, column))
        };
        number("a_over_r", |validity| validity.a_over_r)?;
        number("shape", |validity| validity.shape)?;
        number("sideways", |validity| validity.sideways)?;
        number("probe_share", |validity| validity.probe_share)?;
        number("surface_tension", |validity| validity.surface_tension)?;
        let film = |row: &Option<Validity>| row.and_then(|validity| validity.film);
        let number = |name, of: fn(FilmValidity) -> f64| {
            let column = rows.iter().map(|row| film(row).map_or(f64::NAN, of));
            fields.set_item(name, PyArray1::from_iter(py, column))
        };
        number("a_over_t", |film| film.a_over_t)?;
        number("compressibility", |film| film.compressibility)?;
        number("strain", |film| film.strain)?;
        number("bending", |film| film.bending)?;
        let flag = |name, of: fn(FilmValidity) -> bool| {
            let column = rows.iter().map(|row| film(row).is_some_and(of));
            fields.set_item(name, PyArray1::from_iter(py, column))
        };
        flag("in_range", |film| film.in_range)?;
        flag("no_disc", |film| film.no_disc)?;
        let neglected = PyDict::new(py);
        for (name, effect) in [
            ("sideways", Neglected::Sideways),
            ("elastic_probe", Neglected::ElasticProbe),
            ("strain", Neglected::Strain),
            ("bending", Neglected::Bending),
        ] {
            let matters = |row: &Option<Validity>| {
                row.is_some_and(|validity| validity.neglected().contains(&effect))
            };
            let column = rows.iter().map(matters);
            neglected.set_item(name, PyArray1::from_iter(py, column))?;
        }
        fields.set_item("neglected", neglected)?;
        Ok(fields)
    }

    /// Returns Tabor's parameter, the length of the cohesive zone, the range over the thickness, and the tension.
    fn zone_size<'py>(&self, points: Points<'py>, w: Input<'_>, z0: Input<'_>) -> Outputs<'py, 4> {
        points.evaluate([&w, &z0], |[w, z0]| {
            let range = self.contact.zone_size(w, z0)?;
            Ok::<_, Error>([
                range.tabor,
                range.cohesive_zone,
                range.range_over_thickness,
                range.tension,
            ])
        })
    }

    /// Returns the part by which the pull-off load of JKR is too small.
    fn pull_off_error<'py>(
        &self,
        points: Points<'py>,
        w: Input<'_>,
        z0: Input<'_>,
    ) -> Outputs<'py, 1> {
        points.evaluate([&w, &z0], |[w, z0]| {
            let range = self.contact.zone_size(w, z0)?;
            range.pull_off_error().map(alone)
        })
    }

    /// Returns load and penetration, and the derivatives of both by the name of the input; NaN where one is
    /// not known.
    fn gradient<'py>(
        &self,
        py: Python<'py>,
        points: Points<'py>,
        a: Input<'_>,
        w: Input<'_>,
    ) -> PyResult<([Output<'py>; 2], Bound<'py, PyDict>)> {
        let contact = py.detach(|| self.gradient_contact()).or_raise(py)?;
        let mut values = points.columns()?;
        let mut derivatives = Vec::new();
        for _ in Parameter::ALL {
            derivatives.push(points.columns()?);
        }
        let take = |gradient: Option<ContactGradient>| {
            let of_point = gradient.as_ref();
            add(
                &mut values,
                of_point.map(|gradient| [gradient.load(), gradient.penetration()]),
            );
            for (columns, input) in derivatives.iter_mut().zip(Parameter::ALL) {
                let by = of_point.and_then(|gradient| gradient.by(input).ok());
                add(columns, by.map(|by| [by.load, by.penetration]));
            }
        };
        points.for_each([&a, &w], |[a, w]| contact.gradient(a, w), take)?;
        let array = |column| PyArray1::from_vec(py, column);
        let named = PyDict::new(py);
        for (columns, input) in derivatives.into_iter().zip(Parameter::ALL) {
            named.set_item(key(input), columns.map(array))?;
        }
        Ok((values.map(array), named))
    }

    fn pull_off<'py>(
        &self,
        points: Points<'py>,
        w: Input<'_>,
        imposed: Imposed<'_>,
    ) -> PyResult<StateArrays<'py>> {
        let control = control(imposed)?;
        points.evaluate([&w], |[w]| self.contact.pull_off(w, control).map(numbers))
    }

    fn work_of_adhesion_at_pull_off<'py>(
        &self,
        points: Points<'py>,
        load: Input<'_>,
        imposed: Imposed<'_>,
    ) -> Outputs<'py, 1> {
        let control = control(imposed)?;
        points.evaluate([&load], |[load]| {
            let found = self.contact.work_of_adhesion_at_pull_off(load, control);
            found.map(alone)
        })
    }

    /// Accepts a work of adhesion and what is imposed.
    fn check_equilibria(&self, py: Python<'_>, w: f64, imposed: Imposed<'_>) -> PyResult<()> {
        let control = control(imposed)?;
        py.detach(|| self.contact.equilibria(w, control).map(drop))
            .or_raise(py)
    }

    /// Returns all equilibria at one imposed value, each with its stability.
    fn equilibria_at(
        &self,
        py: Python<'_>,
        w: f64,
        imposed: Imposed<'_>,
        value: f64,
    ) -> PyResult<Vec<(StateNumbers, bool)>> {
        let control = control(imposed)?;
        let found = py.detach(|| self.contact.equilibria(w, control)?.at(value));
        let found = found.or_raise(py)?.into_iter();
        Ok(found.map(|one| (numbers(one.state), one.stable)).collect())
    }

    /// Returns the stable state of a branch at each imposed value.
    fn states<'py>(
        &self,
        py: Python<'py>,
        points: Points<'py>,
        values: Input<'_>,
        w: f64,
        imposed: Imposed<'_>,
        branch: &str,
    ) -> PyResult<StateArrays<'py>> {
        let control = control(imposed)?;
        let state: fn(&Equilibria<'_>, f64) -> Result<State, Error> = match branch {
            "loading" => |of, value| of.loading(value),
            "unloading" => |of, value| of.unloading(value),
            other => return Err(unknown("branch", other)),
        };
        let equilibria = py
            .detach(|| self.contact.equilibria(w, control))
            .or_raise(py)?;
        points.evaluate([&values], |[value]| state(&equilibria, value).map(numbers))
    }

    fn force_displacement<'py>(
        &self,
        py: Python<'py>,
        w: f64,
        imposed: Imposed<'_>,
        most: f64,
        points: i64,
    ) -> PyResult<CurveNumbers<'py>> {
        let control = control(imposed)?;
        let computed = py.detach(|| {
            let points = usize::try_from(points).map_err(|_| interp::Error::InvalidArgument {
                name: "number of points",
                value: points as f64,
                allowed: "from 2 to 1000000".into(),
            })?;
            self.contact
                .equilibria(w, control)?
                .force_displacement(most, points)
        });
        let ForceDisplacement {
            loading,
            unloading,
            jumps,
        } = computed.or_raise(py)?;
        let [loading, unloading] = [loading, unloading]
            .map(|branches| branches.iter().map(|branch| arrays(py, branch)).collect());
        let jumps = jumps
            .into_iter()
            .map(|jump| (numbers(jump.from), jump.to.map(numbers)));
        Ok((loading, unloading, jumps.collect()))
    }
}
