//! Contacts in SI units: loads, equilibria, derivatives, moving contact lines, and fits.

#![forbid(unsafe_code)]

mod contact;
mod crack_tip;
mod equilibria;
mod fit;
mod gradient;
mod half_space;
mod sphere_radius;
