//! A bound of the departure of the surface compliance of a stack from 1.

use interp::Elastic;

use crate::stack::{Layer, Stack};

/// Returns a bound of `|X - 1|`.
///
/// A body whose shear and bulk modulus are nowhere above those of another is nowhere stiffer, at
/// any wave number, and an interface that is not bonded stiffens nothing. `X` is therefore at least
/// the compliance of the half-space with the largest shear and the largest bulk modulus of all
/// bodies. Where all interfaces are bonded, it is at most that of the half-space with the smallest
/// of both.
///
/// Other interfaces divide the stack into groups of bonded bodies. By the principle of minimum
/// complementary energy, any stresses in equilibrium give an upper bound. One field carries the
/// pressure through all groups without shear stress between them. The group with the base has at
/// most the compliance `c` of its softest half-space, a free group at most `2c`, because a layer
/// between equal pressures is two layers on a rigid mirror plane, and the springs have `k/(2 kn)`.
/// The other field leaves the bodies below the highest normal springs without stress: a free group
/// of the thickness `H` has at most `c (2 + 8/(kH)^3)`. The first grows with the wave number and
/// the second falls: the larger of both, at any wave number, is a bound everywhere.
pub fn largest_excess(stack: &Stack) -> f64 {
    let groups = groups(stack);
    let unit = stack.top().solid.reduced();
    let bodies = || groups.iter().flat_map(|group| &group.bodies);
    let smallest = unit * extreme(bodies(), [f64::max, f64::min]);
    let softest = |group: &Group| unit * extreme(group.bodies.iter(), [f64::min, f64::max]);
    let mut through = 0.0;
    // The sum of `E_N*/(2 kn)`, and the field without normal springs: its groups, the free one last.
    let (mut springs, mut without): (f64, Option<[f64; 2]>) = (0.0, None);
    let mut above = 0.0;
    for (i, group) in groups.iter().enumerate().rev() {
        let is_base = i == 0;
        let compliance = softest(group);
        through += if is_base {
            compliance
        } else {
            2.0 * compliance
        };
        if group.normal < f64::INFINITY {
            springs += 0.5 * unit / group.normal;
            without.get_or_insert([
                above + 2.0 * compliance,
                8.0 * compliance / group.thickness.powi(3),
            ]);
        }
        above += 2.0 * compliance;
    }
    let largest = match without {
        None => through,
        Some([constant, cubic]) => {
            // Where the terms of the springs and of the free group are equal.
            let k = (cubic / springs).powf(0.25);
            (through + springs * k).max(constant + cubic / k.powi(3))
        }
    };
    (largest - 1.0).max(1.0 - smallest).max(0.0)
}

/// Bodies that are bonded to each other, from the base up.
struct Group {
    bodies: Vec<Elastic>,
    /// The thickness of the layers.
    thickness: f64,
    /// The normal stiffness of the interface below; infinity below the base.
    normal: f64,
}

/// Returns the groups, from the base up.
fn groups(stack: &Stack) -> Vec<Group> {
    let mut groups = vec![Group {
        bodies: vec![stack.base()],
        thickness: 0.0,
        normal: f64::INFINITY,
    }];
    for Layer {
        solid,
        thickness,
        interface,
    } in stack.layers()
    {
        match groups.last_mut() {
            Some(group) if interface.is_bonded() => {
                group.bodies.push(*solid);
                group.thickness += thickness;
            }
            _ => groups.push(Group {
                bodies: vec![*solid],
                thickness: *thickness,
                normal: interface.stiffnesses()[1],
            }),
        }
    }
    groups
}

/// Returns the compliance `1/E*` of the half-space with an extreme of the shear moduli and the
/// opposite extreme of the compressibilities, `[of_shear, of_compressibility]`, of `bodies`.
fn extreme<'a>(
    bodies: impl Iterator<Item = &'a Elastic>,
    [of_shear, of_compressibility]: [fn(f64, f64) -> f64; 2],
) -> f64 {
    let numbers = |solid: &Elastic| {
        let compressibility = 3.0 * (1.0 - 2.0 * solid.poisson()) / solid.young();
        [shear(solid), compressibility]
    };
    let [shear, compressibility] = bodies
        .map(numbers)
        .reduce(|[g, c], [shear, compressibility]| {
            [of_shear(g, shear), of_compressibility(c, compressibility)]
        })
        .expect("a group has a body");
    if shear == f64::INFINITY {
        return 0.0;
    }
    // `1/E* = (3K + 4G)/(4G (3K + G))`, with the compressibility `1/K`, 0 at a Poisson ratio of
    // 1/2.
    (3.0 + 4.0 * shear * compressibility) / (4.0 * shear * (3.0 + shear * compressibility))
}

/// Returns the shear modulus.
pub fn shear(solid: &Elastic) -> f64 {
    solid.young() / (2.0 * (1.0 + solid.poisson()))
}
