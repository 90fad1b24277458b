//! The attributes, axes and values of a table in its HDF5 file. `interp::schema` has their names.

use std::path::Path;

use hdf5::types::VarLenUnicode;
use hdf5::{H5Type, Location};
use interp::schema::{
    AXES, COMMENT, FORMAT, FORMAT_VERSION, LICENSE, REFERENCES, VALUES, attribute, checksum,
};
use interp::{Quantity, SubstratePoissonRatio, Table};
use ndarray::{ArrayView1, ArrayView4};

use super::bindings::{attach_scale, create_group, make_scale};

/// The number of values compressed together: those of all substrates and Poisson ratios of a few
/// films.
const CHUNK: usize = 1 << 15;
/// The compression level. A higher one takes more time and saves next to nothing on smooth data.
const DEFLATE: u8 = 4;

/// The bytes of written chunks that wait in memory. On a full disk those that wait cannot be written when the file
/// is closed, and the library crashes.
const NO_CACHE: usize = 0;

/// What a library returns where a chunk is missing: no number, because 0 is a valid node.
const MISSING: f64 = f64::NAN;

/// Writes the attributes, axes and values of a dense table to a new file.
pub fn fill(table: &Table, path: &Path) -> hdf5::Result<()> {
    // Every library since HDF5 1.8 reads this format. Without time stamps, equal tables are equal
    // files.
    let file = hdf5::File::with_options()
        .with_fapl(|access| access.libver_v18())
        .with_fcpl(|creation| creation.obj_track_times(false))
        .create(path)?;
    describe(table, &file)?;
    let scales = write_axes(table, &file)?;
    write_values(table, &file, &scales)?;
    file.flush()
}

/// Writes what the table is as attributes of the root group.
fn describe(table: &Table, file: &hdf5::File) -> hdf5::Result<()> {
    let description = table.description();
    text(file, attribute::FORMAT, FORMAT)?;
    number(file, attribute::FORMAT_VERSION, FORMAT_VERSION)?;
    text(file, attribute::COMMENT, COMMENT)?;
    text(file, attribute::REFERENCES, REFERENCES)?;
    text(file, attribute::LICENSE, LICENSE)?;
    text(file, attribute::TITLE, &description.title)?;
    text(file, attribute::SCENE, &description.scene)?;
    match description.nu0 {
        SubstratePoissonRatio::Fixed(nu0) => number(file, attribute::NU0, nu0)?,
        SubstratePoissonRatio::Paired => {
            text(file, attribute::NU0, SubstratePoissonRatio::PAIRED)?;
        }
    }
    text(file, attribute::NORMALISED_BY, table.unit())?;
    number(file, attribute::TOLERANCE, description.tolerance)?;
    text(file, attribute::CREATED_BY, &description.created_by)?;
    let certificate = &description.certificate;
    number(file, attribute::CERTIFIED_MAX_ERROR, certificate.max_error)?;
    number(
        file,
        attribute::CERTIFIED_MEDIAN_ERROR,
        certificate.median_error,
    )?;
    number(file, attribute::CERTIFIED_POINTS, certificate.points)?;
    number(file, attribute::CERTIFIED_SEED, certificate.seed)?;
    number(
        file,
        attribute::CERTIFIED_P999_ERROR,
        certificate.p999_error,
    )?;
    text(
        file,
        attribute::CERTIFIED_WORST_QUANTITY,
        certificate.worst_quantity.name(),
    )?;
    numbers(
        file,
        attribute::CERTIFIED_WORST_POINT,
        &certificate.worst_point,
    )?;
    numbers(
        file,
        attribute::CERTIFIED_IDENTITY_ERRORS,
        &certificate
            .identity_errors
            .map(|error| error.unwrap_or(f64::NAN)),
    )?;

    number(file, attribute::CHECKSUM, checksum(table))
}

/// Writes the nodes, as dimension scales.
fn write_axes(table: &Table, file: &hdf5::File) -> hdf5::Result<Vec<hdf5::Dataset>> {
    let axes = create_group(file, AXES)?;
    let mut scales = Vec::new();
    for parameter in table.parameters() {
        let nodes = table.axis(parameter);
        // One chunk, because only chunks can have a checksum.
        let builder = axes
            .new_dataset_builder()
            .obj_track_times(false)
            .chunk(nodes.len())
            .fill_value(MISSING)
            .fletcher32();
        let axis = builder
            .with_data(ArrayView1::from(nodes))
            .create(parameter.name())?;
        text(&axis, attribute::UNITS, "1")?;
        text(&axis, attribute::LONG_NAME, parameter.long_name())?;
        text(
            &axis,
            attribute::SCALE,
            if nodes.len() == 1 {
                "fixed"
            } else {
                parameter.scale()
            },
        )?;
        make_scale(&axis, parameter.name())?;
        link_in_root(file, AXES, parameter.name())?;
        scales.push(axis);
    }
    Ok(scales)
}

/// Writes the values of each quantity at the nodes.
fn write_values(table: &Table, file: &hdf5::File, scales: &[hdf5::Dataset]) -> hdf5::Result<()> {
    let values = create_group(file, VALUES)?;
    let shape = table.shape();
    let chunk = chunk(shape);
    for quantity in Quantity::ALL {
        let Some(data) = table.values(quantity) else {
            continue;
        };
        let view = ArrayView4::from_shape(shape, data).map_err(|e| e.to_string())?;
        let builder = values
            .new_dataset_builder()
            .obj_track_times(false)
            .chunk(chunk)
            .chunk_cache(1, NO_CACHE, 1.0)
            .fill_value(MISSING)
            .shuffle()
            .deflate(DEFLATE)
            .fletcher32();
        let dataset = builder.with_data(view).create(quantity.name())?;
        text(&dataset, attribute::UNITS, "1")?;
        text(&dataset, attribute::LONG_NAME, quantity.long_name())?;
        text(&dataset, attribute::EQUATION, quantity.equation())?;
        for (dimension, scale) in (0..).zip(scales) {
            attach_scale(&dataset, scale, dimension)?;
        }
        link_in_root(file, VALUES, quantity.name())?;
    }
    Ok(())
}

/// Links the dataset `name` of a group in the root group too, under the same name.
///
/// Programs that read netCDF, xarray among them, look for dimensions and variables in one group.
fn link_in_root(file: &hdf5::File, group: &str, name: &str) -> hdf5::Result<()> {
    file.link_hard(&format!("{group}/{name}"), name)
}

/// Returns the shape of a chunk: the last dimensions whole as long as they fit into [`CHUNK`].
fn chunk(shape: [usize; 4]) -> [usize; 4] {
    let mut room = CHUNK;
    let mut chunk = [1; 4];
    for dimension in (0..4).rev() {
        chunk[dimension] = shape[dimension].min(room).max(1);
        room /= chunk[dimension];
    }
    chunk
}

fn text(location: &Location, name: &str, value: &str) -> hdf5::Result<()> {
    let value: VarLenUnicode = value.parse().map_err(|e| format!("{name}: {e}"))?;
    location
        .new_attr::<VarLenUnicode>()
        .create(name)?
        .write_scalar(&value)
}

fn number<T: H5Type>(location: &Location, name: &str, value: T) -> hdf5::Result<()> {
    location.new_attr::<T>().create(name)?.write_scalar(&value)
}

fn numbers(location: &Location, name: &str, values: &[f64]) -> hdf5::Result<()> {
    location
        .new_attr::<f64>()
        .shape(values.len())
        .create(name)?
        .write(ArrayView1::from(values))
}
