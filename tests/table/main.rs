//! Tables: scenes, generation, certificates, files, and the lookup.

#![forbid(unsafe_code)]

mod beyond;
mod certificate;
mod curve;
mod damaged_hdf5;
mod files;
mod forged_forms;
mod generate;
mod h5py;
mod hostile;
mod lookup;
mod lookup_errors;
mod low_rank;
mod scenes;
mod stacks;
mod tables;
mod xarray;
