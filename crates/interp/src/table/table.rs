//! The table: its axes, its values, their description, and their interpolation for one material.

use std::borrow::Cow;
use std::sync::Arc;

use low_rank::once::Once;
use piecewise::Fitting;

use crate::curve::derived::Derivation;
use crate::curve::nodes::REASONABLE;
use crate::table::axes::Axes;
use crate::table::lookup::Lookup;
use crate::table::stored_tiles::StoredTiles;
use crate::table::tensor_spline::TensorSpline;
use crate::table::tiles;
use crate::{
    Certificate, Curve, Description, Error, Material, MaterialParameter, Parameter, Quantity,
    StackShape, Tile,
};

/// Values of the quantities on a grid of (`a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`).
///
/// The moduli may also be those of [`Parameter::REDUCED`]. A table with [`Parameter::STACK`] is of
/// one stack of layers under spheres of any modulus: [`Table::stack_curve`] looks it up, and every
/// lookup of a film is an error.
#[derive(Clone, Debug)]
pub struct Table {
    description: Description,
    axes: Axes,
    content: Content,
    /// The binary logarithm of the number of pieces of a curve in each octave of `a/t`, if it is
    /// known before the first lookup.
    pieces: Option<Vec<u32>>,
    /// Made at the first interpolation, because some tables are read only to be written elsewhere.
    lookup: Once<Lookup>,
}

/// The values of a table in one of two forms.
#[derive(Clone, Debug)]
enum Content {
    /// Row-major over the four axes, `a_over_t` slowest.
    Dense([Option<Vec<f64>>; 4]),
    LowRank(Arc<StoredTiles>),
}

impl Table {
    /// The least `es/E2* = 1/(1 + E2*/E1*)`, to which the quantities are proportional, so that they stay above 1e-30.
    pub const SOFTEST: f64 = 1e-25;

    /// Makes a table from its parts.
    ///
    /// `axes` holds the nodes of each of [`Parameter::ALL`], [`Parameter::REDUCED`] or
    /// [`Parameter::STACK`], in their order. `values[quantity]`, in the order of
    /// [`Quantity::ALL`], is row-major over the four axes, `a_over_t` slowest, or `None` if
    /// the scene does not ask for the quantity.
    ///
    /// # Errors
    /// [`Error::Malformed`]
    ///
    /// * if an axis is empty or not strictly ascending, or has two nodes too close for a spline;
    /// * if a modulus, an `a_over_t` or a quantity is not in `[1e-30, 1e30]`, or `nu1` or `nu0` not
    ///   in `(-1, 0.5]`. A rigid sphere, `e1_over_e2 = 0`, or a rigid substrate,
    ///   `e0_over_e2 = inf`, must be the only node of its axis; the ratios of reduced moduli may
    ///   end at 0 and infinity; `nu1` and `e0_over_e1`, which may be infinite, have one node in a
    ///   table of one stack;
    /// * if the number of values is not the product of the numbers of nodes, or if all of
    ///   [`Quantity::ALL`] are `None`;
    /// * if the tolerance is not in `(0, 1]`, or the certificate has errors that are negative,
    ///   infinite, not in order, or NaN in other than [`Certificate::UNMEASURED`].
    pub fn new(
        description: Description,
        axes: [(Parameter, Vec<f64>); 4],
        values: [Option<Vec<f64>>; 4],
    ) -> Result<Self, Error> {
        let axes = Axes::new(axes)?;
        description.check()?;
        let malformed = |what: String| Err(Error::Malformed(what));
        let count = axes
            .shape()
            .into_iter()
            .try_fold(1_usize, usize::checked_mul);
        for (quantity, values) in Quantity::ALL.into_iter().zip(&values) {
            let Some(values) = values else { continue };
            if Some(values.len()) != count {
                return malformed(format!(
                    "{} has {} values, its axes have {:?} nodes",
                    quantity.name(),
                    values.len(),
                    axes.shape()
                ));
            }
            if let Some(value) = values.iter().find(|&value| !REASONABLE.contains(value)) {
                return malformed(format!(
                    "{} holds {value:?}, its values must be in [1e-30, 1e30]",
                    quantity.name()
                ));
            }
        }
        if Quantity::ALL.iter().all(|&q| values[q as usize].is_none()) {
            return malformed(
                "it holds no quantity, it must hold one at least: pi0, eeq, gamma or delta0".into(),
            );
        }
        Ok(Self {
            description,
            axes,
            content: Content::Dense(values),
            pieces: None,
            lookup: Once::new(),
        })
    }

    /// Makes a table of `quantities` in low-rank form from its parts. The tiles meet at nodes, and
    /// cover the moduli of film and substrate.
    ///
    /// # Errors
    /// Those of [`Table::new`] about description and axes; [`Error::Malformed`] if there are no
    /// tiles or more than 16, if they overlap or leave a gap, if the quantities are not in order or
    /// hold none of a sphere, if a train has another number of functions, if a core
    /// has several terms along an axis of one node, or for more than 2e8 values at the nodes.
    ///
    /// [`Error::LowRankTooLarge`] if the first lookup would need more than 1e8 numbers, or more
    /// numbers or products than 16 and 4000 for each integer of the cores, of which a byte of a
    /// file holds up to six. These limits do not hold below 1e6 numbers and 1e8 products. What does
    /// not depend on the size of the form, the choice of the pieces of a curve, has a limit of its
    /// own: 500,000 comparisons of a piece with a curve, about a second.
    pub fn from_low_rank(
        description: Description,
        axes: [(Parameter, Vec<f64>); 4],
        quantities: Vec<Quantity>,
        tiles: Vec<Tile>,
    ) -> Result<Self, Error> {
        tiles::check(&Axes::new(axes.clone())?, &quantities, &tiles)?;
        Self::of_tiles(description, axes, StoredTiles::new(quantities, tiles))
    }

    /// Makes a table in low-rank form of tiles that are known to be sound.
    pub(crate) fn of_tiles(
        description: Description,
        axes: [(Parameter, Vec<f64>); 4],
        tiles: StoredTiles,
    ) -> Result<Self, Error> {
        let axes = Axes::new(axes)?;
        description.check()?;
        Ok(Self {
            description,
            axes,
            content: Content::LowRank(Arc::new(tiles)),
            pieces: None,
            lookup: Once::new(),
        })
    }

    /// Gives a table the lengths of the pieces of its curves, as [`Table::pieces`] returns them.
    ///
    /// # Errors
    /// [`Error::Malformed`] for lengths that no choice of pieces has.
    pub(crate) fn with_pieces(mut self, pieces: Vec<u32>) -> Result<Self, Error> {
        let range = self.axes.ends(Parameter::AOverT);
        if !Fitting::may_choose(range, &pieces) {
            return Err(Error::Malformed(format!(
                "its curves have {pieces:?} as the binary logarithms of the numbers of pieces in the \
                 octaves of a_over_t from {:?} to {:?}, which no table has",
                range[0], range[1]
            )));
        }
        self.pieces = Some(pieces);
        Ok(self)
    }

    /// Returns the binary logarithm of the number of pieces of a curve in each octave of `a/t`.
    pub(crate) fn pieces(&self) -> &[u32] {
        self.pieces
            .as_deref()
            .unwrap_or_else(|| self.lookup().pieces_of_octaves())
    }

    /// Returns the description: origin, units and accuracy.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Replaces the certificate, which can be measured only after the table is made. One that
    /// [`Table::new`] would refuse is refused when the table is read again.
    pub fn set_certificate(&mut self, certificate: Certificate) {
        self.description.certificate = certificate;
    }

    /// Returns the parameters of the axes: [`Parameter::ALL`], [`Parameter::REDUCED`] or, of one
    /// stack of layers, [`Parameter::STACK`].
    pub fn parameters(&self) -> [Parameter; 4] {
        self.axes.parameters()
    }

    /// Returns whether this is a table of one stack of layers.
    pub fn is_of_stack(&self) -> bool {
        self.axes.are_of_stack()
    }

    /// Returns the parameters with their nodes, as [`Table::new`] takes them.
    pub fn axes(&self) -> [(Parameter, Vec<f64>); 4] {
        self.axes.all()
    }

    /// Returns the symbol of the modulus in whose units the quantities at the nodes are: `E2*`;
    /// `E1*` with `e1_over_e2 = 0`, a rigid sphere; `Es*` on axes of reduced moduli.
    pub fn unit(&self) -> &'static str {
        self.axes.unit()
    }

    /// Returns the nodes of `parameter`, ascending; a single node if the scene fixes it, and none
    /// if it is not one of [`Table::parameters`].
    pub fn axis(&self, parameter: Parameter) -> &[f64] {
        self.axes.nodes(parameter)
    }

    /// Returns the first and the last node of one of [`Table::parameters`].
    pub fn range(&self, parameter: Parameter) -> [f64; 2] {
        self.axes.ends(parameter)
    }

    /// Returns the coordinates between which one of the tiles lies, for each axis.
    pub fn ends(&self, tile: &Tile) -> [[f64; 2]; 4] {
        tile.place().ends(&self.axes)
    }

    /// Returns the number of nodes on each axis, in the order of [`Table::parameters`].
    pub fn shape(&self) -> [usize; 4] {
        self.axes.shape()
    }

    /// Returns whether the table holds `quantity`, which depends on its scene.
    ///
    /// A table that holds [`Quantity::Gamma`] alone answers all four quantities, because the others
    /// are integrals of it, see [`Curve`].
    pub fn holds(&self, quantity: Quantity) -> bool {
        match &self.content {
            Content::Dense(values) => values[quantity as usize].is_some(),
            Content::LowRank(tiles) => tiles.quantities().contains(&quantity),
        }
    }

    /// Returns the quantities held, in the order of [`Quantity::ALL`].
    pub fn quantities(&self) -> Vec<Quantity> {
        Quantity::ALL
            .into_iter()
            .filter(|&quantity| self.holds(quantity))
            .collect()
    }

    /// Returns the quantities that the curves of this table [answer](Curve::answers), in the order of
    /// [`Quantity::ALL`].
    ///
    /// They are the quantities held and, in a table of films that holds [`Quantity::Gamma`] alone and
    /// begins at an `a/t` of 0.4 at most, all four. A curve whose material makes the others begin less
    /// accurately than the tolerance answers `Gamma` alone.
    pub fn answers(&self) -> Vec<Quantity> {
        let held = self.quantities();
        let derives = held == [Quantity::Gamma]
            && !self.is_of_stack()
            && Derivation::begins(self.axes.ends(Parameter::AOverT));
        if derives {
            Quantity::ALL.to_vec()
        } else {
            held
        }
    }

    /// Returns the values of `quantity` at the nodes, row-major with `a_over_t` slowest.
    ///
    /// It is `None` if the table does not hold the quantity or is in low-rank form;
    /// [`Table::expand`] computes the values of that form.
    pub fn values(&self, quantity: Quantity) -> Option<&[f64]> {
        match &self.content {
            Content::Dense(values) => values[quantity as usize].as_deref(),
            Content::LowRank(_) => None,
        }
    }

    /// Returns the tiles of the low-rank form, or `None` if the table is dense.
    pub fn low_rank(&self) -> Option<&[Tile]> {
        match &self.content {
            Content::LowRank(tiles) => Some(tiles.all()),
            Content::Dense(_) => None,
        }
    }

    /// Returns the ranks of each tile of the low-rank form, or `None` if the table is dense.
    pub fn ranks(&self) -> Option<Vec<[usize; 3]>> {
        let tiles = self.low_rank()?;
        Some(tiles.iter().map(|tile| tile.form.ranks()).collect())
    }

    /// Returns the logarithms that the splines interpolate, `ln(Q/es)` (`ln Delta0`),
    /// at all nodes with node `e1` of the film's modulus.
    ///
    /// They are row-major over `nu1`, `e0_over_e2`, `a_over_t` and the quantities held.
    ///
    /// # Panics
    /// If `e1` is not below the number of nodes of the film's modulus.
    pub fn logarithms(&self, e1: usize) -> Vec<f64> {
        let values = match &self.content {
            Content::LowRank(tiles) => return tiles::logarithms(&self.axes, tiles.all(), e1),
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

    /// Returns the dense table: this table, or the values of its low-rank form at the nodes.
    ///
    /// The description and its certificate are kept. Between the nodes, the splines through these
    /// values differ from the polynomials of the low-rank form by a part of its tolerance.
    ///
    /// Each value takes 8 bytes. A low-rank file of a few kilobytes may expand to 2e8 values: check
    /// [`Table::shape`] first if the origin of the file is doubtful.
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
        Self::new(self.description.clone(), self.axes.all(), values).map(Cow::Owned)
    }

    /// Makes the curve of `material`, the quantities as functions of `a/t`, by tensor splines of
    /// degree 9 along the material axes.
    ///
    /// A material on a substrate with another Poisson ratio than the table's `nu0` is replaced by
    /// its exact equivalent. Among [paired](crate::SubstratePoissonRatio::Paired) Poisson ratios one
    /// exists for all ratios from 0 to 0.5; with one `nu0` for the table, an incompressible film has none for a `nu0`
    /// below the table's. A parameter may miss the box, or a fixed value, by `1e-12` relative,
    /// which allows for rounding.
    ///
    /// # Errors
    /// [`Error::OfStack`] in a table of one stack of layers; [`Error::Normalisation`] for a rigid
    /// sphere in a table for compliant spheres, or the reverse; [`Error::OutsideTable`] for a
    /// material outside the box; [`Error::Equivalent`] if the equivalent does not exist or is
    /// outside the box; [`Error::Unphysical`] if the film is softer than [`Table::SOFTEST`] `E2*`;
    /// [`Error::Malformed`] if a quantity leaves `[1e-30, 1e30]`, which happens only in forged tables.
    pub fn curve(&self, material: &Material) -> Result<Curve, Error> {
        self.accept_films()?;
        self.lookup().curve(&self.axes, &self.description, material)
    }

    /// Makes the curve of `material` with its derivatives with respect to the material, which
    /// [`Curve::gradient`] returns.
    ///
    /// Making this curve takes some three times as long as [`Table::curve`].
    ///
    /// # Errors
    /// As [`Table::curve`].
    pub fn curve_with_gradient(&self, material: &Material) -> Result<Curve, Error> {
        self.curve_with_derivatives(material, &MaterialParameter::ALL)
    }

    /// Makes the curve of `material` with those of its derivatives with respect to `ln e1_over_e2`,
    /// `nu1`, `ln e0_over_e2` and `nu0` that are `wanted`. The others are unknown.
    ///
    /// Each derivative takes some time. That with respect to `nu1` of a nearly incompressible film takes
    /// the most.
    ///
    /// # Errors
    /// As [`Table::curve`].
    pub fn curve_with_derivatives(
        &self,
        material: &Material,
        wanted: &[MaterialParameter],
    ) -> Result<Curve, Error> {
        self.accept_films()?;
        let wanted = MaterialParameter::ALL.map(|parameter| wanted.contains(&parameter));
        self.lookup()
            .curve_with_derivatives(&self.axes, &self.description, material, wanted)
    }

    /// Makes the curve of the stack of layers of this table under a sphere.
    ///
    /// `e1_over_e2` is Young's modulus of the top layer over the sphere's reduced modulus, and 0
    /// under a rigid sphere. `shape` is what [`Curve::of_stack`] takes;
    /// `Stack::shape` of the crate `solve` computes it from the layers in the scene of the table. The
    /// contact is `Contact::new` of the crate `contact` with this curve and a system whose film is
    /// the top layer with the thickness of all layers, and whose substrate is the base.
    ///
    /// The curve has no expansions beyond its nodes, and no derivatives with respect to the
    /// material. The lookup depends on the ratios of moduli and thicknesses alone: it serves every
    /// stack that has those of the table.
    ///
    /// # Errors
    /// [`Error::NotOfStack`] in a table of films; [`Error::Unphysical`] for an `e1_over_e2` that is
    /// negative or not finite; [`Error::Normalisation`], [`Error::OutsideTable`] and
    /// [`Error::Malformed`] as [`Table::curve`].
    pub fn stack_curve(&self, e1_over_e2: f64, shape: StackShape) -> Result<Curve, Error> {
        if !self.is_of_stack() {
            return Err(Error::NotOfStack);
        }
        self.lookup()
            .stack_curve(&self.axes, &self.description, e1_over_e2, shape)
    }

    /// Accepts a table of films, for a lookup of one.
    fn accept_films(&self) -> Result<(), Error> {
        if self.is_of_stack() {
            Err(Error::OfStack)
        } else {
            Ok(())
        }
    }

    /// Returns the prepared lookup, and makes it at the first call.
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
                Content::LowRank(tiles) => TensorSpline::of_low_rank(&self.axes, tiles, tolerance),
            };
            let pieces = self.pieces.as_deref();
            Lookup::new(&self.axes, quantities, tolerance, spline, pieces)
        })
    }
}
