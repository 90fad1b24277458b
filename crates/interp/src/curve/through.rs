//! Makes the curve through quantities at nodes, from elsewhere than a table.

use piecewise::bspline::Basis;

use crate::curve::nodes::{REASONABLE, too_close};
use crate::curve::quantity_resampler::QuantityResampler;
use crate::{Curve, Error, Material, Parameter, Quantities, Quantity};

impl Curve {
    /// Makes the curve through quantities from elsewhere than a table: `nodes` holds pairs of
    /// `a/t`, ascending, and the quantities there.
    ///
    /// The quintic not-a-knot spline interpolates `ln(Pi0/es)`, `ln(Eeq/es)`, `ln(Gamma/es)` and
    /// `ln Delta0` over `ln(a/t)`. Its error falls like the sixth power of the distance of the
    /// nodes. The pieces that replace the spline add 1e-13 if the nodes are on a smooth curve.
    ///
    /// The quantities are not compared with `material`; the crate `solve` makes a curve of
    /// stated accuracy from a material alone. The curve has no expansions beyond the nodes and no
    /// derivatives with respect to the material.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] if `nodes` is empty; if an `a/t` or a quantity is not in
    /// `[1e-30, 1e30]`; if `ln(a/t)` of a node does not exceed that of the node before by 1e-7 of
    /// the range of all nodes and by 1e-9; or if the spline leaves `[1e-30, 1e30]` between the
    /// nodes, or is too steep to decide this.
    ///
    /// ```
    /// # fn main() -> Result<(), interp::Error> {
    /// use interp::{Curve, Material};
    ///
    /// let material = Material::new(1.75, 0.5, 1e5, 0.25)?;
    /// let nodes = [1e-5, 2e-5, 4e-5].map(|a_over_t| (a_over_t, material.thick_film_limit()));
    /// let curve = Curve::through(&nodes, material)?;
    /// assert!((curve.quantities(3e-5)?.eeq - 0.7).abs() < 1e-15);
    /// # Ok(()) }
    /// ```
    pub fn through(nodes: &[(f64, Quantities)], material: Material) -> Result<Self, Error> {
        let nodes: Vec<_> = nodes.iter().map(|&(x, q)| (x, [q])).collect();
        let [curve] = Self::through_each(&nodes, material)?;
        Ok(curve)
    }

    /// Makes several curves of one material through the same nodes, as [`Curve::through`]. They share
    /// their pieces, whose choice is most of the time of a curve.
    ///
    /// # Errors
    /// As [`Curve::through`].
    pub fn through_each<const N: usize>(
        nodes: &[(f64, [Quantities; N])],
        material: Material,
    ) -> Result<[Self; N], Error> {
        const DEGREE: usize = 5;
        const ERROR: f64 = 1e-13;
        Error::argument(!nodes.is_empty(), "the number of nodes", 0.0, "at least 1")?;
        let reasonable = |name, value| {
            Error::argument(REASONABLE.contains(&value), name, value, "in [1e-30, 1e30]")
        };
        for (a_over_t, curves) in nodes {
            reasonable(Parameter::AOverT.name(), *a_over_t)?;
            for quantities in curves {
                Quantity::ALL.into_iter().try_for_each(|quantity| {
                    reasonable(quantity.name(), quantities.get(quantity))
                })?;
            }
        }
        let a_over_t: Vec<f64> = nodes.iter().map(|node| node.0).collect();
        if let Some([_, close]) = too_close(Parameter::AOverT, &a_over_t) {
            let allowed = "larger than the one before: ln(a/t) by at least 1e-9, and by \
                           1e-7 of the range of all nodes";
            Error::argument(false, Parameter::AOverT.name(), close, allowed)?;
        }
        let es = material.sphere_film_modulus();
        let logarithms =
            |quantities: &Quantities| Quantity::ALL.map(|q| q.logarithm(quantities.get(q), es));
        let coordinates: Vec<f64> = a_over_t
            .iter()
            .map(|&x| Parameter::AOverT.coordinate(x))
            .collect();
        let basis = Basis::new(&coordinates, DEGREE);
        let coefficients: [Vec<f64>; N] = std::array::from_fn(|i| {
            let values = nodes.iter().flat_map(|node| logarithms(&node.1[i]));
            let mut coefficients: Vec<f64> = values.collect();
            basis.interpolate(&mut coefficients, 4);
            coefficients
        });
        let range = [a_over_t[0], a_over_t[a_over_t.len() - 1]];
        let of_curve = |i: usize| &coefficients[i];
        let resampler =
            QuantityResampler::fitting(&basis, range, &Quantity::ALL, N, of_curve, ERROR);
        let curves = coefficients
            .each_ref()
            .map(|coefficients| Self::of_splines(&resampler, coefficients, material));
        match curves.iter().find_map(Self::unreasonable) {
            None => Ok(curves),
            Some((quantity, value)) => Err(Error::InvalidArgument {
                name: quantity.name(),
                value,
                allowed: "in [1e-30, 1e30] between the nodes, too: give more nodes where it \
                          changes fast"
                    .into(),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::test_curve::{curve, even, exact};

    /// Nodes as a table has them, and nodes at very different distances.
    fn uneven() -> [Vec<f64>; 2] {
        let crowded = (0..=60)
            .map(|i| (-6.9 * (f64::from(i) * std::f64::consts::PI / 60.0).cos()).exp())
            .collect();
        [
            crowded,
            vec![1e-3, 0.1, 0.13, 0.130001, 0.3, 0.31, 0.7, 2.0, 2.5, 1e3],
        ]
    }

    #[test]
    fn nodes_at_any_distance_are_met() {
        let close = vec![1.0, 1.0 + 1e-8, 1.0 + 2e-8, 1.0 + 1e-7];
        for nodes in [even(7), close, vec![2.5]].into_iter().chain(uneven()) {
            let curve = curve(&nodes);
            for &x in &nodes {
                for quantity in Quantity::ALL {
                    let (value, expected) = (
                        curve.quantity(quantity, x).expect("in range"),
                        exact(x).get(quantity),
                    );
                    // Between nodes far apart and others close by, a spline has bends that pieces
                    // do not follow to the last digit.
                    assert!(
                        (value / expected - 1.0).abs() < 1e-10,
                        "{quantity:?} at {x} of {nodes:?}: {value}, not {expected}"
                    );
                }
            }
        }
    }

    /// Curves that share their pieces are those made alone.
    #[test]
    fn curves_through_the_same_nodes_are_those_made_alone() {
        let twice = |q: Quantities| Quantities::from_array(q.to_array().map(|q| 2.0 * q));
        let nodes: Vec<_> = even(200).into_iter().map(|x| (x, exact(x))).collect();
        let pairs: Vec<_> = nodes.iter().map(|&(x, q)| (x, [q, twice(q)])).collect();
        let material = *curve(&even(7)).material();
        let alone = Curve::through(&nodes, material).expect("sound");
        let both = Curve::through_each(&pairs, material).expect("sound");
        for x in (0..100).map(|i| 10_f64.powf(-2.9 + 0.058 * f64::from(i))) {
            let expected = alone.quantities(x).expect("in range");
            for (curve, factor) in both.iter().zip([1.0, 2.0]) {
                let found = curve.quantities(x).expect("in range");
                for quantity in Quantity::ALL {
                    let ratio = found.get(quantity) / expected.get(quantity);
                    assert!((ratio / factor - 1.0).abs() < 1e-12, "{quantity:?} at {x}");
                }
            }
        }
    }

    #[test]
    fn a_spline_through_enough_nodes_is_the_function() {
        let curve = curve(&even(600));
        for i in 0..10_000 {
            let x = 10_f64
                .powf(-3.0 + 6.0 * (f64::from(i) * 0.618_034 % 1.0))
                .clamp(1e-3, 1e3);
            for quantity in Quantity::ALL {
                let miss =
                    curve.quantity(quantity, x).expect("in range") / exact(x).get(quantity) - 1.0;
                assert!(miss.abs() < 1e-10, "{quantity:?} at {x}: {miss:.1e}");
            }
            assert_eq!(
                curve.quantities(x).expect("in range").to_array(),
                Quantity::ALL.map(|q| curve.quantity(q, x).expect("in range"))
            );
        }
    }

    /// The spline through noise leaves every range, and the pieces do not follow it.
    #[test]
    fn noise_on_many_nodes_is_an_error() {
        let nodes = even(5000);
        let noise = |i: usize, q: usize| (20.0 * (1e3 * (i * (q + 3)) as f64).sin()).exp();
        let noise = |i: usize| Quantities::from_array(std::array::from_fn(|q| noise(i, q)));
        let nodes: Vec<(f64, Quantities)> = nodes
            .iter()
            .enumerate()
            .map(|(i, &x)| (x, noise(i)))
            .collect();
        let curve = Curve::through(
            &nodes,
            Material::new(1.75, 0.5, 1e5, 0.25).expect("physical"),
        );
        assert!(
            matches!(curve, Err(Error::InvalidArgument { .. })),
            "{curve:?}"
        );
    }
}
