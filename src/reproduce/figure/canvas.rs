//! Building blocks of figures: page, panel with labelled axes, markers, lines with markers, legend.

use super::FigureError;
use super::style::{GRID, INK, colour, heading, text};
use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, PathElement, Polygon, Rectangle, Text};
use plotters::prelude::{Cartesian2d, DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, RGBColor, WHITE};

pub(super) type Area<'b> = DrawingArea<SVGBackend<'b>, Shift>;
pub(super) type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
pub(super) type Drawn<'b, T = ()> = Result<T, DrawingAreaErrorKind<<SVGBackend<'b> as DrawingBackend>::ErrorType>>;

/// One axis: label with unit, range, approximate number of ticks, decimals of the tick labels.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    pub label: String,
    pub range: [f64; 2],
    pub ticks: usize,
    pub decimals: usize,
    pub scale: Scale,
}

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scale {
    Linear,
    /// Linear; ticks beyond this value have no label.
    UpTo(f64),
    /// The chart contains decimal logarithms; whole decades are labelled.
    Log10,
}

impl Axis {
    fn tick(&self, value: f64) -> String {
        match self.scale {
            Scale::Linear => number(value, self.decimals),
            Scale::UpTo(last) if value <= last => number(value, self.decimals),
            Scale::Log10 if (value - value.round()).abs() < 1e-9 => number(10_f64.powf(value.round()), self.decimals),
            Scale::UpTo(_) | Scale::Log10 => String::new(),
        }
    }
}

/// Creates an SVG of `size` px whose `title` is visible and accessible; `draw` fills the page below the title.
pub(super) fn page(
    title: &str,
    size: (u32, u32),
    draw: impl for<'b> FnOnce(&Area<'b>) -> Drawn<'b>,
) -> Result<String, FigureError> {
    let mut svg = String::new();
    let drawn = {
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        let fill = |root: &Area<'_>| {
            root.fill(&WHITE)?;
            let style = heading(40).pos(Pos::new(HPos::Center, VPos::Top));
            root.draw(&Text::new(title.to_owned(), (pixels(size.0) / 2, 24), style))?;
            draw(&root.split_vertically(HEADER).1)?;
            root.present()
        };
        fill(&root).map_err(|source| source.to_string())
    };
    drawn.map_err(|message| FigureError::Drawing { title: title.to_owned(), message })?;
    Ok(svg.replacen(">\n", &format!(" role=\"img\">\n<title>{}</title>\n", escape(title)), 1))
}

fn escape(title: &str) -> String {
    title.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Height of the title, px.
pub(super) const HEADER: u32 = 76;

/// Margin around a panel for its tick labels and axis names, px.
pub(super) const LEFT: u32 = 160;
pub(super) const BOTTOM: u32 = 112;
pub(super) const TOP: u32 = 60;
/// Part of `LEFT` and `BOTTOM` that stays blank at the page's edge.
const EDGE: u32 = 16;
/// Origin of a legend in a panel's upper left corner, px.
pub(super) const LEGEND: (i32, i32) = (192, 96);
pub(super) const RIGHT: u32 = 30;

/// Draws axes with a grid on `area`.
pub(super) fn panel<'a, 'b>(area: &'a Area<'b>, title: &str, x: &Axis, y: &Axis) -> Drawn<'b, Chart<'a, 'b>> {
    let mut chart = ChartBuilder::on(area)
        .margin_top(TOP)
        .margin_right(RIGHT)
        .margin_left(EDGE)
        .margin_bottom(EDGE)
        .x_label_area_size(BOTTOM - EDGE)
        .y_label_area_size(LEFT - EDGE)
        .build_cartesian_2d(x.range[0]..x.range[1], y.range[0]..y.range[1])?;
    chart
        .configure_mesh()
        .x_labels(x.ticks)
        .y_labels(y.ticks)
        .max_light_lines(0)
        .bold_line_style(GRID.stroke_width(2))
        .axis_style(INK.stroke_width(2))
        .label_style(text(30))
        .axis_desc_style(text(34))
        .x_desc(&x.label)
        .y_desc(&y.label)
        .x_label_formatter(&|value| x.tick(*value))
        .y_label_formatter(&|value| y.tick(*value))
        .draw()?;
    let style = heading(34).pos(Pos::new(HPos::Left, VPos::Top));
    area.draw(&Text::new(title.to_owned(), (pixels(LEFT), 14), style))?;
    Ok(chart)
}

/// Formats `value` with thin spaces between groups of three digits and a true minus sign.
fn number(value: f64, decimals: usize) -> String {
    let plain = format!("{:.decimals$}", value.abs());
    let (whole, fraction) = plain.split_once('.').map_or((plain.as_str(), None), |(w, f)| (w, Some(f)));
    let mut grouped = String::new();
    for (index, digit) in whole.chars().enumerate() {
        if index > 0 && (whole.len() - index).is_multiple_of(3) {
            grouped.push('\u{202f}');
        }
        grouped.push(digit);
    }
    let sign = if value < 0.0 && plain.chars().any(|c| ('1'..='9').contains(&c)) { "\u{2212}" } else { "" };
    fraction.map_or_else(|| format!("{sign}{grouped}"), |fraction| format!("{sign}{grouped}.{fraction}"))
}

pub(super) fn pixels(value: u32) -> i32 {
    i32::try_from(value).unwrap_or(i32::MAX)
}

/// Corners of the marker of series `index` around the origin, px; `None` for the circle.
fn corners(index: usize, size: i32) -> Option<Vec<(i32, i32)>> {
    let (s, t) = (size, size * 9 / 10);
    Some(match index % 7 {
        0 => return None,
        1 => vec![(-t, -t), (t, -t), (t, t), (-t, t)],
        2 => vec![(0, -s - 2), (s + 1, t), (-s - 1, t)],
        3 => vec![(0, -s - 3), (s + 3, 0), (0, s + 3), (-s - 3, 0)],
        4 => vec![(0, s + 2), (s + 1, -t), (-s - 1, -t)],
        5 => vec![(-s - 2, 0), (t, -s - 1), (t, s + 1)],
        _ => vec![(s + 2, 0), (-t, -s - 1), (-t, s + 1)],
    })
}

/// Draws the marker of series `index` at a pixel; hollow markers are outlines.
pub(super) fn marker<'b>(area: &Area<'b>, index: usize, at: (i32, i32), size: i32, hollow: bool) -> Drawn<'b> {
    let ink = colour(index);
    match (corners(index, size), hollow) {
        (None, true) => area.draw(&Circle::new(at, size, ink.stroke_width(4))),
        (None, false) => area.draw(&Circle::new(at, size, ink.filled())),
        (Some(corners), hollow) => {
            let mut around: Vec<_> = corners.iter().map(|(x, y)| (at.0 + x, at.1 + y)).collect();
            if hollow {
                around.extend_from_within(..2);
                area.draw(&PathElement::new(around, ink.stroke_width(4)))
            } else {
                area.draw(&Polygon::new(around, ink.filled()))
            }
        }
    }
}

/// Draws a line of series `index` through `points`, with its marker at each.
pub(super) fn line<'b>(area: &Area<'b>, chart: &Chart<'_, 'b>, index: usize, points: &[(f64, f64)]) -> Drawn<'b> {
    plain_line(chart, points, colour(index), 5)?;
    points.iter().try_for_each(|point| marker(area, index, pixel(area, chart, *point), 10, false))
}

/// Draws a line without markers.
pub(super) fn plain_line<'b>(chart: &Chart<'_, 'b>, points: &[(f64, f64)], ink: RGBColor, width: u32) -> Drawn<'b> {
    chart.plotting_area().draw(&PathElement::new(points.to_vec(), ink.stroke_width(width)))
}

/// Draws a filled square.
pub(super) fn square<'b>(area: &Area<'b>, (x, y): (i32, i32), half: i32, ink: RGBColor) -> Drawn<'b> {
    area.draw(&Rectangle::new([(x - half, y - half), (x + half, y + half)], ink.filled()))
}

/// Draws a ring with a white interior.
pub(super) fn ring<'b>(area: &Area<'b>, at: (i32, i32), radius: i32, ink: RGBColor) -> Drawn<'b> {
    area.draw(&Circle::new(at, radius, WHITE.mix(0.85).filled()))?;
    area.draw(&Circle::new(at, radius, ink.stroke_width(4)))
}

/// Draws a short text centred on a point.
pub(super) fn label<'b>(area: &Area<'b>, at: (i32, i32), words: &str) -> Drawn<'b> {
    area.draw(&Text::new(words.to_owned(), at, heading(26).pos(Pos::new(HPos::Center, VPos::Center))))
}

/// Pixel on `area` of a point of the chart.
pub(super) fn pixel(area: &Area<'_>, chart: &Chart<'_, '_>, point: (f64, f64)) -> (i32, i32) {
    let on_page = chart.backend_coord(&point);
    let (x, y) = area.get_base_pixel();
    (on_page.0 - x, on_page.1 - y)
}

/// Symbol of a legend entry.
#[derive(Debug, Clone, Copy)]
pub(super) enum Sample {
    /// The line and marker of a series.
    Series(usize),
    /// A hollow marker of a series.
    Hollow(usize),
    /// A plain line.
    Line(RGBColor),
    /// The marker of a series alone.
    Marker(usize),
    /// A plain line with squares.
    Square(RGBColor),
    /// A ring with its number.
    Numbered,
    /// A mean with its spread.
    Spread,
}

/// Draws entries one below the other, the first at `at` (px on `area`).
pub(super) fn legend<'b>(area: &Area<'b>, at: (i32, i32), entries: &[(Sample, String)]) -> Drawn<'b> {
    let far = entries.iter().map(|(_, name)| entry_width(name)).max().unwrap_or(0);
    let low = at.1 + 44 * i32::try_from(entries.len()).unwrap_or(0) - 20;
    area.draw(&Rectangle::new([(at.0 - 14, at.1 - 24), (at.0 + far, low)], WHITE.mix(0.8).filled()))?;
    for (row, (sample, name)) in (0..).zip(entries) {
        entry(area, (at.0, at.1 + row * 44), *sample, name)?;
    }
    Ok(())
}

/// Height of a [`legend_row`], px.
pub(super) const STRIP: u32 = 56;

/// Draws entries side by side on a strip of their own.
pub(super) fn legend_row<'b>(area: &Area<'b>, entries: &[(Sample, String)]) -> Drawn<'b> {
    let mut x = pixels(LEFT);
    for (sample, name) in entries {
        entry(area, (x, pixels(STRIP) / 2), *sample, name)?;
        x += entry_width(name) + 40;
    }
    Ok(())
}

/// Approximate width of an entry, px; the library cannot measure text.
fn entry_width(name: &str) -> i32 {
    i32::try_from(78 + 16 * name.chars().count()).unwrap_or(0)
}

fn entry<'b>(area: &Area<'b>, (x, y): (i32, i32), sample: Sample, name: &str) -> Drawn<'b> {
    let stroke = |ink: RGBColor| PathElement::new(vec![(x, y), (x + 60, y)], ink.stroke_width(5));
    match sample {
        Sample::Series(index) => {
            area.draw(&stroke(colour(index)))?;
            marker(area, index, (x + 30, y), 10, false)?;
        }
        Sample::Hollow(index) => marker(area, index, (x + 30, y), 13, true)?,
        Sample::Line(ink) => area.draw(&stroke(ink))?,
        Sample::Marker(index) => marker(area, index, (x + 30, y), 11, false)?,
        Sample::Square(ink) => {
            area.draw(&stroke(ink))?;
            square(area, (x + 30, y), 9, ink)?;
        }
        Sample::Numbered => {
            ring(area, (x + 44, y), 9, INK)?;
            label(area, (x + 18, y), "1")?;
        }
        Sample::Spread => {
            area.draw(&PathElement::new(vec![(x + 30, y - 20), (x + 30, y + 20)], INK.stroke_width(5)))?;
            area.draw(&Circle::new((x + 30, y), 10, INK.filled()))?;
        }
    }
    let style = text(32).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new(name.to_owned(), (x + 78, y), style))
}

/// A range slightly wider than `values`; [0, 1] if there are none.
pub(super) fn range_of(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for value in values {
        range = [range[0].min(value), range[1].max(value)];
    }
    if !(range[0].is_finite() && range[1].is_finite()) {
        return [0.0, 1.0];
    }
    let margin = if range[1] > range[0] { (range[1] - range[0]) * 0.05 } else { 0.5 };
    [range[0] - margin, range[1] + margin]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(12345.0, 0, "12\u{202f}345")]
    #[case(-0.04, 1, "0.0")]
    #[case(-1234.5, 1, "\u{2212}1\u{202f}234.5")]
    #[case(999.0, 0, "999")]
    fn numbers_are_legible(#[case] value: f64, #[case] decimals: usize, #[case] shown: &str) {
        assert_eq!(number(value, decimals), shown);
    }

    #[test]
    fn a_logarithmic_axis_labels_its_decades() {
        let range = [0.0, 4.0];
        let axis = Axis { label: String::new(), range, ticks: 5, decimals: 0, scale: Scale::Log10 };
        assert_eq!([0.0, 0.5, 3.0].map(|v| axis.tick(v)), ["1", "", "1\u{202f}000"]);
        let axis = Axis { scale: Scale::UpTo(2.0), ..axis };
        assert_eq!([2.0, 3.0].map(|v| axis.tick(v)), ["2", ""]);
    }

    #[test]
    fn ranges_hold_their_values() {
        assert_eq!(range_of([]), [0.0, 1.0]);
        assert_eq!(range_of([3.0]), [2.5, 3.5]);
        assert_eq!(range_of([0.0, 10.0]), [-0.5, 10.5]);
    }
}
