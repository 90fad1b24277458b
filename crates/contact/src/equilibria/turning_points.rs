//! The turning points of the equilibria, and the sections between them.

use std::sync::OnceLock;

use crate::Error;
use crate::line_energy::LineEnergy;
use crate::made::made;
use crate::root::root;
use crate::shape::Shape;
use crate::{Branch, Contact, Control, Equilibria};
use interp::LoadAndPenetration;

/// The number of intervals of the search grid between two radii at which an imposed value is kept
/// beyond the last turning point.
const STRIDE: usize = 7;

/// An interval of contact radii between two neighbouring turning points, or ends of the range.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Section {
    /// The logarithms of the smallest and largest contact radius.
    pub u: [f64; 2],
    /// The imposed values at these two radii.
    pub imposed: [f64; 2],
    /// Whether the imposed value grows with the radius, so that the equilibria are stable.
    pub rises: bool,
}

impl Section {
    /// Tells whether an imposed value occurs in the section.
    pub(crate) fn holds(&self, imposed: f64) -> bool {
        let [first, last] = self.imposed;
        (first.min(last)..=first.max(last)).contains(&imposed)
    }
}

impl Contact {
    /// Finds the turning points of the equilibria with another energy of the contact line, under
    /// any probe but a flat punch.
    pub(crate) fn equilibria_with(
        &self,
        energy: LineEnergy,
        control: Control,
    ) -> Result<Equilibria<'_>, Error> {
        control.check()?;
        let imposed = |u: f64| {
            let a = self.radius_at(u);
            self.load_and_penetration(a, energy.at(a))
                .map(|(load, penetration)| control.imposed(load, penetration))
        };
        let slope = |u: f64| {
            self.state_and_slopes(self.radius_at(u), energy)
                .map(|(_, [load, penetration])| control.imposed(load, penetration))
        };
        let mut grid = self.search_grid()?;
        let mut rising = grid.len();
        while rising > 0 && self.surely_rises(self.radius_at(grid[rising - 1]), energy, control)? {
            rising -= 1;
        }
        // The search ends with the first radius from which on the imposed value surely rises.
        let searched = grid.len().min(rising + 1);
        let beyond = grid.split_off(searched);
        let (first, last) = (grid[0], grid[searched - 1]);
        let slopes: Vec<f64> = grid.iter().map(|&u| slope(u)).collect::<Result<_, _>>()?;

        let mut sections = Vec::new();
        let (mut start, mut rises) = ((first, imposed(first)?), slopes[0] >= 0.0);
        let mut end_section = |end: f64, rises: bool| {
            let value = imposed(end)?;
            sections.push(Section {
                u: [start.0, end],
                imposed: [start.1, value],
                rises,
            });
            start = (end, value);
            Ok::<_, Error>(())
        };
        for k in 1..grid.len() {
            if (slopes[k] >= 0.0) != rises {
                end_section(root(slope, grid[k - 1], grid[k])?, rises)?;
                rises = !rises;
            } else if let Some(next) = slopes.get(k + 1)
                && (*next >= 0.0) == rises
                && slopes[k].abs() < slopes[k - 1].abs()
                && slopes[k].abs() <= next.abs()
                && let Some(between) = other_sign(slope, grid[k - 1], grid[k + 1], rises)?
            {
                // The neighbours of the point have the same sign as the point itself.
                for [from, to] in [[grid[k - 1], between], [between, grid[k + 1]]] {
                    end_section(root(slope, from, to)?, rises)?;
                    rises = !rises;
                }
            }
        }
        end_section(last, rises)?;
        let ends = beyond
            .rchunks(STRIDE)
            .rev()
            .filter_map(|radii| radii.last());
        Ok(Equilibria {
            contact: self,
            energy,
            control,
            sections,
            beyond: ends.map(|&u| (u, OnceLock::new())).collect(),
        })
    }

    /// Tells whether the imposed value is known to grow with the contact radius at radius `a` (m)
    /// from bounds that take less time than the slopes themselves.
    fn surely_rises(&self, a: f64, energy: LineEnergy, control: Control) -> Result<bool, Error> {
        let Some(least) = self.least_slopes(a)? else {
            return Ok(false);
        };
        let lowered = if energy.at(a) == 0.0 {
            LoadAndPenetration::ZERO
        } else {
            let (values, relative) = self.quantities_and_relative_slopes(a)?;
            self.lowered_and_slopes(a, energy, &values, &relative)?[1]
        };
        let imposed = |of: LoadAndPenetration| control.imposed(of.load, of.penetration);
        Ok(imposed(least) > imposed(lowered))
    }

    /// Returns the logarithms of contact radii between which the signs of the slopes are compared: a
    /// grid over the nodes on a film, and from below the first bend of the shape on. On a half-space
    /// without bends, where there is one turning point, they are the ends of the range.
    fn search_grid(&self) -> Result<Vec<f64>, Error> {
        /// The distance of the points. The curve of a film is so smooth that the slope under a paraboloid
        /// shows its extrema on the wider grid.
        const STEP: f64 = 0.05;
        const STEP_OF_PARABOLOID: f64 = 0.2;
        /// The part of the smallest radius of a bend where the bend does not matter yet.
        const BEFORE: f64 = 1e-3;
        /// The least number of intervals.
        const FEWEST: f64 = 16.0;
        /// The points after a bend, over the distance to the next point. There the slope changes like
        /// the root of the distance, or after a flat end like its inverse.
        const AFTER: [f64; 6] = [1e-3, 4e-3, 1.6e-2, 0.0625, 0.25, 0.5625];
        /// The largest rounding of a logarithm of a radius.
        const ROUNDING: f64 = 1e-12;
        let [smallest, largest] = self.search_range()?;
        let bends = self.bends();
        let before = bends.first().map_or(largest, |bend| BEFORE * bend);
        let node = self.node_radii().map_or(largest, |[from, _]| from);
        let first = node.min(before).min(largest).max(smallest);
        let length = (largest / first).ln();
        let intervals = if length > 0.0 {
            let step = match self.shape {
                Shape::Paraboloid { .. } => STEP_OF_PARABOLOID,
                _ => STEP,
            };
            (length / step).ceil().max(FEWEST)
        } else {
            1.0
        };
        let mut grid = vec![smallest.ln()];
        grid.extend(
            (0..=intervals as usize).map(|i| largest.ln() - length * (1.0 - i as f64 / intervals)),
        );
        // That of a flat end is the beginning of the range.
        let bends: Vec<f64> = bends.iter().map(|bend| bend.max(smallest).ln()).collect();
        let inside = |u: &&f64| **u > smallest.ln() && **u < largest.ln();
        grid.extend(bends.iter().filter(inside));
        grid.sort_by(f64::total_cmp);
        // Two points that differ by rounding alone have no points between them.
        let is_same = |one: f64, other: f64| (one - other).abs() <= ROUNDING;
        grid.dedup_by(|next, before| is_same(*next, *before));
        let mut graded = Vec::with_capacity(grid.len() + AFTER.len() * bends.len());
        for pair in grid.windows(2) {
            graded.push(pair[0]);
            if bends.iter().any(|bend| is_same(*bend, pair[0])) {
                graded.extend(AFTER.map(|part| pair[0] + part * (pair[1] - pair[0])));
            }
        }
        graded.extend(grid.last());
        Ok(graded)
    }
}

/// Returns a point between `from` and `to` at which a `slope` has another sign than at both ends,
/// where it `rises` or not, by Fibonacci's search for the extremum; `None` if there is none.
fn other_sign(
    slope: impl Fn(f64) -> Result<f64, Error>,
    mut from: f64,
    mut to: f64,
    rises: bool,
) -> Result<Option<f64>, Error> {
    /// The number of steps. Each shortens the interval by the golden ratio.
    const STEPS: usize = 30;
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let size = |u: f64| slope(u).map(|slope| if rises { slope } else { -slope });
    let is_other = |size: f64| if rises { size < 0.0 } else { size <= 0.0 };
    let inner = |from: f64, to: f64, part: f64| from + part * (to - from);
    let mut points = [1.0 - GOLDEN, GOLDEN].map(|part| inner(from, to, part));
    let mut sizes = [size(points[0])?, size(points[1])?];
    for _ in 0..STEPS {
        if let Some(i) = (0..2).find(|&i| is_other(sizes[i])) {
            return Ok(Some(points[i]));
        }
        if sizes[0] < sizes[1] {
            to = points[1];
            let new = inner(from, to, 1.0 - GOLDEN);
            (points, sizes) = ([new, points[0]], [size(new)?, sizes[0]]);
        } else {
            from = points[0];
            let new = inner(from, to, GOLDEN);
            (points, sizes) = ([points[1], new], [sizes[1], size(new)?]);
        }
    }
    Ok(None)
}

impl Equilibria<'_> {
    /// Returns a section by number. The last one reaches as far as an imposed value needs, or to the
    /// end of the range.
    pub(crate) fn section(&self, number: usize, imposed: f64) -> Result<Section, Error> {
        let mut section = self.sections[number];
        if number + 1 < self.sections.len() {
            return Ok(section);
        }
        for (u, value) in &self.beyond {
            if imposed <= section.imposed[1] {
                break;
            }
            let value = made(value, || Ok::<_, Error>(self.imposed(&self.state(*u)?)))?;
            (section.u[1], section.imposed[1]) = (*u, *value);
        }
        Ok(section)
    }

    /// Returns the section of a branch that holds an imposed value, and its number; `None` if no
    /// section does.
    pub(crate) fn section_of(
        &self,
        branch: Branch,
        imposed: f64,
    ) -> Result<Option<(usize, Section)>, Error> {
        let count = self.sections.len();
        for i in 0..count {
            let number = match branch {
                Branch::Loading => i,
                Branch::Unloading => count - 1 - i,
            };
            let section = self.section(number, imposed)?;
            if section.rises && section.holds(imposed) {
                return Ok(Some((number, section)));
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use interp::{Elastic, Probe, Profile, System, Table};

    /// Slopes at points forty times as near to each other as those of the search change their sign where
    /// the search found it, and nowhere else, on films of all kinds, at all sizes of the turning points.
    #[test]
    fn a_paraboloid_has_no_other_turning_points() -> Result<(), Error> {
        const PARTS: usize = 40;
        let mut counts = [0; 6];
        for i in 0..600 {
            let part = |step: f64| f64::from(i) * step % 1.0;
            // The inverse powers of the roots of `x^3 = x + 1` and of `x^4 = x + 1`.
            let [film, substrate, nu, w] =
                [0.754_877_666, 0.569_840_291, 0.819_172_513, 0.671_043_607].map(part);
            let probe = match i % 2 {
                0 => Probe::Paraboloid { radius: 1e-3 },
                _ => Probe::Sphere { radius: 1e-3 },
            };
            let system = System {
                probe,
                sphere_modulus: if i % 3 == 0 { f64::INFINITY } else { 1e6 },
                film: Elastic::new(1e6 * 10_f64.powf(6.0 * film - 3.0), 0.5 * nu)?,
                film_thickness: 1e-6,
                substrate: Elastic::new(1e6 * 10_f64.powf(5.0 * substrate), 0.3)?,
            };
            let contact = Contact::in_table(Table::embedded(), &system)?;
            let energy = LineEnergy::of_jkr(10_f64.powf(12.0 * w - 9.0));
            for control in [
                Control::Load,
                Control::Displacement,
                Control::Spring { stiffness: 1.0 },
            ] {
                let found = contact.equilibria_with(energy, control)?;
                let grid = contact.search_grid()?;
                let [first, others @ ..] = &found.sections[..] else {
                    unreachable!("there is a section")
                };
                let mut turns = others.iter().map(|section| section.u[0]).peekable();
                let mut rises = first.rises;
                for pair in grid.windows(2) {
                    for part in 1..=PARTS {
                        let at = |part: usize| {
                            pair[0] + (pair[1] - pair[0]) * part as f64 / PARTS as f64
                        };
                        let (from, to) = (at(part - 1), at(part));
                        let (_, [load, penetration]) =
                            contact.state_and_slopes(contact.radius_at(to), energy)?;
                        let slope = control.imposed(load, penetration);
                        rises ^= turns.next_if(|turn| *turn <= to).is_some();
                        assert!(
                            slope == 0.0 || (slope > 0.0) == rises,
                            "{system:?}, {control:?}: {slope} between {from} and {to}"
                        );
                    }
                }
                counts[found.sections.len() - 1] += 1;
            }
        }
        println!("contacts with 0, 1, 2 ... turning points: {counts:?}");
        assert!(counts[3] > 0, "several turning points: {counts:?}");
        Ok(())
    }

    /// The exact slopes, which the search does not compute where the bounds suffice, are larger than
    /// the bounds on films of every kind.
    #[test]
    fn slopes_without_adhesion_are_larger_than_their_bounds() -> Result<(), Error> {
        let profile: Vec<[f64; 2]> = (0..40)
            .map(f64::from)
            .map(|i| [1e-6 * i, 1e4 * (1e-6 * i).powi(2)])
            .collect();
        let probes = [
            Probe::Cone { half_angle: 1.2 },
            Probe::RoundedCone {
                radius: 1e-5,
                half_angle: 1.2,
            },
            Probe::FlatEndedCone {
                radius: 1e-6,
                half_angle: 1.2,
            },
            Probe::PowerLaw {
                coefficient: 1e6,
                exponent: 2.5,
            },
            Probe::PowerLaw {
                coefficient: 1.0,
                exponent: 1.2,
            },
            Probe::Profile(Profile::new(&profile)?),
        ];
        let mut least = f64::INFINITY;
        for probe in probes {
            for [film_modulus, substrate] in [
                [1e3, 1e6],
                [1e3, 1e9],
                [1e5, 1e6],
                [8e5, 1e6],
                [1.2e6, 1e6],
                [1e7, 1e6],
                [1e9, 1e6],
            ] {
                for nu in [0.0, 0.3, 0.45, 0.499, 0.5] {
                    let system = System {
                        probe: probe.clone(),
                        sphere_modulus: f64::INFINITY,
                        film: Elastic::new(film_modulus, nu)?,
                        film_thickness: 1e-6,
                        substrate: Elastic::new(substrate, 0.3)?,
                    };
                    let contact = Contact::in_table(Table::embedded(), &system)?;
                    for u in contact.search_grid()?.into_iter().step_by(4) {
                        let a = contact.radius_at(u);
                        let Some(bound) = contact.least_slopes(a)? else {
                            assert!(system.film.reduced() > system.substrate.reduced());
                            continue;
                        };
                        let (_, own) = contact.adhesionless_and_slopes(a)?;
                        if bound.penetration > 0.0 {
                            least = least.min(own.penetration / bound.penetration);
                        }
                        assert!(
                            own.penetration >= bound.penetration && own.load >= bound.load,
                            "{system:?} at {a}: {own:?}, {bound:?}"
                        );
                    }
                }
            }
        }
        println!("{least}");
        Ok(())
    }
}
