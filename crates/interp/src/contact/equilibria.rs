//! The equilibria of a contact with a given work of adhesion: which there are at a given load or
//! penetration, which are stable, and where the contact separates.

use crate::contact::mechanics::work_of_adhesion;
use crate::contact::root::root;
use crate::{Contact, Error, State};

/// What is imposed on the contact. It decides which equilibria are stable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// The load `F`, N: a dead weight.
    Load,
    /// The penetration `delta`, m: a rigid machine.
    Displacement,
    /// The position `delta + F/k` (m) of the far end of a spring in series with the contact, as of
    /// a cantilever: 0 where the sphere would just touch.
    Spring {
        /// The stiffness `k` of the spring, N/m, from 1e-100 to 1e100.
        stiffness: f64,
    },
}

impl Control {
    /// The name of what is imposed.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::Displacement => "penetration",
            Self::Spring { .. } => "position of the spring",
        }
    }

    /// Accepts a spring whose stiffness is a number to compute with.
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

    /// The imposed value at a load and a penetration, or its slope from theirs.
    pub(crate) fn imposed(self, load: f64, penetration: f64) -> f64 {
        match self {
            Self::Load => load,
            Self::Displacement => penetration,
            Self::Spring { stiffness } => penetration + load / stiffness,
        }
    }
}

/// One of the equilibria at an imposed value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium {
    /// The contact.
    pub state: State,
    /// Whether the contact returns to it after a small change of its radius: whether the imposed
    /// value grows with the contact radius.
    pub stable: bool,
}

/// The equilibria of a contact with one work of adhesion under one control, at all contact radii of
/// [`Contact::contact_radius_range`]: "in range" below.
///
/// At each contact radius there is one equilibrium, `G = w`, and so one imposed value `v(a)`: the
/// load, the penetration or the spring's position. Where `v` grows with `a` the equilibrium is
/// stable: at the same `v`, a contact a little larger has `G > w`, and opens again. The turning
/// points of `v` are sought on a grid of `ln a`, by the change of sign of the exact slope, and then
/// found to rounding. Two within one interval of the grid, 0.05, would go unseen, and with them a
/// hysteresis too small to matter.
///
/// JKR has one turning point, a minimum, and so has a contact that is smaller than the curve's
/// nodes. Films can make further ones, and then several stable equilibria at one `v`.
#[derive(Clone, Debug)]
pub struct Equilibria<'a> {
    pub(crate) contact: &'a Contact,
    pub(crate) work_of_adhesion: f64,
    pub(crate) control: Control,
    /// From the smallest contact radius to the largest.
    pub(crate) sections: Vec<Section>,
}

/// Contact radii between two neighbouring turning points, or ends of the range.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Section {
    /// The logarithms of the smallest and largest contact radius.
    pub u: [f64; 2],
    /// The imposed values there.
    pub imposed: [f64; 2],
    /// Whether the imposed value grows: the equilibria are stable.
    pub rises: bool,
}

impl Section {
    fn holds(&self, imposed: f64) -> bool {
        let [first, last] = self.imposed;
        (first.min(last)..=first.max(last)).contains(&imposed)
    }
}

impl Contact {
    /// The equilibria with work of adhesion `w` (J/m^2). This seeks the turning points; each
    /// question that is then asked takes a few lookups.
    ///
    /// ```
    /// # #[cfg(feature = "embedded")]
    /// # fn main() -> Result<(), interp::Error> {
    /// # use interp::{Control, Elastic, System, Table};
    /// # let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?);
    /// # let system = System { sphere_radius: 1e-3, sphere_modulus: 2e6, film, film_thickness: 1e-5, substrate };
    /// let contact = Table::embedded().contact(&system)?;
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
        control.check()?;
        let imposed = |u: f64| {
            self.load_and_penetration(u.exp(), w)
                .map(|(load, penetration)| control.imposed(load, penetration))
        };
        let slope = |u: f64| {
            self.slopes(u.exp(), w)
                .map(|(load, penetration)| control.imposed(load, penetration))
        };
        let places = self.search_grid();
        let (first, last) = (places[0], places[places.len() - 1]);
        let rises_at = |u: f64| slope(u).map(|slope| slope >= 0.0);

        let mut sections = Vec::new();
        let (mut start, mut rises) = ((first, imposed(first)?), rises_at(first)?);
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
        for pair in places.windows(2) {
            if rises_at(pair[1])? != rises {
                end_section(root(slope, pair[0], pair[1])?, rises)?;
                rises = !rises;
            }
        }
        end_section(last, rises)?;
        Ok(Equilibria {
            contact: self,
            work_of_adhesion: w,
            control,
            sections,
        })
    }

    /// Where a contact with work of adhesion `w` (J/m^2) separates on unloading: see
    /// [`Equilibria::pull_off`].
    ///
    /// # Errors
    /// Those of [`Contact::equilibria`] and [`Equilibria::pull_off`].
    pub fn pull_off(&self, w: f64, control: Control) -> Result<State, Error> {
        self.equilibria(w, control)?.pull_off()
    }

    /// The stable contact with work of adhesion `w` (J/m^2) under no load, the one that unloading
    /// under load control reaches: see [`Equilibria::unloading`]. Without adhesion it is
    /// [`State::ORIGIN`].
    ///
    /// # Errors
    /// Those of [`Contact::equilibria`] and [`Equilibria::unloading`].
    pub fn zero_load(&self, w: f64) -> Result<State, Error> {
        self.equilibria(w, Control::Load)?.unloading(0.0)
    }

    /// [`Contact::contact_radius_range`] with numbers to compute with for 0 and infinity.
    pub(crate) fn search_range(&self) -> [f64; 2] {
        const SMALLEST: f64 = 1e-60;
        const LARGEST: f64 = 1e60;
        let [from, to] = self.node_radii().unwrap_or([SMALLEST, LARGEST]);
        [
            if self.goes_on_to_zero() {
                SMALLEST.min(from)
            } else {
                from
            },
            to,
        ]
    }

    /// Logarithms of contact radii that have at most one turning point from each to the next: on
    /// films, those of a grid.
    fn search_grid(&self) -> Vec<f64> {
        const STEP: f64 = 0.05;
        let [smallest, largest] = self.search_range();
        let (Some(curve), Some([from, _])) = (self.curve(), self.node_radii()) else {
            return vec![smallest.ln(), largest.ln()];
        };
        let length = (curve.range()[1] / curve.range()[0]).ln();
        let intervals = (length / STEP).ceil().max(1.0);
        let nodes =
            (0..=intervals as usize).map(|i| largest.ln() - length * (1.0 - i as f64 / intervals));
        (smallest < from)
            .then(|| smallest.ln())
            .into_iter()
            .chain(nodes)
            .collect()
    }

    /// What to say of a state whose contact radius is out of range.
    pub(crate) fn outside(&self, name: &'static str, value: f64) -> Error {
        let [from, to] = self.search_range();
        Error::OutsideRadii {
            name,
            value,
            from,
            to,
        }
    }
}

impl Equilibria<'_> {
    /// All equilibria in range at an imposed load (N), penetration or position of the spring (m),
    /// in ascending order of contact radius: none beyond pull-off. At a turning point the stable
    /// and the unstable equilibrium are one, called unstable at a minimum and stable at a maximum.
    /// An unstable one whose contact radius is smaller than the range is left out.
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

    /// The stable equilibrium at an imposed value that unloading from a large contact reaches: the
    /// one of the largest contact radius.
    ///
    /// # Errors
    /// Those of [`Equilibria::at`], and [`Error::NoContact`] for a value below that of
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

    /// The stable equilibrium at an imposed value that loading reaches after the sphere has
    /// touched: the one of the smallest contact radius.
    ///
    /// Surfaces that attract each other over no distance meet where load and penetration are 0.
    /// There the contact grows at once to `loading(0.0)`.
    ///
    /// # Errors
    /// Those of [`Equilibria::at`]; [`Error::NoContact`] for a negative value: the sphere does not
    /// touch yet.
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

    /// Where the contact finally separates on unloading: the equilibrium of least imposed value.
    ///
    /// Unloading follows the stable equilibria of the largest contact radius down to where they
    /// end, at a minimum of the imposed value. If there is another stable equilibrium with a
    /// smaller contact radius at this value, the contact jumps to it and unloading goes on from
    /// there. So the minimum from which there is nothing left to jump to is the least of all.
    /// [`Equilibria::force_displacement`] gives the jumps before it. Without adhesion it is
    /// [`State::ORIGIN`].
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] if its contact radius is out of range.
    pub fn pull_off(&self) -> Result<State, Error> {
        if self.adhesionless() {
            return Ok(State::ORIGIN);
        }
        let [first, last] = self.ends();
        if first.rises || !last.rises {
            return Err(self
                .contact
                .outside("the pull-off at work of adhesion", self.work_of_adhesion));
        }
        let stable = self.sections.iter().filter(|section| section.rises);
        let least = stable
            .min_by(|a, b| a.imposed[0].total_cmp(&b.imposed[0]))
            .unwrap_or(last);
        self.state(least.u[0])
    }

    pub(crate) fn adhesionless(&self) -> bool {
        self.work_of_adhesion == 0.0
    }

    /// The first and the last section.
    fn ends(&self) -> [&Section; 2] {
        [&self.sections[0], &self.sections[self.sections.len() - 1]]
    }

    /// Accepts an imposed value if no stable equilibrium has a contact radius out of range.
    pub(crate) fn check(&self, imposed: f64) -> Result<(), Error> {
        Error::unless(imposed.is_finite(), self.control.name(), imposed, "finite")?;
        let [first, last] = self.ends();
        let below =
            first.rises && imposed < first.imposed[0] && !(self.adhesionless() && imposed <= 0.0);
        let within = last.rises && imposed <= last.imposed[1] && !below;
        if within {
            Ok(())
        } else {
            Err(self.contact.outside(self.control.name(), imposed))
        }
    }

    /// The state at the logarithm of a contact radius.
    pub(crate) fn state(&self, u: f64) -> Result<State, Error> {
        self.contact.state(u.exp(), self.work_of_adhesion)
    }

    /// The imposed value of a state.
    pub(crate) fn imposed(&self, state: &State) -> f64 {
        self.control.imposed(state.load, state.penetration)
    }

    /// The logarithm of the contact radius at which a section, which holds it, has an imposed
    /// value.
    pub(crate) fn place(&self, section: &Section, imposed: f64) -> Result<f64, Error> {
        root(
            |u| Ok(self.imposed(&self.state(u)?) - imposed),
            section.u[0],
            section.u[1],
        )
    }

    fn find(&self, section: &Section, imposed: f64) -> Result<State, Error> {
        self.state(self.place(section, imposed)?)
    }
}
