//! Lookups in a table of one stack of layers.

use std::borrow::Cow;

use contact::Contact;
use interp::{Curve, Parameter, SubstratePoissonRatio, System, Table};

use crate::Error;
use crate::stack::NamedStack;
use crate::table::scene::{Scene, TOLERANCE};
use solve::stack::Stack;

/// A table of one stack of layers under spheres of any modulus, with the stack, which is in the
/// scene of the table.
///
/// ```no_run
/// # fn main() -> Result<(), tabulate::Error> {
/// let table = interp::Table::open("primer.h5")?;
/// let table = tabulate::table::StackTable::new(&table)?;
/// // A sphere with R = 1 mm and E2* = 2 MPa: 65 um, 0.04 J/m^2.
/// let contact = table.contact(1e-3, 2e6)?;
/// println!("{:.3e} N", contact.load(65e-6, 0.04)?);
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct StackTable<'a> {
    table: Cow<'a, Table>,
    named: NamedStack,
}

impl<'a> StackTable<'a> {
    /// Reads the stack of a table from its scene.
    ///
    /// # Errors
    /// [`Error::Table`] with [`interp::Error::NotOfStack`] for a table of films, and with
    /// [`interp::Error::Malformed`] for a scene that is not that of the axes.
    pub fn new(table: &'a Table) -> Result<Self, Error> {
        if !table.is_of_stack() {
            return Err(interp::Error::NotOfStack.into());
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
        Ok(Self {
            table: Cow::Borrowed(table),
            named,
        })
    }

    /// Takes the table into this value, so that both live as long as is needed.
    pub fn into_owned(self) -> StackTable<'static> {
        StackTable {
            table: Cow::Owned(self.table.into_owned()),
            named: self.named,
        }
    }

    /// Returns the table.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Returns the stack.
    pub const fn stack(&self) -> &Stack {
        &self.named.stack
    }

    /// Returns the stack with the names of its layers.
    pub const fn named_stack(&self) -> &NamedStack {
        &self.named
    }

    /// Looks up the curve of the stack under a sphere of reduced modulus `sphere_modulus` (Pa;
    /// infinity is rigid): what [`stack_curve`](solve::stack_curve) solves for.
    ///
    /// # Errors
    /// Those of [`Stack::curve_in`].
    pub fn curve(&self, sphere_modulus: f64) -> Result<Curve, Error> {
        Ok(self.stack().curve_in(&self.table, sphere_modulus)?)
    }

    /// Looks up the curve of the stack under a sphere of radius `sphere_radius` (m) and reduced
    /// modulus `sphere_modulus` (Pa; infinity is rigid), and returns the contact.
    ///
    /// # Errors
    /// Those of [`StackTable::curve`] and [`Contact::new`].
    pub fn contact(&self, sphere_radius: f64, sphere_modulus: f64) -> Result<Contact, Error> {
        let system: System = self.stack().system(sphere_radius, sphere_modulus);
        Ok(Contact::new(&system, self.curve(sphere_modulus)?)?)
    }
}
