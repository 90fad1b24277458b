//! The tiles of a table as a file holds them: in code, and decoded when they are needed.

use std::borrow::Cow;

use low_rank::once::Once;
use low_rank::{IntegerTrain, Malformed};
use serde::{Deserialize, Serialize};

use crate::table::tiles::{Place, Tile};
use crate::{Error, Quantity};

/// A tile whose integers are in code.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct CodedTile {
    place: Place,
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
    decoded: Once<Vec<Tile>>,
}

impl CodedTile {
    /// Codes a tile.
    pub(crate) fn new(tile: &Tile) -> Self {
        let form = &tile.form;
        Self {
            place: tile.place(),
            order: form.order(),
            terms: form.terms(),
            weights: form.exponents().clone(),
            step: form.step(),
            integers: form.coded_integers(),
        }
    }

    /// Decodes the tile of a table of these quantities.
    ///
    /// # Errors
    /// [`Error::Malformed`]: those of [`IntegerTrain::of_code`].
    pub(crate) fn decode(&self, quantities: &[Quantity]) -> Result<Tile, Error> {
        let form = IntegerTrain::of_code(
            quantities.len(),
            self.order,
            Tile::SMOOTH_DEGREES,
            self.terms,
            self.weights.clone(),
            self.step,
            &self.integers,
        );
        let Place { film, substrate } = self.place;
        Ok(Tile {
            film,
            substrate,
            form: form.map_err(|Malformed(what)| Error::Malformed(what))?,
        })
    }

    fn decode_sound(&self, quantities: &[Quantity]) -> Tile {
        let tile = self.decode(quantities);
        tile.expect("only code that is known to be sound is kept")
    }
}

impl StoredTiles {
    /// Keeps tiles that are decoded.
    pub(crate) fn new(quantities: Vec<Quantity>, tiles: Vec<Tile>) -> Self {
        Self {
            quantities,
            coded: Vec::new(),
            decoded: Once::from(tiles),
        }
    }

    /// Keeps the code of tiles, which must be sound.
    #[cfg(feature = "embedded")]
    pub(crate) fn of_code(quantities: Vec<Quantity>, coded: Vec<CodedTile>) -> Self {
        Self {
            quantities,
            coded,
            decoded: Once::new(),
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
            None => self.coded.iter().map(|tile| tile.place).collect(),
        }
    }
}
