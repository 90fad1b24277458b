//! Describes figures: panels side by side with two axes each, and in them lines, markers, cells,
//! guides and labels.
//!
//! A label names the point that it belongs to; its place next to this point is found when the panel
//! is drawn.
//!
//! ```
//! # fn main() -> Result<(), figures::Error> {
//! use figures::axis::Axis;
//! use figures::chart::{BLUE, Figure, Marker, Panel, Side};
//! use figures::picture::Format;
//!
//! let measured = [[1e-3, 2e-6], [1e-6, 4e-6], [1e-9, 9e-6]];
//! let x = Axis::decades("relative error", measured.map(|[error, _]| error));
//! let y = Axis::decades("time (s)", measured.map(|[_, seconds]| seconds));
//! let mut panel = Panel::new("Error and time of a solve", x, y);
//! panel.line(measured, BLUE).markers(measured, BLUE, Marker::Full).label(measured[2], "solve", BLUE, Side::Right);
//! let svg = Figure::new(360, [panel]).picture()?.encode(Format::Svg)?;
//! # assert!(svg.starts_with(b"<svg"));
//! # Ok(()) }
//! ```

use std::iter;

use plotters::style::RGBColor;

use crate::axis::Axis;

pub use crate::labels::Side;
pub use plotters::style::RGBColor as Colour;

/// The blue of the palette of Okabe and Ito (*Color Universal Design*, 2008), which colour-blind
/// people can distinguish. The yellow and the sky blue of the palette are too pale for lines.
pub const BLUE: Colour = RGBColor(0, 114, 178);
/// The vermilion of the palette of [`BLUE`].
pub const VERMILION: Colour = RGBColor(213, 94, 0);
/// The green of the palette of [`BLUE`].
pub const GREEN: Colour = RGBColor(0, 158, 115);
/// The purple of the palette of [`BLUE`].
pub const PURPLE: Colour = RGBColor(204, 121, 167);
/// The orange of the palette of [`BLUE`].
pub const ORANGE: Colour = RGBColor(230, 159, 0);
/// The black of the palette of [`BLUE`].
pub const BLACK: Colour = RGBColor(0, 0, 0);
/// The colour of guides and notes.
pub const GREY: Colour = RGBColor(90, 90, 90);

/// The width of a picture in pixels: that of a README on GitHub.
pub const WIDTH: u32 = 840;

/// Panels side by side, in one row or more.
#[derive(Clone, Debug)]
pub struct Figure {
    pub(crate) height: u32,
    pub(crate) rows: Vec<Vec<Panel>>,
}

/// Two axes, and the marks and labels between them.
#[derive(Clone, Debug)]
pub struct Panel {
    pub(crate) title: String,
    pub(crate) axes: [Axis; 2],
    pub(crate) share: f64,
    pub(crate) margin: u32,
    pub(crate) marks: Vec<Mark>,
    pub(crate) labels: Vec<Name>,
}

/// A value of the horizontal axis and one of the vertical.
pub type Point = [f64; 2];

/// The mark of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Full,
    /// A circle.
    Hollow,
    /// A disc of half the size, for points that lie close together.
    Small,
}

/// A text, and the points that it may be next to, the preferred one first.
#[derive(Clone, Debug)]
pub(crate) struct Name {
    pub anchors: Vec<Point>,
    pub text: String,
    pub colour: Colour,
    pub side: Side,
}

/// A shape between the axes.
#[derive(Clone, Debug)]
pub(crate) enum Mark {
    Line {
        points: Vec<Point>,
        colour: Colour,
        dashed: bool,
        width: f64,
    },
    Arrow {
        from: Point,
        to: Point,
        colour: Colour,
    },
    Marker {
        at: Point,
        colour: Colour,
        marker: Marker,
    },
    Cell {
        x: [f64; 2],
        y: [f64; 2],
        colour: Colour,
    },
}

impl Figure {
    /// Makes a figure of [`WIDTH`] by `height` pixels, with its panels from left to right.
    pub fn new(height: u32, panels: impl Into<Vec<Panel>>) -> Self {
        Self::grid(height, [panels.into()])
    }

    /// Makes a figure of [`WIDTH`] by `height` pixels from rows of panels, all of one height.
    pub fn grid(height: u32, rows: impl Into<Vec<Vec<Panel>>>) -> Self {
        Self {
            height,
            rows: rows.into(),
        }
    }
}

impl Panel {
    /// Makes an empty panel.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            axes: [x, y],
            share: 1.0,
            margin: 16,
            marks: Vec::new(),
            labels: Vec::new(),
        }
    }

    /// Sets the share of the figure's width; it is 1 otherwise.
    pub fn share(mut self, share: f64) -> Self {
        self.share = share;
        self
    }

    /// Sets the space right of the axes, in pixels, for labels at the ends of lines.
    pub fn margin(mut self, pixels: u32) -> Self {
        self.margin = pixels;
        self
    }

    /// Draws a line through points; the parts outside the axes are cut off.
    pub fn line(&mut self, points: impl Into<Vec<Point>>, colour: Colour) -> &mut Self {
        self.mark(Mark::Line {
            points: points.into(),
            colour,
            dashed: false,
            width: 2.0,
        })
    }

    /// Draws a line through points, and writes its name at a part of them, from 0 to 1, preferably on the side given.
    pub fn named(
        &mut self,
        points: Vec<Point>,
        colour: Colour,
        name: impl Into<String>,
        (part, side): (f64, Side),
    ) -> &mut Self {
        let place = (part * points.len() as f64) as usize;
        let at = points[place.min(points.len() - 1)];
        self.line(points, colour).label(at, name, colour, side)
    }

    /// Draws a dashed line through points.
    pub fn dashed(&mut self, points: impl Into<Vec<Point>>, colour: Colour) -> &mut Self {
        self.mark(Mark::Line {
            points: points.into(),
            colour,
            dashed: true,
            width: 1.5,
        })
    }

    /// Draws a dotted arrow.
    pub fn arrow(&mut self, from: Point, to: Point, colour: Colour) -> &mut Self {
        self.mark(Mark::Arrow { from, to, colour })
    }

    /// Marks points.
    pub fn markers(
        &mut self,
        points: impl IntoIterator<Item = Point>,
        colour: Colour,
        marker: Marker,
    ) -> &mut Self {
        self.marks.extend(
            points
                .into_iter()
                .map(|at| Mark::Marker { at, colour, marker }),
        );
        self
    }

    /// Fills a rectangle between two values of each axis.
    pub fn cell(&mut self, x: [f64; 2], y: [f64; 2], colour: Colour) -> &mut Self {
        self.mark(Mark::Cell { x, y, colour })
    }

    /// Draws a dashed line across the panel at a value of the vertical axis, with a label near its
    /// left (`Side::Left`) or right end.
    pub fn horizontal_guide(
        &mut self,
        value: f64,
        text: impl Into<String>,
        end: Side,
    ) -> &mut Self {
        let [from, to] = self.axes[0].range();
        let (at, side) = if end == Side::Left {
            (from, Side::AboveRight)
        } else {
            (to, Side::AboveLeft)
        };
        self.mark(Mark::Line {
            points: vec![[from, value], [to, value]],
            colour: GREY,
            dashed: true,
            width: 1.2,
        });
        // Beside the end, or farther along where the end is crowded.
        let along = (0..=10).map(|i| self.axes[0].value(f64::from(i) / 10.0));
        let anchors = iter::once(at).chain(along).map(|x| [x, value]);
        self.label_along(anchors.collect::<Vec<_>>(), text, GREY, side)
    }

    /// Writes a text next to a point, preferably on the side given.
    pub fn label(
        &mut self,
        at: Point,
        text: impl Into<String>,
        colour: Colour,
        side: Side,
    ) -> &mut Self {
        self.label_along([at], text, colour, side)
    }

    /// Writes a text next to one of several points, for instance of the line that it names:
    /// preferably next to the first, on the side given.
    pub fn label_along(
        &mut self,
        points: impl Into<Vec<Point>>,
        text: impl Into<String>,
        colour: Colour,
        side: Side,
    ) -> &mut Self {
        self.labels.push(Name {
            anchors: points.into(),
            text: text.into(),
            colour,
            side,
        });
        self
    }

    fn mark(&mut self, mark: Mark) -> &mut Self {
        self.marks.push(mark);
        self
    }
}
