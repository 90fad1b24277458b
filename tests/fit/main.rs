//! Fits of measured curves: the truth within the intervals, doubts where there is reason, errors
//! that name the line.

#![forbid(unsafe_code)]

mod abscissa_noise;
mod baseline;
mod contact_stiffness;
mod cycles;
mod detector;
mod doubts;
mod drawn;
mod fixed_values;
mod hostile;
mod imagined;
mod interfaces;
mod intervals;
mod jkr_plot;
mod layers;
mod layers_refused;
mod left_out;
mod limits_of_doubts;
mod line_doubts;
mod line_half_space;
mod line_speed;
mod magnitudes;
mod minima;
mod noise;
mod noisy_cycles;
mod not_shown;
mod planning;
mod recovery;
mod relaxing;
mod relaxing_doubts;
mod several_files;
mod shapes;
mod shared_noise;
mod unknown_noise;
mod weights;
