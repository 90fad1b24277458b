//! Small tables with meaningless numbers, for tests of their bytes and of their look-up.

use acceptance::with_payload;
use contact::Contact;
use interp::{
    Certificate, Description, Elastic, Error, Material, MaterialParameter, Parameter, Probe,
    Quantity, SubstratePoissonRatio, System, Table, Tile,
};
use low_rank::IntegerTrain;

/// The nodes of the four axes.
pub const AXES: [&[f64]; 4] = [
    &[0.5, 0.7, 1.0, 1.5, 2.0],
    &[0.1, 1.0, 3.0, 10.0],
    &[0.0, 0.3, 0.5],
    &[1.0, 1e5],
];

/// Returns the nodes of the axes.
pub fn axes() -> [(Parameter, Vec<f64>); 4] {
    Parameter::ALL.map(|parameter| (parameter, AXES[parameter.dimension()].to_vec()))
}

/// Returns the description of all tables.
pub fn description() -> Description {
    Description {
        title: "Small".into(),
        scene: "title = 'Small'".into(),
        nu0: SubstratePoissonRatio::Fixed(0.25),
        tolerance: 1e-3,
        created_by: "a test".into(),
        certificate: Certificate {
            max_error: 1e-3,
            p999_error: 1e-3,
            median_error: 1e-4,
            points: 10,
            worst_point: [1.0, 1.75, 0.3, 300.0],
            ..Certificate::UNMEASURED
        },
    }
}

/// Returns the description of tables with a small tolerance.
fn strict() -> Description {
    Description {
        tolerance: 1e-12,
        ..description()
    }
}

/// Makes a dense table of three quantities.
pub fn dense() -> Table {
    let count: usize = AXES.iter().map(|nodes| nodes.len()).product();
    let values = |offset: f64| (0..count).map(|i| offset + 1e-3 * i as f64).collect();
    Table::new(
        description(),
        axes(),
        [
            Some(values(1.0)),
            None,
            Some(values(2.0)),
            Some(values(0.7)),
        ],
    )
    .expect("valid")
}

/// The order of the cores of all forms of this file.
pub const ORDER: [usize; 3] = [3, 1, 2];

/// Makes a train of so many functions, of these numbers of terms along the substrate's modulus, the film's, its Poisson
/// ratio and `a/t`, and of these ranks. `integer` gives the integers of each core.
pub fn form(
    functions: usize,
    terms: [usize; 4],
    ranks: [usize; 3],
    step: f64,
    integer: impl Fn(i64) -> i64,
) -> IntegerTrain {
    let bonds = [1, ranks[0], ranks[1], ranks[2], functions];
    let cores = std::array::from_fn(|i| {
        let count = (bonds[i] * terms[i] * bonds[i + 1]) as i64;
        (0..count).map(&integer).collect()
    });
    let weights = ranks.map(|rank| vec![0; rank]);
    IntegerTrain::new(
        functions,
        ORDER,
        Tile::SMOOTH_DEGREES,
        terms,
        weights,
        step,
        cores,
    )
    .expect("valid")
}

/// Returns the only tile of a table with this number of nodes on each axis.
pub fn whole(form: IntegerTrain, [_, film, _, substrate]: [usize; 4]) -> Vec<Tile> {
    vec![Tile {
        film: [0, film - 1],
        substrate: [0, substrate - 1],
        form,
    }]
}

/// Makes a low-rank table of all quantities, with bonds of rank 2.
pub fn low_rank() -> Table {
    let [a, e1, nu, e0] = AXES.map(<[f64]>::len);
    let integer = |i: i64| (i * i * 37) % 61 - 30;
    let form = form(4, [e0, e1, nu, a], [2; 3], 0.01, integer);
    let tiles = whole(form, [a, e1, nu, e0]);
    Table::from_low_rank(description(), axes(), Quantity::ALL.to_vec(), tiles).expect("valid")
}

/// Makes a low-rank table of `Gamma` in three tiles.
pub fn low_rank_in_tiles() -> Table {
    let mut axes = axes();
    (axes[1].1, axes[3].1) = (geometric(40, [0.01, 100.0]), geometric(10, [1.0, 1e5]));
    let tile = |film, substrate, terms| Tile {
        film,
        substrate,
        form: form(1, terms, [2; 3], 0.05, |i| 4 + i % 5),
    };
    let tiles = vec![
        tile([0, 20], [0, 9], [4, 12, 3, 5]),
        tile([20, 39], [0, 4], [2, 6, 2, 4]),
        tile([20, 39], [4, 9], [3, 20, 3, 3]),
    ];
    Table::from_low_rank(description(), axes, vec![Quantity::Gamma], tiles).expect("valid")
}

/// Returns a material in the box of every table of this file.
pub fn material() -> Material {
    Material::new(1.75, 0.3, 300.0, 0.25).expect("physical")
}

/// Returns `count` nodes, evenly spaced in the logarithm.
fn geometric(count: usize, [from, to]: [f64; 2]) -> Vec<f64> {
    let part = |i: usize| i as f64 / (count - 1).max(1) as f64;
    let node = |i: usize| from * (to / from).powf(part(i));
    (0..count).map(node).collect()
}

/// Makes a low-rank table of one material with `count` nodes in `a/t`, of rank 1. It takes few
/// bytes.
pub fn of_nodes(count: usize, a_over_t: [f64; 2]) -> Table {
    let axes = [
        (Parameter::AOverT, geometric(count, a_over_t)),
        (Parameter::E1OverE2, vec![1.75]),
        (Parameter::Nu1, vec![0.3]),
        (Parameter::E0OverE2, vec![300.0]),
    ];
    let form = form(4, [1, 1, 1, 30], [1; 3], 0.1, |i| 10 + i % 3);
    Table::from_low_rank(
        strict(),
        axes,
        Quantity::ALL.to_vec(),
        whole(form, [count, 1, 1, 1]),
    )
    .expect("valid")
}

/// Makes a low-rank table with these numbers of terms along the substrate's modulus, the film's,
/// its Poisson ratio and `a/t`, these ranks, and `n_a` nodes of `a/t`.
pub fn demanding(terms: [usize; 4], ranks: [usize; 3], n_a: usize) -> Result<Table, Error> {
    let [n_e0, n_e1, n_nu] = [0, 1, 2].map(|core| terms[core].min(2));
    let axes = [
        (Parameter::AOverT, geometric(n_a, [1e-3, 1e3])),
        (Parameter::E1OverE2, geometric(n_e1, [1.75, 100.0])),
        (Parameter::Nu1, geometric(n_nu, [0.3, 0.49])),
        (Parameter::E0OverE2, geometric(n_e0, [300.0, 1e5])),
    ];
    // So accurate that no part of a core is negligible, and yet of few bits for an integer.
    let integer = |i: i64| i64::from(i % 4 == 0);
    let form = form(4, terms, ranks, 1e-3, integer);
    Table::from_low_rank(
        strict(),
        axes,
        Quantity::ALL.to_vec(),
        whole(form, [n_a, n_e1, n_nu, n_e0]),
    )
}

/// Makes a dense table of noise with `shape` nodes on the axes, and a low-rank one of rank 1. The
/// splines amplify the noise.
pub fn of_shape(shape: [usize; 4], a_over_t: [f64; 2]) -> [Table; 2] {
    let middle = [1.0, 1.75, 0.3, 300.0];
    let axes = Parameter::ALL.map(|parameter| {
        let axis = parameter.dimension();
        let place = |i: usize| i as f64 / (shape[axis] - 1) as f64;
        let node = |i: usize| match axis {
            0 => a_over_t[0] * (a_over_t[1] / a_over_t[0]).powf(place(i)),
            2 => 0.5 * place(i),
            _ => 1e5_f64.powf(place(i)),
        };
        let nodes = if shape[axis] == 1 {
            vec![middle[axis]]
        } else {
            (0..shape[axis]).map(node).collect()
        };
        (parameter, nodes)
    });
    let description = strict();
    let noise = |i: usize| 1.0 + 0.1 * (i as f64).sin();
    let count: usize = shape.iter().product();
    let values = [3, 5, 7, 9].map(|factor| Some((0..count).map(|i| noise(factor * i)).collect()));
    let [a, e1, nu, e0] = shape.map(|count| count.min(40));
    let form = form(4, [e0, e1, nu, a], [1; 3], 0.1, |i| 10 + i % 3);
    let low_rank = Table::from_low_rank(
        description.clone(),
        axes.clone(),
        Quantity::ALL.to_vec(),
        whole(form, shape),
    )
    .expect("valid");
    [
        Table::new(description, axes, values).expect("valid"),
        low_rank,
    ]
}

/// The number of bytes of magic, version, length and checksum.
pub const PREFIX: usize = 24;

/// Returns a payload after magic, version, length and checksum, without which it is not read.
pub fn with_prefix(payload: &[u8]) -> Vec<u8> {
    with_payload(b"COATTBL\n\x04\0\0\0", payload)
}

/// Looks up a material in the middle of the table's box, and asserts that quantities are positive
/// and finite, and slopes and gradients finite.
pub fn look_up(table: &Table) -> Result<(), Error> {
    let middle = |parameter: Parameter| {
        let axis = table.axis(parameter);
        let (from, to) = (axis[0], axis[axis.len() - 1]);
        if parameter == Parameter::Nu1 {
            from.midpoint(to)
        } else {
            (from * to).sqrt()
        }
        .clamp(from, to)
    };
    let [e1, nu1, e0] = [Parameter::E1OverE2, Parameter::Nu1, Parameter::E0OverE2].map(middle);
    let nu0 = table.description().nu0.under(nu1);
    let curve = table.curve_with_gradient(&Material::new(e1, nu1, e0, nu0)?)?;
    let [from, to] = curve.range();
    for x in [
        from,
        middle(Parameter::AOverT),
        to,
        0.5 * from,
        2.0 * to,
        1e-3 * from,
        1e3 * to,
    ] {
        for quantity in table.quantities() {
            let Ok(value) = curve.quantity(quantity, x) else {
                continue;
            };
            assert!(
                value > 0.0 && value.is_finite(),
                "{} = {value:?} at {x:?}",
                quantity.name()
            );
            assert!(
                curve.slope(quantity, x)?.is_finite(),
                "{} at {x:?}",
                quantity.name()
            );
        }
        let Ok(gradient) = curve.gradient(x) else {
            continue;
        };
        let derivatives = MaterialParameter::ALL.map(|parameter| gradient.by(parameter));
        for derivative in derivatives.into_iter().flatten() {
            assert!(
                derivative.to_array().iter().all(|value| value.is_finite()),
                "{derivative:?} at {x:?}"
            );
        }
    }
    Ok(())
}

/// Returns the contact of the paper's system with a film of 1 um, on a substrate with the Poisson
/// ratio of the embedded table.
pub fn contact() -> Contact {
    let (film, substrate) = (Elastic::new(3.5e6, 0.5), Elastic::new(2e11, 0.25));
    let (film, substrate) = (film.expect("physical"), substrate.expect("physical"));
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-3 },
        sphere_modulus: 2e6,
        film,
        film_thickness: 1e-6,
        substrate,
    };
    Contact::in_table(Table::embedded(), &system).expect("in the table")
}

/// Returns the contact of this system without the film.
pub fn bare_contact() -> Contact {
    let half_space = contact().system().expect("on a film").without_film();
    Contact::half_space(&half_space).expect("physical")
}
