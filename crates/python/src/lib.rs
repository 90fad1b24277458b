//! The native part of the Python package `coated_contact`: the module `coated_contact._core`.
//!
//! It is thin. The Python layer beside it checks types, broadcasts, documents and annotates; this
//! module takes flat arrays of f64 and evaluates them with the interpreter's lock released. Data
//! flows `contact → table → bodies`, all through `arrays`, and where it may take long through
//! `interruption`; `likelihood`, `line`, `history`, `cohesive_zone`, `read`, `fit`, `model`, `generate`, `solve` and
//! `cohesive` stand beside them. `experiment`, with its `indentation`, and `parameter`
//! hold what fits are given. `error` makes Python's exceptions
//! of all of them.

#![forbid(unsafe_code)]

mod arrays;
mod bodies;
mod cohesive;
mod cohesive_zone;
mod contact;
mod error;
mod experiment;
mod fit;
mod generate;
mod history;
mod indentation;
mod interruption;
mod likelihood;
mod line;
mod model;
mod parameter;
mod read;
mod solve;
mod table;

use pyo3::prelude::*;

/// The native part of `coated_contact`.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::bodies::{
        NativeCoated, NativeHalfSpace, NativeProbe, NativeStack, check_elastic, magnitudes_of_work,
        read_stack,
    };
    #[pymodule_export]
    use super::cohesive::Cohesive;
    #[pymodule_export]
    use super::cohesive_zone::{zone_equilibria, zone_length, zone_pull_off, zone_states};
    #[pymodule_export]
    use super::contact::{Contact, no_derivative};
    #[pymodule_export]
    use super::fit::{fit_map, fit_together};
    #[pymodule_export]
    use super::generate::{build, generate, solve_piece};
    #[pymodule_export]
    use super::history::{check_relaxation, history, relaxation_values};
    #[pymodule_export]
    use super::likelihood::NativeLikelihood;
    #[pymodule_export]
    use super::line::{check_law, energy_of_speed, impose, line, ramp};
    #[pymodule_export]
    use super::model::{branches, forecast, predict, simulate};
    #[pymodule_export]
    use super::parameter::unit_of;
    #[pymodule_export]
    use super::read::read_file;
    #[pymodule_export]
    use super::solve::{solve, solve_stack, solve_stick_punch, stick_stiffening};
    #[pymodule_export]
    use super::table::Table;

    use super::{Bound, PyModule, PyModuleMethods as _, PyResult};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        ::solve::parallel::prepare_for_forks();
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("LONGEST_ZONE", ::contact::CohesiveZone::LONGEST)?;
        let limits = (
            ::contact::ZoneSize::JKR,
            ::contact::ZoneSize::THIN,
            ::contact::ZoneSize::TENSE,
        );
        module.add("JKR_LIMITS", limits)?;
        let parameters = ::fit::Parameter::ALL.map(::fit::Parameter::identifier);
        module.add("PARAMETERS", parameters.to_vec())?;
        module.add("writes_hdf5", tabulate::table::WRITES_HDF5)
    }
}
