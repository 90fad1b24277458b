//! Small tables, made of the scenes that many tests use, and the shipped ones.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock};

use interp::{Description, Error, Parameter, Quantity, Table};
use tabulate::table::{Plan, Scene, certify, sweep, write};

use crate::{Workdir, nothing_starts};

/// A scene of four axes.
pub const BOX: &str = "
    title      = 'Four axes'
    tolerance  = 1e-6
    a_over_t   = { from = 0.1, to = 10, nodes = 30 }
    e1_over_e2 = { from = 0.3, to = 3, nodes = 14 }
    nu1        = { from = 0.3, to = 0.5 }
    e0_over_e2 = { from = 10, to = 100, nodes = 10 }
";
/// A scene of three axes and two quantities, normalised by `E1*` because the sphere is rigid.
pub const RIGID_SPHERE: &str = "
    title      = 'Rigid sphere'
    tolerance  = 1e-4
    quantities = ['eeq', 'delta0']
    a_over_t   = { from = 0.1, to = 10, nodes = 20 }
    e1_over_e2 = 0
    nu1        = { from = 0.3, to = 0.45, nodes = 9 }
    e0_over_e2 = { from = 1, to = 100, nodes = 9 }
";

/// Returns the table of a scene, certified at 400 points. It is made once for all tests of a program.
pub fn table(scene: &str) -> Table {
    static TABLES: Mutex<BTreeMap<String, Arc<OnceLock<Table>>>> = Mutex::new(BTreeMap::new());
    let mut tables = TABLES.lock().expect("no test panics here");
    let table = Arc::clone(tables.entry(scene.to_owned()).or_default());
    drop(tables);
    table.get_or_init(|| make(scene)).clone()
}

/// Makes the table of a scene.
fn make(scene: &str) -> Table {
    let scene = Scene::parse(scene, None).expect("the tests' scenes are sound");
    let plan = Plan::new(&scene).expect("the tests' scenes are within reach");
    let axes = plan.axes(&scene);
    let values = sweep(&scene, &axes, &|_| {}).expect("the tests' scenes are within reach");
    let mut table =
        Table::new(scene.description(), axes, values).expect("a sweep makes a whole table");
    table.set_certificate(
        certify(&table, 400, 1, &|_| {}).expect("the tests' scenes are within reach"),
    );
    table
}

/// Returns a table of other values, which `value` makes of the quantity, the index and the value, and
/// of another description.
///
/// # Errors
/// As [`Table::new`].
pub fn forged(
    sound: &Table,
    value: impl Fn(Quantity, usize, f64) -> f64,
    change: impl FnOnce(&mut Description),
) -> Result<Table, Error> {
    let values = Quantity::ALL.map(|quantity| {
        let held = sound.values(quantity)?.iter().enumerate();
        Some(held.map(|(i, &held)| value(quantity, i, held)).collect())
    });
    let mut description = sound.description().clone();
    change(&mut description);
    Table::new(description, sound.axes(), values)
}

/// Writes a table as HDF5. No program starts meanwhile: it would keep the file locked until it ends.
pub fn write_hdf5(table: &Table, path: &Path) {
    let _guard = nothing_starts();
    write(table, path).expect("written");
}

/// Returns the first and the last node of an axis.
pub fn ends(table: &Table, parameter: Parameter) -> (f64, f64) {
    table.range(parameter).into()
}

/// Compresses a table to its low-rank form, with errors up to `error` at the nodes.
pub fn low_rank(table: &Table, error: f64) -> Table {
    let form = tabulate::table::compress(table, error).expect("above rounding");
    let (description, quantities) = (table.description().clone(), table.quantities());
    Table::from_low_rank(description, table.axes(), quantities, form).expect("a form of this table")
}

impl Workdir {
    /// Writes a table in its packed form to the file `name`.
    pub fn pack(&self, name: &str, table: &Table) {
        self.write(name, table.to_packed().expect("not too large"));
    }

    /// Reads the table in the file `name`.
    pub fn table(&self, name: &str) -> Table {
        let path = self.path(name);
        let table = if name.ends_with(".h5") {
            Table::open(path)
        } else {
            Table::read(path)
        };
        table.unwrap_or_else(|e| panic!("{e}"))
    }
}

/// Returns the path of a shipped table or scene, `tables/<name>`.
pub fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../tables")
        .join(name)
}
