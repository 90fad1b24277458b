//! A Python script of this folder as a running process. It answers each line of JSON with a line of
//! JSON.

use std::env;
use std::io::{BufRead, BufReader, Lines, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde::de::DeserializeOwned;
use serde_json::Value;

/// Returns whether the bench is run with `--small`.
pub fn is_small() -> bool {
    env::args().any(|argument| argument == "--small")
}

/// The running script.
pub struct Python {
    process: Child,
    questions: ChildStdin,
    answers: Lines<BufReader<ChildStdout>>,
    /// The first line of the script: the versions of Python's packages.
    pub versions: String,
}

impl Python {
    /// Starts a script of this folder; `None` if python3 or one of its packages is missing.
    pub fn start(script: &str) -> Option<Self> {
        let script = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("benches")
            .join(script);
        // One thread, for each kind of BLAS.
        let threads = [
            "OPENBLAS_NUM_THREADS",
            "OMP_NUM_THREADS",
            "MKL_NUM_THREADS",
            "VECLIB_MAXIMUM_THREADS",
        ]
        .map(|name| (name, "1"));
        let interpreter = env::var_os("PYTHON").unwrap_or_else(|| "python3".into());
        let mut command = Command::new(interpreter);
        command
            .arg(script)
            .envs(threads)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped());
        let mut process = command.spawn().ok()?;
        let questions = process.stdin.take().expect("piped");
        let mut answers = BufReader::new(process.stdout.take().expect("piped")).lines();
        let versions = answers.next()?.ok()?;
        Some(Self {
            process,
            questions,
            answers,
            versions,
        })
    }

    /// Sends a question and waits for the answer.
    pub fn ask<A: DeserializeOwned>(&mut self, question: &Value) -> A {
        writeln!(self.questions, "{question}").expect("the script reads");
        let answer = self
            .answers
            .next()
            .expect("the script answers")
            .expect("the answer is text");
        serde_json::from_str(&answer).expect("the answer is JSON of its kind")
    }

    /// Stops the script, which ends with its input.
    pub fn stop(mut self) {
        drop(self.questions);
        self.process.wait().expect("the script ends");
    }
}
