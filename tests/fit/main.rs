//! Fits of measured curves: the truth within the intervals, doubts where there is reason, errors
//! that name the line.

#![forbid(unsafe_code)]

mod doubts;
mod drawn;
mod hostile;
mod imagined;
mod intervals;
mod layers;
mod left_out;
mod minima;
mod planning;
mod recovery;
mod shapes;
