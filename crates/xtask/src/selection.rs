//! The members of the workspace that a cargo command selects.

use std::path::Path;

use serde_json::Value;

use crate::workspace;

/// The package of the program `tabulate`.
pub const TABULATE: &str = "coated-contact-tabulate";

/// The arguments of cargo that name a package.
const PACKAGE: [&str; 2] = ["--package", "-p"];

/// Returns the name that stands before `/` in a feature of `tabulate` on the command line of cargo: that
/// of the package where the arguments select it, that of the dependency where they select only members
/// that depend on it, and none where they select neither.
///
/// # Errors
/// A message if cargo does not list the members.
pub fn prefix_of_features(args: &[&str]) -> Result<Option<String>, String> {
    let members = workspace::members()?;
    let folder = std::env::current_dir().map_err(|e| format!("no current folder: {e}"))?;
    Ok(prefix_among(args, &members, &folder))
}

/// Returns what [`prefix_of_features`] does for arguments that are given in this folder.
fn prefix_among(args: &[&str], members: &[Value], folder: &Path) -> Option<String> {
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
    let selected: Vec<&Value> = members.iter().filter(is_selected).collect();
    let is_tabulate = |package: &&Value| package["name"] == TABULATE;
    if selected.iter().any(is_tabulate) {
        return Some(TABULATE.into());
    }
    let mut dependencies = selected
        .iter()
        .filter_map(|member| member["dependencies"].as_array())
        .flatten();
    let dependency = dependencies.find(is_tabulate)?;
    Some(dependency["rename"].as_str().unwrap_or(TABULATE).into())
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
            let dependencies = dependencies.iter().map(|name| {
                let rename = (*name == TABULATE).then_some("tabulate");
                json!({ "name": name, "rename": rename })
            });
            json!({
                "name": name,
                "manifest_path": format!("/w/{folder}/Cargo.toml"),
                "dependencies": dependencies.collect::<Vec<_>>(),
            })
        };
        let members = [
            member("contact", "crates/contact", &["serde"]),
            member(TABULATE, "crates/tabulate", &["contact"]),
            member("acceptance", "tests", &["contact", TABULATE]),
        ];
        let cases: [(&[&str], &str, Option<&str>); 15] = [
            (&["bench"], "/w", Some(TABULATE)),
            (&["bench", "--workspace"], "/w", Some(TABULATE)),
            (&["bench", "-p", "contact"], "/w", None),
            (&["bench", "-pcontact"], "/w", None),
            (
                &["bench", "--package", "contact", "--bench", "lookup"],
                "/w",
                None,
            ),
            (&["bench", "--package=contact@0.1.0"], "/w", None),
            (
                &["bench", "-p", "contact", "-p", TABULATE],
                "/w",
                Some(TABULATE),
            ),
            (&["bench", "-p", TABULATE], "/w", Some(TABULATE)),
            (&["test", "-p", "acceptance"], "/w", Some("tabulate")),
            (
                &["test", "--workspace"],
                "/w/crates/contact",
                Some(TABULATE),
            ),
            (
                &["test", "-p", TABULATE],
                "/w/crates/contact",
                Some(TABULATE),
            ),
            (&["test"], "/w/crates/contact/src", None),
            (&["test"], "/w/crates", Some(TABULATE)),
            // The arguments of the program are none of cargo's.
            (&["run", "-p", "contact", "--", "-p", TABULATE], "/w", None),
            (
                &["run", "-p", TABULATE, "--", "-p", "contact"],
                "/w",
                Some(TABULATE),
            ),
        ];
        for (args, folder, expected) in cases {
            let found = prefix_among(args, &members, Path::new(folder));
            assert_eq!(found.as_deref(), expected, "{args:?} in {folder}");
        }
    }

    #[test]
    fn every_member_of_the_workspace_is_known() {
        let prefix = |member: &str| prefix_of_features(&["bench", "-p", member]).expect("a list");
        for (member, expected) in [
            ("coated-contact-interp", None),
            ("coated-contact-fit", None),
            ("xtask", None),
            (TABULATE, Some(TABULATE)),
            ("acceptance", Some("tabulate")),
            ("coated-contact-python", Some("tabulate")),
        ] {
            assert_eq!(prefix(member).as_deref(), expected, "{member}");
        }
    }
}
