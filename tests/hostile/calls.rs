//! The calls of [`FUNCTIONS`](crate::functions::FUNCTIONS) that take more than a line, and the
//! contacts that they are about.

use std::sync::LazyLock;

use contact::{Contact, Control, Input, State};
use interp::{Curve, Elastic, Error, HalfSpace, Material, Probe, Quantity, System, Table};

use crate::tables;

/// The results of a function, which must be finite, or an error. Results that may be infinite are
/// checked where they are computed.
pub type Results = Result<Vec<f64>, contact::Error>;

/// A contact on a film, and one on a half-space.
pub static CONTACTS: LazyLock<[Contact; 2]> =
    LazyLock::new(|| [tables::contact(), tables::bare_contact()]);

/// Contacts whose radius and modulus or thickness are at the ends of arithmetic: all that are
/// accepted, on half-spaces and on films.
static EXTREMES: LazyLock<Vec<Contact>> = LazyLock::new(|| {
    const NUMBERS: [f64; 12] = [
        5e-324,
        f64::MIN_POSITIVE,
        1e-150,
        1e-30,
        1e-9,
        5e-5,
        0.04,
        1.0,
        1e30,
        1e150,
        f64::MAX,
        f64::INFINITY,
    ];
    let film = CONTACTS[0].system().expect("on a film");
    let of = |radius: f64, number: f64| {
        let probe = Probe::Paraboloid { radius };
        let half_space = HalfSpace {
            probe: probe.clone(),
            sphere_modulus: number,
            solid: film.without_film().solid,
        };
        let film = System {
            probe,
            film_thickness: number,
            ..film.clone()
        };
        let on_film = Contact::in_table(Table::embedded(), &film);
        Contact::half_space(&half_space).into_iter().chain(on_film)
    };
    let pairs = NUMBERS
        .iter()
        .flat_map(|&r| NUMBERS.map(|number| (r, number)));
    pairs.flat_map(|(r, number)| of(r, number)).collect()
});

/// The contact on a film, with gradients.
pub static GRADIENTS: LazyLock<Contact> = LazyLock::new(|| {
    Contact::in_table_with_gradient(Table::embedded(), CONTACTS[0].system().expect("on a film"))
        .expect("in the table")
});

/// Returns the curve of the contact on a film.
pub fn curve() -> &'static Curve {
    CONTACTS[0].curve().expect("on a film")
}

/// Calls a function of both contacts. It is an error only if both calls are.
pub fn both(call: impl Fn(&Contact) -> Results) -> Results {
    let [film, half_space] = CONTACTS.each_ref().map(call);
    match (film, half_space) {
        (Ok(film), Ok(half_space)) => Ok([film, half_space].concat()),
        (film, half_space) => film.or(half_space),
    }
}

/// As [`both`], and checks the results of three of [`EXTREMES`] too, which the bits of the arguments
/// `x` choose.
pub fn each(x: &[f64], call: impl Fn(&Contact) -> Results) -> Results {
    let mixed = x.iter().fold(0_u64, |mixed, number| {
        (mixed ^ number.to_bits())
            .wrapping_mul(0x9e37_79b9_7f4a_7c15)
            .rotate_left(29)
    });
    for shift in [0, 16, 32] {
        let contact = &EXTREMES[(mixed >> shift) as usize % EXTREMES.len()];
        let results = call(contact).unwrap_or_default();
        assert!(
            results.iter().all(|value| value.is_finite()),
            "{results:?} of {contact:?}"
        );
    }
    both(call)
}

/// Returns all controls.
pub fn controls(stiffness: f64) -> [Control; 3] {
    [
        Control::Load,
        Control::Displacement,
        Control::Spring { stiffness },
    ]
}

/// Returns the numbers of a state.
pub fn numbers(state: State) -> [f64; 3] {
    [state.contact_radius, state.load, state.penetration]
}

/// Makes a system of seven numbers.
pub fn system(x: &[f64]) -> Result<System, Error> {
    let (film, substrate) = (Elastic::new(x[2], x[3])?, Elastic::new(x[5], x[6])?);
    Ok(System {
        probe: Probe::Paraboloid { radius: x[0] },
        sphere_modulus: x[1],
        film,
        film_thickness: x[4],
        substrate,
    })
}

/// Makes a half-space of four numbers.
pub fn half_space(x: &[f64]) -> Result<HalfSpace, Error> {
    Ok(HalfSpace {
        probe: Probe::Paraboloid { radius: x[0] },
        sphere_modulus: x[1],
        solid: Elastic::new(x[2], x[3])?,
    })
}

/// Makes a material of four numbers.
pub fn material(x: &[f64]) -> Result<Material, Error> {
    Material::new(x[0], x[1], x[2], x[3])
}

/// Returns the moduli and limits of a material that must be finite, and checks the others.
pub fn moduli(material: &Material) -> Results {
    let moduli = [
        material.film_modulus(),
        material.substrate_modulus(),
        material.sphere_substrate_modulus(),
    ];
    let limit = material.thin_film_limit().to_array();
    let infinite = [&moduli[..], &limit, &[material.film_over_substrate()]].concat();
    assert!(
        infinite.iter().all(|value| *value >= 0.0),
        "{material:?}: {infinite:?}"
    );
    let finite = [
        material.e1_over_e2(),
        material.nu1(),
        material.nu0(),
        material.sphere_film_modulus(),
    ];
    Ok([finite, material.thick_film_limit().to_array()].concat())
}

/// Returns the quantities of a curve, which must be positive, and their slopes.
pub fn quantities(curve: &Curve, a_over_t: f64) -> Results {
    let values = curve.quantities(a_over_t)?.to_array();
    assert!(
        values.iter().all(|&value| value > 0.0),
        "{values:?} at {a_over_t:?}"
    );
    let slopes: Result<Vec<f64>, Error> = Quantity::ALL
        .iter()
        .map(|&quantity| curve.slope(quantity, a_over_t))
        .collect();
    Ok([values.to_vec(), slopes?].concat())
}

/// Returns the load, and load and penetration together.
pub fn loads(contact: &Contact, a: f64, w: f64) -> Results {
    let (load, penetration) = contact.load_and_penetration(a, w)?;
    Ok(vec![contact.load(a, w)?, load, penetration])
}

/// Returns load, penetration and their known derivatives.
pub fn gradients(contact: &Contact, a: f64, w: f64) -> Results {
    let gradient = contact.gradient(a, w)?;
    let known = Input::ALL
        .into_iter()
        .filter_map(|input| gradient.by(input).ok());
    let mut numbers = vec![gradient.load(), gradient.penetration()];
    numbers.extend(known.flat_map(|by| [by.load, by.penetration]));
    Ok(numbers)
}
