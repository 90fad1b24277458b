//! The tiles of a table as a file holds them: in code, and decoded when they are needed.

use std::borrow::Cow;
use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use crate::table::entropy;
use crate::table::low_rank::shapes;
use crate::table::tiles::{Place, Tile};
use crate::{Error, LowRank, Quantity};

/// A tile whose integers are in code.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct CodedTile {
    /// The first and the last node of the film's modulus, and of the substrate's.
    film: [usize; 2],
    substrate: [usize; 2],
    order: [usize; 3],
    terms: [usize; 4],
    weights: [Vec<i8>; 3],
    step: f64,
    /// The code of the integers of the cores.
    integers: Vec<u8>,
}

/// The tiles of a table.
#[derive(Clone, Debug)]
pub(crate) struct StoredTiles {
    quantities: Vec<Quantity>,
    /// The code of the tiles, which is sound; none if the table was made from tiles.
    coded: Vec<CodedTile>,
    decoded: OnceLock<Vec<Tile>>,
}

impl CodedTile {
    /// Codes a tile.
    pub(crate) fn new(tile: &Tile) -> Self {
        let form = &tile.form;
        Self {
            film: tile.film,
            substrate: tile.substrate,
            order: form.order(),
            terms: form.terms(),
            weights: form.exponents().clone(),
            step: form.step(),
            integers: entropy::encode(form.shapes(), form.integers()),
        }
    }

    /// Decodes the tile of a table of these quantities.
    ///
    /// # Errors
    /// [`Error::Malformed`]: those of the code, and of [`LowRank::new`].
    pub(crate) fn decode(&self, quantities: &[Quantity]) -> Result<Tile, Error> {
        let ranks = self.weights.each_ref().map(Vec::len);
        let cores = entropy::decode(shapes(ranks, self.terms, quantities.len()), &self.integers)?;
        let (order, terms, weights) = (self.order, self.terms, self.weights.clone());
        Ok(Tile {
            film: self.film,
            substrate: self.substrate,
            form: LowRank::new(quantities.to_vec(), order, terms, weights, self.step, cores)?,
        })
    }

    fn place(&self) -> Place {
        Place {
            film: self.film,
            substrate: self.substrate,
        }
    }

    fn decode_sound(&self, quantities: &[Quantity]) -> Tile {
        let tile = self.decode(quantities);
        tile.expect("only code that is known to be sound is kept")
    }
}

impl StoredTiles {
    /// Keeps tiles that are decoded, of which there is one at least.
    pub(crate) fn new(tiles: Vec<Tile>) -> Self {
        Self {
            quantities: tiles[0].form.quantities().to_vec(),
            coded: Vec::new(),
            decoded: OnceLock::from(tiles),
        }
    }

    /// Keeps the code of tiles, which must be sound.
    #[cfg(feature = "embedded")]
    pub(crate) fn of_code(quantities: Vec<Quantity>, coded: Vec<CodedTile>) -> Self {
        Self {
            quantities,
            coded,
            decoded: OnceLock::new(),
        }
    }

    /// Returns the quantities of all tiles.
    pub(crate) fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// Returns all tiles, decoded.
    pub(crate) fn all(&self) -> &[Tile] {
        self.decoded.get_or_init(|| {
            let decode = |tile: &CodedTile| tile.decode_sound(&self.quantities);
            self.coded.iter().map(decode).collect()
        })
    }

    /// Returns the tile number `i`. Unless all tiles are decoded, it alone is, and is not kept.
    pub(crate) fn tile(&self, i: usize) -> Cow<'_, Tile> {
        match self.decoded.get() {
            Some(tiles) => Cow::Borrowed(&tiles[i]),
            None => Cow::Owned(self.coded[i].decode_sound(&self.quantities)),
        }
    }

    /// Returns the nodes between which each tile lies.
    pub(crate) fn places(&self) -> Vec<Place> {
        match self.decoded.get() {
            Some(tiles) => tiles.iter().map(Tile::place).collect(),
            None => self.coded.iter().map(CodedTile::place).collect(),
        }
    }
}
