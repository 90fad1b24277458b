//! Numbers that compare a contact with the assumptions of the model, and thresholds for them.

use std::f64::consts::PI;

use crate::Contact;
use crate::Error;
use interp::check::finite_result;
use interp::{Curve, Probe, System};

/// The geometry of a contact, compared with the assumptions of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Validity {
    /// Contact radius over sphere radius, `a/R`; for a shape without a radius of curvature the slope
    /// of the shape at the edge, which under a paraboloid is `a/R`, and 0 under a flat punch. Of a
    /// paraboloid in place of a sphere, the adhesionless penetration is too small by the part
    /// `(a/R)^2/3` and more (Sneddon, Int. J. Eng. Sci. 3, 47, 1965: `(a/2) ln((R+a)/(R-a))` on a
    /// half-space).
    pub a_over_r: f64,
    /// The part by which the load at a given penetration falls if a sphere stands for its
    /// paraboloid, to the first order in `(a/R)^2`; 0 for other probes. It is the effect that
    /// [`Probe::Sphere`] adds.
    ///
    /// A sphere is its paraboloid and `r^4/(8 R^3)`, whose load `F4` and penetration `delta4` lower the
    /// load `F0` by the part `(S delta4 - F4)/F0`: the load at a given penetration is stationary at the
    /// contact radius. On a half-space it is `delta0/(10 R)`, on thin films up to ten times as much as
    /// this expression. It is this expression under full friction, and on a curve that begins at too large an `a/t`, where
    /// the quartic is not known; outside the nodes of the curve the part of `(a/R)^2` at the nearest one is
    /// taken.
    pub shape: f64,
    /// The part by which the load at a given penetration rises because the surface moves sideways
    /// under the sloping probe, which the model neglects: `3/(4 pi) (1 - 2 nu)/(1 - nu) a/R` times
    /// `1 - probe_share`, with the Poisson ratio of the film or half-space. An elastic probe is taken
    /// as incompressible, because the model does not know its Poisson ratio; one of the Poisson ratio
    /// `nu2` lowers the effect by the same expression with `nu2`, times `probe_share`.
    ///
    /// It follows from the displacement `u_r` of Hertz's contact on a half-space, which meets the
    /// shape at `r + u_r`. On a thin film it is an order of magnitude only. Under cones the effect
    /// is known since Hay, Bolshakov and Pharr, J. Mater. Res. 14, 2296 (1999).
    pub sideways: f64,
    /// The share of the probe in the compliance of probe and film, or half-space: `Es*/E2*`. The
    /// model takes an elastic probe for a half-space, to first order in `a/R`.
    pub probe_share: f64,
    /// The surface tension (N/m) that would raise the load of the contact without adhesion at its penetration by a tenth, if
    /// both bodies had it; infinite where a flat end only touches, and where the contact is not known. The model leaves surface
    /// tension out.
    ///
    /// To the first order a tension `T` adds the energy `T/2 int |grad u|^2 dA` of the displacement `u` without it, so that
    /// the load at a given penetration rises by the part `T pi a s^2 k/(F0 ddelta0/da)`, with the slope `s` of the probe at
    /// the edge. The displacement of the surface around the contact adds `k = 16/pi^2` on a half-space under a paraboloid,
    /// where the part is `6 T/(pi Es* a)`, and 1 where the contact is wide beside the film. Between them
    /// `1 + (16/pi^2 - 1)/(1 + a/t)` is taken: on incompressible layers, against another program, the part is 16 % of itself
    /// too large at `a/t = 1` and 5 % too small at 4, and under a cone on a half-space 17 % too large. Two bodies share the
    /// slope as they share the compliance.
    ///
    /// Beside a flat punch `grad u` has no finite square: the edge is rounded over a length of `T/Es*`, the part grows as
    /// `2 T/(pi Es* a) log(Es* a/T)`, and `0.03 Es* a` is taken, which holds on a half-space. On incompressible layers with `a/t`
    /// of 1 to 4 a tension of 0.018 `Es* a` suffices.
    ///
    /// Soft gels and elastomers in air have 0.02 to 0.07 N/m (Style and others, Nature Communications 4, 2728, 2013), the cortex of a
    /// cell some 1e-4 to 1e-3 N/m, and a gel in its liquid hardly any. A film of thickness `t` under a residual stress
    /// carries this stress times `t`.
    pub surface_tension: f64,
    /// The numbers of the film; `None` on a half-space.
    pub film: Option<FilmValidity>,
}

/// The numbers of [`Validity`] that depend on the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmValidity {
    /// Contact radius over film thickness, `a/t`, the degree of confinement (Shull, Mater. Sci.
    /// Eng. R 36, 1, 2002).
    pub a_over_t: f64,
    /// The compressibility of the film in this contact, `(3/16) (1 - 2 nu1)/(1 - nu1) (a/t)^2`.
    ///
    /// It is the ratio of two stiffnesses of a thin film under a flat frictionless punch. In the
    /// first the volume of the film is fixed, so that it flows sideways as in a squeeze film:
    /// `3 pi G1 a^4/(8 t^3)` on a rigid base. In the second the film cannot move sideways:
    /// `2 pi G1 a^2 (1 - nu1)/((1 - 2 nu1) t)`. Above 1, a thin film deforms by a change of its
    /// volume. Below 1, it behaves as incompressible, and its stress reaches deep into the contact.
    /// Near 1, every digit of `1/2 - nu1` counts (Johnson, *Contact Mechanics*, 5.8). Where `a/t` is
    /// above 1 and this is below 1, the film is confined: under tension a soft one may cavitate or
    /// finger instead of separating at a round edge, which the model does not describe.
    ///
    /// For a stack of layers it is the same ratio, of all layers together
    /// ([`Curve::of_stack`](interp::Curve::of_stack)), and `a/t` is with their whole thickness. It is
    /// NaN if a layer slides on what lies below, or is joined to it by springs: such layers yield
    /// sideways without being confined.
    pub compressibility: f64,
    /// The compression of the film over its thickness, `(delta0/t) (1 - S/S0)`: the part of the
    /// penetration without adhesion that the bare substrate, of stiffness `S0`, would not have at the
    /// same load. It is the size of the strain of the film, and the model is linear. Negative where
    /// the substrate is softer than the film. What springs between the layers open is taken off, about: it is no strain.
    /// Where the curve does not cover `a/t`, it is `delta0/t`
    /// with the penetration on a half-space.
    pub strain: f64,
    /// Whether `a/t` is between the first and the last node of the table or curve. Beyond them an
    /// expansion is used, or there is an error.
    pub in_range: bool,
    /// The part of its thickness by which the contact without adhesion bends a film that is stiffer than its
    /// substrate, `(delta0/t) (1 - S0/S)`, with `S0` as above; 0 for a softer film, and where the curve does not
    /// cover `a/t`. A film that is bent is stretched, too, and the model leaves out that this stiffens it: by the part
    /// `0.44 (w/t)^2` a clamped plate whose middle is pressed down by `w` (Timoshenko and Woinowsky-Krieger, *Theory of
    /// Plates and Shells*, 1959).
    ///
    /// Of a stack the top layer bends. `t` is its thickness, and `S0` is the stiffness of the half-space on which it would
    /// be as compliant as these layers; for one film this gives the same number to a tenth up to `a = 5 t`. With the bending
    /// length `l` (see below), it is 0 where `a` is above `4 l` and `l` below `3 t`: the thin layers of a graded film are no plates.
    pub bending: f64,
    /// Whether the contact without adhesion may be no disc, so that the loads are wrong: the film is so much stiffer than
    /// the substrate that it bends as a plate. With the bending length `l = t (E1*/(6 E0*))^{1/3}`:
    ///
    /// - up to `a = 2 l` it touches the flank of the probe outside the disc, where `E1*` is above `150 E0*` and `a l` above
    ///   `3 t^2`, under cones, powers below 1.5 and profiles. The true load of a cone is larger by up to 3 %, 28 % and 110 % on
    ///   films 200, 1,000 and 10,000 times as stiff as the substrate;
    /// - it lifts off inside, where `a` is above `1.2 t`: up to `a = 2 l` under powers above 2, flat ends and profiles where
    ///   `E1*` is above `30 E0*`, and under a flat punch above `20 E0*`, or on layers that are less than a tenth as stiff as
    ///   the top one. The true load is smaller by up to 3.5 % (`r^6`), 6 % (`r^20`), and under a flat punch 10 % on films and
    ///   16 % on the stacks that were tried.
    ///
    /// Under other probes than a flat punch, layers have the `l`, and the `E1*/E0*`, of a film as thick as the top layer
    /// that bends as they do.
    ///
    /// The limits and errors are those of programs that let the contact be any set of rings. The contact of a paraboloid is
    /// a disc, and that of a sphere errs by 2e-4 at most.
    pub no_disc: bool,
}

/// The compliance of a plate on a half-space under a flat punch that is small beside the bending length, over that of a
/// half-space of the plate and over the product of the radius and the square of the bending length, in units of the
/// thickness: `8/sqrt(3)`.
const OF_PLATE: f64 = 4.62;

impl Validity {
    /// The `a/R` at which the paraboloid begins to matter, by 0.3 % of the penetration.
    pub const LARGE_A_OVER_R: f64 = 0.1;

    /// The `a/R` above which the command line and the page of a table warn: the paraboloid changes
    /// the penetration by 3 % there.
    pub const WARNING_A_OVER_R: f64 = 0.3;

    /// The `a/R` up to which the exact sphere is computed on a film.
    pub const EXACT_SPHERE_A_OVER_R: f64 = 0.55;

    /// The slope at the edge above which the command line and a fit warn of any other shape, that of a
    /// cone of half angle 45 degrees. The model takes slopes to be small.
    pub const WARNING_SLOPE: f64 = 1.0;

    /// The share of the probe in the compliance, and the strain of the film, that count as small: a
    /// judgement, not a measured limit.
    pub const SMALL: f64 = 0.1;

    /// The [bending](FilmValidity::bending) of a stiff film above which the command line and a fit warn: a clamped
    /// plate is 4 % stiffer there.
    pub const WARNING_BENDING: f64 = 0.3;

    /// The [surface tension](Validity::surface_tension) (N/m) below which the command line and a fit name what would change
    /// the load by a tenth: that of silicones in air, the smallest one of a solid in air.
    pub const WARNING_SURFACE_TENSION: f64 = 0.02;

    /// Returns the neglected effects that are larger than the difference between a sphere and its
    /// paraboloid, in the order of [`Neglected`]. While there is one, the exact shape gains nothing
    /// for loads at given penetrations.
    ///
    /// The displacement sideways is compared with [`Validity::shape`] itself, and with 0.1 % under a
    /// probe that is no sphere. An elastic probe
    /// counts above an `a/R` of 0.1 if its share of the compliance is above 0.1, the strain of
    /// the film counts above 0.1: at a large `a/t` it is no longer small before `a/R` matters; and the bending of a
    /// stiff film above 0.3.
    pub fn neglected(&self) -> Vec<Neglected> {
        let mut all = Vec::new();
        /// Of a probe whose shape is exact.
        const UNSEEN: f64 = 1e-3;
        let shape = if self.shape > 0.0 { self.shape } else { UNSEEN };
        if self.sideways > shape {
            all.push(Neglected::Sideways);
        }
        if self.is_large_contact() && self.probe_share > Self::SMALL {
            all.push(Neglected::ElasticProbe);
        }
        if self.film.is_some_and(|film| film.strain > Self::SMALL) {
            all.push(Neglected::Strain);
        }
        if self
            .film
            .is_some_and(|film| film.bending > Self::WARNING_BENDING)
        {
            all.push(Neglected::Bending);
        }
        all
    }

    /// Tells whether `a/R` is above [`Validity::LARGE_A_OVER_R`].
    pub fn is_large_contact(&self) -> bool {
        self.a_over_r > Self::LARGE_A_OVER_R
    }
}

/// An effect that the model neglects, which [`Validity::neglected`] compares with that of the shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Neglected {
    /// The surface of a compressible film moves sideways under the probe.
    Sideways,
    /// An elastic probe is no half-space.
    ElasticProbe,
    /// The strain of the film is not small.
    Strain,
    /// A stiff film is bent by a large part of its thickness.
    Bending,
}

impl Contact {
    /// Compares a contact of radius `a` (m) with the assumptions of the model.
    ///
    /// The size of friction takes two solves of a flat punch, which `solve::stick::Sticking::stiffening` makes.
    ///
    /// # Errors
    /// As [`Mechanics::check_radius`](interp::Mechanics::check_radius); [`interp::Error::Unphysical`] for an `a` so
    /// large beside `t` that a result overflows an f64.
    pub fn validity(&self, a: f64) -> Result<Validity, Error> {
        self.mechanics().check_radius(a)?;
        let a_over_r = match *self.probe() {
            Probe::Sphere { radius } => a / radius,
            ref other => other.slope(a),
        };
        // Where the curve does not cover `a/t`, the size is that of a paraboloid on a half-space.
        let without = self.adhesionless_penetration(a).unwrap_or(a * a_over_r);
        let bare = 2.0 * a * self.mechanics().sphere_substrate_modulus();
        let stiffness = self.stiffness(a).unwrap_or(0.0);
        let of_film = 1.0 - stiffness / bare;
        let film = match self.system().zip(self.curve()) {
            Some((system, curve)) => {
                let (a_over_t, nu1) = (a / system.film_thickness, system.film.poisson());
                let factor = curve
                    .stack()
                    .map_or(3.0 / 16.0 * (1.0 - 2.0 * nu1) / (1.0 - nu1), |stack| {
                        stack.compressibility
                    });
                let compressibility = if factor.is_nan() {
                    factor
                } else {
                    finite_result(a, factor * a_over_t * a_over_t)?
                };
                /// What springs open under a flat punch where all else is softer, over that under the mean pressure, less 1:
                /// the pressure of the edge, up to a distance of t.
                const OF_EDGE: f64 = 0.4;
                let t = system.film_thickness;
                let opening = curve.stack().map_or(0.0, |stack| stack.opening * t);
                let springs = stiffness * opening / (PI * (a * a + t * t));
                let compressed = match of_film {
                    softer if softer > 0.0 => {
                        (softer - springs * (1.0 + OF_EDGE * (1.0 - softer))).max(0.0)
                    }
                    stiffer => stiffer,
                };
                let strain = finite_result(a, without * compressed / t)?;
                let bending = match (curve.stack(), of_film) {
                    (Some(stack), _) => {
                        without / (stack.top * t) * self.bent_part(a, a_over_t / stack.top, system)
                    }
                    (None, stiffer) if stiffer < 0.0 => without * stiffer / (stiffer - 1.0) / t,
                    _ => 0.0,
                };
                let bending = finite_result(a, bending)?;
                let [from, to] = curve.range();
                let in_range = (from..=to).contains(&a_over_t);
                Some(FilmValidity {
                    a_over_t,
                    compressibility,
                    strain,
                    bending,
                    in_range,
                    no_disc: self.beside_the_disc(a, system).contains(&true),
                })
            }
            None => None,
        };
        let (solid, sphere_modulus) = self.touched();
        let compressible = (1.0 - 2.0 * solid.poisson()) / (1.0 - solid.poisson());
        let probe_share = self.mechanics().sphere_film_modulus() / sphere_modulus;
        let shape = match *self.probe() {
            Probe::Paraboloid { radius } | Probe::Sphere { radius } => self
                .shape_on_film(a, radius)
                .filter(|part| part.is_finite())
                .unwrap_or(0.1 * without / radius),
            _ => 0.0,
        };
        Ok(Validity {
            a_over_r,
            shape,
            sideways: 0.75 / PI * compressible * a_over_r * (1.0 - probe_share),
            probe_share,
            surface_tension: self.surface_tension(a, probe_share),
            film,
        })
    }

    /// Returns [`Validity::surface_tension`] at contact radius `a` (m).
    fn surface_tension(&self, a: f64, probe_share: f64) -> f64 {
        /// The part by which the load is raised.
        const RAISED: f64 = 0.1;
        /// What the surface around a paraboloid on a half-space adds to the surface below it.
        const AROUND: f64 = 16.0 / (PI * PI) - 1.0;
        /// The tension over `Es* a` with which a flat punch on a half-space is stiffer by this part.
        const PUNCH: f64 = 0.03;
        let shared = probe_share.mul_add(probe_share, (1.0 - probe_share).powi(2));
        if let Probe::FlatPunch { .. } = self.probe() {
            return PUNCH * self.mechanics().sphere_film_modulus() * a / shared;
        }
        let Ok((without, by_log_radius)) = self.adhesionless_and_slopes(a) else {
            return f64::INFINITY;
        };
        let a_over_t = self
            .system()
            .map_or(0.0, |system| a / system.film_thickness);
        let slope = self.probe().slope(a);
        let energy_slope = PI * (a * slope).powi(2) * (1.0 + AROUND / (1.0 + a_over_t)) * shared;
        if without.load <= 0.0 || slope == 0.0 {
            return f64::INFINITY;
        }
        RAISED * without.load * by_log_radius.penetration / energy_slope
    }

    /// Returns the smallest radius between two (m), of some that are tried, at which a contact with the work of adhesion
    /// `w` (J/m^2) may be no disc; `None` where there is none, or no film.
    ///
    /// Without adhesion it is where [`FilmValidity::no_disc`] is. Adhesion holds the film where it would lift off inside. It
    /// keeps the film from the flank outside where it takes enough of the load away: 10 % for a cone on a film 200 times as
    /// stiff as its substrate, 60 % for one 10,000 times as stiff, by the gap of the model's own state.
    pub fn first_no_disc(&self, [from, to]: [f64; 2], w: f64) -> Option<f64> {
        /// The number of steps from one radius to the other.
        const COUNT: i32 = 50;
        /// The part of the load without adhesion up to which the film stays off the flank.
        const LEFT: f64 = 0.4;
        let system = self.system()?;
        let ratio = (to / from).powf(1.0 / f64::from(COUNT));
        let mut radii = (0..=COUNT).map(|i| from * ratio.powi(i));
        let is_pressed = |a: f64| {
            let loads = self
                .load(a, w)
                .and_then(|load| Ok([load, self.adhesionless_load(a)?]));
            loads.is_ok_and(|[load, without]| load > LEFT * without)
        };
        radii.find(|&a| {
            let [touches_outside, lifts_off_inside] = self.beside_the_disc(a, system);
            w == 0.0 && lifts_off_inside || touches_outside && (w == 0.0 || is_pressed(a))
        })
    }

    /// Tells whether the film may touch the probe outside the disc of a contact without adhesion of radius `a` (m), and
    /// whether it may lift off inside, as [`FilmValidity::no_disc`] says.
    fn beside_the_disc(&self, a: f64, system: &System) -> [bool; 2] {
        /// The part of a contact radius below which a flat end does not matter.
        const SMALL_END: f64 = 0.2;
        let stack = self.curve().and_then(Curve::stack);
        let a_over_t = a / (system.film_thickness * stack.map_or(1.0, |stack| stack.top));
        let contrast_of_film = system.film.reduced() / system.substrate.reduced();
        // Whether the flank of the probe at the edge is nearly straight, and whether its end is flatter than a paraboloid.
        let (straight, flat) = match *self.probe() {
            Probe::Paraboloid { .. } | Probe::Sphere { .. } => return [false; 2],
            Probe::FlatPunch { .. } => {
                // Of a film of this contrast, layers give way by so much.
                let gives_way = match stack {
                    Some(_) => self.compliance_of_layers(a, system) > 10.0,
                    None => contrast_of_film > 20.0,
                };
                return [false, a_over_t > 1.2 && gives_way];
            }
            Probe::Cone { .. } => (true, false),
            Probe::RoundedCone { radius, half_angle } => (a > radius / half_angle.tan(), false),
            Probe::FlatEndedCone { radius, .. } => (true, radius > SMALL_END * a),
            Probe::PowerLaw { exponent, .. } => (exponent < 1.5, exponent > 2.0),
            Probe::Profile(_) => (true, true),
        };
        let bending_length = match stack {
            Some(_) => self.bending_length(a, a_over_t, system),
            None => (contrast_of_film / 6.0).cbrt(),
        };
        let contrast = 6.0 * bending_length.powi(3);
        let bends = a_over_t < 2.0 * bending_length;
        let touches_outside = straight && contrast > 150.0 && a_over_t * bending_length > 3.0;
        let lifts_off_inside = flat && contrast > 30.0 && a_over_t > 1.2;
        [bends && touches_outside, bends && lifts_off_inside]
    }

    /// Returns the compliance of layers under a flat punch of radius `a` (m) over that of a half-space of the top one; NaN
    /// where it is not known.
    fn compliance_of_layers(&self, a: f64, system: &System) -> f64 {
        let stiffness = self.stiffness(a).unwrap_or(f64::NAN);
        (2.0 * a / stiffness - system.sphere_modulus.recip()) * system.film.reduced()
    }

    /// Returns the length `l`, over the thickness `t` of the top layer, over which this layer spreads a force as a plate on
    /// what lies below it, from the compliance of the layers. A plate on a half-space sinks by `l^2/(3 sqrt(3) D)` per force,
    /// with `D = E1* t^3/12`, under a punch that is wider than `l` by that of the half-space, and in between by about the
    /// harmonic mean.
    fn bending_length(&self, a: f64, a_over_top: f64, system: &System) -> f64 {
        let more = self.compliance_of_layers(a, system) - 1.0;
        if more.is_nan() || more <= 0.0 {
            return 0.0;
        }
        let of_plate = more / (OF_PLATE * a_over_top);
        let of_half_space = OF_PLATE * a_over_top / 6.0;
        (0..20).fold(of_plate.sqrt(), |length, _| {
            (of_plate * (1.0 + of_half_space / length)).sqrt()
        })
    }

    /// Returns `1 - S0/S` of a top layer of the thickness `t` that bends as layers do, with the stiffness `S0` of what lies
    /// below it.
    fn bent_part(&self, a: f64, a_over_top: f64, system: &System) -> f64 {
        let length = self.bending_length(a, a_over_top, system);
        let below = 6.0 * length.powi(3);
        let of_probe = system.film.reduced() / system.sphere_modulus;
        let of_plate = OF_PLATE * a_over_top * length * length;
        let is_plate = a_over_top < 4.0 * length || length > 3.0;
        if is_plate {
            below / (below + of_plate) * below / (1.0 + below + of_probe)
        } else {
            0.0
        }
    }

    /// Returns [`Validity::shape`] of a sphere on a film; `None` where it is not known.
    fn shape_on_film(&self, a: f64, radius: f64) -> Option<f64> {
        let quartic = self.quartic.get_or_init(|| self.on_quartic().map(Box::new));
        let (quartic, t) = (quartic.as_ref()?, self.system()?.film_thickness);
        let [from, to] = self.curve()?.range().map(|x| x * t);
        let at = a.clamp(from, to);
        let added = quartic.adhesionless(at).ok()?;
        let lost = self.stiffness(at).ok()? * added.penetration - added.load;
        let part = lost / self.adhesionless_load(at).ok()? * (t / radius).powi(3) / 8.0;
        Some(part * (a / at).powi(2))
    }

    /// Returns the contact of the probe `r^4/t^3` with the same bodies; `None` where it is not known.
    fn on_quartic(&self) -> Option<Self> {
        let (system, curve) = self.system().zip(self.curve())?;
        let probe = Probe::PowerLaw {
            coefficient: system.film_thickness.powi(-3),
            exponent: 4.0,
        };
        let system = System {
            probe,
            ..system.clone()
        };
        Self::new(&system, curve.clone()).ok()
    }
}
