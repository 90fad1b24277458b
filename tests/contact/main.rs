//! Contacts in SI units: loads, equilibria, derivatives, and moving contact lines.

#![forbid(unsafe_code)]

mod branch;
mod contact;
mod crack_tip;
mod equilibria;
mod gradient;
mod half_space;
mod hostile;
mod jkr;
mod moving_stiffness;
mod outside;
mod profile;
mod shapes;
mod sphere_radius;
mod stacks;
mod stiff_films;
