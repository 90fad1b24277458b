//! Fits of measured curves: the truth within the intervals, doubts where there is reason, errors
//! that name the line.

#![forbid(unsafe_code)]

mod abscissa_noise;
mod doubts;
mod hostile;
mod imagined;
mod layers;
mod planning;
mod recovery;
mod shapes;
