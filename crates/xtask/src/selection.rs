//! The members of the workspace that a cargo command selects.

use std::path::Path;

use serde_json::Value;

use crate::workspace;

/// The package of the program `tabulate`.
pub const TABULATE: &str = "coated-contact-tabulate";

/// The arguments of cargo that name a package.
const PACKAGE: [&str; 2] = ["--package", "-p"];

/// Returns whether a cargo command with these arguments selects `tabulate` or a member that depends
/// on it. Cargo refuses the features of `tabulate` where it selects neither.
///
/// # Errors
/// A message if cargo does not list the members.
pub fn has_tabulate(args: &[&str]) -> Result<bool, String> {
    let members = workspace::members()?;
    let folder = std::env::current_dir().map_err(|e| format!("no current folder: {e}"))?;
    Ok(any_has_tabulate(args, &members, &folder))
}

/// Returns whether the arguments, given in this folder, select one of the `members` that is or uses
/// `tabulate`.
fn any_has_tabulate(args: &[&str], members: &[Value], folder: &Path) -> bool {
    // What follows is for the program that cargo runs.
    let own = args.iter().position(|arg| *arg == "--");
    let args = &args[..own.unwrap_or(args.len())];
    let named = packages(args);
    let everything = |arg: &&str| ["--workspace", "--all"].contains(arg);
    let is_selected = |member: &&Value| {
        if args.iter().any(everything) {
            true
        } else if named.is_empty() {
            // In the folder of a member cargo takes this member, elsewhere all.
            let home = |member: &Value| {
                let manifest = member["manifest_path"].as_str()?;
                Some(folder.starts_with(Path::new(manifest).parent()?))
            };
            let is_home = |member: &Value| home(member) == Some(true);
            is_home(member) || !members.iter().any(is_home)
        } else {
            named.iter().any(|name| member["name"] == *name)
        }
    };
    let uses = |member: &Value| {
        let dependencies = member["dependencies"].as_array();
        let is_tabulate = |package: &Value| package["name"] == TABULATE;
        is_tabulate(member) || dependencies.is_some_and(|all| all.iter().any(is_tabulate))
    };
    members.iter().filter(is_selected).any(uses)
}

/// Returns the names of the packages in `-p NAME`, `-pNAME`, `--package NAME` and `--package=NAME`,
/// without their versions.
fn packages<'a>(args: &[&'a str]) -> Vec<&'a str> {
    let mut names = Vec::new();
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        let attached = PACKAGE.iter().find_map(|flag| arg.strip_prefix(flag));
        let name = match attached {
            Some("") => args.next().copied(),
            Some(name) => Some(name.trim_start_matches('=')),
            None => None,
        };
        names.extend(name.map(|name| name.split('@').next().unwrap_or(name)));
    }
    names
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn only_members_with_tabulate_get_its_features() {
        let member = |name: &str, folder: &str, dependencies: &[&str]| {
            let dependencies = dependencies.iter().map(|name| json!({ "name": name }));
            json!({
                "name": name,
                "manifest_path": format!("/w/{folder}/Cargo.toml"),
                "dependencies": dependencies.collect::<Vec<_>>(),
            })
        };
        let members = [
            member("interp", "crates/interp", &["serde"]),
            member(TABULATE, "crates/tabulate", &["interp"]),
            member("acceptance", "tests", &["interp", TABULATE]),
        ];
        let cases: [(&[&str], &str, bool); 15] = [
            (&["bench"], "/w", true),
            (&["bench", "--workspace"], "/w", true),
            (&["bench", "-p", "interp"], "/w", false),
            (&["bench", "-pinterp"], "/w", false),
            (
                &["bench", "--package", "interp", "--bench", "lookup"],
                "/w",
                false,
            ),
            (&["bench", "--package=interp@0.1.0"], "/w", false),
            (&["bench", "-p", "interp", "-p", TABULATE], "/w", true),
            (&["bench", "-p", TABULATE], "/w", true),
            (&["test", "-p", "acceptance"], "/w", true),
            (&["test", "--workspace"], "/w/crates/interp", true),
            (&["test", "-p", TABULATE], "/w/crates/interp", true),
            (&["test"], "/w/crates/interp/src", false),
            (&["test"], "/w/crates", true),
            // The arguments of the program are none of cargo's.
            (&["run", "-p", "interp", "--", "-p", TABULATE], "/w", false),
            (&["run", "-p", TABULATE, "--", "-p", "interp"], "/w", true),
        ];
        for (args, folder, expected) in cases {
            let found = any_has_tabulate(args, &members, Path::new(folder));
            assert_eq!(found, expected, "{args:?} in {folder}");
        }
    }

    #[test]
    fn every_member_of_the_workspace_is_known() {
        let selects = |member: &str| has_tabulate(&["bench", "-p", member]).expect("a list");
        for (member, expected) in [
            ("coated-contact-interp", false),
            ("coated-contact-fit", false),
            ("xtask", false),
            (TABULATE, true),
            ("acceptance", true),
            ("coated-contact-python", true),
        ] {
            assert_eq!(selects(member), expected, "{member}");
        }
    }
}
