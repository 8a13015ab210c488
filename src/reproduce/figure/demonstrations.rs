//! Figure 2: demonstrations in grey, and the generalized curve through its goals.

use super::FigureError;
use super::canvas::range_of;
use super::canvas::{
    Area, Axis, Drawn, HEADER, STRIP, Sample, Scale, legend_row, marker, page, panel, pixel, plain_line,
};
use super::style::{GREY, WIDTH, colour};
use crate::framework::Feature;

/// One feature over time; all times in s, scaled to the mean demonstration.
#[derive(Debug, Clone, PartialEq)]
pub struct Generalization {
    /// Feature shown.
    pub feature: Feature,
    /// Samples of each demonstration: time (s), value (feature's unit).
    pub demonstrations: Vec<Vec<(f64, f64)>>,
    /// Points of the interpolated curve: time (s), value (feature's unit).
    pub curve: Vec<(f64, f64)>,
    /// Goals: time (s), value (feature's unit).
    pub goals: Vec<(f64, f64)>,
}

/// Height of one feature's panel, px.
const PANEL_PX: u32 = 520;

/// Draws the figure as SVG, one feature below the other.
///
/// # Errors
/// [`FigureError`] if it cannot be drawn.
pub fn demonstrations(title: &str, features: &[Generalization]) -> Result<String, FigureError> {
    let count = u32::try_from(features.len().max(1)).unwrap_or(1);
    page(title, (WIDTH, HEADER + STRIP + count * PANEL_PX), |area| {
        let (strip, panels) = area.split_vertically(STRIP);
        if let Some(first) = features.first() {
            let entries = [
                (Sample::Line(GREY), format!("{} demonstrations", first.demonstrations.len())),
                (Sample::Line(colour(0)), "generalized (radial basis functions)".to_owned()),
                (Sample::Marker(1), format!("{} goals", first.goals.len())),
            ];
            legend_row(&strip, &entries)?;
        }
        let areas = panels.split_evenly((features.len().max(1), 1));
        features.iter().zip(&areas).try_for_each(|(content, area)| draw(area, content))
    })
}

fn draw<'b>(area: &Area<'b>, content: &Generalization) -> Drawn<'b> {
    let all = || content.demonstrations.iter().flatten().chain(&content.curve).chain(&content.goals);
    let unit = if content.feature.unit.is_empty() { "1" } else { &content.feature.unit };
    let x = Axis {
        label: "time, scaled to the mean demonstration (s)".to_owned(),
        range: range_of(all().map(|point| point.0)),
        ticks: 10,
        decimals: 0,
        scale: Scale::Linear,
    };
    let label = format!("{} ({unit})", content.feature.name);
    let y = Axis { label, range: range_of(all().map(|point| point.1)), ticks: 5, decimals: 0, scale: Scale::Linear };
    let chart = panel(area, "", &x, &y)?;
    for demonstration in &content.demonstrations {
        plain_line(&chart, demonstration, GREY, 3)?;
    }
    plain_line(&chart, &content.curve, colour(0), 5)?;
    content.goals.iter().try_for_each(|goal| marker(area, 1, pixel(area, &chart, *goal), 10, false))
}
