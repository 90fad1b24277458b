//! The layout of a page on a phone, a tablet and a desktop.

use acceptance::shipped;
use figures::page::Illustration;
use interp::Table;
use serde_json::Value;
use tabulate::plot::fig2;
use tabulate::report::report;

use crate::SPHERE;
use crate::browser::seen;

/// The widths of the pages, in pixels.
const WIDTHS: [u32; 4] = [320, 390, 768, 1200];

/// A machine may have wider fonts than another one.
const WIDER: &str = "* { letter-spacing: .06em; }</style>";

/// Runs in a page that holds the report once for each width. Leaves the number of drawings of each,
/// and everything that is cut off or reaches beyond the width: at first, and with a figure at full
/// size.
const MEASURE: &str = "<script>addEventListener('load', () => {
    const cutOff = (page) => {
        const { defaultView: view, documentElement: root } = page;
        const outside = [...page.body.querySelectorAll('*')].filter((element) => {
            const { right, width } = element.getBoundingClientRect();
            const hides = view.getComputedStyle(element).overflowX !== 'visible';
            return width > 0 && (right > root.clientWidth + 0.5 || (hides && element.scrollWidth > element.clientWidth));
        });
        const names = outside.map((element) => `${element.tagName} ${element.id || element.className}`);
        return root.scrollWidth > root.clientWidth ? ['the page', ...names] : names;
    };
    const seen = [...document.querySelectorAll('iframe')].map(({ contentDocument: page }) => {
        page.querySelector('details').open = true;
        const cut = cutOff(page), button = page.querySelector('.enlarge'), image = page.querySelector('.figures img');
        const fits = image.getBoundingClientRect().width;
        if (button.checkVisibility()) button.click();
        const root = page.documentElement;
        return {
            width: root.clientWidth,
            drawings: page.querySelectorAll('#charts svg').length,
            cut,
            full: image.getBoundingClientRect().width,
            moves: root.scrollWidth > root.clientWidth,
            fits,
        };
    });
    document.body.append(Object.assign(document.createElement('pre'), { id: 'seen', textContent: JSON.stringify(seen) }));
});</script>";

#[test]
fn a_phone_a_tablet_and_a_desktop_show_it_without_cutting_anything_off() {
    let table = Table::read(shipped("paper.bin")).expect("the shipped table");
    let figure = Illustration {
        caption: "Fig. 2",
        figure: fig2::figure().expect("solves"),
    };
    let page = report(&table, &[figure], &SPHERE)
        .expect("a report")
        .replacen("</style>", WIDER, 1);
    let escaped = page.replace('&', "&amp;").replace('"', "&quot;");
    let frames = WIDTHS.map(|width| {
        format!("<iframe style='border:0;width:{width}px' srcdoc=\"{escaped}\"></iframe>")
    });
    let Some(text) = seen(&format!("<body>{}{MEASURE}</body>", frames.concat())) else {
        return;
    };
    let seen: Value = serde_json::from_str(&text).expect("JSON");
    for (width, look) in WIDTHS.into_iter().zip(seen.as_array().expect("looks")) {
        // A scroll bar may take some of the width.
        let inside = look["width"].as_u64().expect("a width");
        assert!((u64::from(width) - 20..=u64::from(width)).contains(&inside));
        assert_eq!(look["drawings"], 2, "at {width} px");
        assert_eq!(look["cut"], Value::Array(Vec::new()), "at {width} px");
        // The whole figure fits; at its full size it moves in a frame of its own.
        assert!(look["fits"].as_f64().expect("a width") <= f64::from(width));
        if width < 700 {
            assert_eq!(look["full"], 840.0, "at {width} px");
        }
        assert_eq!(look["moves"], false, "at {width} px");
    }
}
