//! The inputs of a contact, and the derivatives of load and penetration with respect to them.

use interp::LoadAndPenetration;
use interp::check::finite_result;

use crate::Contact;
use crate::Error;
use crate::bodies::Bodies;

named! {
    /// An input on which the load and the penetration of a contact depend, in SI units.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum Input {
        /// Contact radius `a`, m.
        ContactRadius = "contact radius",
        /// Work of adhesion `w`, J/m^2.
        WorkOfAdhesion = "work of adhesion",
        /// Radius `R` of the probe, m: of the sphere or paraboloid, of the end of a cone, or of the
        /// punch.
        SphereRadius = "sphere radius",
        /// Reduced modulus `E2*` of the sphere, Pa.
        SphereModulus = "sphere modulus",
        /// Thickness `t` of the film, m.
        FilmThickness = "film thickness",
        /// Young's modulus `E1` of the film, Pa.
        FilmModulus = "film modulus",
        /// Poisson ratio `nu1` of the film.
        FilmPoisson = "film Poisson ratio",
        /// Young's modulus `E0` of the substrate, Pa.
        SubstrateModulus = "substrate modulus",
        /// Poisson ratio `nu0` of the substrate.
        SubstratePoisson = "substrate Poisson ratio",
    }
}

/// The derivatives of the load `F` and the penetration `delta` with respect to one [`Input`] at fixed
/// other inputs, in N and m per unit of the input.
pub type Derivatives = LoadAndPenetration;

/// Load and penetration at one contact radius and work of adhesion, with their derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactGradient {
    load: f64,
    penetration: f64,
    /// The derivatives in the order of [`Input::ALL`]; `None` where one is not known.
    derivatives: [Option<Derivatives>; 9],
}

impl ContactGradient {
    /// Returns the load `F`, N.
    pub const fn load(&self) -> f64 {
        self.load
    }

    /// Returns the penetration `delta`, m.
    pub const fn penetration(&self) -> f64 {
        self.penetration
    }

    /// Returns the derivatives with respect to one `input`.
    ///
    /// They are 0 with respect to the modulus and the Poisson ratio of a rigid body.
    ///
    /// # Errors
    /// [`interp::Error::FixedParameter`] for an input whose derivative needs a parameter of the material
    /// that the table fixes, or that the curve has no derivative with respect to; for an input of the
    /// film on a half-space; for the radius of a probe that has none, and the contact radius of a flat
    /// punch, which is that of the punch; and for the work of adhesion if it is below 2.3e-308 J/m^2,
    /// because the load falls like its square root.
    pub fn by(&self, input: Input) -> Result<Derivatives, Error> {
        self.derivatives[input as usize]
            .ok_or_else(|| interp::Error::FixedParameter(input.name()).into())
    }
}

impl Contact {
    /// Computes load and penetration at contact radius `a` (m) and work of adhesion `w` (J/m^2),
    /// and their derivatives with respect to every [`Input`].
    ///
    /// Load and penetration are those of [`Contact::load_and_penetration`]. The derivatives follow
    /// by the chain rule through eqs. 2 and 4 to 8 and from the derivatives of the table's splines.
    ///
    /// ```
    /// # fn main() -> Result<(), contact::Error> {
    /// # use interp::{Elastic, Probe, System, Table};
    /// # use contact::{Contact, Input};
    /// # let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?);
    /// # let system = System { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, film, film_thickness: 1e-6, substrate };
    /// let contact = Contact::in_table_with_gradient(Table::embedded(), &system)?;
    /// let gradient = contact.gradient(65e-6, 0.04)?;
    /// let [film, sphere] = [(Input::FilmModulus, 3.5e6), (Input::SphereModulus, 2e6)].map(|(input, modulus)| {
    ///     gradient.by(input).map(|derivatives| derivatives.load * modulus)
    /// });
    /// assert!(film?.abs() < 0.05 * sphere?.abs()); // a thin film is hardly seen
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`Contact::load_and_penetration`], but always [`interp::Error::OutsideTable`] above the nodes in
    /// `a/t`; [`interp::Error::NoGradient`] on a curve made without derivatives; [`interp::Error::Unphysical`] for
    /// a derivative that overflows an f64; [`Error::OtherMaterial`] on a curve whose derivatives
    /// are those of an equivalent material on another substrate.
    pub fn gradient(&self, a: f64, w: f64) -> Result<ContactGradient, Error> {
        self.same_material()?;
        let mut gradient = None;
        let terms = self.terms(a, w, &mut gradient)?;
        let derivatives = Input::ALL.map(|input| terms.by(input));
        // Infinity or NaN if one of the numbers is.
        let mut zeros = Derivatives::ZERO;
        for by in derivatives.iter().flatten() {
            zeros.load += 0.0 * by.load;
            zeros.penetration += 0.0 * by.penetration;
        }
        let LoadAndPenetration { load, penetration } = terms.pair();
        Ok(ContactGradient {
            load: finite_result(a, load + zeros.load)?,
            penetration: finite_result(a, penetration + zeros.penetration)?,
            derivatives,
        })
    }

    /// Writes into `derivatives` those of load and penetration at contact radius `a` (m) and work of
    /// adhesion `w` (J/m^2) with respect to each of the `inputs`, and returns load (N) and penetration
    /// (m). It takes less time than [`Contact::gradient`], which differentiates by all inputs.
    ///
    /// # Errors
    /// As [`Contact::gradient`] and [`ContactGradient::by`]; [`interp::Error::InvalidArgument`] unless
    /// `derivatives` is as long as `inputs`.
    pub fn derivatives(
        &self,
        a: f64,
        w: f64,
        inputs: &[Input],
        derivatives: &mut [Derivatives],
    ) -> Result<(f64, f64), Error> {
        interp::Error::same_length(inputs, derivatives)?;
        self.same_material()?;
        let mut gradient = None;
        let terms = self.terms(a, w, &mut gradient)?;
        for (derivatives, &input) in derivatives.iter_mut().zip(inputs) {
            let by = terms.by_one(input);
            let by = by.ok_or_else(|| interp::Error::FixedParameter(input.name()))?;
            finite_result(a, by.load)?;
            finite_result(a, by.penetration)?;
            *derivatives = by;
        }
        let LoadAndPenetration { load, penetration } = terms.pair();
        Ok((finite_result(a, load)?, finite_result(a, penetration)?))
    }

    /// Accepts a curve whose derivatives are those of the material of the system itself.
    pub(crate) fn same_material(&self) -> Result<(), Error> {
        let Bodies::Coated {
            system,
            differentiated: false,
            curve,
        } = &self.bodies
        else {
            return Ok(());
        };
        Err(Error::OtherMaterial {
            curve: curve.differentiated_for()?.to_array(),
            system: system.material()?.to_array(),
        })
    }
}
