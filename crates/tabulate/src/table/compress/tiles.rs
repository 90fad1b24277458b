//! The tiles of a low-rank form: where they meet, and the form of each.

use interp::{Parameter, Table, Tile};
use low_rank::compress::{self, Axis, NotReached};
use solve::parallel::on_all_cores;

use crate::Error;

/// The smallest number of nodes on both sides of a cut. A smaller tile would save nothing.
const LEAST_NODES: usize = 8;

/// The error of the tiles of films softer than sphere and substrate, in parts of the allowed one.
/// There an error of the table changes the derivative with respect to the Poisson ratio most.
const SOFT: f64 = 0.5;

/// A cut of a box at a value of a modulus, and the cuts of its two sides.
struct Cut {
    parameter: Parameter,
    at: f64,
    below: Option<&'static Cut>,
    above: Option<&'static Cut>,
}

/// Where tiles meet: the films softer than sphere and substrate together are apart from stiffer
/// ones, and among these the substrates softer than the sphere from stiffer ones. The contacts of
/// stiff films on soft substrates have the largest ranks, and are cut most.
static CUTS: Cut = Cut {
    parameter: Parameter::E1sOverEinfs,
    at: 1.0,
    below: Some(&Cut {
        parameter: Parameter::E1sOverEinfs,
        at: 1e-5,
        below: None,
        above: None,
    }),
    above: Some(&Cut {
        parameter: Parameter::E0sOverE2s,
        at: 1.0,
        below: Some(&Cut {
            parameter: Parameter::E1sOverEinfs,
            at: 1e5,
            below: Some(&Cut {
                parameter: Parameter::E1sOverEinfs,
                at: 1e3,
                below: None,
                above: None,
            }),
            above: Some(&Cut {
                parameter: Parameter::E0sOverE2s,
                at: 1e-5,
                below: None,
                above: None,
            }),
        }),
        above: None,
    }),
};

/// The first and the last node of film and substrate.
type Nodes = [[usize; 2]; 2];

/// Returns a table in low-rank form, in about as few bytes as `error` allows, the largest relative
/// error of the quantities at the nodes.
///
/// # Errors
/// [`Error::NoLowRank`] where the smallest steps have a larger error; [`Error::Table`] for a
/// low-rank form that needs too much at its first lookup.
pub fn compress(table: &Table, error: f64) -> Result<Vec<Tile>, Error> {
    let [_, n_film, _, n_substrate] = table.shape();
    let whole = [[0, n_film - 1], [0, n_substrate - 1]];
    let mut boxes = Vec::new();
    divide(table, whole, Some(&CUTS), &mut boxes);
    let logarithms: Vec<f64> = (0..n_film)
        .flat_map(|film| table.logarithms(film))
        .collect();
    let form = |[film, substrate]: Nodes| {
        let softer = table.axis(Parameter::E1sOverEinfs).get(film[1]);
        let is_soft = softer.is_some_and(|&stiffest| stiffest < 2.0 * CUTS.at);
        let error = if is_soft { SOFT * error } else { error };
        let (axes, count) = (axes(table, [film, substrate]), table.quantities().len());
        let form = on_all_cores(|| compress::compress(axes, count, &logarithms, error));
        let form =
            form.map_err(|NotReached { error, reached }| {
                Error::NoLowRank(format!(
                    "rounding keeps the low-rank form from an error of {error:.1e}: it has {reached:.1e}; ask for a larger tolerance"
                ))
            })?;
        Ok(Tile {
            film,
            substrate,
            form,
        })
    };
    boxes.into_iter().map(form).collect()
}

/// Divides the box of some nodes of film and substrate by a cut, and each side by its cuts.
fn divide(table: &Table, nodes: Nodes, cut: Option<&Cut>, boxes: &mut Vec<Nodes>) {
    let Some(cut) = cut else {
        boxes.push(nodes);
        return;
    };
    let side = usize::from(cut.parameter.dimension() == 3);
    let [first, last] = nodes[side];
    // No nodes in a table of other parameters.
    let at = table
        .axis(cut.parameter)
        .partition_point(|&node| node < cut.at);
    if table.axis(cut.parameter).is_empty() || last - first < LEAST_NODES {
        boxes.push(nodes);
    } else if at < first + LEAST_NODES {
        divide(table, nodes, cut.above, boxes);
    } else if at + LEAST_NODES > last {
        divide(table, nodes, cut.below, boxes);
    } else {
        let (mut below, mut above) = (nodes, nodes);
        (below[side], above[side]) = ([first, at], [at, last]);
        divide(table, below, cut.below, boxes);
        divide(table, above, cut.above, boxes);
    }
}

/// Returns the axes of a table, for the part at some nodes of film and substrate: in the order of
/// the table's logarithms.
fn axes(table: &Table, [film, substrate]: Nodes) -> [Axis; 4] {
    let shape = table.shape();
    [1, 2, 3, 0].map(|dimension| {
        let parameter = table.parameters()[dimension];
        let nodes = match dimension {
            1 => film,
            3 => substrate,
            _ => [0, shape[dimension] - 1],
        };
        let coordinates = table.axis(parameter).iter();
        Axis {
            coordinates: coordinates
                .map(|&node| parameter.coordinate(node))
                .collect(),
            nodes,
            smooth_degree: Tile::SMOOTH_DEGREES[dimension],
        }
    })
}
