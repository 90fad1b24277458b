//! The low-rank form of a table in tiles: a tensor train for each stretch of the film's modulus.
//!
//! A film softer than sphere and substrate makes other contacts than a stiff one. The bonds of a
//! train for both would be as long as those of two trains together, and a lookup would multiply by
//! all of them.

use std::ops::Range;

use crate::table::demand::Demand;
use crate::{Error, LowRank, Quantity};

/// The number of nodes by which a tile reaches beyond the nodes where it meets its neighbours. The
/// error of splines is larger next to their ends, and falls by 0.6 from node to node: with 6 nodes
/// the packed table of `tables/universal.toml` had an error of 4e-7 beside the cut.
const OVERLAP: usize = 16;
/// The largest number of tiles, which limits what the first lookup of a forged table needs.
const MOST_TILES: usize = 8;

/// The low-rank forms of a table, one for each tile of the axis of the film's modulus.
#[derive(Clone, Debug)]
pub struct Tiles {
    /// The nodes of that axis where tiles meet, ascending.
    cuts: Vec<usize>,
    forms: Vec<LowRank>,
}

impl From<LowRank> for Tiles {
    fn from(form: LowRank) -> Self {
        Self {
            cuts: Vec::new(),
            forms: vec![form],
        }
    }
}

impl Tiles {
    /// Joins the forms of the tiles that meet at the nodes `cuts`; each holds the
    /// [nodes](Self::nodes) of its tile.
    ///
    /// # Errors
    /// [`Error::Malformed`] unless `cuts` ascend and there is one form more than cuts, at most 8;
    /// or if the forms differ in their quantities, or in the number of nodes on another axis.
    /// [`Error::LowRankTooLarge`] if all forms together need more than one may, see
    /// [`LowRank::new`].
    pub fn new(cuts: Vec<usize>, forms: Vec<LowRank>) -> Result<Self, Error> {
        let malformed = |what: String| Err(Error::Malformed(what));
        if forms.len() != cuts.len() + 1 || forms.len() > MOST_TILES {
            return malformed(format!(
                "it has {} low-rank forms and {} cuts between them: there must be one form more than \
                 cuts, and {MOST_TILES} at most",
                forms.len(),
                cuts.len()
            ));
        }
        if !cuts.is_sorted_by(|a, b| a < b) {
            return malformed(format!(
                "its tiles meet at the nodes {cuts:?}, not ascending"
            ));
        }
        let others = |form: &LowRank| {
            let [a, _, nu, e0] = form.shape();
            ([a, nu, e0], form.quantities().to_vec())
        };
        if forms[1..]
            .iter()
            .any(|form| others(form) != others(&forms[0]))
        {
            return malformed("its tiles differ in their quantities or in their nodes".into());
        }
        let all = forms
            .iter()
            .map(LowRank::demand)
            .fold(Demand::default(), Demand::plus);
        let [a, film, nu, e0] = forms[0].shape();
        all.check(forms[0].ranks(), [e0, film, nu, a])?;
        Ok(Self { cuts, forms })
    }

    /// Returns the nodes of each tile of an axis of `count` nodes, which is cut at the nodes
    /// `cuts`: those between the cuts, and sixteen more beyond each cut.
    pub fn nodes(cuts: &[usize], count: usize) -> Vec<Range<usize>> {
        let first = |cut: &usize| cut.saturating_sub(OVERLAP);
        let end = |cut: &usize| cut.saturating_add(OVERLAP + 1).min(count);
        (0..=cuts.len())
            .map(|i| {
                let before = i.checked_sub(1).map_or(0, |i| first(&cuts[i]));
                before..cuts.get(i).map_or(count, end)
            })
            .collect()
    }

    /// Returns the nodes of the film's modulus where tiles meet.
    pub fn cuts(&self) -> &[usize] {
        &self.cuts
    }

    /// Returns the forms, in the order of their tiles.
    pub fn forms(&self) -> &[LowRank] {
        &self.forms
    }

    /// Returns the ranks of each form.
    pub fn ranks(&self) -> Vec<[usize; 3]> {
        self.forms.iter().map(LowRank::ranks).collect()
    }

    /// Returns the quantities held, in the order of [`Quantity::ALL`].
    pub fn quantities(&self) -> &[Quantity] {
        self.forms[0].quantities()
    }

    /// Returns whether these are the tiles of axes with `shape` nodes.
    pub(crate) fn fit(&self, shape: [usize; 4]) -> bool {
        let [a, film, nu, e0] = shape;
        let nodes = Self::nodes(&self.cuts, film);
        let fits =
            |(form, nodes): (&LowRank, &Range<usize>)| form.shape() == [a, nodes.len(), nu, e0];
        self.cuts.last().is_none_or(|&last| last < film) && self.forms.iter().zip(&nodes).all(fits)
    }

    /// Returns the logarithms at all nodes with node `e1` of `count` nodes of the film's modulus,
    /// as [`Table::logarithms`](crate::Table::logarithms).
    pub(crate) fn logarithms(&self, e1: usize, count: usize) -> Vec<f64> {
        let tile = self.cuts.partition_point(|&cut| cut <= e1);
        let first = Self::nodes(&self.cuts, count)[tile].start;
        self.forms[tile].logarithms(e1 - first)
    }
}
