//! The parameters of the quantities, and the coordinates in which the quantities are smooth.

/// A parameter of the quantities, and an axis of a table.
///
/// A [`Material`](crate::Material) has the parameters [`E1OverE2`](Self::E1OverE2),
/// [`Nu1`](Self::Nu1) and [`E0OverE2`](Self::E0OverE2). The axes of a table are
/// [`Parameter::ALL`], or [`Parameter::REDUCED`] with the ratios of reduced moduli in which limits
/// are ordinary points, or [`Parameter::STACK`] for one stack of layers.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
)]
pub enum Parameter {
    /// Contact radius over film thickness.
    AOverT,
    /// `E1/E2*`: Young's modulus of the film over the sphere's reduced modulus.
    E1OverE2,
    /// Poisson ratio of the film.
    Nu1,
    /// `E0/E2*`: Young's modulus of the substrate over the sphere's reduced modulus.
    E0OverE2,
    /// `E1*/Einf*`: reduced modulus of the film over that of sphere and substrate in contact,
    /// `1/Einf* = 1/E2* + 1/E0*`; 0 between a rigid sphere and a rigid substrate.
    E1sOverEinfs,
    /// `E0*/E2*`: reduced modulus of the substrate over that of the sphere; 0 is a rigid sphere,
    /// infinity a rigid substrate.
    E0sOverE2s,
    /// `E0/E1`: Young's modulus of the base of a stack of layers over that of its top layer;
    /// infinity is a rigid base.
    E0OverE1,
}

impl Parameter {
    /// `a/t` and the three parameters of a [`Material`](crate::Material), in the order of the
    /// dimensions of a table (row-major, the first varies slowest).
    pub const ALL: [Self; 4] = [Self::AOverT, Self::E1OverE2, Self::Nu1, Self::E0OverE2];

    /// `a/t` and the three parameters of a material by reduced moduli, in the order of the
    /// dimensions of a table.
    pub const REDUCED: [Self; 4] = [
        Self::AOverT,
        Self::E1sOverEinfs,
        Self::Nu1,
        Self::E0sOverE2s,
    ];

    /// The parameters of a table of one stack of layers under spheres of any modulus, in the order
    /// of the dimensions of a table.
    ///
    /// `a/t` has the thickness of all layers, and `E1` and `nu1` are those of the top layer. The
    /// last two have one node each. The layers below are in the scene of the table.
    pub const STACK: [Self; 4] = [Self::AOverT, Self::E1OverE2, Self::Nu1, Self::E0OverE1];

    /// Where the coordinate of `E1*/Einf*` ends to be logarithmic. Below, sphere and substrate are
    /// nearly rigid at any `a/t` up to 1e3: an incompressible film feels their compliance where
    /// `E1*/Einf* (a/t)^3` is of order one.
    const E1S_END: f64 = 1e-10;

    /// Where the coordinate of `E0*/E2*` ends to be logarithmic, and begins, at its inverse.
    /// Beyond, the softer of substrate and sphere is nearly all of their compliance, also compared
    /// with that of a film with `E1*/Einf*` up to 1e10.
    const E0S_END: f64 = 1e-11;

    /// The `1 - 2 nu1` at which the coordinate of `nu1` ends to be a power: below, a film is nearly
    /// incompressible at any `a/t` up to 1e3.
    const NU1_END: f64 = 1e-6;

    /// Returns the dimension of a table that this parameter may be the axis of.
    pub const fn dimension(self) -> usize {
        match self {
            Self::AOverT => 0,
            Self::E1OverE2 | Self::E1sOverEinfs => 1,
            Self::Nu1 => 2,
            Self::E0OverE2 | Self::E0sOverE2s | Self::E0OverE1 => 3,
        }
    }

    /// Returns the name used in the API, on the command line, in CSV, TOML and HDF5.
    pub const fn name(self) -> &'static str {
        match self {
            Self::AOverT => "a_over_t",
            Self::E1OverE2 => "e1_over_e2",
            Self::Nu1 => "nu1",
            Self::E0OverE2 => "e0_over_e2",
            Self::E1sOverEinfs => "e1s_over_einfs",
            Self::E0sOverE2s => "e0s_over_e2s",
            Self::E0OverE1 => "e0_over_e1",
        }
    }

    /// Returns the definition in words, as stored in the table's attribute `long_name`.
    pub const fn long_name(self) -> &'static str {
        match self {
            Self::AOverT => "contact radius over film thickness",
            Self::E1OverE2 => {
                "Young's modulus of the film over the sphere's reduced modulus E2* (0: rigid sphere)"
            }
            Self::Nu1 => "Poisson ratio of the film",
            Self::E0OverE2 => {
                "Young's modulus of the substrate over the sphere's reduced modulus E2* \
                 (over the film's Young's modulus if the sphere is rigid)"
            }
            Self::E1sOverEinfs => {
                "reduced modulus E1* of the film over Einf* of sphere and substrate, \
                 1/Einf* = 1/E2* + 1/E0* (0: both rigid)"
            }
            Self::E0sOverE2s => {
                "reduced modulus E0* of the substrate over that of the sphere, E2* \
                 (0: rigid sphere, inf: rigid substrate)"
            }
            Self::E0OverE1 => {
                "Young's modulus of the base of a stack of layers over that of its top layer \
                 (inf: rigid base); film: top layer, film thickness: that of all layers"
            }
        }
    }

    /// Returns the name of the [coordinate](Parameter::coordinate), as stored in the table's
    /// attribute `scale`.
    pub const fn scale(self) -> &'static str {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 | Self::E0OverE1 => "logarithmic",
            Self::Nu1 => "-(1 - 2 nu1 + 1e-6)^(1/8)",
            Self::E1sOverEinfs => "ln(e1s_over_einfs + 1e-10)",
            Self::E0sOverE2s => "ln((e0s_over_e2s + 1e-11)/(1 + 1e-11 e0s_over_e2s))",
        }
    }

    /// Returns the coordinate in which nodes are placed and splines are smooth.
    ///
    /// It is the logarithm of `value`; for `nu1` it is an eighth root, because a nearly
    /// incompressible film changes its behaviour where `(1 - 2 nu1) (a/t)^2 ~ 1`.
    /// The ratios of reduced moduli have coordinates, [`Parameter::scale`], that are logarithms
    /// except near 0 and infinity. There they end at finite values, because the quantities are
    /// smooth functions of `E1*/Einf*` at 0, and of `E0*/E2*` and its inverse at 0.
    pub fn coordinate(self, value: f64) -> f64 {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 | Self::E0OverE1 => value.ln(),
            Self::Nu1 => -(1.0 - 2.0 * value + Self::NU1_END).powf(0.125),
            Self::E1sOverEinfs => (value + Self::E1S_END).ln(),
            // Both forms are exact at their end.
            Self::E0sOverE2s if value < 1.0 => {
                ((value + Self::E0S_END) / (1.0 + value * Self::E0S_END)).ln()
            }
            Self::E0sOverE2s => {
                -((1.0 / value + Self::E0S_END) / (1.0 + Self::E0S_END / value)).ln()
            }
        }
    }

    /// Returns the derivative of the coordinate with respect to the value, at the value with this
    /// `coordinate`.
    pub fn speed(self, coordinate: f64) -> f64 {
        match self {
            Self::AOverT
            | Self::E1OverE2
            | Self::E0OverE2
            | Self::E1sOverEinfs
            | Self::E0OverE1 => (-coordinate).exp(),
            Self::Nu1 => -0.25 / coordinate.powi(7),
            Self::E0sOverE2s => {
                let value = self.value(coordinate);
                1.0 / (value + Self::E0S_END) - 1.0 / (value + 1.0 / Self::E0S_END)
            }
        }
    }

    /// Returns `value` times the derivative of the coordinate of a modulus ratio with respect to
    /// it: 1 where the coordinate is the logarithm.
    pub(crate) fn logarithmic_speed(self, value: f64) -> f64 {
        match self {
            Self::E1sOverEinfs => value / (value + Self::E1S_END),
            Self::E0sOverE2s => {
                1.0 / (1.0 + Self::E0S_END / value) - 1.0 / (1.0 + 1.0 / (Self::E0S_END * value))
            }
            _ => 1.0,
        }
    }

    /// Returns the value with this `coordinate`: the inverse of [`Parameter::coordinate`].
    pub fn value(self, coordinate: f64) -> f64 {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 | Self::E0OverE1 => coordinate.exp(),
            Self::Nu1 => 0.5 * (1.0 + Self::NU1_END - coordinate.powi(8)),
            Self::E1sOverEinfs => (coordinate.exp() - Self::E1S_END).max(0.0),
            // From the end that is nearer, so that the difference is exact there.
            Self::E0sOverE2s => {
                let inverse = |coordinate: f64| {
                    let value = coordinate.exp();
                    (value - Self::E0S_END).max(0.0) / (1.0 - value * Self::E0S_END)
                };
                if coordinate < 0.0 {
                    inverse(coordinate)
                } else {
                    1.0 / inverse(-coordinate)
                }
            }
        }
    }
}
