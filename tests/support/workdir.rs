//! The program under test, run in a temporary folder.

use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempDir;

use crate::rows;

/// A temporary folder, and the program under test, which runs in it.
#[derive(Debug)]
pub struct Workdir {
    program: &'static str,
    folder: TempDir,
}

/// Exit status and output of a run of the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Exit status.
    pub status: i32,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

impl Run {
    /// Whether it ended with `status`, printed nothing on standard output, and did not panic.
    pub(crate) fn fails(&self, status: i32) -> bool {
        self.status == status && self.stdout.is_empty() && !self.stderr.contains("panicked")
    }
}

/// Returns the arguments in a line as a user types it: spaces part them, and one that holds spaces stands between quotes
/// `'`.
pub fn arguments(line: &str) -> Vec<String> {
    let parts = line.split('\'').enumerate();
    let words = parts.flat_map(|(i, part)| match i % 2 {
        0 => part.split_whitespace().collect(),
        _ => vec![part],
    });
    words.map(str::to_owned).collect()
}

/// Makes an empty [`Workdir`] for the program under test.
///
/// A macro, because cargo tells the path of the program to the tests only, and not to this library.
#[macro_export]
macro_rules! workdir {
    () => {
        $crate::Workdir::new(env!("CARGO_BIN_EXE_tabulate-under-test"))
    };
}

/// Waits until no other thread is starting a program, and keeps all others from it.
///
/// A started program inherits the files that are open in this process, with their locks: files opened
/// by Rust until its exec, files opened by the HDF5 library until it ends. A test that opens such a
/// file again would find it locked.
pub fn nothing_starts() -> MutexGuard<'static, ()> {
    static STARTING: Mutex<()> = Mutex::new(());
    STARTING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Starts a program, whose output is captured. Help texts do not depend on the width of the terminal of who tests.
pub fn start(command: &mut Command) -> Child {
    let _guard = nothing_starts();
    let command = command.env_remove("COLUMNS");
    let captured = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    captured.spawn().expect("the program starts")
}

impl Workdir {
    /// Makes an empty folder for `program`, a path. [`workdir!`](crate::workdir) gives the path.
    pub fn new(program: &'static str) -> Self {
        Self {
            program,
            folder: TempDir::new().expect("a temporary folder"),
        }
    }

    /// Returns the path of the file `name` in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes the file `name` and returns its path.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, content).unwrap_or_else(|e| panic!("{name}: {e}"));
        path
    }

    /// Writes the files of a table as text, which [`rows`] reads: the name of each and its content, in which `\n`
    /// ends a line.
    pub fn write_files(&self, table: &str) {
        for [name, content] in rows(table) {
            self.write(name, content.replace("\\n", "\n"));
        }
    }

    /// Writes `points.csv`: rows of `a/t`, `E1/E2*`, the film's Poisson ratio and `E0/E2*`.
    pub fn write_points(&self, rows: &str) {
        let columns = "a_over_t,e1_over_e2,nu1,e0_over_e2";
        self.write("points.csv", format!("{columns}\n{rows}"));
    }

    /// Returns the bytes of the file `name`.
    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Returns the text in the file `name`.
    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Returns the names of all files in the folder, hidden ones too, sorted.
    pub fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).expect("the folder is there");
        let mut names: Vec<String> = entries
            .map(|entry| {
                let name = entry.expect("an entry").file_name();
                name.to_string_lossy().into()
            })
            .collect();
        names.sort();
        names
    }

    /// Runs the program to its end. Its output is captured, and so is not a terminal.
    pub fn run(&self, args: impl AsRef<str>) -> Run {
        self.end(args.as_ref(), self.start(&args))
    }

    /// Starts the program. Its output is captured.
    pub fn start(&self, args: impl AsRef<str>) -> Child {
        self.spawn(Command::new(self.program).args(arguments(args.as_ref())))
    }

    /// Runs a shell script, in which `$0` is the program.
    pub fn script(&self, script: &str) -> Run {
        let child = self.spawn(Command::new("sh").args(["-c", script, self.program]));
        self.end(script, child)
    }

    fn spawn(&self, command: &mut Command) -> Child {
        start(command.current_dir(self.folder.path()).stdin(Stdio::null()))
    }

    /// Waits for the end of `child` and returns its exit status and output. Messages name it by
    /// `args`.
    pub fn end(&self, args: &str, child: Child) -> Run {
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

    /// Runs the program, which must succeed and print nothing on standard error but comment lines,
    /// which begin with `# `, and the note of surface tension, which all soft gels have, and returns its standard output.
    pub fn succeed(&self, args: impl AsRef<str>) -> String {
        let run = self.run(&args);
        let mut lines = run.stderr.lines();
        let all_comments =
            lines.all(|line| line.starts_with("# ") || line.contains("surface tension"));
        let succeeds = run.status == 0 && all_comments;
        assert!(succeeds, "{:?}: {run:?}", args.as_ref());
        run.stdout
    }

    /// Runs the program, which must succeed, whatever it says on standard error.
    pub fn answer(&self, args: impl AsRef<str>) -> Run {
        let run = self.run(&args);
        assert_eq!(run.status, 0, "{:?}: {run:?}", args.as_ref());
        run
    }

    /// Makes data with `tabulate simulate`, which may warn that contacts leave the assumptions of the
    /// model, and returns its standard output.
    pub fn simulate(&self, args: impl std::fmt::Display) -> String {
        let run = self.run(format!("simulate {args}"));
        let of_model = [
            "a/R reaches ",
            "the slope of the probe reaches ",
            " is compressed by up to ",
            "and the model has none. Gels and elastomers",
        ];
        let is_note = |line: &str| {
            line.starts_with("# ") || of_model.iter().any(|words| line.contains(words))
        };
        let succeeds = run.status == 0 && run.stderr.lines().all(is_note);
        assert!(succeeds, "simulate {args}: {run:?}");
        run.stdout
    }

    /// Runs the program, which must end with `status` and print nothing on standard output, and
    /// returns its standard error.
    pub fn fail(&self, status: i32, args: impl AsRef<str>) -> String {
        let run = self.run(&args);
        assert!(run.fails(status), "{:?}: {run:?}", args.as_ref());
        run.stderr
    }
}
