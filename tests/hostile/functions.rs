//! The public functions that take numbers, in one list for the property test and for the fuzzer.
//!
//! For a new function add a row to [`FUNCTIONS`], and a test of the properties of its results to
//! `physics.rs`.

use std::array::from_fn;

use contact::{
    CohesiveZone, Contact, CrackTip, Hysteresis, JkrFit, JkrPoint, RateDependent, TimedState,
};
use interp::{
    Certificate, Curve, Elastic, Error, Material, MaterialParameter, Mechanics, Parameter,
    Quantities, Quantity, SubstratePoissonRatio, Table, Tile,
};
use low_rank::{IntegerTrain, Malformed};
use piecewise::bspline::{Basis, LARGEST_DEGREE, TABLE_DEGREE};

use crate::calls::{
    GRADIENTS, Results, both, controls, curve, each, gradients, half_space, loads, material,
    moduli, numbers, quantities, system,
};
use crate::tables::{self, AXES, look_up};

/// A function under test: its name, valid arguments, and a call with any arguments.
pub type Function = (&'static str, &'static [f64], fn(&[f64]) -> Results);

/// All functions under test.
pub const FUNCTIONS: &[Function] = &[
    ("Elastic::new", &[1e6, 0.3], |x| {
        let solid = Elastic::new(x[0], x[1])?;
        assert!(
            solid.young() > 0.0 && solid.reduced() >= 0.75 * solid.young(),
            "{solid:?}"
        );
        Ok(vec![solid.poisson()])
    }),
    (
        "System::material",
        &[1e-3, 2e6, 3.5e6, 0.5, 1e-6, 2e11, 0.25],
        |x| moduli(&system(x)?.material()?),
    ),
    ("Material::new", &[1.75, 0.5, 1e5, 0.25], |x| {
        moduli(&material(x)?)
    }),
    ("Material::of_reduced_moduli", &[0.7, 0.3, 2.0, 0.25], |x| {
        moduli(&Material::of_reduced_moduli(x[0], x[1], x[2], x[3])?)
    }),
    (
        "Material::with_substrate_poisson_ratio",
        &[1.75, 0.3, 300.0, 0.25, 0.3],
        |x| moduli(&material(x)?.with_substrate_poisson_ratio(x[4])?),
    ),
    ("Table::curve", &[1.75, 0.5, 1e5, 0.25, 2.0], |x| {
        quantities(&Table::embedded().curve(&material(x)?)?, x[4])
    }),
    (
        "Table::contact",
        &[1e-3, 2e6, 3.5e6, 0.5, 1e-6, 2e11, 0.25, 6e-5, 0.04],
        |x| {
            loads(
                &Contact::in_table(Table::embedded(), &system(x)?)?,
                x[7],
                x[8],
            )
        },
    ),
    ("Curve::quantities", &[2.0], |x| quantities(curve(), x[0])),
    ("Curve::quantity_at_all", &[2.0, 1e-5, 500.0], |x| {
        let mut values = vec![0.0; x.len()];
        curve().quantity_at_all(Quantity::Gamma, x, &mut values)?;
        Ok(values)
    }),
    ("Curve::error", &[2.0], |x| Ok(vec![curve().error(x[0])?])),
    ("Curve::spline", &[100.0], |x| {
        let spline = curve().spline(Quantity::Pi0, x[0] as usize)?;
        let keys = spline.keys().iter();
        Ok(keys.flat_map(|key| [key.t, key.value]).collect())
    }),
    ("Curve::gradient", &[1.75, 0.5, 1e5, 0.25, 2.0], |x| {
        let curve = Table::embedded().curve_with_gradient(&material(x)?)?;
        let gradient = curve.gradient(x[4])?;
        let by = MaterialParameter::ALL.map(|parameter| gradient.by(parameter));
        let by = by
            .into_iter()
            .chain([Ok(gradient.values()), Ok(gradient.slopes())]);
        Ok(by
            .collect::<Result<Vec<_>, Error>>()?
            .iter()
            .flat_map(|four| four.to_array())
            .collect())
    }),
    (
        "Curve::through",
        &[
            1.0, 3.0, 0.8, 0.9, 1.1, 2.0, 4.0, 0.9, 0.8, 1.2, 1.75, 0.5, 1e5, 0.25,
        ],
        |x| {
            let node = |x: &[f64]| (x[0], Quantities::from_array(from_fn(|i| x[i + 1])));
            let curve = Curve::through(&[node(x), node(&x[5..])], material(&x[10..])?)?;
            quantities(&curve, (x[0] * x[5]).sqrt())
        },
    ),
    (
        "Contact::new",
        &[1e-3, 2e6, 3.5e6, 0.5, 1e-6, 2e11, 0.25, 6e-5, 0.04],
        |x| loads(&Contact::new(&system(x)?, curve().clone())?, x[7], x[8]),
    ),
    (
        "Contact::half_space",
        &[1e-3, 2e6, 2e11, 0.25, 6e-5, 0.04],
        |x| loads(&Contact::half_space(&half_space(x)?)?, x[4], x[5]),
    ),
    (
        "HalfSpace::compound_modulus",
        &[1e-3, 2e6, 2e11, 0.25],
        |x| Ok(vec![half_space(x)?.compound_modulus()?]),
    ),
    ("Contact::quantities", &[6e-5], |x| {
        each(x, |contact| {
            Ok(contact.quantities(x[0])?.to_array().to_vec())
        })
    }),
    ("Contact::load", &[6e-5, 0.04], |x| {
        each(x, |contact| loads(contact, x[0], x[1]))
    }),
    ("Contact::stiffness", &[6e-5], |x| {
        each(x, |contact| Ok(vec![contact.stiffness(x[0])?]))
    }),
    ("Contact::stress_intensity", &[6e-5, 0.04], |x| {
        each(x, |contact| Ok(vec![contact.stress_intensity(x[0], x[1])?]))
    }),
    ("Contact::energy_release_rate_at_load", &[6e-5, 1e-4], |x| {
        each(x, |contact| {
            Ok(vec![contact.energy_release_rate_at_load(x[0], x[1])?])
        })
    }),
    (
        "Contact::energy_release_rate_at_penetration",
        &[6e-5, 1e-6],
        |x| {
            each(x, |contact| {
                Ok(vec![
                    contact.energy_release_rate_at_penetration(x[0], x[1])?,
                ])
            })
        },
    ),
    (
        "Contact::radius_and_energy_release_rate",
        &[-1e-4, 1e-7],
        |x| {
            each(x, |contact| {
                contact
                    .radius_and_energy_release_rate(x[0], x[1])
                    .map(|(a, g)| vec![a, g])
            })
        },
    ),
    ("Contact::validity", &[6e-5], |x| {
        each(x, |contact| {
            let validity = contact.validity(x[0])?;
            let film = validity
                .film
                .map_or([0.0; 2], |film| [film.a_over_t, film.compressibility]);
            Ok([&[validity.a_over_r], &film[..]].concat())
        })
    }),
    ("Contact::zone_size", &[0.04, 1e-9], |x| {
        each(x, |contact| {
            let range = contact.zone_size(x[0], x[1])?;
            let error = range.pull_off_error().unwrap_or_default();
            Ok(vec![range.tabor, range.cohesive_zone, error])
        })
    }),
    (
        "Contact::cohesive_zone",
        &[0.04, 1e6, 6e-5, -1e-5, 50.0],
        |x| {
            each(x, |contact| {
                let range = CohesiveZone { stress: x[1] };
                let attraction = contact.cohesive_zone(x[0], range)?;
                let mut found: Vec<_> = attraction.state(x[2]).into_iter().collect();
                for control in controls(x[4]) {
                    found.extend(attraction.pull_off(control));
                    let equilibria = attraction.equilibria(control, x[3]).unwrap_or_default();
                    found.extend(equilibria.iter().map(|found| found.state));
                }
                let values = found
                    .iter()
                    .flat_map(|at| [at.contact_radius, at.outer_radius, at.load, at.penetration]);
                Ok(values.chain([attraction.zone()]).collect())
            })
        },
    ),
    ("Contact::jkr_fit", &[0.04, 5e-5, 1e-4, 2e6], |x| {
        each(x, |contact| {
            let fit = contact.jkr_fit(x[0], [x[1], x[2]], 4)?;
            let _ = fit.work_of_adhesion_with(x[3]);
            Ok(vec![fit.modulus, fit.intercept])
        })
    }),
    ("Contact::film_bias", &[0.04, 5e-5, 1e-4], |x| {
        each(x, |contact| {
            let bias = contact.film_bias(x[0], [x[1], x[2]], 5)?;
            let _ = bias.exceeds(x[1]);
            Ok(vec![
                bias.fit.modulus,
                bias.fit.intercept,
                bias.modulus,
                bias.work_of_adhesion,
            ])
        })
    }),
    ("Contact::equilibria", &[0.04, -1e-5, 50.0], |x| {
        each(x, |contact| {
            let mut found = Vec::new();
            for control in controls(x[2]) {
                let equilibria = contact.equilibria(x[0], control)?;
                let all = equilibria.at(x[1]).unwrap_or_default();
                found.extend(all.iter().map(|equilibrium| equilibrium.state));
                found.extend(equilibria.unloading(x[1]));
                found.extend(equilibria.loading(x[1]));
                found.extend(equilibria.pull_off());
                if let Ok(whole) = equilibria.force_displacement(x[1], 3) {
                    found.extend(whole.loading.iter().chain(&whole.unloading).flatten());
                }
            }
            Ok(found.into_iter().flat_map(numbers).collect())
        })
    }),
    ("Contact::zero_load", &[0.04, 50.0], |x| {
        each(x, |contact| {
            let apart = controls(x[1]).map(|control| contact.pull_off(x[0], control));
            let at_rest = contact.zero_load(x[0])?;
            let all = apart.into_iter().flatten().chain([at_rest]);
            Ok(all.flat_map(numbers).collect())
        })
    }),
    (
        "Contact::work_of_adhesion_at_pull_off",
        &[-1e-6, 50.0],
        |x| {
            each(x, |contact| {
                let found = controls(x[1])
                    .map(|control| contact.work_of_adhesion_at_pull_off(x[0], control));
                Ok(found.into_iter().flatten().collect())
            })
        },
    ),
    (
        "Contact::line",
        &[0.03, 0.05, 6e-5, 50.0, 1e-4, -1e-5],
        |x| {
            each(x, |contact| {
                let mut line = contact.line(Hysteresis::new(x[0], x[1])?, x[2])?;
                let states = controls(x[3]).map(|control| {
                    line.impose(control, x[4])
                        .and_then(|_| line.impose(control, x[5]))
                });
                let [load, penetration, spring] = states;
                let others = [penetration, spring].into_iter().flatten();
                let all = others.chain([load?]).flatten();
                Ok(all.flat_map(numbers).collect())
            })
        },
    ),
    (
        "ContactLine::ramp",
        &[0.03, 0.05, 1e-6, 0.6, 6e-5, 1e-4, 1.0, 1e-4, 0.0, 50.0],
        |x| {
            // Not the contacts of `each`, some of which take the largest number of steps, a second.
            both(|contact| {
                let mut line = contact.line(
                    RateDependent::new(Hysteresis::new(x[0], x[1])?, x[2], x[3])?,
                    x[4],
                )?;
                let control = controls(x[9])[x[8].abs() as usize % 3];
                let states = line.ramp(control, x[5], x[6], x[7])?.into_iter();
                let of = |at: TimedState| [vec![at.time], numbers(at.state).to_vec()].concat();
                Ok(states.flat_map(of).collect())
            })
        },
    ),
    ("Contact::gradient", &[6e-5, 0.04], |x| {
        gradients(&GRADIENTS, x[0], x[1])
    }),
    (
        "Table::contact_with_gradient",
        &[1e-3, 2e6, 3.5e6, 0.5, 1e-6, 2e11, 0.25, 6e-5, 0.04],
        |x| {
            gradients(
                &Contact::in_table_with_gradient(Table::embedded(), &system(x)?)?,
                x[7],
                x[8],
            )
        },
    ),
    ("JkrFit::through", &[1.0, 2.0, 2.0, 5.0, 3.0, 7.0], |x| {
        let points = x.chunks_exact(2).map(|pair| JkrPoint {
            abscissa: pair[0],
            ordinate: pair[1],
        });
        let fit = JkrFit::through(&points.collect::<Vec<_>>())?;
        Ok(vec![fit.modulus, fit.intercept])
    }),
    (
        "RateDependent::energy_release_rate",
        &[0.03, 0.05, 1e-6, 0.6, 0.1, 1e-6],
        |x| {
            let law = RateDependent::new(Hysteresis::new(x[0], x[1])?, x[2], x[3])?;
            assert!(
                !law.speed(x[4]).is_nan() || x[4].is_nan(),
                "{law:?} at {}",
                x[4]
            );
            Ok([law.at_rest().to_vec(), vec![law.energy_release_rate(x[5])?]].concat())
        },
    ),
    (
        "Mechanics::edge_singularity",
        &[1e-3, 2e6, 3.5e6, 0.5, 1e-6, 2e11, 0.25, 6e-5, 0.04],
        |x| {
            Ok(vec![
                Mechanics::new(&system(x)?)?.edge_singularity(x[7], x[8])?,
            ])
        },
    ),
    // These functions are plain arithmetic: they may return NaN and infinity, but not panic.
    (
        "Mechanics::load",
        &[
            1e-3, 2e6, 3.5e6, 0.5, 1e-6, 2e11, 0.25, 6e-5, 10.0, 2.0, 0.9, 0.8, 0.7, 0.6,
        ],
        |x| {
            let (mechanics, quantities) = (
                Mechanics::new(&system(x)?)?,
                Quantities::from_array(from_fn(|i| x[10 + i])),
            );
            let _ = (
                mechanics.load(x[7], x[8], x[9], x[10]),
                mechanics.load_and_penetration(x[7], x[8], &quantities),
            );
            let _ = (
                mechanics.energy_release_rate(x[7], x[8]),
                JkrPoint::new(x[7], x[8], mechanics.sphere_radius()),
            );
            Ok(vec![])
        },
    ),
    ("Parameter::coordinate", &[0.3], |x| {
        for parameter in Parameter::ALL.into_iter().chain(Parameter::REDUCED) {
            let _ = (
                parameter.coordinate(x[0]),
                parameter.value(x[0]),
                parameter.speed(x[0]),
            );
        }
        let _ = (
            SubstratePoissonRatio::Paired.under(x[0]),
            JkrPoint::new(x[0], x[0], x[0]),
        );
        Ok(vec![])
    }),
    ("Quantity::logarithm", &[0.7, 0.6], |x| {
        let _ = Quantity::ALL.map(|quantity| quantity.logarithm(x[0], x[1]));
        Ok(vec![])
    }),
    // Nodes that do not ascend make a useless basis, but no panic.
    (
        "Basis::new",
        &[
            0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 3.3,
        ],
        |x| {
            for degree in [0, 1, 4, TABLE_DEGREE, LARGEST_DEGREE] {
                let basis = Basis::new(&x[..12], degree);
                let mut values = x[..12].to_vec();
                basis.interpolate(&mut values, 1);
                let weights = basis.weights(x[12]);
                assert!(weights.first + weights.count <= 12, "{weights:?}");
            }
            Ok(vec![])
        },
    ),
    // A table holds finite numbers, or it is malformed.
    (
        "Table::new",
        &[1e-3, 0.25, 0.7, 2.0, 0.1, 0.5, 1.0, 0.7],
        |x| {
            let (mut description, mut axes) = (tables::description(), tables::axes());
            description.tolerance = x[0];
            description.nu0 = SubstratePoissonRatio::Fixed(x[1]);
            for (dimension, node, value) in [
                (0, 1, x[2]),
                (0, 4, x[3]),
                (1, 0, x[4]),
                (2, 2, x[5]),
                (3, 0, x[6]),
            ] {
                axes[dimension].1[node] = value;
            }
            let mut values = vec![0.7; AXES.iter().map(|nodes| nodes.len()).product()];
            let middle = values.len() / 2;
            values[middle] = x[7];
            look_up(&Table::new(
                description,
                axes,
                [Some(values), None, None, None],
            )?)?;
            Ok(vec![])
        },
    ),
    // The error of a table is a finite number, or the certificate is malformed.
    ("Certificate", &[1e-3, 5e-4, 1e-4, 1.0, 2e-3, 2.0], |x| {
        let mut description = tables::description();
        description.certificate = Certificate {
            max_error: x[0],
            p999_error: x[1],
            median_error: x[2],
            worst_point: [x[3]; 4],
            identity_errors: [Some(x[4]), None, None, None],
            ..description.certificate
        };
        let count = AXES.iter().map(|nodes| nodes.len()).product();
        let values: [_; 4] = from_fn(|_| Some(vec![0.7; count]));
        let table = Table::new(description, tables::axes(), values)?;
        let curve = table.curve(&tables::material())?;
        Ok(vec![curve.error(x[5]).unwrap_or(0.0), curve.error(0.7)?])
    }),
    ("IntegerTrain::new", &[0.1, 1.0, -2.0, 3.0], |x| {
        let terms = [3, 1, 2, 0].map(|dimension| AXES[dimension].len());
        let integer = |number: f64| number as i64;
        let form = IntegerTrain::new(
            1,
            tables::ORDER,
            Tile::SMOOTH_DEGREES,
            terms,
            from_fn(|_| vec![integer(x[1]) as i8]),
            x[0],
            terms.map(|count| [integer(x[2]), integer(x[3])].repeat(count)[..count].to_vec()),
        )
        .map_err(|Malformed(what)| Error::Malformed(what))?;
        let tiles = tables::whole(form, AXES.map(<[f64]>::len));
        look_up(&Table::from_low_rank(
            tables::description(),
            tables::axes(),
            vec![Quantity::Pi0],
            tiles,
        )?)?;
        Ok(vec![])
    }),
];
