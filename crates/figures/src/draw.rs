//! Draws the figures that [`crate::chart`] describes, with the crate `plotters`.
//!
//! First the axes with their numbers, then the marks, which become obstacles, and then the labels,
//! for which [`crate::labels`] finds places between the obstacles.

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Circle, DashedPathElement, PathElement, Polygon, Rectangle, Text};
use plotters::prelude::SVGBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, IntoFont, RGBColor, ShapeStyle, TextStyle, WHITE};

use crate::Error;
use crate::axis::Axis;
use crate::chart::{BLACK, Colour, Figure, GREY, Mark, Marker, Name, Panel, Point, WIDTH};
use crate::clip::inside;
use crate::labels::{self, Label, Obstacles, Room};
use crate::picture::{Picture, text_width};

const GRID: Colour = RGBColor(225, 225, 225);
const FINE_GRID: Colour = RGBColor(242, 242, 242);

/// The coordinates of `plotters` are whole numbers: this many to a pixel.
const FINE: i32 = 10;

impl Figure {
    /// Draws the figure.
    ///
    /// # Errors
    /// [`Error`] if a text holds a character that the font lacks.
    pub fn picture(&self) -> Result<Picture, Error> {
        self.drawn().map(|(picture, _)| picture)
    }

    /// Draws the figure, and returns the texts of it for which there is no room: each collides with a line, a marker, another text
    /// or the edge.
    ///
    /// # Errors
    /// As [`Figure::picture`].
    pub fn drawn(&self) -> Result<(Picture, Vec<String>), Error> {
        let mut colliding = Vec::new();
        let fine = FINE as u32;
        let mut svg = String::new();
        let root = SVGBackend::with_string(&mut svg, (fine * WIDTH, fine * self.height))
            .into_drawing_area();
        root.fill(&WHITE)?;
        // All axes have the height of those of the panel with most above and below them.
        let panels = self.rows.iter().flatten();
        let around = panels
            .map(above_and_below)
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
                colliding.extend(draw(panel, &area, around)?);
                rest = right;
            }
        }
        root.present()?;
        drop(root);
        // The size in pixels, and round corners of lines.
        let [width, height] = [WIDTH, self.height];
        let (old, new) = (
            format!("width=\"{}\" height=\"{}\"", fine * width, fine * height),
            format!("width=\"{width}\" height=\"{height}\" stroke-linejoin=\"round\""),
        );
        let picture = Picture::from_svg(&svg.replacen(&old, &new, 1))?;
        Ok((picture, colliding))
    }
}

/// The size of titles in pixels.
const TITLE: f64 = 16.0;
/// The size of other text in pixels.
const TEXT: f64 = 14.0;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Axis, Axis>>;

/// Returns the space above the axes of a panel, for its title, and below them, for the numbers and
/// the label of the horizontal axis, in pixels.
fn above_and_below(panel: &Panel) -> [f64; 2] {
    let [x, _] = &panel.axes;
    let numbers = if x.ticks().is_empty() { 4.0 } else { 26.0 };
    [
        if panel.title.is_empty() { 10.0 } else { 40.0 },
        numbers + if x.label().is_empty() { 0.0 } else { 18.0 },
    ]
}

/// Draws a panel on an area, with this space above and below its axes in pixels. Returns the texts
/// that collide with something.
fn draw(panel: &Panel, area: &Area<'_>, [above, below]: [f64; 2]) -> Result<Vec<String>, Error> {
    let [x, y] = &panel.axes;
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
        .margin_right(fine(f64::from(panel.margin)))
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
    for mark in &panel.marks {
        mark.draw(&mut chart, &panel.axes, &mut obstacles)?;
    }
    draw_texts(panel, area, &chart, &obstacles)
}

/// Draws the title and the labels of a panel. Returns those that collide with something.
fn draw_texts(
    panel: &Panel,
    area: &Area<'_>,
    chart: &Chart<'_>,
    obstacles: &Obstacles,
) -> Result<Vec<String>, Error> {
    /// The least space beside a title, in pixels.
    const BESIDE: f64 = 8.0;
    let (left, top) = chart.plotting_area().get_base_pixel();
    let (width_of_axes, height) = chart.plotting_area().dim_in_pixel();
    let (base, (width, _)) = (area.get_base_pixel(), area.dim_in_pixel());
    let centred = Pos::new(HPos::Center, VPos::Center);
    // Over the middle of the axes, unless the title is too long.
    let middle = left + width_of_axes as i32 / 2 - base.0;
    let half = fine(0.5 * TITLE * text_width(&panel.title)? + BESIDE);
    let middle = middle.min(width as i32 - half).max(half);
    let mut colliding = Vec::new();
    if middle + half > width as i32 {
        colliding.push(panel.title.clone());
    }
    area.draw(&Text::new(
        panel.title.as_str(),
        (middle, top - base.1 - fine(16.0)),
        text(TITLE, BLACK).pos(centred),
    ))?;
    // Labels may reach a little above the vertical axis, as its numbers do, but not into the horizontal one.
    let [above, from_below] = [0.6 * TEXT, 3.0];
    let pixels = |place: i32| f64::from(place) / f64::from(FINE);
    let bottom = top + height as i32;
    let room = Room {
        x: [pixels(left), pixels(base.0 + width as i32) - 3.0],
        y: [pixels(top) - above, pixels(bottom) - from_below],
    };
    let label = |name: &Name| -> Result<Label, Error> {
        // A label of a point outside the axes is at their edge.
        let anchor = |at: &Point| {
            let [x, y] = place(chart, *at);
            [
                x.clamp(pixels(left), pixels(left + width_of_axes as i32)),
                y.clamp(pixels(top), pixels(bottom)),
            ]
        };
        Ok(Label {
            anchors: name.anchors.iter().map(anchor).collect(),
            size: [text_width(&name.text)? * TEXT, TEXT],
            colour: name.colour,
            side: name.side,
        })
    };
    let labels = panel.labels.iter().map(label);
    let labels = labels.collect::<Result<Vec<_>, Error>>()?;
    let placed = labels::place(&labels, &room, obstacles);
    for (name, place) in panel.labels.iter().zip(placed) {
        if place.collides {
            colliding.push(name.text.clone());
        }
        let [x, y] = place.centre;
        area.draw(&Text::new(
            name.text.as_str(),
            (fine(x) - base.0, fine(y) - base.1),
            text(TEXT, name.colour).pos(centred),
        ))?;
    }
    Ok(colliding)
}

impl Mark {
    /// Draws the mark, and adds it to the obstacles of labels.
    fn draw(
        &self,
        chart: &mut Chart<'_>,
        axes: &[Axis; 2],
        obstacles: &mut Obstacles,
    ) -> Result<(), Error> {
        match self {
            Self::Line {
                points,
                colour,
                dashed,
                width,
            } => {
                for piece in inside(points, axes) {
                    for ends in piece.windows(2) {
                        let [from, to] = [ends[0], ends[1]].map(|(x, y)| place(chart, [x, y]));
                        obstacles.line(*colour, from, to);
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
                let [start, end] = [from, to].map(|point| place(chart, *point));
                obstacles.line(*colour, start, end);
                let area = chart.plotting_area().strip_coord_spec();
                let (left, top) = area.get_base_pixel();
                let at = |[x, y]: [f64; 2]| (fine(x) - left, fine(y) - top);
                let length = (end[0] - start[0]).hypot(end[1] - start[1]).max(1.0);
                let along = [0, 1].map(|k| (end[k] - start[k]) / length);
                // A head of 9 by 7 pixels, and a dotted line up to it.
                let [back, aside] = [9.0, 3.5];
                let neck = [0, 1].map(|k| end[k] - back * along[k]);
                area.draw(&DashedPathElement::new(
                    [at(start), at(neck)],
                    fine(2.0),
                    fine(3.0),
                    stroke(*colour, 1.5),
                ))?;
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
                let edge = || stroke(*colour, 1.5);
                let (radius, styles) = match marker {
                    Marker::Full => (4.0, vec![colour.filled(), edge()]),
                    Marker::Hollow => (4.0, vec![WHITE.filled(), edge()]),
                    Marker::Small => (2.0, vec![colour.filled()]),
                };
                let [x, y] = place(chart, *at);
                obstacles.line(*colour, [x - radius, y], [x + radius, y]);
                obstacles.line(*colour, [x, y - radius], [x, y + radius]);
                for style in styles {
                    let circle = Circle::new((at[0], at[1]), fine(radius), style);
                    chart.plotting_area().draw(&circle)?;
                }
            }
            Self::Cell { x, y, colour } => {
                let area = chart.plotting_area().strip_coord_spec();
                let (left, top) = area.get_base_pixel();
                // On whole pixels, or the paper would shine through between neighbours.
                let corner = |k: usize| {
                    let [x, y] = place(chart, [x[k], y[k]]).map(f64::round);
                    (fine(x) - left, fine(y) - top)
                };
                area.draw(&Rectangle::new([corner(0), corner(1)], colour.filled()))?;
            }
        }
        Ok(())
    }
}

/// Returns the place of a point in the whole drawing, in pixels.
fn place(chart: &Chart<'_>, point: Point) -> [f64; 2] {
    let (x, y) = chart.backend_coord(&(point[0], point[1]));
    [x, y].map(|place| f64::from(place) / f64::from(FINE))
}

/// Converts pixels to the coordinates of `plotters`.
fn fine(pixels: f64) -> i32 {
    (pixels * f64::from(FINE)).round() as i32
}

fn stroke(colour: Colour, width: f64) -> ShapeStyle {
    colour.stroke_width(fine(width) as u32)
}

fn text(size: f64, colour: Colour) -> TextStyle<'static> {
    // The factor from usual sizes of text to those of `plotters`.
    const UNUSUAL: f64 = 1.24;
    let font = ("sans-serif", UNUSUAL * size * f64::from(FINE)).into_font();
    TextStyle {
        color: colour.to_backend_color(),
        ..TextStyle::from(font)
    }
}
