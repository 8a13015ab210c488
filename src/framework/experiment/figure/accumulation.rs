//! Figures 4, 6, 8, 9, 10: evaluations until each goal is done, mean over the runs with a band of one sd.

use super::FigureError;
use super::canvas::{Area, Axis, Drawn, LEGEND, Sample, legend, line, marker, page, panel, pixel};
use super::style::{HEIGHT, WIDTH, band_colour};
use crate::framework::experiment::Summary;
use plotters::element::Polygon;

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Accumulation {
    /// Method or setting.
    pub name: String,
    /// Cumulative evaluations after goal 1..n.
    pub cumulative: Vec<Summary>,
    /// The published mean after the last goal.
    pub published: Option<f64>,
}

/// Curves that share axes.
#[derive(Debug, Clone, PartialEq)]
pub struct AccumulationPanel {
    /// What they have in common.
    pub title: String,
    /// The curves.
    pub curves: Vec<Accumulation>,
}

/// The figure as SVG, panels side by side.
///
/// # Errors
/// [`FigureError`] if it cannot be drawn.
pub fn accumulation(title: &str, panels: &[AccumulationPanel]) -> Result<String, FigureError> {
    page(title, (WIDTH, HEIGHT), |area| {
        let areas = area.split_evenly((1, panels.len().max(1)));
        panels.iter().zip(&areas).try_for_each(|(panel, area)| draw(area, panel))
    })
}

fn draw<'b>(area: &Area<'b>, content: &AccumulationPanel) -> Drawn<'b> {
    let goals = content.curves.iter().map(|curve| curve.cumulative.len()).max().unwrap_or(1);
    let top = content.curves.iter().flat_map(|curve| {
        let bands = curve.cumulative.iter().map(|s| s.mean + s.sd.unwrap_or(0.0));
        bands.chain(curve.published)
    });
    let top = top.fold(1.0, f64::max) * 1.04;
    let x = Axis { label: "goal".to_owned(), range: [0.6, goals as f64 + 0.4], ticks: goals.min(17) + 1, decimals: 0 };
    let y = Axis { label: "evaluations so far (count)".to_owned(), range: [0.0, top], ticks: 8, decimals: 0 };
    let chart = panel(area, &content.title, &x, &y)?;
    for (index, curve) in content.curves.iter().enumerate() {
        let edge = |sign: f64| {
            let point = move |(goal, s): (usize, &Summary)| ((goal + 1) as f64, s.mean + sign * s.sd.unwrap_or(0.0));
            curve.cumulative.iter().enumerate().map(point).collect::<Vec<_>>()
        };
        let band: Vec<_> = edge(1.0).into_iter().chain(edge(-1.0).into_iter().rev()).collect();
        chart.plotting_area().draw(&Polygon::new(band, band_colour(index)))?;
    }
    let mut entries = Vec::new();
    for (index, curve) in content.curves.iter().enumerate() {
        let mean: Vec<_> = curve.cumulative.iter().enumerate().map(|(goal, s)| ((goal + 1) as f64, s.mean)).collect();
        line(area, &chart, index, &mean)?;
        if let Some(published) = curve.published {
            marker(area, index, pixel(area, &chart, (goals as f64, published)), 15, true)?;
        }
        entries.push((Sample::Series(index), curve.name.clone()));
    }
    if content.curves.iter().any(|curve| curve.published.is_some()) {
        entries.push((Sample::Hollow(6), "published (hollow)".to_owned()));
    }
    legend(area, LEGEND, &entries)
}
