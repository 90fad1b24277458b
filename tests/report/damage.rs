//! A page whose data is damaged, by a mail program for instance: it says so, and nothing else.

use acceptance::table;
use tabulate::report::report;

use crate::SPHERE;
use crate::browser::told;

const SCENE: &str = "
    title      = 'Small'
    tolerance  = 1e-2
    a_over_t   = { from = 0.1, to = 10, nodes = 11 }
    e1_over_e2 = { from = 1, to = 2, nodes = 4 }
    nu1        = 0.5
    e0_over_e2 = { from = 10, to = 20, nodes = 3 }
";
const DAMAGED: &str = "The data of this page is damaged. Copy the page again, or make it again with `tabulate report`.";

/// Returns a page and its data in base64.
fn page() -> (String, String) {
    let page = report(&table(SCENE), &[], &SPHERE).expect("a report");
    let (_, rest) = page
        .split_once("id=\"integers\">")
        .expect("the page has data");
    let data = rest.split('<').next().unwrap_or_default().to_owned();
    (page, data)
}

#[test]
fn a_page_with_damaged_data_says_so() {
    let (page, data) = page();
    let Some(sound) = told(&page) else { return };
    assert!(!sound.to_string().contains("damaged"), "{sound}");
    let middle = data.len() / 2;
    let other = if data.as_bytes()[middle] == b'A' {
        "B"
    } else {
        "A"
    };
    for damaged in [
        String::new(),
        data[..middle].to_owned(),
        data[..data.len() - 4].to_owned(),
        format!("{data}AAAA"),
        format!("{}{other}{}", &data[..middle], &data[middle + 1..]),
        format!("{}=3D{}", &data[..middle], &data[middle..]),
    ] {
        let told = told(&page.replacen(&data, &damaged, 1));
        assert_eq!(told.expect("as before"), DAMAGED);
    }
}
