//! The contact of any shape on a film, from the field of the flat punch.
//!
//! With the [field](super::field), its `E = P + Q` and `O = Q - P`, `gamma = Gamma/es`, and the
//! [transform](super::transform) `b` of the shape,
//!
//! ```text
//! delta0  = [b + int_0^a b E ds]/gamma              = b + int_0^a b' O ds/gamma
//! delta0' = [b'(a) + int_0^a b' O ds]/gamma         = [b'(0) E(0) + int_0^a b'' E ds]/gamma
//! F0      = S delta0 - 2 E* M
//! M       = gamma [int b + int_0^a (int b) O ds]    = gamma int_0^a b E ds
//! ```
//!
//! where the first form holds where `Gamma` grows and the second one where it falls: so all terms are
//! positive. `M` is `int_0^a b g1/es ds`, `delta0 = M'/gamma^2` because the edge of `A g = b` has the
//! value `delta0 Gamma`, and its second form is `int b'' (U - s) ds` by parts. With the
//! [coefficients](super::modes) of the field and the [moments](super::moments) of the shape all
//! integrals are sums, without a quadrature over the shape. The derivatives are the same sums with
//! those of the field or of the shape.

use std::sync::{Arc, OnceLock};

use super::field::Field;
use super::legendre::MOST;
use super::medium::{At, Change, Changed, Medium};
use super::modes::Modes;
use super::moments::{Curvature, Integrals};
use super::polynomial::{POINTS, basis_on, points_on};
use super::transform::{Knot, Transform};
use crate::Error;
use crate::made::made;
use interp::{Curve, MaterialParameter, Parameter};

/// Between radii with no knot above this part of the smaller one, the integrals are as smooth as the
/// coefficients.
const NEAR: f64 = 0.5;

/// A shape on a film. Lengths are in units of the film's thickness.
#[derive(Clone, Debug)]
pub(crate) struct Solved {
    shape: Arc<Outline>,
    own: Arc<Expanded>,
    /// The derivatives with respect to the parameters of the material, made when they are needed.
    by: Arc<[OnceLock<(Change, Expanded)>; MaterialParameter::ALL.len()]>,
}

/// A shape by its transform and its curvature.
#[derive(Debug)]
struct Outline {
    transform: Transform,
    curvature: Curvature,
}

/// Penetration `delta0/t`, its derivative, and load `F0/(Es* t^2)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Values {
    pub penetration: f64,
    pub slope: f64,
    pub load: f64,
}

/// A field, its coefficients between the ends of its blocks, and its integrals with a shape where
/// these are smooth, made when they are needed.
#[derive(Debug)]
struct Expanded {
    shape: Arc<Outline>,
    field: Arc<Field>,
    modes: Vec<OnceLock<Modes>>,
    smooth: Vec<OnceLock<[Integrals; POINTS]>>,
}

impl Expanded {
    fn new(shape: Arc<Outline>, field: Field) -> Self {
        let count = field.ends().len() - 1;
        Self {
            shape,
            modes: vec![OnceLock::new(); count],
            smooth: vec![OnceLock::new(); count],
            field: Arc::new(field),
        }
    }

    /// Returns the number of the block of a contact radius, and its ends.
    fn block(&self, x: f64) -> (usize, [f64; 2]) {
        let field = &self.field;
        let number = field.block(x.min(field.last * (1.0 - f64::EPSILON)));
        (number, [field.ends()[number], field.ends()[number + 1]])
    }

    /// Returns the coefficients on the block of a contact radius. A derivative has as many as the
    /// field `of`.
    fn modes(&self, x: f64, of: Option<&Self>) -> Result<&Modes, Error> {
        let (number, ends) = self.block(x);
        made(&self.modes[number], || {
            let of = of.map(|of| of.modes(x, None)).transpose()?;
            Modes::new(&self.field, ends, of)
        })
    }

    /// Returns the integrals with the shape at a contact radius.
    fn integrals(&self, x: f64, of: Option<&Self>) -> Result<Integrals, Error> {
        let Outline {
            transform,
            curvature,
        } = &*self.shape;
        let at = |modes: &Modes, x: f64| {
            let mut place = [[0.0; 2]; MOST];
            curvature.integrals(x, transform.integral(x), modes.at(x, &mut place))
        };
        let (number, ends) = self.block(x);
        let near = |knot: &Knot| knot.radius > NEAR * ends[0] && knot.radius < ends[1];
        if transform.knots().iter().any(near) {
            return Ok(at(self.modes(x, of)?, x));
        }
        let order = transform.order();
        let points = made(&self.smooth[number], || {
            let modes = self.modes(x, of)?;
            let scaled = |x: f64| at(modes, x).scaled(x.powf(-order));
            Ok::<_, Error>(points_on(ends).map(scaled))
        })?;
        let terms = points.iter().zip(basis_on(ends, x));
        let sum = terms.fold(Integrals::default(), |sum, (own, part)| {
            sum.plus(own.scaled(part))
        });
        Ok(if order == 0.0 {
            sum
        } else {
            sum.scaled(x.powf(order))
        })
    }
}

/// What a shape has at a contact radius without a film: `b`, `b'` and `int b`.
#[derive(Clone, Copy, Debug, Default)]
struct Bare {
    value: f64,
    slope: f64,
    integral: f64,
}

impl Solved {
    /// Prepares contact radii up to `most`.
    pub(super) fn new(curve: &Curve, transform: Transform, most: f64) -> Result<Self, Error> {
        curve.accept_integrals("the contact of this probe")?;
        let field = Field::new(Medium::new(curve)?, most)?;
        let begins = transform.knots().first().map_or(0.0, |knot| knot.radius);
        if begins > 0.0 && begins >= field.last {
            return Err(interp::Error::OutsideTable {
                axis: Parameter::AOverT.name(),
                value: begins,
                from: 0.0,
                to: field.last,
            }
            .into());
        }
        let shape = Arc::new(Outline {
            curvature: Curvature::of(&transform).expect("a sphere is solved by its even powers"),
            transform,
        });
        Ok(Self {
            own: Arc::new(Expanded::new(shape.clone(), field)),
            shape,
            by: Arc::default(),
        })
    }

    /// Returns the largest contact radius.
    pub(super) fn last(&self) -> f64 {
        self.own.field.last
    }

    /// Returns the transform of the shape.
    pub(super) fn transform(&self) -> &Transform {
        &self.shape.transform
    }

    fn bare(&self, x: f64) -> Bare {
        Bare {
            value: self.shape.transform.value(x),
            slope: self.shape.transform.slope(x),
            integral: self.shape.transform.integral(x),
        }
    }

    /// Returns whether the film is thick at a contact radius, so that the mean of the contact moves
    /// only.
    fn is_thick(&self, x: f64) -> bool {
        x < self.own.field.ends()[1]
    }

    /// Returns penetration and load at a contact radius.
    pub(super) fn values(&self, x: f64) -> Result<Values, Error> {
        let bare = self.bare(x);
        let field = &self.own.field;
        if self.is_thick(x) {
            let Bare {
                value,
                slope,
                integral,
            } = bare;
            let departure = field.medium.departure(None, x);
            return Ok(Values {
                penetration: value + departure * (value - integral / x),
                // `delta0' = F0'/S`, and the load is that of a half-space.
                slope: slope * (1.0 + departure),
                load: 2.0 * (x * value - integral),
            });
        }
        let at = field.medium.at(x)?;
        let integrals = self.own.integrals(x, None)?;
        let [penetration, moment] = self.pair(bare, at.gamma, integrals);
        let slope = if field.falls {
            integrals.curvature
        } else {
            bare.slope + integrals.slope
        };
        Ok(Values {
            penetration,
            slope: slope / at.gamma,
            load: 2.0 * (x * at.eeq * penetration - moment),
        })
    }

    /// Returns a lower bound of the derivative of the penetration at a contact radius, on a film that is
    /// not stiffer than its substrate. On a stiffer one a flat punch pulls in the middle.
    ///
    /// In `delta0' = (1/S') int_0^a 2 pi r p (f'' + f'/r) dr` with the surface `f` and the pressure
    /// `p` of the flat punch of unit penetration, whose load is `S`, let `f''` count for nothing, `f'`
    /// for that at `a/2`, at least `4 b(a/2)/(pi a)`, and the load for half of it: outside `a/2` there
    /// is more, 0.56 under the parabola of pressure on a thin incompressible film, which is the least,
    /// 0.87 on a half-space.
    pub(super) fn least_slope(&self, x: f64) -> Result<f64, Error> {
        let At { gamma, eeq, .. } = self.own.field.medium.at(x)?;
        let half = self.shape.transform.value(0.5 * x);
        Ok(eeq / (gamma * gamma) * 2.0 / std::f64::consts::PI * half / x)
    }

    /// Returns the penetration and `M` of a shape.
    fn pair(&self, bare: Bare, gamma: f64, of: Integrals) -> [f64; 2] {
        if self.own.field.falls {
            [bare.value + of.slope / gamma, gamma * of.value]
        } else {
            [
                (bare.value + of.value) / gamma,
                gamma * (bare.integral + of.integral),
            ]
        }
    }

    /// Returns the derivatives of penetration and load with respect to the logarithm of all lengths of the shape.
    pub(super) fn by_size(&self, x: f64) -> Result<[f64; 2], Error> {
        let Bare {
            value,
            slope,
            integral,
        } = self.bare(x);
        // Those of `b - s b'`, of which the slope is not needed.
        let bare = Bare {
            value: value - x * slope,
            slope: 0.0,
            integral: 2.0 * integral - x * value,
        };
        let medium = &self.own.field.medium;
        if self.is_thick(x) {
            let mean = bare.integral / x;
            return Ok([
                bare.value + medium.departure(None, x) * (bare.value - mean),
                2.0 * x * (bare.value - mean),
            ]);
        }
        let At { gamma, eeq, .. } = medium.at(x)?;
        let mut place = [[0.0; 2]; MOST];
        let modes = self.own.modes(x, None)?.at(x, &mut place);
        let dilated = self.shape.curvature.dilated();
        let integrals = dilated.integrals(x, bare.integral, modes);
        let [penetration, moment] = self.pair(bare, gamma, integrals);
        Ok([penetration, 2.0 * (x * eeq * penetration - moment)])
    }

    /// Returns the derivatives of penetration and load with respect to a parameter of the material.
    pub(super) fn by_parameter(
        &self,
        curve: &Curve,
        parameter: MaterialParameter,
        x: f64,
    ) -> Result<[f64; 2], Error> {
        let field = &self.own.field;
        let (change, derivative) = made(&self.by[parameter as usize], || {
            let change = field.medium.change(curve, parameter)?;
            let derivative = Field::derivative(field, change);
            Ok::<_, Error>((change, Expanded::new(self.shape.clone(), derivative)))
        })?;
        let bare = self.bare(x);
        if self.is_thick(x) {
            let mean = bare.integral / x;
            let departure = field.medium.departure(Some(*change), x);
            return Ok([departure * (bare.value - mean), 0.0]);
        }
        let At { gamma, eeq, .. } = field.medium.at(x)?;
        let Changed {
            ln_gamma, ln_eeq, ..
        } = field.medium.changed(*change, x)?;
        let own = self.own.integrals(x, None)?;
        let by_own = derivative.integrals(x, Some(&self.own))?;
        let [penetration, moment] = self.pair(bare, gamma, own);
        let [by_penetration, by_moment] = self.pair(Bare::default(), gamma, by_own);
        let on_half_space = if field.falls { bare.value } else { 0.0 };
        let by_penetration = by_penetration - ln_gamma * (penetration - on_half_space);
        let by_moment = by_moment + ln_gamma * moment;
        let by_product = eeq * (ln_eeq * penetration + by_penetration);
        Ok([by_penetration, 2.0 * (x * by_product - by_moment)])
    }
}
