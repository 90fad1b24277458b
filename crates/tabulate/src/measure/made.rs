//! A table that is generated to be measured.

use std::io;
use std::time::Instant;

use interp::Table;

use crate::Error;
use crate::table::{Budget, Observer, Options, Scene, default_points, generate};

/// A generated table, and the work of generating it.
pub struct Made {
    /// The table.
    pub table: Table,
    /// Contacts solved for the nodes, including those of tables that were refined afterwards.
    pub solves: u64,
    /// The time in seconds, including planning and certificate.
    pub seconds: f64,
    /// The size of the HDF5 file.
    pub bytes: u64,
}

impl Made {
    /// Generates the table of a scene in a temporary file.
    ///
    /// # Errors
    /// Those of [`generate`]; [`Error::Write`] for a temporary folder that cannot be written.
    pub fn new(
        scene: &Scene,
        budget: Option<Budget<'_>>,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        let unwritable = |source| Error::Write {
            path: std::env::temp_dir(),
            source: io::Error::other(format!(
                "{source}; set the environment variable TMPDIR to another folder"
            )),
        };
        let folder = tempfile::tempdir().map_err(unwritable)?;
        let path = folder.path().join("table.h5");
        let options = Options {
            certificate_points: default_points(scene.axes()),
            seed: 1,
            resume: false,
            budget,
        };
        let began = Instant::now();
        let generated = generate(scene, &path, &options, observer)?;
        let seconds = began.elapsed().as_secs_f64();
        let bytes = path.metadata().map_err(unwritable)?.len();
        Ok(Self {
            table: generated.table,
            solves: generated.points as u64,
            seconds,
            bytes,
        })
    }
}
