//! The table: axes, values, where they come from, and how accurate they are between the nodes.

use std::borrow::Cow;
use std::sync::OnceLock;

use crate::curve::nodes::REASONABLE;
use crate::table::axes::Axes;
use crate::table::lookup::Lookup;
use crate::table::tensor_spline::TensorSpline;
use crate::{Certificate, Curve, Description, Error, LowRank, Material, Parameter, Quantity};

/// Values of the quantities on a grid of (`a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`).
#[derive(Clone, Debug)]
pub struct Table {
    description: Description,
    axes: Axes,
    content: Content,
    /// Made at the first interpolation: a table may also be read only to be written elsewhere.
    lookup: OnceLock<Lookup>,
}

/// The forms of a table.
#[derive(Clone, Debug)]
enum Content {
    /// Row-major over the four axes, `a_over_t` slowest.
    Dense([Option<Vec<f64>>; 4]),
    LowRank(Box<LowRank>),
}

impl Table {
    /// A table from its parts. `values[quantity]` is row-major over the four axes, `a_over_t`
    /// slowest; `None` where the scene did not ask for the quantity.
    ///
    /// # Errors
    /// [`Error::Malformed`] if an axis is empty or not strictly ascending, holds a value outside
    /// physics, has two nodes that a spline could not tell apart, or has another number of nodes
    /// than the values; or if no quantity is given. Moduli, `a_over_t` and the quantities must be
    /// in `[1e-30, 1e30]`, but for a rigid sphere or substrate, which is a fixed parameter; the
    /// tolerance in `(0, 1]`.
    pub fn new(
        description: Description,
        axes: [Vec<f64>; 4],
        values: [Option<Vec<f64>>; 4],
    ) -> Result<Self, Error> {
        let axes = Axes::new(axes)?;
        description.check(&axes)?;
        let malformed = |what: String| Err(Error::Malformed(what));
        let count = axes
            .shape()
            .into_iter()
            .try_fold(1_usize, usize::checked_mul);
        for (quantity, values) in Quantity::ALL.into_iter().zip(&values) {
            let Some(values) = values else { continue };
            if Some(values.len()) != count {
                return malformed(format!(
                    "{} has {} values on {count:?} nodes",
                    quantity.name(),
                    values.len()
                ));
            }
            if let Some(value) = values.iter().find(|&value| !REASONABLE.contains(value)) {
                return malformed(format!("{} holds {value:?}", quantity.name()));
            }
        }
        if values.iter().all(Option::is_none) {
            return malformed("it holds no quantity".into());
        }
        Ok(Self {
            description,
            axes,
            content: Content::Dense(values),
            lookup: OnceLock::new(),
        })
    }

    /// A low-rank table from its parts.
    ///
    /// # Errors
    /// Those of [`Table::new`] that concern description and axes; [`Error::Malformed`] if an axis
    /// has another number of nodes than its core.
    pub fn from_low_rank(
        description: Description,
        axes: [Vec<f64>; 4],
        form: LowRank,
    ) -> Result<Self, Error> {
        let axes = Axes::new(axes)?;
        description.check(&axes)?;
        let shape = axes.shape();
        if form.shape() != shape {
            return Err(Error::Malformed(format!(
                "cores for {:?} nodes on {shape:?}",
                form.shape()
            )));
        }
        Ok(Self {
            description,
            axes,
            content: Content::LowRank(Box::new(form)),
            lookup: OnceLock::new(),
        })
    }

    /// What the table says of itself.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Replaces the certificate, which is measured when the table is there.
    pub fn set_certificate(&mut self, certificate: Certificate) {
        self.description.certificate = certificate;
    }

    /// The nodes of a parameter, ascending; a single one where the scene fixes it.
    pub fn axis(&self, parameter: Parameter) -> &[f64] {
        self.axes.nodes(parameter)
    }

    /// The number of nodes on each axis, in the order of [`Parameter::ALL`].
    pub fn shape(&self) -> [usize; 4] {
        self.axes.shape()
    }

    /// True if the table holds the quantity, false if its scene did not ask for it.
    pub fn holds(&self, quantity: Quantity) -> bool {
        match &self.content {
            Content::Dense(values) => values[quantity as usize].is_some(),
            Content::LowRank(form) => form.quantities().contains(&quantity),
        }
    }

    /// The quantities held, in the order of [`Quantity::ALL`].
    pub fn quantities(&self) -> Vec<Quantity> {
        Quantity::ALL
            .into_iter()
            .filter(|&quantity| self.holds(quantity))
            .collect()
    }

    /// The values of a quantity at the nodes, row-major with `a_over_t` slowest, if the table holds
    /// them: one in low-rank form does after [`Table::expand`].
    pub fn values(&self, quantity: Quantity) -> Option<&[f64]> {
        match &self.content {
            Content::Dense(values) => values[quantity as usize].as_deref(),
            Content::LowRank(_) => None,
        }
    }

    /// The low-rank form, if the table has it.
    pub fn low_rank(&self) -> Option<&LowRank> {
        match &self.content {
            Content::LowRank(form) => Some(form),
            Content::Dense(_) => None,
        }
    }

    /// What is splined, `ln(Q/es)` (`ln Delta0`), at all nodes with one `e1_over_e2`: row-major
    /// over `nu1`, `e0_over_e2`, `a_over_t` and the quantities held.
    ///
    /// # Panics
    /// If the axis `e1_over_e2` has no node of this number.
    pub fn logarithms(&self, e1: usize) -> Vec<f64> {
        let values = match &self.content {
            Content::LowRank(form) => return form.logarithms(e1),
            Content::Dense(values) => values,
        };
        let [n_a, n_e1, n_nu, n_e0] = self.shape();
        let held = self.quantities();
        let mut logarithms = vec![0.0; n_a * n_nu * n_e0 * held.len()];
        for (i, &quantity) in held.iter().enumerate() {
            let Some(values) = &values[quantity as usize] else {
                continue;
            };
            for nu in 0..n_nu {
                let es = self.axes.sphere_film_modulus(e1, nu);
                for a in 0..n_a {
                    let values = &values[((a * n_e1 + e1) * n_nu + nu) * n_e0..][..n_e0];
                    for (e0, value) in values.iter().enumerate() {
                        logarithms[((nu * n_e0 + e0) * n_a + a) * held.len() + i] =
                            quantity.logarithm(*value, es);
                    }
                }
            }
        }
        logarithms
    }

    /// The dense table on the nodes: itself, or the values of one in low-rank form. The description
    /// stays, and with it the certificate, because the splines through these values are the table's
    /// but for rounding.
    ///
    /// The values take 8 bytes each. A low-rank file of a few kilobytes may stand for 2e8 of them:
    /// see [`Table::shape`] first if its origin is doubtful.
    ///
    /// # Errors
    /// [`Error::Malformed`] if a value is not in `[1e-30, 1e30]`.
    pub fn expand(&self) -> Result<Cow<'_, Self>, Error> {
        if matches!(self.content, Content::Dense(_)) {
            return Ok(Cow::Borrowed(self));
        }
        let [n_a, n_e1, n_nu, n_e0] = self.shape();
        let held = self.quantities();
        let mut values = [const { None }; 4];
        for &quantity in &held {
            values[quantity as usize] = Some(vec![0.0; n_a * n_e1 * n_nu * n_e0]);
        }
        for e1 in 0..n_e1 {
            let logarithms = self.logarithms(e1);
            for (i, group) in logarithms.chunks_exact(held.len()).enumerate() {
                let (nu, e0, a) = (i / (n_e0 * n_a), i / n_a % n_e0, i % n_a);
                let es = self.axes.sphere_film_modulus(e1, nu);
                let at = ((a * n_e1 + e1) * n_nu + nu) * n_e0 + e0;
                for (&quantity, logarithm) in held.iter().zip(group) {
                    if let Some(values) = &mut values[quantity as usize] {
                        values[at] = quantity.scale(es) * logarithm.exp();
                    }
                }
            }
        }
        Self::new(self.description.clone(), self.axes.all().clone(), values).map(Cow::Owned)
    }

    /// The quantities as functions of `a/t` for one material, from tensor splines of degree 9 along
    /// the material axes.
    ///
    /// A material on a substrate with another Poisson ratio than the table's `nu0` is replaced by
    /// its exact [equivalent](Material::with_substrate_poisson_ratio), where there is one: for
    /// `nu0` below the table's, an incompressible film has none. A parameter may miss the box, or a
    /// fixed value, by `1e-12` relative, which is rounding.
    ///
    /// # Errors
    /// [`Error::Normalisation`] for a rigid sphere in a table for compliant ones or the reverse;
    /// [`Error::OutsideTable`] for a material outside the box; [`Error::Equivalent`] where the
    /// equivalent does not exist or is outside the box; [`Error::Malformed`] if a quantity leaves
    /// `[1e-30, 1e30]`, which only forged tables have.
    pub fn curve(&self, material: &Material) -> Result<Curve, Error> {
        self.lookup().curve(&self.axes, &self.description, material)
    }

    /// The same with its derivatives with respect to the material, which [`Curve::gradient`] gives:
    /// those of the splines. Making it takes some three times as long.
    ///
    /// # Errors
    /// As [`Table::curve`].
    pub fn curve_with_gradient(&self, material: &Material) -> Result<Curve, Error> {
        self.lookup()
            .curve_with_gradient(&self.axes, &self.description, material)
    }

    fn lookup(&self) -> &Lookup {
        self.lookup.get_or_init(|| {
            let (quantities, tolerance) = (self.quantities(), self.description.tolerance);
            let spline = match &self.content {
                Content::Dense(_) => {
                    let [_, n_e1, ..] = self.shape();
                    let mut logarithms = Vec::with_capacity(
                        self.shape().iter().product::<usize>() * quantities.len(),
                    );
                    (0..n_e1).for_each(|e1| logarithms.extend(self.logarithms(e1)));
                    TensorSpline::through(&self.axes, logarithms)
                }
                Content::LowRank(form) => TensorSpline::of_low_rank(&self.axes, form, tolerance),
            };
            Lookup::new(&self.axes, quantities, tolerance, spline)
        })
    }
}
