//! Reads the HDF5 table without a C library.

use std::collections::HashMap;
use std::path::Path;

use hdf5_pure::{AttrValue, DType, File};

use crate::table::schema::{AXES, FORMAT, FORMAT_VERSION, VALUES, attribute};
use crate::{Certificate, Description, Error, Normalisation, Parameter, Quantity, Table};

impl Table {
    /// Reads an HDF5 table (feature `hdf5`).
    ///
    /// # Errors
    /// [`Error::Io`] if the file cannot be opened, [`Error::Foreign`] if it is no HDF5 file or
    /// holds no table, [`Error::Version`] for another version, [`Error::Malformed`] for missing,
    /// mistyped or contradicting parts.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        // Opened here first, so that a missing file is told from a foreign one.
        let path = path.as_ref();
        let io = |source| Error::Io {
            path: path.to_owned(),
            source,
        };
        let bytes = std::fs::metadata(path).map_err(io)?.len();
        drop(std::fs::File::open(path).map_err(io)?);
        let file = File::open(path).map_err(|e| Error::Foreign(e.to_string()))?;
        let attributes = Attributes(file.root().attrs().map_err(malformed)?);
        match attributes.text(attribute::FORMAT) {
            Ok(FORMAT) => {}
            _ => {
                return Err(Error::Foreign(format!(
                    "its attribute {} is not {FORMAT:?}",
                    attribute::FORMAT
                )));
            }
        }
        let version = attributes.integer(attribute::FORMAT_VERSION)?;
        if version != u64::from(FORMAT_VERSION) {
            let found = u32::try_from(version).unwrap_or(u32::MAX);
            return Err(Error::Version {
                found,
                supported: FORMAT_VERSION,
            });
        }
        let normalised_by = attributes.text(attribute::NORMALISED_BY)?;
        let normalisation = [Normalisation::Sphere, Normalisation::Film]
            .into_iter()
            .find(|normalisation| normalisation.symbol() == normalised_by)
            .ok_or_else(|| Error::Malformed(format!("it is normalised by {normalised_by:?}")))?;
        let description = Description {
            title: attributes.text(attribute::TITLE)?.to_owned(),
            scene: attributes.text(attribute::SCENE)?.to_owned(),
            nu0: attributes.number(attribute::NU0)?,
            normalisation,
            tolerance: attributes.number(attribute::TOLERANCE)?,
            created_by: attributes.text(attribute::CREATED_BY)?.to_owned(),
            certificate: certificate(&attributes)?,
        };
        let mut axes = [const { Vec::new() }; 4];
        for (axis, parameter) in axes.iter_mut().zip(Parameter::ALL) {
            *axis = dataset(&file, bytes, &format!("{AXES}/{}", parameter.name()), None)?;
        }
        let shape: Vec<u64> = axes.iter().map(|nodes| nodes.len() as u64).collect();
        let held = file
            .group(VALUES)
            .and_then(|group| group.datasets())
            .map_err(malformed)?;
        let mut values = [const { None }; 4];
        for quantity in Quantity::ALL {
            if held.iter().any(|name| name == quantity.name()) {
                values[quantity as usize] = Some(dataset(
                    &file,
                    bytes,
                    &format!("{VALUES}/{}", quantity.name()),
                    Some(&shape),
                )?);
            }
        }
        Self::new(description, axes, values)
    }
}

/// The certificate that the attributes hold.
fn certificate(attributes: &Attributes) -> Result<Certificate, Error> {
    let name = attributes.text(attribute::CERTIFIED_WORST_QUANTITY)?;
    let quantity = Quantity::ALL
        .into_iter()
        .find(|quantity| quantity.name() == name);
    Ok(Certificate {
        max_error: attributes.number(attribute::CERTIFIED_MAX_ERROR)?,
        p999_error: attributes.number(attribute::CERTIFIED_P999_ERROR)?,
        median_error: attributes.number(attribute::CERTIFIED_MEDIAN_ERROR)?,
        points: attributes.integer(attribute::CERTIFIED_POINTS)?,
        seed: attributes.integer(attribute::CERTIFIED_SEED)?,
        worst_quantity: quantity
            .ok_or_else(|| Error::Malformed(format!("its largest error is that of {name:?}")))?,
        worst_point: attributes.numbers(attribute::CERTIFIED_WORST_POINT)?,
        identity_errors: attributes
            .numbers(attribute::CERTIFIED_IDENTITY_ERRORS)?
            .map(|error: f64| (!error.is_nan()).then_some(error)),
    })
}

/// More than deflate can shrink anything: a dataset larger than the file times this is a forged
/// one.
const COMPRESSION: u64 = 1032;

/// The f64 values of a dataset, which must have the given shape (or one dimension), in a file of
/// the given size.
fn dataset(file: &File, bytes: u64, path: &str, shape: Option<&[u64]>) -> Result<Vec<f64>, Error> {
    let dataset = file.dataset(path).map_err(malformed)?;
    let kind = dataset.dtype().map_err(malformed)?;
    if !matches!(kind, DType::F64) {
        return Err(Error::Malformed(format!("{path} holds {kind}, not f64")));
    }
    let found = dataset.shape().map_err(malformed)?;
    if shape.is_some_and(|shape| shape != found) {
        return Err(Error::Malformed(format!(
            "{path} has shape {found:?}, its axes have {shape:?}"
        )));
    }
    let size = found
        .iter()
        .try_fold(8_u64, |size, &length| size.checked_mul(length));
    if found.len() != shape.map_or(1, <[u64]>::len)
        || size.is_none_or(|size| size > bytes.saturating_mul(COMPRESSION))
    {
        return Err(Error::Malformed(format!(
            "{path} has shape {found:?} in a file of {bytes} bytes"
        )));
    }
    dataset.read_f64().map_err(malformed)
}

struct Attributes(HashMap<String, AttrValue>);

impl Attributes {
    fn get(&self, name: &str) -> Result<&AttrValue, Error> {
        self.0
            .get(name)
            .ok_or_else(|| Error::Malformed(format!("attribute {name} is missing")))
    }

    fn text(&self, name: &str) -> Result<&str, Error> {
        let value = self.get(name)?;
        value
            .as_str()
            .ok_or_else(|| Error::Malformed(format!("attribute {name} is no string")))
    }

    fn number(&self, name: &str) -> Result<f64, Error> {
        match self.get(name)? {
            AttrValue::F64(value) => Ok(*value),
            _ => Err(Error::Malformed(format!("attribute {name} is no f64"))),
        }
    }

    fn numbers<const N: usize>(&self, name: &str) -> Result<[f64; N], Error> {
        match self.get(name)? {
            AttrValue::F64Array(values) if values.len() == N => {
                Ok(std::array::from_fn(|i| values[i]))
            }
            _ => Err(Error::Malformed(format!(
                "attribute {name} is no array of {N} f64"
            ))),
        }
    }

    fn integer(&self, name: &str) -> Result<u64, Error> {
        match self.get(name)? {
            AttrValue::U32(value) => Ok(u64::from(*value)),
            AttrValue::U64(value) => Ok(*value),
            _ => Err(Error::Malformed(format!(
                "attribute {name} is no unsigned integer"
            ))),
        }
    }
}

fn malformed(error: hdf5_pure::Error) -> Error {
    Error::Malformed(error.to_string())
}
