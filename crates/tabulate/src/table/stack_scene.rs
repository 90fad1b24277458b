//! Scenes of one stack of layers: the table `[stack]` of a scene, and what goes with it.

use interp::{Parameter, SubstratePoissonRatio};

use crate::stack;
use crate::table::extent::{Bounds, Extent};
use crate::table::scene_text::{Text, checked};
use solve::check_reach;
use solve::stack::Stack;

/// Returns the box of a stack of layers.
pub(super) fn bounds(scene: &Text, stack: stack::Text) -> Result<Bounds, String> {
    let settled = [
        ("nu1", scene.nu1.is_some()),
        ("nu0", scene.nu0.is_some()),
        ("e0_over_e2", scene.e0_over_e2.is_some()),
        ("e1s_over_einfs", scene.e1s_over_einfs.is_some()),
        ("e0s_over_e2s", scene.e0s_over_e2s.is_some()),
    ];
    if let Some((key, _)) = settled.iter().find(|(_, given)| *given) {
        return Err(format!(
            "{key} does not go with [stack], whose layers and base have their moduli and Poisson \
             ratios: leave it out"
        ));
    }
    let Some(spheres) = &scene.e1_over_e2 else {
        return Err(
            "e1_over_e2 is missing: give a number or a range, Young's modulus of the top \
             layer over the sphere's reduced modulus E2* (0: rigid sphere)"
                .into(),
        );
    };
    let named = stack.stack().map_err(|what| format!("stack: {what}"))?;
    let (top, base) = (named.stack.surface(), named.stack.base());
    Ok(Bounds {
        parameters: Parameter::STACK,
        extents: [
            checked(Parameter::AOverT, &scene.a_over_t)?,
            checked(Parameter::E1OverE2, spheres)?,
            Extent::Fixed(top.poisson()),
            Extent::Fixed(base.young() / top.young()),
        ],
        nu0: SubstratePoissonRatio::Fixed(base.poisson()),
        stack: Some(named),
    })
}

/// Accepts the contact radii and the spheres of a scene of a stack.
pub(super) fn check(stack: &Stack, extents: &[Extent; 4]) -> Result<(), String> {
    check_reach(stack, extents[0].ends()[1]).map_err(|e| e.to_string())?;
    let young = stack.surface().young();
    let [softest, stiffest] = extents[1].ends();
    let representable = young / stiffest >= f64::MIN_POSITIVE && young / softest < f64::INFINITY;
    if representable || stiffest == 0.0 {
        return Ok(());
    }
    Err(format!(
        "e1_over_e2 = {softest:?} to {stiffest:?} with a top layer of {young:?} Pa are spheres \
         beyond double precision: give the moduli of the stack in Pa"
    ))
}

/// Returns the message of the TOML reader, or a better one for layers outside of a stack.
pub(super) fn explained(text: &str, error: &toml::de::Error) -> String {
    let keys = text.parse::<toml::Table>().unwrap_or_default();
    match keys.keys().find(|key| key.starts_with("layer")) {
        Some(key) => format!(
            "{key}: the layers of a scene are in its table [stack]: write [stack] with base = {{ .. }}, then a \
             [[stack.layers]] for each layer, after the keys title, tolerance, quantities, a_over_t and e1_over_e2"
        ),
        None => error.to_string().trim_end().to_owned(),
    }
}
