//! The stack of layers that a table is of.

use interp::{Parameter, SubstratePoissonRatio, Table};

use crate::Error;
use crate::stack::NamedStack;
use crate::table::scene::{Scene, TOLERANCE};

/// Reads the stack of a table from its scene; `None` for a table of films.
///
/// [`Stack::curve_in`](solve::stack::Stack::curve_in) looks up the curve under a sphere of any modulus: what
/// [`stack_curve`](solve::stack_curve) solves for.
///
/// ```no_run
/// # fn main() -> Result<(), tabulate::Error> {
/// let table = interp::Table::open("primer.h5")?;
/// let stack = tabulate::table::stack_of(&table)?.expect("a table of a stack").stack;
/// // A sphere with R = 1 mm and E2* = 2 MPa: 65 um, 0.04 J/m^2.
/// let system = stack.system(1e-3, 2e6);
/// let contact = contact::Contact::new(&system, stack.curve_in(&table, 2e6)?)?;
/// println!("{:.3e} N", contact.load(65e-6, 0.04)?);
/// # Ok(()) }
/// ```
///
/// # Errors
/// [`Error::Table`] with [`interp::Error::Malformed`] for a scene that is not that of the axes.
pub fn stack_of(table: &Table) -> Result<Option<NamedStack>, Error> {
    if !table.is_of_stack() {
        return Ok(None);
    }
    let description = table.description();
    let malformed = |what: String| interp::Error::Malformed(format!("its scene: {what}"));
    // The tolerance that was used may be another than that of the text.
    let scene = Scene::parse(&description.scene, Some(TOLERANCE[1])).map_err(malformed)?;
    let Some(named) = scene.stack else {
        return Err(malformed("it has no [stack]".into()).into());
    };
    let (top, base) = (named.stack.surface(), named.stack.base());
    let of_scene = [top.poisson(), base.young() / top.young(), base.poisson()];
    let of_axes = [
        table.axis(Parameter::Nu1)[0],
        table.axis(Parameter::E0OverE1)[0],
        match description.nu0 {
            SubstratePoissonRatio::Fixed(nu0) => nu0,
            SubstratePoissonRatio::Paired => f64::NAN,
        },
    ];
    if of_scene != of_axes {
        return Err(malformed(format!(
            "nu1, e0_over_e1 and nu0 are {of_scene:?} in its [stack], and {of_axes:?} in the table"
        ))
        .into());
    }
    Ok(Some(named))
}
