//! The file of a report: its words, its figures, and the table in it.

use acceptance::{Contacts, assert_names, larger, shipped, table, workdir};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use interp::{Quantity, Table};
use tabulate::report::report;

use crate::{DIFFERENCE, FOUR_AXES, GAMMA_ALONE, RIGID_SPHERE, SPHERE, embedded_universal};

/// Reads the table in a page.
fn packed(page: &str) -> Table {
    let (_, rest) = page
        .split_once("id=\"packed\">")
        .expect("the page has data");
    let (data, _) = rest.split_once('<').expect("the data ends");
    Table::from_packed(&STANDARD.decode(data).expect("base64")).expect("a packed table")
}

#[test]
fn the_file_is_whole_and_the_same_twice() {
    let workdir = workdir!();
    let source = shipped("paper.bin");
    let source = source.to_str().expect("a path in UTF-8");
    for name in ["one.html", "two.html"] {
        assert_eq!(workdir.succeed(&["report", source, "-o", name]), "");
    }
    let page = String::from_utf8(workdir.read("one.html")).expect("UTF-8");
    assert_eq!(page.as_bytes(), workdir.read("two.html"));
    assert_eq!(workdir.files(), ["one.html", "two.html"]);
    let table = Table::read(shipped("paper.bin")).expect("the shipped table");
    let description = table.description();
    let certificate = &description.certificate;
    let words = [
        format!("<title>{}</title>", description.title),
        format!("<dd>{:.1e}</dd>", certificate.max_error),
        format!("<dd>{:.1e}</dd>", certificate.median_error),
        format!(
            "<dd>{} direct solves, seed {}</dd>",
            certificate.points, certificate.seed
        ),
        format!(
            "{} at a/t = {}",
            certificate.worst_quantity.name(),
            &certificate.worst_point[0].to_string()[..5]
        ),
        description.created_by.clone(),
        description.scene.trim_end().replace('"', "&quot;"),
    ];
    assert_names(&page, &words.each_ref().map(String::as_str));
    assert_eq!(
        page.matches("<figure><img alt=").count(),
        4,
        "the error map, and the paper's figures"
    );
    assert!(!page.contains("{{") && !page.contains("}}"));
    // The name of the SVG format is not an address to fetch.
    assert!(
        !page
            .replace("http://www.w3.org/2000/svg", "")
            .contains("://")
    );
}

#[test]
fn what_a_table_says_is_text() {
    let page = report(&table(FOUR_AXES), &[], &SPHERE).expect("a report");
    assert_names(&page, &["<title>Ångström &amp; &lt;Söhne&gt;</title>"]);
    assert!(!page.contains("<Söhne>"));
}

#[test]
fn the_table_in_the_page_is_the_table() {
    let tables = [
        Table::read(shipped("paper.bin")).expect("the shipped table"),
        table(FOUR_AXES),
        table(RIGID_SPHERE),
        // In tiles.
        table(GAMMA_ALONE),
    ];
    for table in tables {
        let embedded = packed(&report(&table, &[], &SPHERE).expect("a report"));
        assert_eq!(embedded.description(), table.description());
        let mut contacts = Contacts::new(1);
        let mut largest = 0.0;
        for _ in 0..2000 {
            let (x, material) = contacts.point_of(&table);
            let [ours, theirs] = [&table, &embedded]
                .map(|table| table.curve(&material).expect("a material in the box"));
            let difference = |quantity: Quantity| {
                let [ours, theirs] = [&ours, &theirs]
                    .map(|curve| curve.quantity(quantity, x).expect("held and in range"));
                (theirs / ours - 1.0).abs()
            };
            largest = table
                .quantities()
                .into_iter()
                .map(difference)
                .fold(largest, larger);
        }
        assert!(
            largest < DIFFERENCE,
            "{}: {largest:e}",
            table.description().title
        );
    }
    // A table in low-rank form is in the page unchanged.
    let table = Table::read(embedded_universal()).expect("the embedded table");
    let embedded = packed(&report(&table, &[], &SPHERE).expect("a report"));
    assert_eq!(
        embedded.to_packed().expect("packed"),
        table.to_packed().expect("packed")
    );
}

#[test]
fn nothing_is_written_on_top_of_the_table() {
    let workdir = workdir!();
    workdir.write(
        "table.bin",
        std::fs::read(shipped("paper.bin")).expect("the shipped table"),
    );
    let message = workdir.fail(1, &["report", "table.bin", "-o", "table.bin"]);
    assert_names(&message, &["table.bin", "it is the input"]);
    workdir.fail(2, &["report", "table.bin"]);
    assert_names(
        &workdir.succeed(&["report", "--help"]),
        &["TABLE", "-o", "--output", "REPORT.html"],
    );
}
