//! The HDF5 file of a table: written atomically, read with every type and shape checked.

use std::fs::File;
use std::io;
use std::path::Path;

use hdf5::types::{FloatSize, IntSize, TypeDescriptor, VarLenUnicode};
use hdf5::{Dataset, H5Type, Location};
use interp::schema::{AXES, FORMAT, FORMAT_VERSION, Parameter, VALUES, attribute};
use interp::{Certificate, Description, Normalisation, Quantity, Table};
use ndarray::{ArrayView1, ArrayView4};

use crate::dimension_scale::{attach_scale, make_scale};
use crate::{Error, output};

/// Values compressed together: a chunk spans all substrates and Poisson ratios of a few films.
const CHUNK: usize = 1 << 15;
/// Compression level: more costs time and saves next to nothing on smooth f64 data.
const DEFLATE: u8 = 4;

/// Writes the table under a temporary name and renames it when it is complete, so that `path` never holds half a table.
///
/// # Errors
/// [`Error::Write`] with the path.
pub fn write(table: &Table, path: &Path) -> Result<(), Error> {
    output::atomically(path, |unfinished| fill(table, unfinished).map_err(io::Error::other))
}

fn fill(table: &Table, path: &Path) -> hdf5::Result<()> {
    // Readable by every library since HDF5 1.8, and without time stamps: equal tables are equal files.
    let file = hdf5::File::with_options()
        .with_fapl(|access| access.libver_v18())
        .with_fcpl(|creation| creation.obj_track_times(false))
        .create(path)?;
    let description = table.description();
    text(&file, attribute::FORMAT, FORMAT)?;
    number(&file, attribute::FORMAT_VERSION, FORMAT_VERSION)?;
    text(&file, attribute::TITLE, &description.title)?;
    text(&file, attribute::SCENE, &description.scene)?;
    number(&file, attribute::NU0, description.nu0)?;
    text(&file, attribute::NORMALISED_BY, description.normalisation.symbol())?;
    number(&file, attribute::TOLERANCE, description.tolerance)?;
    text(&file, attribute::CREATED_BY, &description.created_by)?;
    let certificate = &description.certificate;
    number(&file, attribute::CERTIFIED_MAX_ERROR, certificate.max_error)?;
    number(&file, attribute::CERTIFIED_MEDIAN_ERROR, certificate.median_error)?;
    number(&file, attribute::CERTIFIED_POINTS, certificate.points)?;
    number(&file, attribute::CERTIFIED_SEED, certificate.seed)?;

    let axes = file.create_group(AXES)?;
    let mut scales = Vec::new();
    for parameter in Parameter::ALL {
        let nodes = table.axis(parameter);
        let builder = axes.new_dataset_builder().obj_track_times(false);
        let axis = builder.with_data(ArrayView1::from(nodes)).create(parameter.name())?;
        text(&axis, attribute::UNITS, "1")?;
        text(&axis, attribute::LONG_NAME, parameter.long_name())?;
        text(&axis, attribute::SCALE, if nodes.len() == 1 { "fixed" } else { parameter.scale() })?;
        make_scale(&axis, parameter.name())?;
        scales.push(axis);
    }

    let values = file.create_group(VALUES)?;
    let shape = table.shape();
    let chunk = chunk(shape);
    for quantity in Quantity::ALL {
        let Some(data) = table.values(quantity) else { continue };
        let view = ArrayView4::from_shape(shape, data).map_err(|e| e.to_string())?;
        let builder = values.new_dataset_builder().obj_track_times(false).chunk(chunk).shuffle().deflate(DEFLATE).fletcher32();
        let dataset = builder.with_data(view).create(quantity.name())?;
        text(&dataset, attribute::UNITS, "1")?;
        text(&dataset, attribute::LONG_NAME, quantity.long_name())?;
        text(&dataset, attribute::EQUATION, quantity.equation())?;
        for (dimension, scale) in (0..).zip(&scales) {
            attach_scale(&dataset, scale, dimension)?;
        }
    }
    file.flush()
}

/// Whole trailing dimensions as long as they fit.
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
    location.new_attr::<VarLenUnicode>().create(name)?.write_scalar(&value)
}

fn number<T: H5Type>(location: &Location, name: &str, value: T) -> hdf5::Result<()> {
    location.new_attr::<T>().create(name)?.write_scalar(&value)
}

/// Reads a table.
///
/// # Errors
/// [`Error::Read`] if there is no such file; [`Error::Table`] for a file that is no table, another format version, or malformed parts.
pub fn read(path: &Path) -> Result<Table, Error> {
    // Opened here first, so that a missing file is told from a foreign one.
    drop(File::open(path).map_err(|source| Error::Read { path: path.to_owned(), source })?);
    let foreign = |what: String| Error::from(interp::Error::Foreign(what));
    let file = hdf5::File::open(path).map_err(|e| foreign(e.to_string()))?;
    if !read_text(&file, attribute::FORMAT).is_ok_and(|format| format == FORMAT) {
        return Err(foreign(format!("its attribute {} is not {FORMAT:?}", attribute::FORMAT)));
    }
    let version: u32 = read_number(&file, attribute::FORMAT_VERSION, TypeDescriptor::Unsigned(IntSize::U4)).map_err(malformed)?;
    if version != FORMAT_VERSION {
        return Err(interp::Error::Version { found: version, supported: FORMAT_VERSION }.into());
    }
    let (description, axes, values) = parts(&file).map_err(malformed)?;
    Ok(Table::new(description, axes, values)?)
}

type Parts = (Description, [Vec<f64>; 4], [Option<Vec<f64>>; 4]);

fn parts(file: &hdf5::File) -> hdf5::Result<Parts> {
    let real = |name| read_number::<f64>(file, name, TypeDescriptor::Float(FloatSize::U8));
    let count = |name| read_number::<u64>(file, name, TypeDescriptor::Unsigned(IntSize::U8));
    let symbol = read_text(file, attribute::NORMALISED_BY)?;
    let normalisation = [Normalisation::Sphere, Normalisation::Film]
        .into_iter()
        .find(|normalisation| normalisation.symbol() == symbol)
        .ok_or_else(|| format!("it is normalised by {symbol:?}"))?;
    let description = Description {
        title: read_text(file, attribute::TITLE)?,
        scene: read_text(file, attribute::SCENE)?,
        nu0: real(attribute::NU0)?,
        normalisation,
        tolerance: real(attribute::TOLERANCE)?,
        created_by: read_text(file, attribute::CREATED_BY)?,
        certificate: Certificate {
            max_error: real(attribute::CERTIFIED_MAX_ERROR)?,
            median_error: real(attribute::CERTIFIED_MEDIAN_ERROR)?,
            points: count(attribute::CERTIFIED_POINTS)?,
            seed: count(attribute::CERTIFIED_SEED)?,
        },
    };
    let group = file.group(AXES)?;
    let mut axes = [const { Vec::new() }; 4];
    for (axis, parameter) in axes.iter_mut().zip(Parameter::ALL) {
        let dataset = group.dataset(parameter.name())?;
        *axis = read_dataset(&dataset, &[dataset.size()])?;
    }
    let shape = axes.each_ref().map(Vec::len);
    let group = file.group(VALUES)?;
    let mut values = [const { None }; 4];
    for quantity in Quantity::ALL {
        if group.link_exists(quantity.name()) {
            values[quantity as usize] = Some(read_dataset(&group.dataset(quantity.name())?, &shape)?);
        }
    }
    Ok((description, axes, values))
}

/// The values of a dataset of the given shape. The stored type is checked, because the library would convert any other silently.
fn read_dataset(dataset: &Dataset, shape: &[usize]) -> hdf5::Result<Vec<f64>> {
    let (kind, found) = (dataset.dtype()?.to_descriptor()?, dataset.shape());
    if kind != TypeDescriptor::Float(FloatSize::U8) || found != shape {
        return Err(format!("{} holds {kind} of shape {found:?}, not float64 of shape {shape:?}", dataset.name()).into());
    }
    dataset.read_raw()
}

fn read_text(location: &Location, name: &str) -> hdf5::Result<String> {
    Ok(location.attr(name)?.read_scalar::<VarLenUnicode>()?.as_str().to_owned())
}

fn read_number<T: H5Type>(location: &Location, name: &str, kind: TypeDescriptor) -> hdf5::Result<T> {
    let attribute = location.attr(name)?;
    let found = attribute.dtype()?.to_descriptor()?;
    if found != kind {
        return Err(format!("attribute {name} holds {found}, not {kind}").into());
    }
    attribute.read_scalar()
}

fn malformed(error: hdf5::Error) -> Error {
    interp::Error::Malformed(error.to_string()).into()
}
