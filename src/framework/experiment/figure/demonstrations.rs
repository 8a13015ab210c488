//! Figure 2: demonstrations in grey, the generalized curve through its goals.

use super::FigureError;
use super::canvas::{Axis, LEGEND, Sample, legend, marker, page, panel, pixel, plain_line, range_of};
use super::style::{GREY, HEIGHT, WIDTH, colour};
use crate::framework::Feature;

/// One feature over time; all times in s on the mean demonstration's scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Generalization {
    /// What is shown.
    pub feature: Feature,
    /// Each demonstration's samples: time (s), value (feature's unit).
    pub demonstrations: Vec<Vec<(f64, f64)>>,
    /// The interpolated curve.
    pub curve: Vec<(f64, f64)>,
    /// The goals.
    pub goals: Vec<(f64, f64)>,
}

/// The figure as SVG, features side by side.
///
/// # Errors
/// [`FigureError`] if it cannot be drawn.
pub fn demonstrations(title: &str, features: &[Generalization]) -> Result<String, FigureError> {
    page(title, (WIDTH, HEIGHT), |area| {
        let areas = area.split_evenly((1, features.len().max(1)));
        for (content, area) in features.iter().zip(&areas) {
            let all = || content.demonstrations.iter().flatten().chain(&content.curve).chain(&content.goals);
            let unit = if content.feature.unit.is_empty() { "1" } else { &content.feature.unit };
            let x = Axis {
                label: "time, scaled to the mean demonstration (s)".to_owned(),
                range: range_of(all().map(|point| point.0)),
                ticks: 8,
                decimals: 0,
            };
            let label = format!("{} ({unit})", content.feature.name);
            let y = Axis { label, range: range_of(all().map(|point| point.1)), ticks: 8, decimals: 0 };
            let chart = panel(area, "", &x, &y)?;
            for demonstration in &content.demonstrations {
                plain_line(&chart, demonstration, GREY, 3)?;
            }
            plain_line(&chart, &content.curve, colour(0), 6)?;
            for goal in &content.goals {
                marker(area, 1, pixel(area, &chart, *goal), 11, false)?;
            }
            let entries = [
                (Sample::Line(GREY), format!("{} demonstrations", content.demonstrations.len())),
                (Sample::Line(colour(0)), "generalized (radial basis functions)".to_owned()),
                (Sample::Marker(1), format!("{} goals", content.goals.len())),
            ];
            legend(area, LEGEND, &entries)?;
        }
        Ok(())
    })
}
