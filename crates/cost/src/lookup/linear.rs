//! Linear interpolation of the logarithms that the table splines, in the table's coordinates.

use interp::{Curve, Error, Material, Parameter, Quantity, Table};

/// Linear interpolation in `N` variables at once.
struct Linear<const N: usize> {
    /// The coordinates of the nodes, in the order of the values.
    axes: [Vec<f64>; N],
    /// Row-major over the axes.
    values: Vec<f64>,
}

/// The order of the dimensions of a table. `a/t` is the last, so that neighbours along it are neighbours in
/// memory, as in [`Table::logarithms`].
const ORDER: [Parameter; 4] = [
    Parameter::E1OverE2,
    Parameter::Nu1,
    Parameter::E0OverE2,
    Parameter::AOverT,
];

/// Returns the interpolation of a quantity between the nodes of a table that holds all four quantities, at points of
/// its box.
pub fn in_table(table: &Table, quantity: Quantity) -> impl Fn(f64, &Material) -> f64 + use<> {
    let of_film = |e1| {
        let all = table.logarithms(e1);
        let own = all.into_iter().skip(quantity as usize);
        own.step_by(4)
    };
    let films = 0..table.axis(Parameter::E1OverE2).len();
    let linear = Linear {
        axes: ORDER.map(|parameter| coordinates(parameter, table.axis(parameter))),
        values: films.flat_map(of_film).collect(),
    };
    move |a_over_t, material| {
        let (e1, nu1) = (material.e1_over_e2(), material.nu1());
        let point = [e1, nu1, material.e0_over_e2(), a_over_t];
        let point = std::array::from_fn(|k| ORDER[k].coordinate(point[k]));
        quantity.scale(material.sphere_film_modulus()) * linear.at(point).exp()
    }
}

/// Returns the interpolation of a quantity between its values on the curve of one material at `nodes`, which are
/// ascending `a/t`.
///
/// # Errors
/// Those of [`Curve::quantity`].
pub fn on_curve(
    curve: &Curve,
    quantity: Quantity,
    nodes: &[f64],
) -> Result<impl Fn(f64) -> f64 + use<>, Error> {
    let es = curve.material().sphere_film_modulus();
    let value = |&x: &f64| Ok(quantity.logarithm(curve.quantity(quantity, x)?, es));
    let linear = Linear {
        axes: [coordinates(Parameter::AOverT, nodes)],
        values: nodes.iter().map(value).collect::<Result<_, Error>>()?,
    };
    let scale = quantity.scale(es);
    Ok(move |x| scale * linear.at([Parameter::AOverT.coordinate(x)]).exp())
}

fn coordinates(parameter: Parameter, nodes: &[f64]) -> Vec<f64> {
    let coordinates = nodes.iter().map(|&node| parameter.coordinate(node));
    coordinates.collect()
}

impl<const N: usize> Linear<N> {
    /// Returns the value at a point between the first and the last node of each axis.
    fn at(&self, point: [f64; N]) -> f64 {
        let (mut places, mut shares) = ([0; N], [0.0; N]);
        for (k, axis) in self.axes.iter().enumerate() {
            (places[k], shares[k]) = bracket(axis, point[k]);
        }
        let mut sum = 0.0;
        for corner in 0..1 << N {
            let (mut weight, mut index) = (1.0, 0);
            for (k, axis) in self.axes.iter().enumerate() {
                let upper = corner >> k & 1;
                weight *= if upper == 1 {
                    shares[k]
                } else {
                    1.0 - shares[k]
                };
                index = index * axis.len() + (places[k] + upper).min(axis.len() - 1);
            }
            sum += weight * self.values[index];
        }
        sum
    }
}

/// Returns the index of the node before a coordinate, and the share of the way to the next node. Of
/// a single node, returns its index and 0.
fn bracket(axis: &[f64], coordinate: f64) -> (usize, f64) {
    if axis.len() == 1 {
        return (0, 0.0);
    }
    let place = axis[1..axis.len() - 1].partition_point(|&node| node <= coordinate);
    (
        place,
        (coordinate - axis[place]) / (axis[place + 1] - axis[place]),
    )
}
