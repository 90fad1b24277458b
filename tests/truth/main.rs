//! The solve and the model against published and independently computed values, exact identities
//! and limits.

#![forbid(unsafe_code)]

mod approximations;
mod catalogue;
mod cohesive;
mod cohesive_zone;
mod compliance;
mod contacts;
mod derived;
mod domain;
mod equilibria;
mod equivalence;
mod hard_cases;
mod hayes;
mod identities;
mod interface_contacts;
mod interface_limits;
mod interfaces;
mod layer_limits;
mod limits;
mod paper;
mod power_laws;
mod pull_off;
mod reference;
mod regimes;
mod shape_limits;
mod shapes_on_stacks;
mod stack_limits;
mod stacks;
mod stick;
mod stick_effects;
mod stick_errors;
mod stick_layers;
mod stick_limits;
mod surface_tension;
mod viscoelastic;
