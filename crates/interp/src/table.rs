//! The table: axes, values, where they come from, and how accurate they are between the nodes.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::ops::RangeInclusive;
use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use crate::lookup::{Coefficients, Lookup, film_limit};
use crate::low_rank::LowRank;
use crate::material::{Normalisation, ROUNDING, poisson_ratio};
use crate::schema::Parameter;
use crate::{Certificate, Curve, Error, Material, Quantity};

/// What a table says of itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Description {
    /// The scene's title.
    pub title: String,
    /// The scene, as TOML.
    pub scene: String,
    /// The substrate's Poisson ratio, the same in the whole table.
    pub nu0: f64,
    /// The modulus in whose units the values are.
    pub normalisation: Normalisation,
    /// The relative tolerance that the table is to keep: what its scene asks for, or what it was truncated to.
    pub tolerance: f64,
    /// Program and version.
    pub created_by: String,
    /// The measured accuracy.
    pub certificate: Certificate,
}

/// What moduli, `a/t` and quantities may be: far more than is solved, and far from where arithmetic overflows.
pub(crate) const REASONABLE: RangeInclusive<f64> = 1e-30..=1e30;

/// The closest that nodes may be, relative to the length of their axis.
const CLOSEST: f64 = 1e-7;
/// And in the coordinate of the axis.
const SHORTEST: f64 = 1e-9;

/// Values of the quantities on a grid of (`a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`).
#[derive(Clone, Debug)]
pub struct Table {
    description: Description,
    axes: [Vec<f64>; 4],
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
    /// Splines through what was given as logarithms, of these quantities; all else is in the coefficients.
    Splined(Vec<Quantity>),
}

impl Table {
    /// A table from its parts. `values[quantity]` is row-major over the four axes, `a_over_t` slowest; `None` where the scene did
    /// not ask for the quantity.
    ///
    /// # Errors
    /// [`Error::Malformed`] if an axis is empty or not strictly ascending, holds a value outside physics, has two nodes that a
    /// spline could not tell apart, or has another number of nodes than the values; or if no quantity is given. Moduli, `a_over_t`
    /// and the quantities must be in `[1e-30, 1e30]`, but for a rigid sphere or substrate, which is a fixed parameter; the
    /// tolerance in `(0, 1]`.
    pub fn new(description: Description, axes: [Vec<f64>; 4], values: [Option<Vec<f64>>; 4]) -> Result<Self, Error> {
        check(&description, &axes)?;
        let malformed = |what: String| Err(Error::Malformed(what));
        let count = axes.iter().try_fold(1_usize, |product, nodes| product.checked_mul(nodes.len()));
        for (quantity, values) in Quantity::ALL.into_iter().zip(&values) {
            let Some(values) = values else { continue };
            if Some(values.len()) != count {
                return malformed(format!("{} has {} values on {count:?} nodes", quantity.name(), values.len()));
            }
            if let Some(value) = values.iter().find(|&value| !REASONABLE.contains(value)) {
                return malformed(format!("{} holds {value:?}", quantity.name()));
            }
        }
        if values.iter().all(Option::is_none) {
            return malformed("it holds no quantity".into());
        }
        Ok(Self { description, axes, content: Content::Dense(values), lookup: OnceLock::new() })
    }

    /// A low-rank table from its parts.
    ///
    /// # Errors
    /// Those of [`Table::new`] that concern description and axes; [`Error::Malformed`] if an axis has another number of nodes than
    /// its core.
    pub fn from_low_rank(description: Description, axes: [Vec<f64>; 4], form: LowRank) -> Result<Self, Error> {
        check(&description, &axes)?;
        let shape = axes.each_ref().map(Vec::len);
        if form.shape() != shape {
            return Err(Error::Malformed(format!("cores for {:?} nodes on {shape:?}", form.shape())));
        }
        Ok(Self { description, axes, content: Content::LowRank(Box::new(form)), lookup: OnceLock::new() })
    }

    /// A table for looking up only, which takes half the memory of [`Table::new`] and no copy: from the logarithms that are
    /// splined, in the layout of [`Table::logarithms`], one `e1_over_e2` after the other.
    ///
    /// # Errors
    /// Those of [`Table::new`] that concern description and axes; [`Error::Malformed`] if no quantity is given or they are not in
    /// order, if there are not as many logarithms as values at the nodes, or if one is not that of a value in `[1e-30, 1e30]`.
    pub fn from_logarithms(
        description: Description,
        axes: [Vec<f64>; 4],
        quantities: Vec<Quantity>,
        logarithms: Vec<f64>,
    ) -> Result<Self, Error> {
        check(&description, &axes)?;
        let malformed = |what: String| Err(Error::Malformed(what));
        if quantities.is_empty() || !quantities.is_sorted_by(|a, b| a < b) {
            return malformed(format!("logarithms of {quantities:?}"));
        }
        let count = axes.iter().try_fold(quantities.len(), |product, nodes| product.checked_mul(nodes.len()));
        if Some(logarithms.len()) != count {
            return malformed(format!("{} logarithms for {count:?} values", logarithms.len()));
        }
        let table = Self { description, axes, content: Content::Splined(quantities), lookup: OnceLock::new() };
        table.check_logarithms(&logarithms)?;
        let coefficients = Coefficients::splined(&table, logarithms);
        let lookup = Lookup::new(&table, coefficients);
        Ok(Self { lookup: OnceLock::from(lookup), ..table })
    }

    /// Accepts logarithms, in the layout of [`Table::logarithms`], of values in `[1e-30, 1e30]`.
    fn check_logarithms(&self, logarithms: &[f64]) -> Result<(), Error> {
        let [n_a, _, n_nu, n_e0] = self.shape();
        let held = self.quantities();
        for (film, block) in logarithms.chunks_exact(n_e0 * n_a * held.len()).enumerate() {
            let es = film_limit(self, film / n_nu, film % n_nu);
            for (i, quantity) in held.iter().enumerate() {
                let [least, largest] = [REASONABLE.start(), REASONABLE.end()].map(|&end| quantity.logarithm(end, es));
                if let Some(logarithm) = block.iter().skip(i).step_by(held.len()).find(|value| !(least..=largest).contains(value)) {
                    return Err(Error::Malformed(format!("{} has the logarithm {logarithm:?}", quantity.name())));
                }
            }
        }
        Ok(())
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
        &self.axes[parameter as usize]
    }

    /// The number of nodes on each axis, in the order of [`Parameter::ALL`].
    pub fn shape(&self) -> [usize; 4] {
        self.axes.each_ref().map(Vec::len)
    }

    /// True if the table holds the quantity, false if its scene did not ask for it.
    pub fn holds(&self, quantity: Quantity) -> bool {
        match &self.content {
            Content::Dense(values) => values[quantity as usize].is_some(),
            Content::LowRank(form) => form.quantities().contains(&quantity),
            Content::Splined(quantities) => quantities.contains(&quantity),
        }
    }

    /// The quantities held, in the order of [`Quantity::ALL`].
    pub fn quantities(&self) -> Vec<Quantity> {
        Quantity::ALL.into_iter().filter(|&quantity| self.holds(quantity)).collect()
    }

    /// The values of a quantity at the nodes, row-major with `a_over_t` slowest, if the table holds them: one in low-rank form, or
    /// of splines only, does after [`Table::expand`].
    pub fn values(&self, quantity: Quantity) -> Option<&[f64]> {
        match &self.content {
            Content::Dense(values) => values[quantity as usize].as_deref(),
            Content::LowRank(_) | Content::Splined(_) => None,
        }
    }

    /// The low-rank form, if the table has it.
    pub fn low_rank(&self) -> Option<&LowRank> {
        match &self.content {
            Content::LowRank(form) => Some(form),
            Content::Dense(_) | Content::Splined(_) => None,
        }
    }

    /// What is splined, `ln(Q/es)` (`ln Delta0`), at all nodes with one `e1_over_e2`: row-major over `nu1`, `e0_over_e2`,
    /// `a_over_t` and the quantities held.
    ///
    /// # Panics
    /// If the axis `e1_over_e2` has no node of this number.
    pub fn logarithms(&self, e1: usize) -> Vec<f64> {
        let values = match &self.content {
            Content::LowRank(form) => return form.logarithms(e1),
            Content::Splined(_) => return self.lookup().coefficients.at_nodes(self, e1),
            Content::Dense(values) => values,
        };
        let [n_a, n_e1, n_nu, n_e0] = self.shape();
        let held = self.quantities();
        let mut logarithms = vec![0.0; n_a * n_nu * n_e0 * held.len()];
        for (i, &quantity) in held.iter().enumerate() {
            let Some(values) = &values[quantity as usize] else { continue };
            for nu in 0..n_nu {
                let es = film_limit(self, e1, nu);
                for a in 0..n_a {
                    let values = &values[((a * n_e1 + e1) * n_nu + nu) * n_e0..][..n_e0];
                    for (e0, value) in values.iter().enumerate() {
                        logarithms[((nu * n_e0 + e0) * n_a + a) * held.len() + i] = quantity.logarithm(*value, es);
                    }
                }
            }
        }
        logarithms
    }

    /// The dense table on the nodes: itself, or the values of one in low-rank form or of splines only. The description stays, and
    /// with it the certificate, because the splines through these values are the table's but for rounding.
    ///
    /// The values take 8 bytes each. A low-rank file of a few kilobytes may stand for 2e8 of them: see [`Table::shape`] first if
    /// its origin is doubtful.
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
                let es = film_limit(self, e1, nu);
                let at = ((a * n_e1 + e1) * n_nu + nu) * n_e0 + e0;
                for (&quantity, logarithm) in held.iter().zip(group) {
                    if let Some(values) = &mut values[quantity as usize] {
                        values[at] = quantity.scale(es) * logarithm.exp();
                    }
                }
            }
        }
        Self::new(self.description.clone(), self.axes.clone(), values).map(Cow::Owned)
    }

    /// The quantities as functions of `a/t` for one material, from tensor splines of degree 9 along the material axes.
    ///
    /// A material on a substrate with another Poisson ratio than the table's `nu0` is replaced by its exact
    /// [equivalent](Material::with_substrate_poisson_ratio), where there is one: for `nu0` below the table's, an incompressible
    /// film has none. A parameter may miss the box, or a fixed value, by `1e-12` relative, which is rounding.
    ///
    /// # Errors
    /// [`Error::Normalisation`] for a rigid sphere in a table for compliant ones or the reverse; [`Error::OutsideTable`] for a
    /// material outside the box; [`Error::Equivalent`] where the equivalent does not exist or is outside the box;
    /// [`Error::Malformed`] if a quantity leaves `[1e-30, 1e30]`, which only forged tables have.
    pub fn curve(&self, material: &Material) -> Result<Curve, Error> {
        self.lookup().curve(self, material)
    }

    /// The same with its derivatives with respect to the material, which [`Curve::gradient`] gives: those of the splines. Making it
    /// takes some three times as long.
    ///
    /// # Errors
    /// As [`Table::curve`].
    pub fn curve_with_gradient(&self, material: &Material) -> Result<Curve, Error> {
        self.lookup().curve_with_gradient(self, material)
    }

    fn lookup(&self) -> &Lookup {
        self.lookup.get_or_init(|| Lookup::new(self, Coefficients::new(self)))
    }

    /// The coordinate at which an axis is to be interpolated for `value`.
    pub(crate) fn locate(&self, parameter: Parameter, value: f64) -> Result<f64, Error> {
        locate(parameter, self.axis(parameter), value)
    }
}

/// Accepts axes that can be splined, and what a description says of them.
fn check(description: &Description, axes: &[Vec<f64>; 4]) -> Result<(), Error> {
    let malformed = |what: String| Err(Error::Malformed(what));
    for (parameter, nodes) in Parameter::ALL.into_iter().zip(axes) {
        let name = parameter.name();
        if nodes.is_empty() {
            return malformed(format!("axis {name} is empty"));
        }
        if let Some(pair) = nodes.windows(2).find(|pair| pair[0].partial_cmp(&pair[1]) != Some(Ordering::Less)) {
            return malformed(format!("axis {name} is not ascending: {:?} is followed by {:?}", pair[0], pair[1]));
        }
        let physical = |&node: &f64| match parameter {
            Parameter::Nu1 => poisson_ratio(name, node).is_ok(),
            Parameter::AOverT => REASONABLE.contains(&node),
            // A rigid sphere or substrate is a fixed parameter, never a node among others.
            Parameter::E1OverE2 => REASONABLE.contains(&node) || (node == 0.0 && nodes.len() == 1),
            Parameter::E0OverE2 => REASONABLE.contains(&node) || (node == f64::INFINITY && nodes.len() == 1),
        };
        if let Some(node) = nodes.iter().find(|node| !physical(node)) {
            return malformed(format!("axis {name} holds {node:?}"));
        }
        if let Some([low, high]) = too_close(parameter, nodes) {
            return malformed(format!("axis {name} has nodes too close to each other: {low:?} and {high:?}"));
        }
    }
    let rigid_sphere = axes[1][0] == 0.0;
    if rigid_sphere != (description.normalisation == Normalisation::Film) {
        let symbol = description.normalisation.symbol();
        return malformed(format!("normalised by {symbol} with e1_over_e2 from {}", axes[1][0]));
    }
    if let Err(error) = poisson_ratio("nu0", description.nu0) {
        return malformed(error.to_string());
    }
    let tolerance = description.tolerance;
    if !(tolerance > 0.0 && tolerance <= 1.0) {
        return malformed(format!("its tolerance is {tolerance:?}, not above 0 and at most 1"));
    }
    Ok(())
}

/// The first neighbours on an axis that a spline could not tell apart, or that descend.
pub(crate) fn too_close(parameter: Parameter, nodes: &[f64]) -> Option<[f64; 2]> {
    let distance = |from: f64, to: f64| parameter.coordinate(to) - parameter.coordinate(from);
    let least = (CLOSEST * distance(nodes[0], nodes[nodes.len() - 1]).abs()).max(SHORTEST);
    nodes.windows(2).map(|pair| [pair[0], pair[1]]).find(|&[low, high]| high <= low || distance(low, high) < least)
}

/// The coordinate of `value` on an axis with the given nodes, or why it is not on it.
pub(crate) fn locate(parameter: Parameter, nodes: &[f64], value: f64) -> Result<f64, Error> {
    let (from, to) = (nodes[0], nodes[nodes.len() - 1]);
    let size = |end: f64| if parameter == Parameter::Nu1 { 1.0 } else { end.abs() };
    let near = |end: f64| end.is_finite() && (value - end).abs() <= ROUNDING * size(end);
    if value >= from && value <= to {
        Ok(parameter.coordinate(value))
    } else if near(from) {
        Ok(parameter.coordinate(from))
    } else if near(to) {
        Ok(parameter.coordinate(to))
    } else {
        Err(Error::OutsideTable { axis: parameter.name(), value, from, to })
    }
}
