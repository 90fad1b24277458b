//! Runs a page in Chromium.
//!
//! The harness in a page runs to its end before the page's `load` event, and Chromium writes the
//! page after this event. No clock or timeout takes part: a slow machine only takes longer.

use std::env;
use std::ffi::OsStr;
use std::io::{Write, stderr};
use std::process::{Command, Output};
use std::thread;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;

/// The options of Chromium: no window, no network, nothing but the page.
const OPTIONS: [&str; 12] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    // Without these two, Chromium gives up on a page that takes long.
    "--disable-hang-monitor",
    "--disable-gpu-watchdog",
    "--enable-logging=stderr",
    "--dump-dom",
];

/// The width of the window where a test does not choose one, in pixels.
const USUAL: u32 = 800;

/// Returns the text that a page in Chromium leaves in its element `seen`; none without Chromium.
pub fn seen(page: &str) -> Option<String> {
    seen_at(page, USUAL)
}

/// Returns what [`seen`] returns, in a window of a width.
fn seen_at(page: &str, width: u32) -> Option<String> {
    let Some(chromium) = env::var_os("CHROMIUM").filter(|path| !path.is_empty()) else {
        // The macro `eprintln` would be captured, and not shown for a test that passes.
        let _ = writeln!(
            stderr(),
            "SKIPPED {}: there is no browser. Install Chromium and run `cargo xtask test`, or set CHROMIUM to the path of the browser.",
            thread::current().name().unwrap_or("a test of the report")
        );
        return None;
    };
    // Rarely Chromium ends by a signal before it has opened the page.
    let output = opened(&chromium, page, width);
    let has_crashed = output.status.code().is_none() && output.stdout.is_empty();
    let output = if has_crashed {
        opened(&chromium, page, width)
    } else {
        output
    };
    let [dom, log] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    let console: Vec<&str> = log
        .lines()
        .filter(|line| line.contains("CONSOLE"))
        .collect();
    assert!(console.is_empty(), "{console:?}");
    let text = dom
        .split_once("id=\"seen\">")
        .and_then(|(_, rest)| rest.split_once('<'))
        .map(|(text, _)| text.to_owned());
    // Whether Chromium stopped, did not open the page, or left the middle of it.
    let (status, length) = (output.status, dom.len());
    let ending = text.ok_or_else(|| format!("{status}, {length} bytes of the page, {log}"));
    Some(ending.expect("the page comes to its end"))
}

/// Opens a page in Chromium, with a profile of its own.
fn opened(chromium: &OsStr, page: &str, width: u32) -> Output {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("report.html");
    std::fs::write(&path, page).expect("written");
    Command::new(chromium)
        .args(OPTIONS)
        .arg(format!("--window-size={width},900"))
        .arg(format!(
            "--user-data-dir={}",
            folder.path().join("profile").display()
        ))
        .arg(format!("file://{}", path.display()))
        .output()
        .expect("Chromium runs")
}

/// Returns the value that a script, appended to a report, leaves in `seen` (see `report.js`). The
/// page must have no complaints, and must fetch nothing. None without Chromium.
fn run(page: &str, script: &str) -> Option<Value> {
    run_at(page, script, USUAL)
}

/// Returns what [`run`] returns, in a window of a width.
fn run_at(page: &str, script: &str, width: u32) -> Option<Value> {
    const COLLECT: &str = "<head><script>const complaints = [];
        addEventListener('error', (event) => complaints.push(String(event.message)));
        addEventListener('unhandledrejection', (event) => complaints.push(String(event.reason)));
        addEventListener('securitypolicyviolation', (event) => complaints.push(event.violatedDirective));
        for (const kind of ['error', 'warn']) console[kind] = (...words) => complaints.push(words.join(' '));</script>";
    let harness = include_str!("report.js");
    let page = page.replacen("<head>", COLLECT, 1).replace(
        "</body>",
        &format!("<script type=\"module\">{harness}\nleave({script});</script></body>"),
    );
    let bytes = STANDARD.decode(seen_at(&page, width)?).expect("base64");
    let seen: Value = serde_json::from_slice(&bytes).expect("JSON");
    assert_eq!(seen["complaints"], Value::Array(Vec::new()));
    assert_eq!(seen["fetched"], 0);
    Some(seen["result"].clone())
}

/// Returns the content of a report at each of the addresses, and the effect of each slider.
pub fn browse(page: &str, addresses: &[String]) -> Option<Value> {
    let addresses = serde_json::to_string(addresses).expect("text");
    run(page, &format!("browse({addresses})"))
}

/// Returns what a report shows after each choice of a probe, on a film of a thickness in um.
pub fn choose(page: &str, probes: &[&str], thickness: f64) -> Option<Value> {
    let probes = serde_json::to_string(probes).expect("text");
    run(page, &format!("choose({probes}, {thickness})"))
}

/// Returns the texts of a report that collide or are cut off at each of the addresses, on a page of
/// a width.
pub fn crowded(page: &str, addresses: &[&str], width: u32) -> Option<Value> {
    // No window of Chromium is narrower.
    const NARROWEST: u32 = 500;
    let addresses = serde_json::to_string(addresses).expect("text");
    let script = format!("crowded({addresses}, {width})");
    run_at(page, &script, width.max(NARROWEST))
}

/// Returns the messages of a report.
pub fn told(page: &str) -> Option<Value> {
    run(page, "told()")
}

/// Returns the state of the fields and messages of a report after each of the entries, a field's
/// name and the text typed into it, one after the other.
pub fn fill(page: &str, entries: &[(&str, &str)]) -> Option<Value> {
    let entries = serde_json::to_string(entries).expect("text");
    run(page, &format!("fill({entries})"))
}
