//! Many materials at one `a/t`, with the values and matrices that they share.
//!
//! The Bessel values of one `a/t` serve every material whose compliance varies on scales of the
//! same size, and the matrices of one (`a/t`, `nu1`, `nu0`, `E0/E1`) serve every sphere. Where
//! `E1/E2*` and `E0/E2*` are even grids with a common spacing, the ratios `E0/E1` repeat along
//! diagonals, and a grid of `n x n` materials has only `2n - 1` pairs of matrices.

use std::collections::BTreeMap;

use interp::{Material, Quantities};
use rayon::prelude::*;

use crate::Error;
use crate::compliance::Compliance;
use crate::compliance::surface::SurfaceCompliance;
use crate::compliance::symbol::Symbol;
use crate::galerkin;
use crate::galerkin::abscissae::{Abscissae, BesselValues};
use crate::galerkin::operator::Operator;
use crate::method::{Method, has_closed_form};
use crate::parallel::{on_all_cores, try_map};

/// Materials, grouped by film and substrate.
pub struct Batch {
    materials: Vec<Material>,
    groups: Vec<Group>,
}

/// One film on one substrate, with the indices of the materials that differ by the sphere only.
struct Group {
    compliance: Compliance,
    members: Vec<usize>,
}

impl Group {
    /// Returns whether Galerkin's method, whose matrices the members share, costs less than what
    /// each member would take alone.
    fn prefers_galerkin(&self, x: f64, materials: &[Material], tolerance: f64) -> bool {
        /// The [cost](galerkin::cost) of one contact up to which Galerkin's method is faster here.
        /// It is larger than the time of the Wiener-Hopf method, because the cost includes the
        /// Bessel values. With 10 instead, the scene `universal` takes 3 % longer.
        const WIENER_HOPF: f64 = 25.0;
        let takes_galerkin = |&member: &usize| {
            let symbol = Symbol::with_compliance(self.compliance, &materials[member]);
            Method::candidates(x, &symbol, tolerance).next() == Some(Method::Galerkin)
        };
        galerkin::cost(x, tolerance) <= WIENER_HOPF * self.members.len() as f64
            || self.members.iter().any(takes_galerkin)
    }

    /// Returns the exponent of the largest power of 4 that is at most the smallest scale of the
    /// compliance. The first panel has the length of this scale, and the end of each further one is
    /// 4 times its beginning. Panels for one group therefore suit every group with the same
    /// exponent, with one panel too many at most.
    fn scale(&self) -> i32 {
        (0.5 * self.compliance.smallest_scale().log2()).floor() as i32
    }
}

impl Batch {
    /// Groups `materials` by `nu1`, `nu0` and `E1/E0`. Ratios that differ by rounding count as
    /// equal.
    pub fn new(materials: Vec<Material>) -> Self {
        const ROUNDING: f64 = 1e-14;
        let key = |&i: &usize| {
            let material: &Material = &materials[i];
            (
                material.nu1(),
                material.nu0(),
                material.film_over_substrate(),
            )
        };
        let mut order: Vec<usize> = (0..materials.len()).collect();
        order.sort_by(|a, b| key(a).partial_cmp(&key(b)).expect("materials hold no NaN"));
        let belong_together = |a: &usize, b: &usize| {
            let ((nu1_a, nu0_a, ratio_a), (nu1_b, nu0_b, ratio_b)) = (key(a), key(b));
            (nu1_a, nu0_a) == (nu1_b, nu0_b) && (ratio_a - ratio_b).abs() <= ROUNDING * ratio_a
        };
        let group = |members: &[usize]| Group {
            compliance: Compliance::new(&materials[members[0]]),
            members: members.to_vec(),
        };
        let groups = order.chunk_by(belong_together).map(group).collect();
        Self { materials, groups }
    }

    /// Returns the materials, in the order in which they were given.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Solves every material at `x = a/t`, on all cores, and returns the quantities in the order of
    /// the materials.
    ///
    /// Galerkin's method on shared abscissae is used where it is fast and reaches `tolerance`; every
    /// other material is solved with `solve_one`. `progress` is called with the number of materials
    /// finished since the last call, from any thread. The result does not depend on the number of
    /// threads.
    ///
    /// # Errors
    /// The first of those of `solve_one`, in the order of the groups.
    pub fn solve(
        &self,
        x: f64,
        tolerance: f64,
        solve_one: &(dyn Fn(&Material) -> Result<Quantities, Error> + Sync),
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Vec<Quantities>, Error> {
        let shared = Shared::new(x, self, tolerance);
        let solve_group = |(group, scale): (&Group, &Option<i32>)| -> Result<_, Error> {
            let solved = shared.solve(group, *scale, &self.materials, solve_one)?;
            progress(solved.len());
            Ok(solved)
        };
        let solved = try_map(self.groups.par_iter().zip(&shared.scales), solve_group)?;
        let missing = Quantities::from_array([f64::NAN; 4]);
        let mut all = vec![missing; self.materials.len()];
        for (group, solved) in self.groups.iter().zip(solved) {
            for (&member, solved) in group.members.iter().zip(solved) {
                all[member] = solved;
            }
        }
        Ok(all)
    }
}

/// The values that materials share at one `a/t`.
struct Shared {
    tolerance: f64,
    /// The [scale](Group::scale) of every group that prefers Galerkin's method.
    scales: Vec<Option<i32>>,
    /// The abscissae and Bessel values of these groups, by their scales.
    galerkin: BTreeMap<i32, (Abscissae, BesselValues)>,
}

impl Shared {
    /// Evaluates the Bessel functions at `x = a/t`, on panels that serve every group of one scale.
    fn new(x: f64, batch: &Batch, tolerance: f64) -> Self {
        let scale = |group: &Group| {
            let prefers_galerkin = group.prefers_galerkin(x, &batch.materials, tolerance);
            prefers_galerkin.then(|| group.scale())
        };
        let scales: Vec<_> = on_all_cores(|| batch.groups.par_iter().map(scale).collect());
        let mut of_scales: BTreeMap<i32, Vec<&Compliance>> = BTreeMap::new();
        for (group, scale) in batch.groups.iter().zip(&scales) {
            if let Some(scale) = scale {
                let of_scale = of_scales.entry(*scale).or_default();
                of_scale.push(&group.compliance);
            }
        }
        let prepare = |(scale, compliances): (i32, Vec<&Compliance>)| {
            let abscissae = galerkin::shared_abscissae(x, compliances, tolerance);
            let bessel = abscissae.bessel_values();
            (scale, (abscissae, bessel))
        };
        Self {
            tolerance,
            scales,
            galerkin: on_all_cores(|| of_scales.into_par_iter().map(prepare).collect()),
        }
    }

    /// Returns the quantities of every member of a group, whose `scale` is none if it does not
    /// prefer Galerkin's method.
    fn solve(
        &self,
        group: &Group,
        scale: Option<i32>,
        materials: &[Material],
        solve_one: &(dyn Fn(&Material) -> Result<Quantities, Error> + Sync),
    ) -> Result<Vec<Quantities>, Error> {
        let members = group.members.iter().map(|&member| &materials[member]);
        let galerkin = scale.map(|scale| &self.galerkin[&scale]);
        let assemble = |abscissae, bessel| match group.members.len() {
            1 => Operator::for_one_sphere(&group.compliance, abscissae, bessel),
            _ => Operator::for_many_spheres(&group.compliance, abscissae, bessel),
        };
        let mut operator = None;
        let solve_member = |material: &Material| {
            let symbol = Symbol::with_compliance(group.compliance, material);
            if let Some((abscissae, bessel)) = galerkin
                && !has_closed_form(&symbol, self.tolerance)
            {
                let operator = operator.get_or_insert_with(|| assemble(abscissae, bessel));
                if let Some(solved) = operator.solve_to(&symbol, self.tolerance) {
                    return Ok(solved.quantities);
                }
            }
            // Thin films, and the rare material that needs more modes or panels of its own.
            solve_one(material)
        };
        members.map(solve_member).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::{difference, larger};
    use crate::solve;

    /// Every sphere on films and substrates of which some differ by `nu0` alone, and films on
    /// substrates under one sphere each.
    #[test]
    fn shared_matrices_give_the_quantities_of_single_solves() {
        const TOLERANCE: f64 = 1e-9;
        let mut materials = Vec::new();
        for e1 in [0.0, 1e-9, 1e-3, 1.0, 1e4, 1e100] {
            for ratio in [1e-14, 1e-3, 1.0, 1e12] {
                for (nu1, nu0) in [(0.5, 0.0), (0.5, 0.4), (0.25, 0.4), (0.0, 0.5)] {
                    let e0 = ratio * if e1 == 0.0 { 1.0 } else { e1 };
                    materials.push(Material::new(e1, nu1, e0, nu0).expect("physical"));
                }
            }
        }
        for digits in -11..=11 {
            let e0 = 10_f64.powi(digits);
            materials.push(Material::new(1.0, 0.3, e0, 0.2).expect("physical"));
        }
        materials.push(Material::new(1.0, 0.3, 1.0 + 1e-7, 0.2).expect("physical"));
        let alone = |x| move |material: &Material| Ok(solve(x, material, TOLERANCE)?.quantities);
        let batch = Batch::new(materials);
        assert_eq!(batch.groups.len(), 4 * 4 + 24);
        let mut worst = 0.0;
        for x in [1e-3, 1.0, 30.0] {
            let solved = batch
                .solve(x, TOLERANCE, &alone(x), &|_| ())
                .expect("within reach");
            for (material, solved) in batch.materials().iter().zip(&solved) {
                let single: Result<_, Error> = alone(x)(material);
                let single = single.expect("within reach");
                worst = larger(worst, difference(solved, &single));
            }
        }
        println!("shared matrices: {worst:.1e}");
        assert!(worst <= 2.0 * TOLERANCE);
    }
}
