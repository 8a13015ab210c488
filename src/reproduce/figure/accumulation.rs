//! Figures 4, 6, 8, 9, 10: mean evaluations until each goal is done; next to the last goal, the spread of the runs and
//! the mean of the raw logs.

use super::FigureError;
use super::canvas::{Area, Axis, Drawn, HEADER, LEGEND, Sample, Scale, legend, marker, page, panel, pixel, plain_line};
use super::style::{WIDTH, colour};
use crate::framework::experiment::Summary;

/// One curve of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Accumulation {
    /// Method or setting.
    pub name: String,
    /// Cumulative evaluations after goal 1..n.
    pub cumulative: Vec<Summary>,
    /// Mean of the raw logs after the last goal; `None` if unknown.
    pub raw: Option<f64>,
}

/// Curves that share axes.
#[derive(Debug, Clone, PartialEq)]
pub struct AccumulationPanel {
    /// Title of the panel.
    pub title: String,
    /// Curves of the panel.
    pub curves: Vec<Accumulation>,
}

/// Height of one panel, px.
const PANEL_PX: u32 = 860;
/// Extra width of the goal axis for the spreads next to the last goal, relative to its length.
const BESIDE: f64 = 0.3;

/// Draws the figure as SVG, one panel below the other.
///
/// # Errors
/// [`FigureError`] if it cannot be drawn.
pub fn accumulation(title: &str, panels: &[AccumulationPanel]) -> Result<String, FigureError> {
    let count = u32::try_from(panels.len().max(1)).unwrap_or(1);
    page(title, (WIDTH, HEADER + count * PANEL_PX), |area| {
        let areas = area.split_evenly((panels.len().max(1), 1));
        panels.iter().zip(&areas).try_for_each(|(panel, area)| draw(area, panel))
    })
}

fn draw<'b>(area: &Area<'b>, content: &AccumulationPanel) -> Drawn<'b> {
    let curves = &content.curves;
    let goals = curves.iter().map(|curve| curve.cumulative.len()).max().unwrap_or(1);
    let last = |curve: &Accumulation| curve.cumulative.last().map(|s| (s.mean, s.sd.unwrap_or(0.0)));
    let tops = curves.iter().flat_map(|curve| [last(curve).map(|(mean, sd)| mean + sd), curve.raw]);
    let top = tops.flatten().fold(1.0, f64::max) * 1.04;
    let beside = BESIDE * goals as f64;
    let x = Axis {
        label: "goal".to_owned(),
        range: [0.6, goals as f64 + beside],
        ticks: goals + 8,
        decimals: 0,
        scale: Scale::UpTo(goals as f64),
    };
    let y = Axis {
        label: "evaluations so far (count)".to_owned(),
        range: [0.0, top],
        ticks: 8,
        decimals: 0,
        scale: Scale::Linear,
    };
    let chart = panel(area, &content.title, &x, &y)?;
    let mut entries = Vec::new();
    for (index, curve) in curves.iter().enumerate() {
        // Earlier curves are drawn below later ones and larger, so that coinciding curves can be distinguished.
        let size = 10 + 2 * i32::try_from(curves.len() - 1 - index).unwrap_or(0);
        let points: Vec<_> = curve.cumulative.iter().enumerate().map(|(g, s)| ((g + 1) as f64, s.mean)).collect();
        plain_line(&chart, &points, colour(index), size.unsigned_abs() / 2)?;
        points.iter().try_for_each(|point| marker(area, index, pixel(area, &chart, *point), size, false))?;
        entries.push((Sample::Series(index), curve.name.clone()));
    }
    for (index, curve) in curves.iter().enumerate() {
        let column = goals as f64 + beside * (index as f64 + 1.0) / (curves.len() as f64 + 0.7);
        if let Some((mean, sd)) = last(curve) {
            plain_line(&chart, &[(column, mean - sd), (column, mean + sd)], colour(index), 5)?;
            marker(area, index, pixel(area, &chart, (column, mean)), 12, false)?;
        }
        if let Some(raw) = curve.raw {
            let shifted = column + 0.3 * beside / (curves.len() as f64 + 0.7);
            marker(area, index, pixel(area, &chart, (shifted, raw)), 13, true)?;
        }
    }
    entries.push((Sample::Spread, "after the last goal: mean \u{b1} sd".to_owned()));
    if curves.iter().any(|curve| curve.raw.is_some()) {
        entries.push((Sample::Hollow(6), "mean of the authors' raw logs".to_owned()));
    }
    legend(area, LEGEND, &entries)
}
