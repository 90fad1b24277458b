//! What every figure is made of: panels side by side with two axes each, and on them lines,
//! markers, cells, guides and labels. A label says where it belongs; the panel finds the place
//! nearby that covers least.
//!
//! ```
//! # fn main() -> Result<(), tabulate::Error> {
//! use tabulate::plot::axis::Axis;
//! use tabulate::plot::chart::{BLUE, Figure, Marker, Panel, Side};
//! use tabulate::plot::picture::Format;
//!
//! let measured = [[1e-3, 2e-6], [1e-6, 4e-6], [1e-9, 9e-6]];
//! let x = Axis::decades("relative error", measured.map(|[error, _]| error));
//! let y = Axis::decades("time (s)", measured.map(|[_, seconds]| seconds));
//! let mut panel = Panel::new("What accuracy costs", x, y);
//! panel.line(measured, BLUE).markers(measured, BLUE, Marker::Full).label(measured[2], "solve", BLUE, Side::Right);
//! let svg = Figure::new(360, [panel]).picture()?.encode(Format::Svg)?;
//! # assert!(svg.starts_with(b"<svg"));
//! # Ok(()) }
//! ```

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Circle, DashedPathElement, PathElement, Polygon, Rectangle, Text};
use plotters::prelude::SVGBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, IntoFont, RGBColor, ShapeStyle, TextStyle, WHITE};

use super::axis::Axis;
use super::labels::{Label, Obstacles, Room};
use super::picture::{Picture, text_width};
use crate::Error;

pub use super::labels::Side;
pub use plotters::style::RGBColor as Colour;

/// Colours that the colour-blind tell apart, by Okabe and Ito (*Color Universal Design*, 2008);
/// their yellow and sky blue are too pale for lines.
pub const BLUE: Colour = RGBColor(0, 114, 178);
/// See [`BLUE`].
pub const VERMILION: Colour = RGBColor(213, 94, 0);
/// See [`BLUE`].
pub const GREEN: Colour = RGBColor(0, 158, 115);
/// See [`BLUE`].
pub const PURPLE: Colour = RGBColor(204, 121, 167);
/// See [`BLUE`].
pub const ORANGE: Colour = RGBColor(230, 159, 0);
/// See [`BLUE`].
pub const BLACK: Colour = RGBColor(0, 0, 0);
/// For guides and what stands back.
pub const GREY: Colour = RGBColor(90, 90, 90);
const GRID: Colour = RGBColor(225, 225, 225);
const FINE_GRID: Colour = RGBColor(242, 242, 242);

/// Width of a picture in pixels: that of a README on GitHub.
pub const WIDTH: u32 = 840;

/// The library's coordinates are whole numbers: each is this part of a pixel.
const FINE: i32 = 10;

/// Sizes of text in pixels.
const TITLE: f64 = 16.0;
const TEXT: f64 = 14.0;

/// Panels side by side, in one row or more.
#[derive(Clone, Debug)]
pub struct Figure {
    height: u32,
    rows: Vec<Vec<Panel>>,
}

/// Two axes and what is drawn between them.
#[derive(Clone, Debug)]
pub struct Panel {
    title: String,
    axes: [Axis; 2],
    share: f64,
    margin: u32,
    marks: Vec<Mark>,
    labels: Vec<(Point, Label)>,
}

/// A value of the horizontal axis and one of the vertical.
pub type Point = [f64; 2];

/// How a point is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Full,
    /// A circle.
    Hollow,
}

#[derive(Clone, Debug)]
enum Mark {
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
    /// A figure of [`WIDTH`] by `height` pixels, with its panels from left to right.
    pub fn new(height: u32, panels: impl Into<Vec<Panel>>) -> Self {
        Self::grid(height, [panels.into()])
    }

    /// The same with rows of panels below each other, all of one height.
    pub fn grid(height: u32, rows: impl Into<Vec<Vec<Panel>>>) -> Self {
        Self {
            height,
            rows: rows.into(),
        }
    }

    /// Draws it.
    ///
    /// # Errors
    /// [`Error::Picture`] if a text holds a character that the font lacks.
    pub fn picture(&self) -> Result<Picture, Error> {
        let fine = FINE as u32;
        let mut svg = String::new();
        let root = SVGBackend::with_string(&mut svg, (fine * WIDTH, fine * self.height))
            .into_drawing_area();
        root.fill(&WHITE)?;
        // All panels are as high as the one with most around it.
        let panels = self.rows.iter().flatten();
        let around = panels
            .map(Panel::above_and_below)
            .fold([0.0_f64; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
        for (row, area) in self
            .rows
            .iter()
            .zip(root.split_evenly((self.rows.len(), 1)))
        {
            let whole = row.iter().map(|panel| panel.share).sum::<f64>();
            let (mut so_far, mut rest) = (0.0, area);
            for panel in row {
                so_far += panel.share;
                let end = (f64::from(fine * WIDTH) * so_far / whole).round() as i32;
                let (area, right) = rest.split_horizontally(end - rest.get_base_pixel().0);
                panel.draw(&area, around)?;
                rest = right;
            }
        }
        root.present()?;
        drop(root);
        // The size in pixels; and corners of lines that do not stick out.
        let [width, height] = [WIDTH, self.height];
        let (old, new) = (
            format!("width=\"{}\" height=\"{}\"", fine * width, fine * height),
            format!("width=\"{width}\" height=\"{height}\" stroke-linejoin=\"round\""),
        );
        Picture::from_svg(&svg.replacen(&old, &new, 1))
    }
}

impl Panel {
    /// An empty panel.
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

    /// Its share of the figure's width, where the other panels have 1.
    pub fn share(mut self, share: f64) -> Self {
        self.share = share;
        self
    }

    /// Pixels to the right of the axes, for labels at the ends of lines.
    pub fn margin(mut self, pixels: u32) -> Self {
        self.margin = pixels;
        self
    }

    /// A line through points; what is outside the axes is cut off.
    pub fn line(&mut self, points: impl Into<Vec<Point>>, colour: Colour) -> &mut Self {
        self.mark(Mark::Line {
            points: points.into(),
            colour,
            dashed: false,
            width: 2.0,
        })
    }

    /// A dashed line through points.
    pub fn dashed(&mut self, points: impl Into<Vec<Point>>, colour: Colour) -> &mut Self {
        self.mark(Mark::Line {
            points: points.into(),
            colour,
            dashed: true,
            width: 1.5,
        })
    }

    /// A dotted arrow.
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

    /// A filled rectangle between two values of each axis.
    pub fn cell(&mut self, x: [f64; 2], y: [f64; 2], colour: Colour) -> &mut Self {
        self.mark(Mark::Cell { x, y, colour })
    }

    /// A dashed line across the panel at a value of the vertical axis, with a label at its left
    /// (`Side::Left`) or right end.
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
        self.label([at, value], text, GREY, side)
    }

    /// Text beside a point, preferably on the side given.
    pub fn label(
        &mut self,
        at: Point,
        text: impl Into<String>,
        colour: Colour,
        side: Side,
    ) -> &mut Self {
        self.labels.push((
            at,
            Label {
                text: text.into(),
                colour,
                side,
            },
        ));
        self
    }

    fn mark(&mut self, mark: Mark) -> &mut Self {
        self.marks.push(mark);
        self
    }

    /// Pixels for the title, and for numbers and label of the horizontal axis.
    fn above_and_below(&self) -> [f64; 2] {
        let [x, _] = &self.axes;
        let numbers = if x.ticks().is_empty() { 4.0 } else { 26.0 };
        [
            if self.title.is_empty() { 10.0 } else { 40.0 },
            numbers + if x.label().is_empty() { 0.0 } else { 18.0 },
        ]
    }

    fn draw(&self, area: &Area<'_>, [above, below]: [f64; 2]) -> Result<(), Error> {
        let [x, y] = &self.axes;
        let widest = y
            .ticks()
            .iter()
            .map(|(_, name)| text_width(name))
            .try_fold(0.0_f64, |most, w| w.map(|w| most.max(w)))?;
        let label = if y.label().is_empty() { 0.0 } else { 22.0 };
        let mut builder = ChartBuilder::on(area);
        builder
            .margin_top(fine(above))
            .margin_left(fine(8.0))
            .margin_bottom(fine(8.0))
            .margin_right(fine(f64::from(self.margin)))
            .x_label_area_size(fine(below))
            .y_label_area_size(fine(10.0 + widest * TEXT + label));
        let mut chart = builder.build_cartesian_2d(x.clone(), y.clone())?;
        chart
            .configure_mesh()
            .bold_line_style(stroke(GRID, 1.0))
            .light_line_style(stroke(FINE_GRID, 1.0))
            .axis_style(stroke(GREY, 1.0))
            .set_all_tick_mark_size(fine(4.0))
            .label_style(text(TEXT, BLACK))
            .x_desc(x.label())
            .y_desc(y.label())
            .draw()?;
        let mut obstacles = Obstacles::default();
        for mark in &self.marks {
            mark.draw(&mut chart, &self.axes, &mut obstacles)?;
        }
        self.draw_texts(area, &chart, obstacles)
    }

    fn draw_texts(
        &self,
        area: &Area<'_>,
        chart: &Chart<'_>,
        mut obstacles: Obstacles,
    ) -> Result<(), Error> {
        let (left, top) = chart.plotting_area().get_base_pixel();
        let (width_of_axes, height) = chart.plotting_area().dim_in_pixel();
        let (base, (width, _)) = (area.get_base_pixel(), area.dim_in_pixel());
        // Over the middle of the axes, unless the title is too long.
        let middle = left + width_of_axes as i32 / 2 - base.0;
        let middle = middle.max(fine(0.5 * TITLE * text_width(&self.title)? + 3.0));
        let title = text(TITLE, BLACK).pos(Pos::new(HPos::Center, VPos::Center));
        area.draw(&Text::new(
            self.title.as_str(),
            (middle, top - base.1 - fine(16.0)),
            title,
        ))?;
        // Labels may reach a little beyond the ends of the vertical axis, as its numbers do.
        let half = f64::from(fine(0.6 * TEXT));
        let room = Room {
            x: [
                f64::from(left),
                f64::from(base.0 + width as i32 - fine(3.0)),
            ],
            y: [
                f64::from(top) - half,
                f64::from(top) + f64::from(height) + half,
            ],
        };
        for (at, label) in &self.labels {
            let size =
                [text_width(&label.text)? * TEXT, TEXT].map(|length| length * f64::from(FINE));
            // A label of something outside the axes is at their edge.
            let [x, y] = pixel(chart, *at);
            let (x, y) = (
                x.clamp(left, left + width_of_axes as i32),
                y.clamp(top, top + height as i32),
            );
            let [x, y] = label.place(
                [x, y].map(f64::from),
                size,
                f64::from(FINE),
                &room,
                &mut obstacles,
            );
            let style = text(TEXT, label.colour).pos(Pos::new(HPos::Center, VPos::Center));
            area.draw(&Text::new(
                label.text.as_str(),
                (x as i32 - base.0, y as i32 - base.1),
                style,
            ))?;
        }
        Ok(())
    }
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Axis, Axis>>;

impl Mark {
    fn draw(
        &self,
        chart: &mut Chart<'_>,
        axes: &[Axis; 2],
        obstacles: &mut Obstacles,
    ) -> Result<(), Error> {
        let distance = 3.0 * f64::from(FINE);
        match self {
            Self::Line {
                points,
                colour,
                dashed,
                width,
            } => {
                for piece in inside(points, axes) {
                    for ends in piece.windows(2) {
                        let [from, to] =
                            [ends[0], ends[1]].map(|(x, y)| pixel(chart, [x, y]).map(f64::from));
                        obstacles.line(from, to, distance);
                    }
                    let style = stroke(*colour, *width);
                    if *dashed {
                        let dashes = DashedPathElement::new(piece, fine(6.0), fine(4.0), style);
                        chart.plotting_area().draw(&dashes)?;
                    } else {
                        chart
                            .plotting_area()
                            .draw(&PathElement::new(piece, style))?;
                    }
                }
            }
            Self::Arrow { from, to, colour } => {
                let [start, end] = [from, to].map(|point| pixel(chart, *point).map(f64::from));
                obstacles.line(start, end, distance);
                let area = chart.plotting_area().strip_coord_spec();
                let (left, top) = area.get_base_pixel();
                let at = |point: [f64; 2]| {
                    (
                        point[0].round() as i32 - left,
                        point[1].round() as i32 - top,
                    )
                };
                let length = (end[0] - start[0]).hypot(end[1] - start[1]).max(1.0);
                let along = [0, 1].map(|k| (end[k] - start[k]) / length);
                // A head of 9 by 7 pixels, and a line up to it.
                let [back, aside] = [9.0, 3.5].map(|pixels| pixels * f64::from(FINE));
                let neck = [0, 1].map(|k| end[k] - back * along[k]);
                let dots = DashedPathElement::new(
                    [at(start), at(neck)],
                    fine(2.0),
                    fine(3.0),
                    stroke(*colour, 1.5),
                );
                area.draw(&dots)?;
                let corner = |side: f64| {
                    at([
                        neck[0] - side * aside * along[1],
                        neck[1] + side * aside * along[0],
                    ])
                };
                area.draw(&Polygon::new(
                    [at(end), corner(1.0), corner(-1.0)],
                    colour.filled(),
                ))?;
            }
            Self::Marker { at, colour, marker } => {
                let [x, y] = pixel(chart, *at).map(f64::from);
                let reach = 4.0 * f64::from(FINE);
                obstacles.line([x - reach, y], [x + reach, y], distance);
                obstacles.line([x, y - reach], [x, y + reach], distance);
                let (inside, edge) = if *marker == Marker::Full {
                    (*colour, *colour)
                } else {
                    (WHITE, *colour)
                };
                chart.plotting_area().draw(&Circle::new(
                    (at[0], at[1]),
                    fine(4.0),
                    inside.filled(),
                ))?;
                chart.plotting_area().draw(&Circle::new(
                    (at[0], at[1]),
                    fine(4.0),
                    stroke(edge, 1.5),
                ))?;
            }
            Self::Cell { x, y, colour } => {
                let area = chart.plotting_area().strip_coord_spec();
                let (left, top) = area.get_base_pixel();
                // On whole pixels, or the paper would shine through between neighbours.
                let corner = |k: usize| {
                    let [x, y] = pixel(chart, [x[k], y[k]])
                        .map(|place| (f64::from(place) / f64::from(FINE)).round());
                    (fine(x) - left, fine(y) - top)
                };
                area.draw(&Rectangle::new([corner(0), corner(1)], colour.filled()))?;
            }
        }
        Ok(())
    }
}

/// The pieces of a line that are between the axes: each of its segments is cut where it leaves
/// (Liang and Barsky, 1984).
fn inside(points: &[Point], axes: &[Axis; 2]) -> Vec<Vec<(f64, f64)>> {
    let place = |point: &Point| [0, 1].map(|k| axes[k].position(point[k]));
    let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut connected = false;
    for ends in points.windows(2) {
        let (from, to) = (place(&ends[0]), place(&ends[1]));
        let drawable = from.iter().chain(&to).all(|place| place.is_finite());
        let (mut enter, mut leave) = (0.0_f64, if drawable { 1.0_f64 } else { f64::NEG_INFINITY });
        for k in 0..2 {
            for (distance, speed) in [(from[k], to[k] - from[k]), (1.0 - from[k], from[k] - to[k])]
            {
                if speed > 0.0 {
                    enter = enter.max(-distance / speed);
                } else if speed < 0.0 {
                    leave = leave.min(-distance / speed);
                } else if distance < 0.0 {
                    leave = f64::NEG_INFINITY;
                }
            }
        }
        if enter > leave {
            connected = false;
            continue;
        }
        let at = |part: f64, end: &Point| {
            if part == 0.0 || part == 1.0 {
                return (end[0], end[1]);
            }
            let value = |k: usize| axes[k].value(from[k] + part * (to[k] - from[k]));
            (value(0), value(1))
        };
        if !connected {
            pieces.push(vec![at(enter, &ends[0])]);
        }
        if let Some(piece) = pieces.last_mut() {
            piece.push(at(leave, &ends[1]));
        }
        connected = leave == 1.0;
    }
    pieces
}

/// Where a point is in the whole drawing.
fn pixel(chart: &Chart<'_>, point: Point) -> [i32; 2] {
    let (x, y) = chart.backend_coord(&(point[0], point[1]));
    [x, y]
}

/// Pixels in the library's coordinates.
fn fine(pixels: f64) -> i32 {
    (pixels * f64::from(FINE)).round() as i32
}

fn stroke(colour: Colour, width: f64) -> ShapeStyle {
    colour.stroke_width(fine(width) as u32)
}

fn text(size: f64, colour: Colour) -> TextStyle<'static> {
    // The library's sizes of text are these times the usual ones.
    const UNUSUAL: f64 = 1.24;
    let font = ("sans-serif", UNUSUAL * size * f64::from(FINE)).into_font();
    TextStyle {
        color: colour.to_backend_color(),
        ..TextStyle::from(font)
    }
}
