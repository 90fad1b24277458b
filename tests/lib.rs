//! What the acceptance tests beside this file share: reading CSV, random contacts, small tables,
//! the program under test, and how errors are measured.

#![forbid(unsafe_code)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use interp::Parameter;
use interp::{Certificate, Description, Elastic, Material, Quantities, Quantity, System, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use tabulate::solve;
use tabulate::table::Plan;
use tabulate::table::Scene;
use tabulate::table::certify;
use tabulate::table::sweep;
use tempfile::TempDir;

/// A CSV file, a data file or an output: one row per case, with named columns. Lines that begin
/// with `#` are comments.
#[derive(Clone, Debug)]
pub struct Data {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// One case of a [`Data`] file.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    data: &'a Data,
    row: &'a [String],
}

impl Data {
    /// Reads `data/<name>.csv`.
    ///
    /// # Panics
    /// If the file is missing or holds no case.
    pub fn read(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("data")
            .join(format!("{name}.csv"));
        let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        Self::parse(name, &text)
    }

    /// Reads CSV text; `name` is for messages.
    ///
    /// # Panics
    /// If it holds no case.
    pub fn parse(name: &str, text: &str) -> Self {
        let mut lines = text
            .lines()
            .filter(|line| !line.starts_with('#') && !line.is_empty());
        let fields = |line: &str| line.split(',').map(str::to_owned).collect();
        let columns: Vec<String> = fields(lines.next().expect("a header line"));
        let rows: Vec<Vec<String>> = lines.map(fields).collect();
        assert!(!rows.is_empty(), "{name} holds no case");
        assert!(
            rows.iter().all(|row| row.len() == columns.len()),
            "{name} has rows of different lengths"
        );
        Self { columns, rows }
    }

    /// The names of the columns, in the order of the file.
    pub fn columns(&self) -> Vec<&str> {
        self.columns.iter().map(String::as_str).collect()
    }

    /// The cases, in the order of the file.
    pub fn cases(&self) -> impl Iterator<Item = Case<'_>> {
        self.rows.iter().map(|row| Case { data: self, row })
    }
}

impl Case<'_> {
    /// The text in a named column.
    ///
    /// # Panics
    /// If there is no such column.
    pub fn text(&self, column: &str) -> &str {
        let index = self.data.columns.iter().position(|name| name == column);
        &self.row[index.unwrap_or_else(|| panic!("no column {column:?}"))]
    }

    /// The number in a named column.
    ///
    /// # Panics
    /// If there is no such column, or no number in it.
    pub fn get(&self, column: &str) -> f64 {
        let text = self.text(column);
        text.parse()
            .unwrap_or_else(|_| panic!("{column}: {text:?} is no number"))
    }

    /// The material of the columns `e1_over_e2`, `nu1`, `e0_over_e2`, `nu0`.
    ///
    /// # Panics
    /// If it is not physical.
    pub fn material(&self) -> Material {
        material([
            self.get("e1_over_e2"),
            self.get("nu1"),
            self.get("e0_over_e2"),
            self.get("nu0"),
        ])
    }

    /// The quantities of the columns `pi0`, `eeq`, `gamma`, `delta0`.
    pub fn quantities(&self) -> Quantities {
        Quantities::from_array(["pi0", "eeq", "gamma", "delta0"].map(|name| self.get(name)))
    }
}

/// The material `[e1_over_e2, nu1, e0_over_e2, nu0]`.
///
/// # Panics
/// If it is not physical.
pub fn material([e1_over_e2, nu1, e0_over_e2, nu0]: [f64; 4]) -> Material {
    Material::new(e1_over_e2, nu1, e0_over_e2, nu0).expect("the tests' materials are physical")
}

/// The largest relative deviation of the four quantities from those of `truth`.
pub fn relative_error(quantities: &Quantities, truth: &Quantities) -> f64 {
    relative_errors(quantities, truth)
        .into_iter()
        .fold(0.0, larger)
}

/// The relative deviation of each of the four quantities from that of `truth`.
pub fn relative_errors(quantities: &Quantities, truth: &Quantities) -> [f64; 4] {
    let (values, truths) = (quantities.to_array(), truth.to_array());
    std::array::from_fn(|i| (values[i] / truths[i] - 1.0).abs())
}

/// The larger of two errors, NaN if either is: a NaN must not pass for a small error.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}

/// An endless, reproducible stream of random contacts.
#[derive(Clone, Debug)]
pub struct Contacts {
    generator: Pcg64Mcg,
}

impl Contacts {
    /// The stream of one seed.
    pub fn new(seed: u64) -> Self {
        Self {
            generator: Pcg64Mcg::seed_from_u64(seed),
        }
    }

    /// A number uniform in `[from, to)`.
    pub fn uniform(&mut self, from: f64, to: f64) -> f64 {
        self.generator.random_range(from..to)
    }

    /// A number whose logarithm is uniform in `[ln from, ln to)`.
    pub fn log_uniform(&mut self, from: f64, to: f64) -> f64 {
        self.uniform(from.ln(), to.ln()).exp()
    }

    /// A Poisson ratio of `(-0.5, 0.5]`: one in four exactly 0.5, one in four logarithmically close
    /// to it, the rest uniform.
    pub fn poisson_ratio(&mut self) -> f64 {
        match self.generator.random_range(0..4) {
            0 => 0.5,
            1 => 0.5 - self.log_uniform(1e-9, 1e-2),
            _ => self.uniform(-0.5, 0.5),
        }
    }

    /// A point of a table's box, evenly distributed in the axes' coordinates: `a/t` and the
    /// material.
    pub fn point_of(&mut self, table: &Table) -> (f64, Material) {
        let [x, e1, nu1, e0] = Parameter::ALL.map(|parameter| {
            let (first, last) = ends(table, parameter);
            if first == last {
                return first;
            }
            let coordinate = self.uniform(parameter.coordinate(first), parameter.coordinate(last));
            parameter.value(coordinate).clamp(first, last)
        });
        (x, material([e1, nu1, e0, table.description().nu0]))
    }

    /// A material with film and substrate moduli between the given bounds; one in six has a rigid
    /// substrate.
    pub fn material(&mut self, e1_over_e2: [f64; 2], e0_over_e2: [f64; 2]) -> Material {
        let e1 = self.log_uniform(e1_over_e2[0], e1_over_e2[1]);
        let e0 = self.log_uniform(e0_over_e2[0], e0_over_e2[1]);
        let e0 = if self.generator.random_range(0..6) == 0 {
            f64::INFINITY
        } else {
            e0
        };
        material([e1, self.poisson_ratio(), e0, self.poisson_ratio()])
    }
}

/// Four axes.
pub const BOX: &str = "
    title      = 'Four axes'
    tolerance  = 1e-6
    a_over_t   = { from = 0.1, to = 10, nodes = 30 }
    e1_over_e2 = { from = 0.3, to = 3, nodes = 14 }
    nu1        = { from = 0.3, to = 0.5, nodes = 13 }
    e0_over_e2 = { from = 10, to = 100, nodes = 10 }
";
/// Three axes, the sphere rigid: all is normalised by `E1*`.
pub const RIGID_SPHERE: &str = "
    title      = 'Rigid sphere'
    tolerance  = 1e-4
    quantities = ['eeq', 'delta0']
    a_over_t   = { from = 0.1, to = 10, nodes = 20 }
    e1_over_e2 = 0
    nu1        = { from = 0.3, to = 0.45, nodes = 9 }
    e0_over_e2 = { from = 1, to = 100, nodes = 9 }
";

/// The table of a scene, with a certificate of 400 points.
///
/// # Panics
/// If the scene is wrong or a point is not solved.
pub fn table(scene: &str) -> Table {
    let scene = Scene::parse(scene, None).expect("the tests' scenes are sound");
    let axes = Plan::new(&scene)
        .expect("the tests' scenes are within reach")
        .axes();
    let values = sweep(&scene, &axes, &|_| {}).expect("the tests' scenes are within reach");
    let normalisation = scene
        .material([axes[1][0], axes[2][0], axes[3][0]])
        .expect("physical")
        .normalisation();
    let description = Description {
        title: scene.title,
        scene: scene.text,
        nu0: scene.nu0,
        normalisation,
        tolerance: scene.tolerance,
        created_by: "acceptance tests".into(),
        certificate: Certificate::UNMEASURED,
    };
    let mut table = Table::new(description, axes, values).expect("a sweep makes a whole table");
    table.set_certificate(
        certify(&table, 400, 1, &|_| {}).expect("the tests' scenes are within reach"),
    );
    table
}

/// The nodes of a table.
pub fn axes(table: &Table) -> [Vec<f64>; 4] {
    Parameter::ALL.map(|parameter| table.axis(parameter).to_vec())
}

/// A table in low-rank form, with this error at its nodes.
///
/// # Panics
/// If rounding does not allow it.
pub fn low_rank(table: &Table, error: f64) -> Table {
    let form = tabulate::table::compress(table, error).expect("above rounding");
    Table::from_low_rank(table.description().clone(), axes(table), form)
        .expect("a form of this table")
}

/// The path of a table or scene that comes with the project.
pub fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../tables")
        .join(name)
}

/// The first and the last node of an axis.
pub fn ends(table: &Table, parameter: Parameter) -> (f64, f64) {
    let nodes = table.axis(parameter);
    (nodes[0], nodes[nodes.len() - 1])
}

/// The tolerance of the direct solves that are taken for the truth.
pub const TRUTH: f64 = 1e-11;

/// The largest relative error of the quantities that a table holds, at one point of it.
///
/// # Panics
/// If the point is not inside, or out of reach of the solve.
pub fn error_at(table: &Table, x: f64, material: &Material) -> f64 {
    let truth = solve(x, material, TRUTH)
        .expect("moderate contrasts converge")
        .quantities;
    let curve = table.curve(material).expect("a material inside the box");
    let error = |quantity| {
        (curve
            .quantity(quantity, x)
            .expect("a held quantity inside the box")
            / truth.get(quantity)
            - 1.0)
            .abs()
    };
    table.quantities().into_iter().map(error).fold(0.0, larger)
}

/// CRC-32 of zip and PNG, bit by bit.
pub fn checksum(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            if crc & 1 == 1 {
                crc >> 1 ^ 0xedb8_8320
            } else {
                crc >> 1
            }
        })
    })
}

/// Bytes before the payload of the packed form.
pub const PREFIX: usize = 24;

/// A packed table with another payload, whose length and checksum are right.
pub fn with_payload(packed: &[u8], payload: &[u8]) -> Vec<u8> {
    [
        &packed[..12],
        &(payload.len() as u64).to_le_bytes(),
        &checksum(payload).to_le_bytes(),
        payload,
    ]
    .concat()
}

/// The bits of numbers: equal bits are more than equal values, and say so of NaN.
pub fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// The bits of everything numeric in a table: axes, then the values of each quantity.
pub fn all_bits(table: &Table) -> Vec<Option<Vec<u64>>> {
    let axes = Parameter::ALL.map(|parameter| Some(bits(table.axis(parameter))));
    axes.into_iter()
        .chain(Quantity::ALL.map(|quantity| table.values(quantity).map(bits)))
        .collect()
}

/// The system of Barthel's Tables 1 and 2 with a film of the given thickness (m).
pub fn paper_system(film_thickness: f64) -> System {
    let solid = |young, poisson| Elastic::new(young, poisson).expect("physical");
    System {
        sphere_radius: 1e-3,
        sphere_modulus: 2e6,
        film: solid(3.5e6, 0.5),
        film_thickness,
        substrate: solid(2e11, 0.25),
    }
}

/// A folder for one test, and the command line program run inside it.
#[derive(Debug)]
pub struct Desk {
    program: &'static str,
    folder: TempDir,
}

/// What a run of the program left.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Exit status.
    pub status: i32,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

impl Desk {
    /// An empty folder for the program, which only the test itself knows:
    /// `env!("CARGO_BIN_EXE_tabulate-under-test")`.
    ///
    /// # Panics
    /// If no folder can be made.
    pub fn new(program: &'static str) -> Self {
        Self {
            program,
            folder: TempDir::new().expect("a temporary folder"),
        }
    }

    /// The path of a file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file and returns its path.
    ///
    /// # Panics
    /// If it cannot be written.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, content).unwrap_or_else(|e| panic!("{name}: {e}"));
        path
    }

    /// The bytes of a file.
    ///
    /// # Panics
    /// If it cannot be read.
    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// The names of everything in the folder, hidden files too, sorted.
    ///
    /// # Panics
    /// If the folder cannot be read.
    pub fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).expect("the folder is there");
        let mut names: Vec<String> = entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into()
            })
            .collect();
        names.sort();
        names
    }

    /// Runs the program in the folder, its output caught and so not a terminal.
    ///
    /// # Panics
    /// If it cannot be run, is killed, or prints something that is no UTF-8.
    pub fn run(&self, args: &[&str]) -> Run {
        self.end(args, self.start(args))
    }

    /// Starts the program in the folder, its output caught.
    ///
    /// # Panics
    /// If it cannot be started.
    pub fn start(&self, args: &[&str]) -> Child {
        let mut command = Command::new(self.program);
        command
            .args(args)
            .current_dir(self.folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command.spawn().expect("the program starts")
    }

    /// Runs a shell script in the folder, in which `$0` is the program.
    ///
    /// # Panics
    /// As [`Desk::run`].
    pub fn script(&self, script: &str) -> Run {
        let mut command = Command::new("sh");
        command
            .args(["-c", script, self.program])
            .current_dir(self.folder.path())
            .stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        self.end(&[script], command.spawn().expect("the shell starts"))
    }

    /// What a program leaves when it has ended.
    ///
    /// # Panics
    /// As [`Desk::run`].
    pub fn end(&self, args: &[&str], child: Child) -> Run {
        let output = child.wait_with_output().expect("the program runs");
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        let status = output
            .status
            .code()
            .unwrap_or_else(|| panic!("{args:?}: {}", output.status));
        Run {
            status,
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }

    /// Runs the program, which must succeed and say nothing on standard error; returns its standard
    /// output.
    ///
    /// # Panics
    /// If it fails or complains.
    pub fn succeed(&self, args: &[&str]) -> String {
        let run = self.run(args);
        assert!(
            run.status == 0 && run.stderr.is_empty(),
            "{args:?}: {run:?}"
        );
        run.stdout
    }

    /// Runs the program, which must end with `status` and print nothing on standard output; returns
    /// its standard error.
    ///
    /// # Panics
    /// If it ends otherwise.
    pub fn fail(&self, status: i32, args: &[&str]) -> String {
        let run = self.run(args);
        assert!(
            run.status == status && run.stdout.is_empty() && !run.stderr.contains("panicked"),
            "{args:?}: {run:?}"
        );
        run.stderr
    }
}

/// Asserts that a message holds every one of the words.
///
/// # Panics
/// If one is missing.
pub fn assert_names(message: &str, words: &[&str]) {
    for word in words {
        assert!(message.contains(word), "{word:?} is not in: {message}");
    }
}
