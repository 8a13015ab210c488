//! Figure 5: where the tool went, goal by goal, beside where it should have been; from above and from the side, both
//! axes of a panel to one scale.

use super::FigureError;
use super::canvas::{Area, Axis, BOTTOM, Drawn, LEFT, LEGEND, RIGHT, Sample, TOP, legend, line, numbered, page, panel};
use super::canvas::{pixel, plain_line, range_of};
use super::style::{HEIGHT, INK, WIDTH};

/// One run.
#[derive(Debug, Clone, PartialEq)]
pub struct Trail {
    /// Method or setting.
    pub name: String,
    /// Tool position after each goal, x y z, mm.
    pub positions_mm: Vec<[f64; 3]>,
}

/// The figure as SVG; `goals_mm` are the goals' x y z in mm.
///
/// # Errors
/// [`FigureError`] if it cannot be drawn.
pub fn trails(title: &str, goals_mm: &[[f64; 3]], trails: &[Trail]) -> Result<String, FigureError> {
    page(title, (WIDTH, HEIGHT), |area| {
        let areas = area.split_evenly((1, 2));
        view(&areas[0], "seen from above", [1, 0], goals_mm, trails)?;
        view(&areas[1], "seen from the robot's right", [0, 2], goals_mm, trails)?;
        let mut entries = vec![(Sample::Numbered, "goals 1 to n".to_owned())];
        entries.extend(trails.iter().enumerate().map(|(index, trail)| (Sample::Series(index), trail.name.clone())));
        legend(&areas[1], LEGEND, &entries)
    })
}

/// Projection on coordinates `[horizontal, vertical]` (0 x, 1 y, 2 z).
fn view<'b>(area: &Area<'b>, title: &str, [h, v]: [usize; 2], goals: &[[f64; 3]], trails: &[Trail]) -> Drawn<'b> {
    let all = || goals.iter().chain(trails.iter().flat_map(|trail| &trail.positions_mm));
    let (width, height) = area.dim_in_pixel();
    let room = [width.saturating_sub(LEFT + RIGHT).max(1), height.saturating_sub(TOP + BOTTOM).max(1)];
    let [across, up] = to_one_scale([range_of(all().map(|p| p[h])), range_of(all().map(|p| p[v]))], room);
    let names = ["x, forward (mm)", "y, to the left (mm)", "z, up (mm)"];
    // Seen from above, the robot's left is at the left: y runs backwards.
    let across = if h == 1 { [across[1], across[0]] } else { across };
    let axis = |coordinate: usize, range| Axis { label: names[coordinate].to_owned(), range, ticks: 7, decimals: 0 };
    let chart = panel(area, title, &axis(h, across), &axis(v, up))?;
    let flat = |positions: &[[f64; 3]]| positions.iter().map(|p| (p[h], p[v])).collect::<Vec<_>>();
    plain_line(&chart, &flat(goals), INK, 3)?;
    for (index, trail) in trails.iter().enumerate() {
        line(area, &chart, index, &flat(&trail.positions_mm))?;
    }
    for (number, goal) in flat(goals).into_iter().enumerate() {
        numbered(area, pixel(area, &chart, goal), number + 1)?;
    }
    Ok(())
}

/// Widens one of the ranges so that a unit is as long on both axes.
fn to_one_scale(ranges: [[f64; 2]; 2], room_px: [u32; 2]) -> [[f64; 2]; 2] {
    let span = |k: usize| ranges[k][1] - ranges[k][0];
    let per_pixel = (span(0) / f64::from(room_px[0])).max(span(1) / f64::from(room_px[1]));
    [0, 1].map(|k| {
        let middle = f64::midpoint(ranges[k][0], ranges[k][1]);
        let half = per_pixel * f64::from(room_px[k]) / 2.0;
        [middle - half, middle + half]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_axes_get_one_scale_and_lose_nothing() {
        let [x, y] = to_one_scale([[0.0, 10.0], [5.0, 6.0]], [100, 50]);
        assert_eq!(x, [0.0, 10.0]);
        assert_eq!(y, [3.0, 8.0]);
    }
}
