//! Linear interpolation of the logarithms that the table splines, in the table's coordinates.

use interp::{Curve, Error, Material, Parameter, Quantity, Table};

/// Linear interpolation of one quantity in all four parameters at once.
pub struct Multilinear {
    quantity: Quantity,
    /// The coordinates of the nodes, in the order of the values.
    axes: [Vec<f64>; 4],
    /// Row-major over [`ORDER`].
    logarithms: Vec<f64>,
}

/// The order of the dimensions. `a/t` is the last, so that neighbours along it are neighbours in
/// memory, as in [`Table::logarithms`].
const ORDER: [Parameter; 4] = [
    Parameter::E1OverE2,
    Parameter::Nu1,
    Parameter::E0OverE2,
    Parameter::AOverT,
];

impl Multilinear {
    /// Returns the interpolation between the nodes of a table that holds all four quantities.
    pub fn new(table: &Table, quantity: Quantity) -> Self {
        let axes = ORDER.map(|parameter| {
            table
                .axis(parameter)
                .iter()
                .map(|&node| parameter.coordinate(node))
                .collect()
        });
        let of_film = |e1| {
            table
                .logarithms(e1)
                .chunks_exact(4)
                .map(|four| four[quantity as usize])
                .collect::<Vec<f64>>()
        };
        let logarithms = (0..table.axis(Parameter::E1OverE2).len())
            .flat_map(of_film)
            .collect();
        Self {
            quantity,
            axes,
            logarithms,
        }
    }

    /// Returns the quantity at a point of the table's box.
    pub fn at(&self, a_over_t: f64, material: &Material) -> f64 {
        let point = [
            material.e1_over_e2(),
            material.nu1(),
            material.e0_over_e2(),
            a_over_t,
        ];
        let (mut places, mut shares) = ([0; 4], [0.0; 4]);
        for (k, axis) in self.axes.iter().enumerate() {
            (places[k], shares[k]) = bracket(axis, ORDER[k].coordinate(point[k]));
        }
        let mut sum = 0.0;
        for corner in 0..16 {
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
            sum += weight * self.logarithms[index];
        }
        self.quantity.scale(material.sphere_film_modulus()) * sum.exp()
    }
}

/// Linear interpolation of one quantity along the curve of one material.
pub struct Linear {
    scale: f64,
    places: Vec<f64>,
    logarithms: Vec<f64>,
}

impl Linear {
    /// Returns the interpolation between the values at `nodes`, which are ascending `a/t`.
    ///
    /// # Errors
    /// Those of [`Curve::quantity`].
    pub fn new(curve: &Curve, quantity: Quantity, nodes: &[f64]) -> Result<Self, Error> {
        let es = curve.material().sphere_film_modulus();
        let logarithms = nodes
            .iter()
            .map(|&x| Ok(quantity.logarithm(curve.quantity(quantity, x)?, es)))
            .collect::<Result<_, Error>>()?;
        let places = nodes
            .iter()
            .map(|&x| Parameter::AOverT.coordinate(x))
            .collect();
        Ok(Self {
            scale: quantity.scale(es),
            places,
            logarithms,
        })
    }

    /// Returns the quantity between the first and the last node.
    pub fn at(&self, a_over_t: f64) -> f64 {
        let (place, share) = bracket(&self.places, Parameter::AOverT.coordinate(a_over_t));
        let next = (place + 1).min(self.logarithms.len() - 1);
        self.scale * ((1.0 - share) * self.logarithms[place] + share * self.logarithms[next]).exp()
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
