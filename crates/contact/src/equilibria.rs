//! The equilibria of a contact with a given work of adhesion under a load, a penetration or a
//! spring, their stability, and the separation.

use super::line_energy::LineEnergy;
use super::root::root;
use crate::{Contact, State};
use interp::Error;
use interp::check::{finite_input, work_of_adhesion};

/// The quantity that is imposed on the contact. The stability of the equilibria depends on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// The load `F`, N: a dead weight.
    Load,
    /// The penetration `delta`, m: a rigid testing machine.
    Displacement,
    /// The position `delta + F/k` (m) of the far end of a spring in series with the contact, such
    /// as a cantilever. It is 0 where the sphere would just touch.
    Spring {
        /// The stiffness `k` of the spring, N/m, from 1e-100 to 1e100.
        stiffness: f64,
    },
}

impl Control {
    /// Returns the name of the imposed quantity.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::Displacement => "penetration",
            Self::Spring { .. } => "position of the spring",
        }
    }

    /// Accepts a spring unless its stiffness is so extreme that computations would overflow.
    pub(crate) fn check(self) -> Result<(), Error> {
        match self {
            Self::Spring { stiffness } => Error::unless(
                (1e-100..=1e100).contains(&stiffness),
                "stiffness of the spring",
                stiffness,
                "in [1e-100, 1e100] N/m",
            ),
            _ => Ok(()),
        }
    }

    /// Returns the imposed value at a `load` (N) and a `penetration` (m), or its slope from their
    /// slopes.
    pub fn imposed(self, load: f64, penetration: f64) -> f64 {
        match self {
            Self::Load => load,
            Self::Displacement => penetration,
            Self::Spring { stiffness } => penetration + load / stiffness,
        }
    }
}

/// An equilibrium at an imposed value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium {
    /// The state of the contact.
    pub state: State,
    /// Whether the contact returns to this state after a small change of its radius. It does where
    /// the imposed value grows with the contact radius.
    pub stable: bool,
}

/// The equilibria of a contact with one work of adhesion under one control, at all contact radii of
/// [`Contact::contact_radius_range`]. "In range" below means in this range.
///
/// At each contact radius there is one equilibrium, `G = w`, and so one imposed value `v(a)`: the
/// load, the penetration or the spring's position. The equilibrium is stable where `v` grows with
/// `a`, because a slightly larger contact at an unchanged `v` has `G > w`, and shrinks back.
///
/// The turning points of `v` are found by the change of sign of its exact slope on a grid of
/// `ln a`, at most 0.05 apart, which contains the radii where the shape bends and points between
/// them; and then refined to rounding. Where the slope comes nearer to 0 at a point of the grid than
/// at both of its neighbours without a change of sign, its extremum is searched, too. Two turning
/// points are missed only between two neighbouring points of the grid at which the slope does not
/// show its extremum; their hysteresis is too small to matter.
///
/// JKR has one turning point, a minimum, and so has a contact that is smaller than the curve's
/// nodes, under a shape that does not bend there. Films and bends can cause more turning points, and
/// then several stable equilibria at one `v`.
#[derive(Clone, Debug)]
pub struct Equilibria<'a> {
    pub(crate) contact: &'a Contact,
    pub(crate) energy: LineEnergy,
    pub(crate) control: Control,
    /// In ascending order of contact radius.
    pub(crate) sections: Vec<Section>,
}

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
    /// Finds the turning points of the equilibria with work of adhesion `w` (J/m^2) under a
    /// `control`.
    ///
    /// Each function of the result then takes a few evaluations of the curve.
    ///
    /// ```
    /// # #[cfg(feature = "embedded")]
    /// # fn main() -> Result<(), interp::Error> {
    /// # use interp::{Elastic, Probe, System, Table};
    /// # use contact::Control;
    /// # let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?);
    /// # let system = System { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, film, film_thickness: 1e-5, substrate };
    /// let contact = Contact::in_table(Table::embedded(), &system)?;
    /// let equilibria = contact.equilibria(0.04, Control::Load)?;
    /// let at_rest = equilibria.unloading(0.0)?; // 67.06 um
    /// assert!((at_rest.contact_radius / 67.06e-6 - 1.0).abs() < 1e-4);
    /// for equilibrium in equilibria.at(-1e-4)? {
    ///     println!("{} m, stable: {}", equilibrium.state.contact_radius, equilibrium.stable);
    /// }
    /// # Ok(()) }
    /// # #[cfg(not(feature = "embedded"))]
    /// # fn main() {}
    /// ```
    ///
    /// # Errors
    /// [`Error::Unphysical`] for a `w` that is negative, infinite or NaN, or a spring's stiffness
    /// outside `[1e-100, 1e100]`; [`Error::MissingQuantity`] without `pi0`, `delta0` and, with
    /// adhesion, `eeq` and `gamma`.
    pub fn equilibria(&self, w: f64, control: Control) -> Result<Equilibria<'_>, Error> {
        work_of_adhesion(w)?;
        if self.is_punch() {
            control.check()?;
            return self.equilibria_of_punch(w, control);
        }
        self.equilibria_with(LineEnergy::of_jkr(w), control)
    }

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
        let grid = self.search_grid()?;
        let (first, last) = (grid[0], grid[grid.len() - 1]);
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
            Ok(())
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
        Ok(Equilibria {
            contact: self,
            energy,
            control,
            sections,
        })
    }

    /// Returns the equilibria of a flat punch. Its line stays at the edge of the punch, so that there
    /// is one stable equilibrium at every imposed value from that of the pull-off on.
    fn equilibria_of_punch(&self, w: f64, control: Control) -> Result<Equilibria<'_>, Error> {
        let [radius, _] = self.contact_radius_range();
        let (load, penetration) = self.load_and_penetration(radius, w)?;
        Ok(Equilibria {
            contact: self,
            energy: LineEnergy::of_jkr(w),
            control,
            sections: vec![Section {
                u: [radius.ln(); 2],
                imposed: [control.imposed(load, penetration), f64::MAX],
                rises: true,
            }],
        })
    }

    /// Returns the state in which a contact with work of adhesion `w` (J/m^2) separates on
    /// unloading, [`Equilibria::pull_off`].
    ///
    /// # Errors
    /// As [`Contact::equilibria`] and [`Equilibria::pull_off`].
    pub fn pull_off(&self, w: f64, control: Control) -> Result<State, Error> {
        self.equilibria(w, control)?.pull_off()
    }

    /// Returns the stable state with work of adhesion `w` (J/m^2) at zero load.
    ///
    /// It is the state that unloading under load control reaches, [`Equilibria::unloading`].
    /// Without adhesion it is [`State::ORIGIN`].
    ///
    /// # Errors
    /// As [`Contact::equilibria`] and [`Equilibria::unloading`].
    pub fn zero_load(&self, w: f64) -> Result<State, Error> {
        self.equilibria(w, Control::Load)?.unloading(0.0)
    }

    /// Returns the logarithms of contact radii between which the signs of the slopes are compared: a
    /// grid over the nodes on a film, and from below the first bend of the shape on. On a half-space
    /// without bends, where there is one turning point, they are the ends of the range.
    fn search_grid(&self) -> Result<Vec<f64>, Error> {
        const STEP: f64 = 0.05;
        /// The part of the smallest radius of a bend where the bend does not matter yet.
        const BEFORE: f64 = 1e-3;
        /// The least number of intervals.
        const FEWEST: f64 = 16.0;
        /// The points after a bend, over the distance to the next point. There the slope changes like
        /// the root of the distance, or after a flat end like its inverse.
        const AFTER: [f64; 6] = [1e-3, 4e-3, 1.6e-2, 0.0625, 0.25, 0.5625];
        let [smallest, largest] = self.search_range()?;
        let bends = self.bends();
        let before = bends.first().map_or(largest, |bend| BEFORE * bend);
        let node = self.node_radii().map_or(largest, |[from, _]| from);
        let first = node.min(before).min(largest).max(smallest);
        let length = (largest / first).ln();
        let intervals = if length > 0.0 {
            (length / STEP).ceil().max(FEWEST)
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
        grid.dedup();
        let mut graded = Vec::with_capacity(grid.len() + AFTER.len() * bends.len());
        for pair in grid.windows(2) {
            graded.push(pair[0]);
            if bends.contains(&pair[0]) {
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
    /// Returns all equilibria in range at an `imposed` load (N), penetration (m) or position of the
    /// spring (m), in ascending order of contact radius.
    ///
    /// There are none beyond pull-off. At a turning point the stable and the unstable equilibrium
    /// are one; it is called unstable at a minimum and stable at a maximum. An unstable equilibrium
    /// with a contact radius below the range is left out.
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] if a stable equilibrium has a contact radius out of range;
    /// [`Error::Unphysical`] if `imposed` is not finite.
    pub fn at(&self, imposed: f64) -> Result<Vec<Equilibrium>, Error> {
        self.check(imposed)?;
        if self.adhesionless() && imposed == 0.0 {
            return Ok(vec![Equilibrium {
                state: State::ORIGIN,
                stable: true,
            }]);
        }
        let sections = self.sections.iter().enumerate();
        // A turning point belongs to the section that ends there.
        let here = sections.filter(|(i, section)| {
            section.holds(imposed) && (*i == 0 || imposed != section.imposed[0])
        });
        here.map(|(_, section)| {
            Ok(Equilibrium {
                state: self.find(section, imposed)?,
                stable: section.rises,
            })
        })
        .collect()
    }

    /// Returns the stable equilibrium at an `imposed` value that unloading from a large contact
    /// reaches: that of the largest contact radius.
    ///
    /// # Errors
    /// As [`Equilibria::at`]; [`Error::NoContact`] for a value below that of
    /// [`Equilibria::pull_off`].
    pub fn unloading(&self, imposed: f64) -> Result<State, Error> {
        self.check(imposed)?;
        if self.adhesionless() && imposed == 0.0 {
            return Ok(State::ORIGIN);
        }
        match self
            .sections
            .iter()
            .rev()
            .find(|section| section.rises && section.holds(imposed))
        {
            Some(section) => self.find(section, imposed),
            None => {
                let values = self.sections.iter().flat_map(|section| section.imposed);
                let least = if self.adhesionless() {
                    0.0
                } else {
                    values.fold(f64::INFINITY, f64::min)
                };
                Err(Error::NoContact {
                    name: self.control.name(),
                    value: imposed,
                    least,
                })
            }
        }
    }

    /// Returns the stable equilibrium at an `imposed` value that loading reaches after the first
    /// touch: that of the smallest contact radius.
    ///
    /// The attraction has no range, so the surfaces meet where load and penetration are 0. There
    /// the contact grows at once to `loading(0.0)`.
    ///
    /// # Errors
    /// As [`Equilibria::at`]; [`Error::NoContact`] for a negative value, at which the sphere does
    /// not touch yet.
    pub fn loading(&self, imposed: f64) -> Result<State, Error> {
        self.check(imposed)?;
        if imposed < 0.0 {
            return Err(Error::NoContact {
                name: self.control.name(),
                value: imposed,
                least: 0.0,
            });
        }
        if self.adhesionless() && imposed == 0.0 {
            return Ok(State::ORIGIN);
        }
        let first = &self.sections[0];
        let starts_in_range = first.imposed[0] <= if first.rises { imposed } else { 0.0 };
        match self
            .sections
            .iter()
            .find(|section| section.rises && section.holds(imposed))
        {
            Some(section) if starts_in_range => self.find(section, imposed),
            _ => Err(self.contact.outside(self.control.name(), imposed)),
        }
    }

    /// Returns the state in which the contact finally separates on unloading: the equilibrium of
    /// the smallest imposed value.
    ///
    /// Under a flat end, the smallest contact has the radius of the end, and may be this state.
    ///
    /// Unloading follows the stable equilibria of the largest contact radius down to their end, a
    /// minimum of the imposed value. If another stable equilibrium with a smaller contact radius
    /// exists at this value, the contact jumps to it, and unloading continues from there. No
    /// equilibrium is left to jump to at the smallest of all minima.
    ///
    /// [`Equilibria::force_displacement`] gives the jumps before the separation. Without adhesion
    /// the state is [`State::ORIGIN`].
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] if its contact radius is out of range.
    pub fn pull_off(&self) -> Result<State, Error> {
        if self.adhesionless() {
            return Ok(State::ORIGIN);
        }
        let [first, last] = self.ends();
        if (first.rises && !self.contact.has_flat_end()) || !last.rises {
            return Err(self.contact.outside(
                "the pull-off at work of adhesion",
                self.energy.work_of_adhesion(),
            ));
        }
        let stable = self.sections.iter().filter(|section| section.rises);
        let least = stable
            .min_by(|a, b| a.imposed[0].total_cmp(&b.imposed[0]))
            .unwrap_or(last);
        self.state(least.u[0])
    }

    pub(crate) fn adhesionless(&self) -> bool {
        self.energy.work_of_adhesion() == 0.0
    }

    /// Returns the first and the last section.
    fn ends(&self) -> [&Section; 2] {
        [&self.sections[0], &self.sections[self.sections.len() - 1]]
    }

    /// Accepts an imposed value unless a stable equilibrium may have a contact radius out of range.
    pub(crate) fn check(&self, imposed: f64) -> Result<(), Error> {
        finite_input(self.control.name(), imposed)?;
        let [first, last] = self.ends();
        // Below the contact of a flat end there is none.
        let below = first.rises
            && imposed < first.imposed[0]
            && !self.contact.has_flat_end()
            && !(self.adhesionless() && imposed <= 0.0);
        let within = last.rises && imposed <= last.imposed[1] && !below;
        if within {
            Ok(())
        } else {
            Err(self.contact.outside(self.control.name(), imposed))
        }
    }

    /// Returns the state at the contact radius with logarithm `u`.
    pub(crate) fn state(&self, u: f64) -> Result<State, Error> {
        let a = self.contact.radius_at(u);
        self.contact.state(a, self.energy.at(a))
    }

    /// Returns the imposed value of a state.
    pub(crate) fn imposed(&self, state: &State) -> f64 {
        self.control.imposed(state.load, state.penetration)
    }

    /// Returns the logarithm of the contact radius at which a section has an imposed value. The
    /// value must occur in the section.
    pub(crate) fn log_radius(&self, section: &Section, imposed: f64) -> Result<f64, Error> {
        root(
            |u| Ok(self.imposed(&self.state(u)?) - imposed),
            section.u[0],
            section.u[1],
        )
    }

    /// Returns the state of a section at an imposed value.
    fn find(&self, section: &Section, imposed: f64) -> Result<State, Error> {
        if self.contact.is_punch() {
            let [radius, _] = self.contact.contact_radius_range();
            let (state, _) = self.contact.state_under(self.control, imposed, radius)?;
            return Ok(state);
        }
        self.state(self.log_radius(section, imposed)?)
    }
}
