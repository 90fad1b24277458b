//! A stack of layers on its base: the surface compliance by minors, without cancellation or
//! overflow.
//!
//! `slab.rs` has the equations of one layer, and how it carries the minors `y` from its bottom to
//! its top. On an elastic base `y` begins with `(1, 1-nu, 1/2-nu, 1-nu, 3/4-nu)` in units of `1/G`,
//! on a rigid one with `(1, 0, 0, 0, 0)`. At an interface the compliances take the unit of the next
//! layer: `c11`, `c12` and `c22` are multiplied with `m = G_new/G_old`, and `D` with `m^2`.
//! `joint.rs` has the interfaces that are not bonded.
//!
//! Measured against mpmath over 2000 random stacks (`tests/truth/stacks.rs`): the errors of `X - 1`
//! and of the slope are at most 2.1e-15 and 5.3e-15 of `max(X, 1)`, that of `X` at most 2.2e-15 of `X`.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use interp::Material;

use crate::compliance::excess::{largest_excess, shear};
use crate::compliance::minors::{Minors, scaled, sum};
use crate::compliance::slab::{Component, Samples, Slab};
use crate::compliance::surface::{AllSamples, SurfaceCompliance, VectorCompliance, sample_all};
use crate::stack::{Interface, Stack};

/// The smallest scale over the estimate of the nearest pole, of a stack that is not bonded: the
/// estimate leaves out the factor 1/2 of the bound, and plates that slide need some of it.
const OF_POLE: f64 = 0.6;

/// The surface compliance of a stack of layers on its base. Wave numbers are in units of one over
/// the thickness of the top layer.
#[derive(Clone, Debug)]
pub struct LayeredCompliance {
    /// The minors of the base's surface, in its own unit.
    base: [f64; 5],
    /// The layers below the top one, from the base up.
    buried: Vec<Slab>,
    /// The top layer, of thickness 1.
    top: Slab,
    /// The wave number that is added to all ([`Interface::least`]).
    least: f64,
    smallest_scale: f64,
    largest_excess: f64,
}

impl LayeredCompliance {
    /// Returns the compliance of `stack`.
    pub fn new(stack: &Stack) -> Self {
        let base = stack.base();
        let nu0 = base.poisson();
        let unit = stack.top().thickness;
        let mut below = base;
        let mut slabs: Vec<Slab> = Vec::with_capacity(stack.layers().len());
        for layer in stack.layers() {
            let contrast = if below.young() == f64::INFINITY {
                1.0
            } else {
                shear(&layer.solid) / shear(&below)
            };
            let thickness = layer.thickness / unit;
            let interface = layer.interface.over(shear(&layer.solid), unit);
            slabs.push(Slab::new(
                layer.solid.poisson(),
                thickness,
                contrast,
                interface,
            ));
            below = layer.solid;
        }
        let top = slabs.pop().expect("a stack has a layer");
        let base = if base.young() == f64::INFINITY {
            [1.0, 0.0, 0.0, 0.0, 0.0]
        } else {
            [1.0, 1.0 - nu0, 0.5 - nu0, 1.0 - nu0, 0.75 - nu0]
        };
        Self::with_slabs(base, slabs, top, largest_excess(stack))
    }

    /// Returns the compliance of the one film of `material` on its substrate, of any contrast.
    pub(crate) fn of_film(material: &Material) -> Self {
        let (nu1, nu0) = (material.nu1(), material.nu0());
        let m = material.film_over_substrate() * ((1.0 + nu0) / (1.0 + nu1));
        // The minors of the base in the unit of the film, divided by the larger of 1 and `m^2`.
        let (unit, share) = (1.0 / m.max(1.0), m.min(1.0));
        let single = share * unit;
        let base = [
            unit * unit,
            single * (1.0 - nu0),
            single * (0.5 - nu0),
            single * (1.0 - nu0),
            share * share * (0.75 - nu0),
        ];
        let ratio = material.film_modulus() / material.substrate_modulus();
        let bound = 2.0 * ratio.max(1.0);
        Self::with_slabs(
            base,
            Vec::new(),
            Slab::new(nu1, 1.0, 1.0, Interface::Bonded),
            bound,
        )
    }

    /// Finds the nearest pole.
    fn with_slabs(base: [f64; 5], buried: Vec<Slab>, top: Slab, largest_excess: f64) -> Self {
        let least = buried
            .iter()
            .chain([&top])
            .map(|slab| slab.interface.least());
        let least = least.fold(0.0, f64::max);
        let is_bonded = |slab: &Slab| matches!(slab.interface, Interface::Bonded);
        let bonded = buried.iter().all(is_bonded) && is_bonded(&top);
        let share = if bonded { 1.0 } else { OF_POLE };
        let mut compliance = Self {
            base,
            buried,
            top,
            least,
            smallest_scale: 1.0,
            largest_excess,
        };
        // Below 1e-40 lies nothing of the integral of `X`, which is at most some 1e9.
        let nearest_pole = dispatch!(Level::new(), simd => compliance.nearest_pole(simd));
        compliance.smallest_scale = (share * nearest_pole).clamp(1e-40, 1.0);
        compliance
    }

    /// Returns `X(q)` for a finite `q >= 0`, with a relative error of a few rounding units, however
    /// small it is.
    pub fn x(&self, q: f64) -> f64 {
        dispatch!(Level::new(), simd => self.x_at(simd, q))
    }

    #[inline(always)]
    fn x_at<S: Simd>(&self, simd: S, q: f64) -> f64 {
        self.evaluate(simd, S::f64s::splat(simd, q)).x[0]
    }

    /// Returns the compliance at several wave numbers `k`.
    #[inline(always)]
    fn evaluate<S: Simd>(&self, simd: S, k: S::f64s) -> Samples<S::f64s> {
        let k = k + self.least;
        let [y, z] = self.below_top(simd, k);
        let [samples] = self.top.sample(simd, k, y, z, [Component::NORMAL]);
        samples
    }

    /// Returns the wave number that is added to all.
    pub(crate) const fn least(&self) -> f64 {
        self.least
    }

    /// Returns the top layer.
    pub(crate) fn top(&self) -> &Slab {
        &self.top
    }

    /// Returns the minors `y` and `z = k dy/dk` at the bottom of the top layer, in its unit, at
    /// several wave numbers `k`.
    #[inline(always)]
    pub(crate) fn below_top<S: Simd>(&self, simd: S, k: S::f64s) -> [Minors<S>; 2] {
        let zero = S::f64s::splat(simd, 0.0);
        let (mut y, mut z) = (self.base(simd), [zero; 5]);
        for slab in &self.buried {
            [y, z] = slab.enter(simd, k, y, z);
            [y, z] = slab.cross(simd, k, y, z);
            // A factor of `y` is free, and so is its slope: `d` becomes 1 and its slope 0.
            let unit = S::f64s::splat(simd, 1.0) / y[0];
            y = scaled::<S>(unit, y);
            z = scaled::<S>(unit, z);
            z = sum::<S>(z, zero - z[0], y);
        }
        self.top.enter(simd, k, y, z)
    }

    /// Returns the minors of the base's surface.
    #[inline(always)]
    fn base<S: Simd>(&self, simd: S) -> Minors<S> {
        let mut y = [S::f64s::splat(simd, 0.0); 5];
        for (y, base) in y.iter_mut().zip(self.base) {
            *y = S::f64s::splat(simd, base);
        }
        y
    }

    /// Estimates from below how far the nearest pole of `X` is from wave number 0.
    ///
    /// The poles are the zeros of `d` at the top, an entire function of `k`. By the bound of
    /// Fujiwara for the zeros of a polynomial, none is nearer than half of `min_n |d_0/d_n|^{1/n}`
    /// with the coefficients `d_n` of its power series. Those up to degree 8 are taken: shear lag
    /// of a stiff layer is of degree 1, bending of degree 3, 4 or 6, and higher coefficients fall
    /// factorially. Above an interface without shear stress all minors have a power of `k` in
    /// common, which is left out, and `d` has another one, which `c22` has, too, or which makes `X`
    /// vanish on a rigid base: neither is a pole.
    #[inline(always)]
    fn nearest_pole<S: Simd>(&self, simd: S) -> f64 {
        const DEGREE: usize = 8;
        let splat = |value: f64| S::f64s::splat(simd, value);
        let slabs = || self.buried.iter().chain([&self.top]);
        let lost = slabs().filter(|slab| slab.interface.least() > 0.0).count();
        let degree = DEGREE + 2 * lost;
        // The coefficients of each minor.
        let mut y = vec![[splat(0.0); 5]; degree + 1];
        y[0] = self.base(simd);
        let lowest = |y: &[Minors<S>]| y.iter().position(|minors| minors[0][0] != 0.0);
        for slab in slabs() {
            for minors in &mut y {
                *minors = slab.in_unit::<S>(*minors);
            }
            slab.interface.pass_series(simd, &mut y);
            // The exponential series: each term is `k h N/n` times the term before.
            let mut term = y.clone();
            for n in 1..=degree {
                let factor = splat(slab.thickness / n as f64);
                for power in (n..=degree).rev() {
                    term[power] = scaled::<S>(factor, slab.n_times::<S>(term[power - 1]));
                    y[power] = sum::<S>(y[power], splat(1.0), term[power]);
                }
            }
            let unit = splat(1.0) / y[lowest(&y).expect("a layer is compliant")][0];
            for minors in &mut y {
                *minors = scaled::<S>(unit, *minors);
            }
        }
        let from = lowest(&y).expect("a layer is compliant");
        let mut nearest = f64::INFINITY;
        for (n, minors) in y[from..].iter().enumerate().skip(1).take(DEGREE) {
            nearest = nearest.min(minors[0][0].abs().powf(-1.0 / n as f64));
        }
        nearest
    }
}

impl VectorCompliance for LayeredCompliance {
    #[inline(always)]
    fn samples<S: Simd>(&self, simd: S, q: S::f64s) -> [S::f64s; 2] {
        let Samples { excess, slope, .. } = self.evaluate(simd, q);
        [excess, slope]
    }
}

impl SurfaceCompliance for LayeredCompliance {
    /// Poles were found as near to the real axis as 26.8 degrees; a plate on a thin incompressible
    /// layer has them at 30 degrees. With poles at 26 degrees, the ellipse of convergence of a
    /// panel `[c, 4c]` is 1.8: 16, 20, 24 and 32 points leave `1.8^{-32}`, `1.8^{-40}`,
    /// `1.8^{-48}` and `1.8^{-64}`.
    fn points(&self, tolerance: f64, oscillates: bool) -> usize {
        match tolerance {
            _ if oscillates => 32,
            1e-6.. => 16,
            1e-9.. => 20,
            1e-11.. => 24,
            _ => 32,
        }
    }

    fn sample_all(&self, q: &[f64]) -> AllSamples {
        sample_all(self, q)
    }

    fn smallest_scale(&self) -> f64 {
        self.smallest_scale
    }

    fn largest_excess(&self) -> f64 {
        self.largest_excess
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use interp::Elastic;

    use super::*;
    use crate::compliance::surface::Sample;
    use crate::compliance::surface::tests::assert_that_the_cut_off_bounds_the_rest;
    use crate::estimate::larger;
    use crate::stack::{Interface, Layer};

    /// Draws a stack of two to ten layers, with moduli over nine decades and thicknesses over four.
    pub fn random_stack(seed: u64) -> Stack {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let count = random.random_range(2..=10);
        let solid = |random: &mut Pcg64Mcg| {
            let young = 10_f64.powf(random.random_range(0.0..9.0));
            let poisson = match random.random_range(0..3) {
                0 => 0.5,
                1 => random.random_range(-0.9..0.5),
                _ => random.random_range(0.2..0.5),
            };
            Elastic::new(young, poisson).expect("physical")
        };
        let base = if random.random_bool(0.3) {
            Elastic::new(f64::INFINITY, 0.0).expect("physical")
        } else {
            solid(&mut random)
        };
        let layers: Vec<Layer> = (0..count)
            .map(|_| {
                let solid = solid(&mut random);
                Layer::bonded(solid, 10_f64.powf(random.random_range(-4.0..0.0)))
            })
            .collect();
        Stack::new(base, layers).expect("within the limits")
    }

    /// Draws a stack of one to ten layers, of which a third each is bonded, slides and has springs,
    /// whose stiffnesses are over 20 decades.
    pub fn random_stack_with_interfaces(seed: u64) -> Stack {
        let stack = random_stack(seed);
        let mut random = Pcg64Mcg::seed_from_u64(!seed);
        let mut layers = stack.layers().to_vec();
        layers.truncate(random.random_range(1..=layers.len()));
        let thickness: f64 = layers.iter().map(|layer| layer.thickness).sum();
        for layer in &mut layers {
            let unit = 1e9 / thickness;
            layer.interface = match random.random_range(0..3) {
                0 => Interface::Bonded,
                1 => Interface::Sliding,
                _ => Interface::Springs {
                    tangential: unit * 10_f64.powf(random.random_range(-18.0..2.0)),
                    normal: if random.random_bool(0.4) {
                        f64::INFINITY
                    } else {
                        unit * 10_f64.powf(random.random_range(-12.0..2.0))
                    },
                },
            };
        }
        Stack::new(stack.base(), layers).expect("within the limits")
    }

    /// Draws stacks, bonded ones and others.
    fn random_stacks(count: u64) -> impl Iterator<Item = Stack> {
        (0..count).map(|seed| match seed % 2 {
            0 => random_stack(seed),
            _ => random_stack_with_interfaces(seed),
        })
    }

    /// Beyond the cut-off, `X - 1` and `q X'` are below the tolerance for all stacks, as for films.
    /// Measured: at most 0.27 of the tolerance.
    #[test]
    fn the_cut_off_bounds_the_rest() {
        assert_that_the_cut_off_bounds_the_rest(
            random_stacks(4000).map(|stack| LayeredCompliance::new(&stack)),
        );
    }

    /// Groups of wave numbers, on both sides of the switch of every layer.
    #[test]
    fn many_samples_are_those_of_one_after_the_other() {
        for stack in random_stacks(400) {
            let compliance = LayeredCompliance::new(&stack);
            let q: Vec<f64> = (0..61)
                .map(|i| 10_f64.powf(-4.0 + 0.09 * f64::from(i)))
                .collect();
            let all = compliance.sample_all(&q);
            assert_eq!([all.excess.len(), all.slope.len()], [q.len(); 2]);
            for (i, &q) in q.iter().enumerate() {
                let Sample { excess, slope } = compliance.sample(q);
                assert_eq!([all.excess[i], all.slope[i]], [excess, slope], "{q}");
            }
        }
    }

    /// `X` of bonded layers is between those of two half-spaces; of others, below the energy of
    /// chosen stresses.
    #[test]
    fn the_excess_is_within_its_bound() {
        let mut closest: f64 = 0.0;
        for stack in random_stacks(2000) {
            let compliance = LayeredCompliance::new(&stack);
            for i in 0..80 {
                let q = 10_f64.powf(-8.5 + 0.125 * f64::from(i));
                let share = compliance.sample(q).excess.abs() / compliance.largest_excess();
                closest = larger(closest, share);
            }
        }
        println!("the largest excess is {closest:.3} of the bound");
        assert!(closest <= 1.0 + 1e-12);
    }
}
