//! The file of a report: its words, its figures, and the table in it.

use acceptance::{Contacts, assert_names, larger, shipped, table, workdir};
use interp::{Quantity, Table};
use tabulate::report::{coarse, report};

use crate::{DIFFERENCE, FOUR_AXES, GAMMA_ALONE, RIGID_SPHERE, SPHERE, embedded_universal};

#[test]
fn the_file_is_whole_and_the_same_twice() {
    let workdir = workdir!();
    let source = shipped("paper.bin");
    let source = source.to_str().expect("a path in UTF-8");
    for name in ["one.html", "two.html"] {
        assert_eq!(workdir.succeed(format!("report {source} -o {name}")), "");
    }
    let page = workdir.text("one.html");
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
fn the_numbers_in_a_page_are_those_of_the_table() {
    let tables = [
        Table::read(shipped("paper.bin")).expect("the shipped table"),
        table(FOUR_AXES),
        table(RIGID_SPHERE),
        // In tiles.
        table(GAMMA_ALONE),
        Table::read(embedded_universal()).expect("the embedded table"),
    ];
    for table in tables {
        let title = &table.description().title;
        let coarse = coarse(&table).expect("numbers");
        let mut contacts = Contacts::new(2);
        let (mut largest, mut compared) = (0.0, 0);
        for _ in 0..2000 {
            let (x, material) = contacts.point_of(&table);
            let [ours, theirs] = [&table, &coarse.table]
                .map(|table| table.curve(&material).expect("a material in the box"));
            // A table of `Gamma` derives the others where it begins accurately enough for its tolerance.
            let answered = |quantity: &Quantity| ours.answers(*quantity);
            for quantity in table.answers().into_iter().filter(answered) {
                let [ours, theirs] =
                    [&ours, &theirs].map(|curve| curve.quantity(quantity, x).expect("answered"));
                largest = larger(largest, (theirs / ours - 1.0).abs());
                compared += 1;
            }
        }
        assert!(compared > 2000, "{title}: {compared}");
        assert!(largest < DIFFERENCE, "{title}: {largest:e}");
        // The page states the largest one of its own points, which differ.
        assert!(coarse.difference < DIFFERENCE, "{title}");
        assert!(coarse.difference > 0.0, "{title}");
    }
}

#[test]
fn a_page_of_every_film_is_small() {
    let table = Table::read(embedded_universal()).expect("the embedded table");
    let page = report(&table, &[], &SPHERE).expect("a report");
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
}
