//! Methods in one plane: the number of evaluations each needs, on a logarithmic axis, against its final discrepancy.
//!
//! A marker is the mean over the runs, its cross the 95 % interval of that mean; the name is next to it.

use super::FigureError;
use super::canvas::{Area, Axis, Drawn, LEFT, RIGHT, Scale, marker, page, panel, pixel, pixels, plain_line};
use super::style::{GREY, WIDTH, colour, text};
use crate::framework::experiment::Summary;
use plotters::element::{PathElement, Text};
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Cost and result of one method.
#[derive(Debug, Clone, PartialEq)]
pub struct Method {
    /// Name shown next to the marker.
    pub name: String,
    /// Evaluations per run.
    pub evaluations: Summary,
    /// Discrepancy per run (features' unit).
    pub discrepancy: Summary,
}

/// Height of the figure, px.
const HEIGHT: u32 = 1000;
/// Approximate width of a letter and height of a line, px; the library cannot measure text.
const LETTER: (i32, i32) = (15, 36);
/// Distance from a marker to its name, px.
const GAP: i32 = 22;

/// Draws the figure as SVG; `unit` is the discrepancy's.
///
/// # Errors
/// [`FigureError`] if it cannot be drawn.
pub fn trade_off(title: &str, unit: &str, methods: &[Method]) -> Result<String, FigureError> {
    page(title, (WIDTH, HEIGHT), |area| draw(area, unit, methods))
}

/// Lower end of the 95 % interval, mean, upper end.
fn interval(summary: &Summary) -> [f64; 3] {
    let [low, high] = summary.interval_95.unwrap_or([summary.mean; 2]);
    [low, summary.mean, high]
}

/// Evaluations as decimal logarithms; every run has at least one.
fn logarithms(summary: &Summary) -> [f64; 3] {
    interval(summary).map(|evaluations| evaluations.max(1.0).log10())
}

/// Whole decades around `values`, at least one, with some room for the last tick's label.
fn decades(values: impl Iterator<Item = [f64; 3]>) -> [f64; 2] {
    let widest = |[low, high]: [f64; 2], [l, _, h]: [f64; 3]| [low.min(l), high.max(h)];
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], widest);
    if low.is_finite() && high.is_finite() {
        [low.floor(), high.ceil().max(low.floor() + 1.0) + 0.04]
    } else {
        [0.0, 1.0]
    }
}

fn draw<'b>(area: &Area<'b>, unit: &str, methods: &[Method]) -> Drawn<'b> {
    let range = decades(methods.iter().map(|m| logarithms(&m.evaluations)));
    let label = "evaluations (count, logarithmic)".to_owned();
    let x = Axis { label, range, ticks: 8, decimals: 0, scale: Scale::Log10 };
    let top = methods.iter().map(|m| interval(&m.discrepancy)[2]).fold(f64::MIN_POSITIVE, f64::max) * 1.1;
    let label = format!("discrepancy ({unit})");
    let y = Axis { label, range: [0.0, top], ticks: 7, decimals: usize::from(top < 10.0), scale: Scale::Linear };
    let chart = panel(area, "", &x, &y)?;
    let mut taken: Vec<Frame> = Vec::new();
    for (index, method) in methods.iter().enumerate() {
        let ([left, centre, right], [low, middle, high]) =
            (logarithms(&method.evaluations), interval(&method.discrepancy));
        plain_line(&chart, &[(left, middle), (right, middle)], colour(index), 4)?;
        plain_line(&chart, &[(centre, low), (centre, high)], colour(index), 4)?;
        let at = pixel(area, &chart, (centre, middle));
        marker(area, index, at, 13, false)?;
        taken.push(Frame::around(at));
    }
    for method in methods {
        let at = pixel(area, &chart, (logarithms(&method.evaluations)[1], interval(&method.discrepancy)[1]));
        name(area, at, &method.name, &mut taken)?;
    }
    Ok(())
}

/// A rectangle on the page, px.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Frame {
    left: i32,
    top: i32,
    right: i32,
    bottom: i32,
}

impl Frame {
    fn around((x, y): (i32, i32)) -> Self {
        Self { left: x - 15, top: y - 15, right: x + 15, bottom: y + 15 }
    }

    fn meets(self, other: Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }
}

/// Draws a name where it covers neither a marker nor another name, if there is such a place near its marker. A thin
/// line leads to names that are not directly next to theirs.
fn name<'b>(area: &Area<'b>, at: (i32, i32), name: &str, taken: &mut Vec<Frame>) -> Drawn<'b> {
    let wide = LETTER.0 * i32::try_from(name.chars().count()).unwrap_or(0);
    let frame = place(at, wide, pixels(LEFT)..pixels(WIDTH - RIGHT), taken);
    taken.push(frame);
    let middle = i32::midpoint(frame.top, frame.bottom);
    if middle != at.1 {
        let edge = if middle < at.1 { frame.bottom } else { frame.top };
        let to = (at.0.clamp(frame.left, frame.right), edge);
        area.draw(&PathElement::new(vec![at, to], GREY.stroke_width(2)))?;
    }
    let style = text(32).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new(name.to_owned(), (frame.left, middle), style))
}

/// The nearest free place within `page`: right or left of the marker at `(x, y)`, or else higher or lower.
fn place((x, y): (i32, i32), wide: i32, page: std::ops::Range<i32>, taken: &[Frame]) -> Frame {
    let sides = [x + GAP, x - GAP - wide, x - wide / 2];
    let rises = [0, -LETTER.1, LETTER.1, -2 * LETTER.1, 2 * LETTER.1, -3 * LETTER.1, 3 * LETTER.1];
    let frame = |left: i32, rise: i32| {
        let top = y + rise - LETTER.1 / 2;
        Frame { left, top, right: left + wide, bottom: top + LETTER.1 }
    };
    let free = |frame: &Frame| {
        page.contains(&frame.left) && page.contains(&frame.right) && !taken.iter().any(|other| other.meets(*frame))
    };
    let mut places = rises.iter().flat_map(|rise| sides.map(|left| frame(left, *rise)));
    places.find(free).unwrap_or_else(|| frame(sides[0], 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_hold_their_values() {
        assert_eq!(decades([[1.1, 1.2, 1.3], [2.9, 3.9, 3.95]].into_iter()), [1.0, 4.04]);
        assert_eq!(decades([[2.0; 3]].into_iter()), [2.0, 3.04]);
        assert_eq!(decades(std::iter::empty()), [0.0, 1.0]);
    }

    #[test]
    fn names_keep_apart() {
        let mut taken = vec![Frame::around((500, 500)), Frame::around((510, 505)), Frame::around((505, 490))];
        for _ in 0..3 {
            let frame = place((505, 500), 120, 160..1600, &taken);
            assert!(!taken.iter().any(|other| other.meets(frame)), "{frame:?} {taken:?}");
            taken.push(frame);
        }
        let at_the_edge = place((1580, 500), 120, 160..1600, &[]);
        assert!(at_the_edge.right < 1580);
    }
}
