//! Reads an HDF5 table, without a C library.

use std::collections::HashMap;
use std::fs;
use std::io::Read;
use std::path::Path;

use hdf5_pure::{AttrValue, File, ReadSeekSource, Source};

use crate::table::hdf5_chunks;
use crate::table::hdf5_source::Structure;
use crate::table::packed::is_packed;
use crate::table::schema::{AXES, FORMAT, FORMAT_VERSION, VALUES, attribute, checksum};
use crate::{Certificate, Description, Error, Parameter, Quantity, SubstratePoissonRatio, Table};

impl Table {
    /// Reads an HDF5 table (feature `hdf5`). A packed table is read by [`Table::read`].
    ///
    /// # Errors
    /// [`Error::Io`] if the file cannot be opened; [`Error::InFile`] with the path and what is wrong:
    /// [`Error::Foreign`] if it is not an HDF5 file, or
    /// one without a table; [`Error::Version`] for another version; [`Error::Malformed`] for
    /// missing, mistyped or contradictory parts, for a layout that is never written, and for more
    /// numbers than are allowed: 64 bytes of them for each byte of the file, or 64 MB if that is
    /// more; [`Error::Checksum`] if the numbers are not those that were written.
    ///
    /// Reading takes the memory of the numbers, one chunk and at most 64 MB more (measured by
    /// `tests/table/hostile.rs` with forged files).
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::of_hdf5(path).map_err(|error| error.in_file(path))
    }

    /// Reads an HDF5 table. Errors of its content are without its path.
    fn of_hdf5(path: &Path) -> Result<Self, Error> {
        let io = |source| Error::Io {
            path: path.to_owned(),
            source,
        };
        let open = || fs::File::open(path).map_err(io);
        let mut start = Vec::new();
        open()?.take(8).read_to_end(&mut start).map_err(io)?;
        if is_packed(&start) {
            return Err(Error::Foreign(
                "it is a packed table, not an HDF5 file; read it as a packed table".into(),
            ));
        }
        let foreign = |error: hdf5_pure::Error| {
            Error::Foreign(format!("it cannot be read as an HDF5 file ({error})"))
        };
        let structure = Structure::new(open()?).map_err(|error| foreign(error.into()))?;
        let file = File::from_source(structure).map_err(foreign)?;
        let attributes = Attributes(file.root().attrs().map_err(malformed)?);
        match attributes.text(attribute::FORMAT) {
            Ok(FORMAT) => {}
            _ => {
                return Err(Error::Foreign(format!(
                    "its attribute {} is not {FORMAT:?}, as it is in tables of this project",
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
        let description = Description {
            title: attributes.text(attribute::TITLE)?.to_owned(),
            scene: attributes.text(attribute::SCENE)?.to_owned(),
            nu0: match attributes.text(attribute::NU0) {
                Ok(SubstratePoissonRatio::PAIRED) => SubstratePoissonRatio::Paired,
                _ => SubstratePoissonRatio::Fixed(attributes.number(attribute::NU0)?),
            },
            tolerance: attributes.number(attribute::TOLERANCE)?,
            created_by: attributes.text(attribute::CREATED_BY)?.to_owned(),
            certificate: certificate(&attributes)?,
        };
        let names = file
            .group(AXES)
            .and_then(|group| group.datasets())
            .map_err(malformed)?;
        let has = |parameter: Parameter| names.iter().any(|name| name == parameter.name());
        let mut axes = if has(Parameter::E1sOverEinfs) {
            Parameter::REDUCED
        } else if has(Parameter::E0OverE1) {
            Parameter::STACK
        } else {
            Parameter::ALL
        }
        .map(|parameter| (parameter, Vec::new()));
        let bytes = ReadSeekSource::new(open()?).map_err(|error| malformed(error.into()))?;
        let left = bytes
            .len()
            .saturating_mul(VALUES_FOR_A_BYTE)
            .max(ALWAYS_ALLOWED);
        let mut tables = Tables { file, bytes, left };
        for (parameter, nodes) in &mut axes {
            *nodes = tables.dataset(&format!("{AXES}/{}", parameter.name()), None)?;
        }
        let shape: Vec<u64> = axes.iter().map(|(_, nodes)| nodes.len() as u64).collect();
        let held = tables
            .file
            .group(VALUES)
            .and_then(|group| group.datasets())
            .map_err(malformed)?;
        let mut values = [const { None }; 4];
        for quantity in Quantity::ALL {
            if held.iter().any(|name| name == quantity.name()) {
                let path = format!("{VALUES}/{}", quantity.name());
                values[quantity as usize] = Some(tables.dataset(&path, Some(&shape))?);
            }
        }
        let table = Self::new(description, axes, values)?;
        let (unit, stated) = (table.unit(), attributes.text(attribute::NORMALISED_BY)?);
        if stated != unit {
            return Err(Error::Malformed(format!(
                "it is normalised by {stated:?}, its axes belong to values in units of {unit:?}"
            )));
        }
        let (stored, found) = (attributes.integer(attribute::CHECKSUM)?, checksum(&table));
        if stored != u64::from(found) {
            let stored = u32::try_from(stored).unwrap_or(u32::MAX);
            return Err(Error::Checksum { stored, found });
        }
        Ok(table)
    }
}

/// Reads the certificate from the attributes.
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
        worst_quantity: quantity.ok_or_else(|| {
            Error::Malformed(format!(
                "its largest error is that of {name:?}, which is no quantity"
            ))
        })?,
        worst_point: attributes.numbers(attribute::CERTIFIED_WORST_POINT)?,
        identity_errors: attributes
            .numbers(attribute::CERTIFIED_IDENTITY_ERRORS)?
            .map(|error| (!error.is_nan()).then_some(error)),
    })
}

/// The largest number of bytes of values for each byte of a file. Values of a real table have 1.5
/// to 2; this limit protects a program that limits the size of the files that it reads.
const VALUES_FOR_A_BYTE: u64 = 64;
/// The number of bytes that the values of a file of any size may have.
const ALWAYS_ALLOWED: u64 = 1 << 26;

/// An open file.
struct Tables {
    file: File,
    /// The bytes of the same file, for the numbers.
    bytes: ReadSeekSource<fs::File>,
    /// The number of bytes that the numbers may still take.
    left: u64,
}

impl Tables {
    /// Reads the f64 of the dataset at `path`, which must have `shape`, or one dimension if `shape`
    /// is `None`.
    fn dataset(&mut self, path: &str, shape: Option<&[u64]>) -> Result<Vec<f64>, Error> {
        let dataset = self.file.dataset(path).map_err(malformed)?;
        let found = dataset.shape().map_err(malformed)?;
        let fits = shape.map_or(found.len() == 1, |shape| shape == found);
        if !fits {
            let wanted = shape.map_or("one dimension".into(), |shape| format!("{shape:?}"));
            return Err(Error::Malformed(format!(
                "{path} has shape {found:?}, its axes need {wanted}"
            )));
        }
        let size = found
            .iter()
            .try_fold(8_u64, |size, &length| size.checked_mul(length));
        match size.and_then(|size| self.left.checked_sub(size)) {
            Some(left) => self.left = left,
            None => {
                return Err(Error::Malformed(format!(
                    "{path} has shape {found:?} in a file of {} bytes; at most {VALUES_FOR_A_BYTE} \
                     bytes of numbers for each byte, or {ALWAYS_ALLOWED}, are allowed",
                    self.bytes.len()
                )));
            }
        }
        hdf5_chunks::read(&dataset, &self.bytes, path, &found)
    }
}

/// The attributes of the root group.
struct Attributes(HashMap<String, AttrValue>);

impl Attributes {
    /// Returns an attribute.
    fn get(&self, name: &str) -> Result<&AttrValue, Error> {
        self.0
            .get(name)
            .ok_or_else(|| Error::Malformed(format!("attribute {name} is missing")))
    }

    /// Returns the text of an attribute.
    fn text(&self, name: &str) -> Result<&str, Error> {
        let value = self.get(name)?;
        value
            .as_str()
            .ok_or_else(|| Error::Malformed(format!("attribute {name} is not a string")))
    }

    /// Returns the f64 of an attribute.
    fn number(&self, name: &str) -> Result<f64, Error> {
        match self.get(name)? {
            AttrValue::F64(value) => Ok(*value),
            _ => Err(Error::Malformed(format!("attribute {name} is not an f64"))),
        }
    }

    /// Returns the `N` f64 of an attribute.
    fn numbers<const N: usize>(&self, name: &str) -> Result<[f64; N], Error> {
        match self.get(name)? {
            AttrValue::F64Array(values) if values.len() == N => {
                Ok(std::array::from_fn(|i| values[i]))
            }
            _ => Err(Error::Malformed(format!(
                "attribute {name} is not an array of {N} f64"
            ))),
        }
    }

    /// Returns the unsigned integer of an attribute.
    fn integer(&self, name: &str) -> Result<u64, Error> {
        match self.get(name)? {
            AttrValue::U32(value) => Ok(u64::from(*value)),
            AttrValue::U64(value) => Ok(*value),
            _ => Err(Error::Malformed(format!(
                "attribute {name} is not an unsigned integer"
            ))),
        }
    }
}

/// An error of the HDF5 reader inside a file that is a table.
fn malformed(error: hdf5_pure::Error) -> Error {
    Error::Malformed(error.to_string())
}
