//! Figure 7: the wall after each goal, cell by cell, and the reference curve against the achieved one.

use super::FigureError;
use super::canvas::{
    Area, Axis, Drawn, HEADER, LEGEND, Sample, Scale, legend, line, page, panel, pixel, pixels, plain_line, square,
};
use super::style::{GREY, INK, WIDTH, colour, heading, text};
use plotters::element::{Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, RGBColor, WHITE};

/// Progress of a run on a grid of cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Coverage {
    /// Number of rows of the grid, lowest first.
    pub rows: usize,
    /// Number of columns of the grid, the robot's rightmost first.
    pub columns: usize,
    /// For each goal, which cells are done, row-major.
    pub done: Vec<Vec<bool>>,
    /// Painted share of the goals, %.
    pub reference: Vec<f64>,
    /// Painted share reached, %.
    pub achieved: Vec<f64>,
}

/// Number of walls per row of the figure.
const PER_ROW: usize = 6;
/// Height of a row of walls, px.
const WALL_PX: u32 = 300;
/// Height of the curve below, px.
const CURVE_PX: u32 = 560;
/// A cell done at an earlier goal.
const EARLIER: RGBColor = RGBColor(150, 199, 226);

/// Draws the figure as SVG.
///
/// # Errors
/// [`FigureError`] if it cannot be drawn.
pub fn coverage(title: &str, content: &Coverage) -> Result<String, FigureError> {
    // One slot more than there are goals, for the legend.
    let rows = u32::try_from((content.done.len() + 1).div_ceil(PER_ROW)).unwrap_or(1);
    page(title, (WIDTH, HEADER + rows * WALL_PX + CURVE_PX), |area| {
        let (walls, curve) = area.split_vertically(rows * WALL_PX);
        let slots = walls.split_evenly((rows as usize, PER_ROW));
        for (goal, slot) in slots.iter().enumerate().take(content.done.len()) {
            wall(slot, content, goal)?;
        }
        if let Some(slot) = slots.last() {
            let entries = [(colour(0), "this goal"), (EARLIER, "earlier"), (WHITE, "not yet")];
            for (row, (fill, name)) in (0..).zip(entries) {
                let at = (36, 80 + 56 * row);
                cell(slot, at, 34, fill)?;
                let style = text(30).pos(Pos::new(HPos::Left, VPos::Center));
                slot.draw(&Text::new(name, (at.0 + 52, at.1 + 17), style))?;
            }
        }
        against_reference(&curve, content)
    })
}

fn cell<'b>(area: &Area<'b>, (x, y): (i32, i32), size: i32, fill: RGBColor) -> Drawn<'b> {
    area.draw(&Rectangle::new([(x, y), (x + size, y + size)], fill.filled()))?;
    area.draw(&Rectangle::new([(x, y), (x + size, y + size)], INK.stroke_width(2)))
}

fn wall<'b>(area: &Area<'b>, content: &Coverage, goal: usize) -> Drawn<'b> {
    let centre = pixels(area.dim_in_pixel().0) / 2;
    let style = heading(30).pos(Pos::new(HPos::Center, VPos::Top));
    area.draw(&Text::new(format!("goal {}: {} %", goal + 1, content.reference[goal]), (centre, 14), style))?;
    let longest = i32::try_from(content.rows.max(content.columns)).unwrap_or(1).max(1);
    let size = 196 / longest;
    let left = centre - size * i32::try_from(content.columns).unwrap_or(1) / 2;
    for row in 0..content.rows {
        for column in 0..content.columns {
            let index = row * content.columns + column;
            let earlier = goal > 0 && content.done[goal - 1][index];
            let fill = match (content.done[goal][index], earlier) {
                (true, true) => EARLIER,
                (true, false) => colour(0),
                (false, _) => WHITE,
            };
            let place = |k: usize| i32::try_from(k).unwrap_or(0) * size;
            cell(area, (left + place(content.columns - 1 - column), 50 + place(content.rows - 1 - row)), size, fill)?;
        }
    }
    let style = text(28).pos(Pos::new(HPos::Center, VPos::Top));
    area.draw(&Text::new(format!("reached {} %", content.achieved[goal]), (centre, 254), style))
}

fn against_reference<'b>(area: &Area<'b>, content: &Coverage) -> Drawn<'b> {
    let goals = content.reference.len();
    let x = Axis {
        label: "goal".to_owned(),
        range: [0.6, goals as f64 + 0.4],
        ticks: goals.min(17) + 1,
        decimals: 0,
        scale: Scale::Linear,
    };
    let y = Axis { label: "painted (%)".to_owned(), range: [0.0, 104.0], ticks: 6, decimals: 0, scale: Scale::Linear };
    let chart = panel(area, "", &x, &y)?;
    let points = |values: &[f64]| values.iter().enumerate().map(|(g, v)| ((g + 1) as f64, *v)).collect::<Vec<_>>();
    let reference = points(&content.reference);
    plain_line(&chart, &reference, GREY, 5)?;
    reference.iter().try_for_each(|point| square(area, pixel(area, &chart, *point), 9, GREY))?;
    line(area, &chart, 0, &points(&content.achieved))?;
    let entries = [(Sample::Square(GREY), "reference".to_owned()), (Sample::Series(0), "achieved".to_owned())];
    legend(area, LEGEND, &entries)
}
