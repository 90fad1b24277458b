//! Every file and folder of the project that a document or a comment names exists.

use std::fs;
use std::path::{Path, PathBuf};

/// The endings of the files that are documents, or have comments.
const DOCUMENTS: [&str; 4] = ["md", "rs", "js", "toml"];
/// The endings of the files that are kept in the repository.
const KEPT: [&str; 9] = ["rs", "py", "js", "c", "md", "toml", "csv", "html", "svg"];
/// The folders by whose names a path is recognised.
const FOLDERS: [&str; 7] = [
    "crates", "tests", "tables", "src", "benches", "examples", ".github",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Adds the files with documents in a folder to `found`.
fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().and_then(|name| name.to_str());
        if path.is_dir() && name != Some("target") {
            collect(&path, found);
        } else if is_of(&path, &DOCUMENTS) {
            found.push(path);
        }
    }
}

fn is_of(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| endings.contains(&ending))
}

/// Returns whether a text between backticks is the path of a file or folder in the repository.
fn names_a_path(text: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-/".contains(c);
    text.contains('/')
        && !text.ends_with('/')
        && text.chars().all(plain)
        && (is_of(Path::new(text), &KEPT)
            || text.split('/').take(2).any(|part| FOLDERS.contains(&part)))
        && !is_of(Path::new(text), &["h5", "bin"])
}

/// Returns whether a path exists, seen from one of the folders around a document, from the sources
/// of one, or from `crates`.
fn exists(path: &str, document: &Path, root: &Path) -> bool {
    let around = document
        .ancestors()
        .skip(1)
        .take_while(|folder| folder.starts_with(root));
    around
        .flat_map(|folder| [folder.to_owned(), folder.join("src"), folder.join("crates")])
        .any(|folder| folder.join(path).exists())
}

#[test]
fn every_path_that_is_named_exists() {
    let root = root().canonicalize().expect("the project");
    let mut documents = Vec::new();
    for folder in ["crates", "tests", "tables", ".github"] {
        collect(&root.join(folder), &mut documents);
    }
    documents.push(root.join("README.md"));
    let (mut named, mut dead) = (0, Vec::new());
    for document in documents {
        let text = fs::read_to_string(&document).expect("text in UTF-8");
        let is_code = !is_of(&document, &["md"]);
        let is_comment = |line: &&str| {
            let line = line.trim_start();
            !is_code || line.starts_with("//") || line.starts_with('#') || line.starts_with('*')
        };
        for (i, line) in text
            .lines()
            .enumerate()
            .filter(|(_, line)| is_comment(line))
        {
            for path in line
                .split('`')
                .skip(1)
                .step_by(2)
                .filter(|path| names_a_path(path))
            {
                named += 1;
                if !exists(path, &document, &root) {
                    let document = document.strip_prefix(&root).expect("inside").display();
                    dead.push(format!("{document}:{}: {path}", i + 1));
                }
            }
        }
    }
    assert!(named > 100, "{named} paths are found");
    assert!(dead.is_empty(), "these do not exist:\n{}", dead.join("\n"));
}
