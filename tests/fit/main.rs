//! Fits of measured curves: the truth within the intervals, doubts where there is reason, errors
//! that name the line.

#![forbid(unsafe_code)]

mod doubts;
mod hostile;
mod imagined;
mod layers;
mod magnitudes;
mod planning;
mod recovery;
mod shapes;
