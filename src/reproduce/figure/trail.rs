//! Figure 5: positions of the tool, goal by goal, next to the goals; one row per run, seen from above and from the
//! side, both axes of a panel to one scale.

use super::FigureError;
use super::canvas::{Area, Axis, BOTTOM, Drawn, HEADER, LEFT, RIGHT, STRIP, Sample, Scale, TOP};
use super::canvas::{Chart, label, legend_row, line, page, panel, pixel, plain_line, range_of, ring};
use super::style::{GREY, INK, WIDTH};

/// One run of the figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Trail {
    /// Method or setting.
    pub name: String,
    /// Tool position after each goal: x, y, z, mm.
    pub positions_mm: Vec<[f64; 3]>,
}

/// Height of one run's panels, px.
const ROW_PX: u32 = 660;
/// Goals closer than this share a label, px.
const TOGETHER_PX: i32 = 40;

/// Draws the figure as SVG; `goals_mm` are the goals' x, y, z in mm.
///
/// # Errors
/// [`FigureError`] if it cannot be drawn.
pub fn trails(title: &str, goals_mm: &[[f64; 3]], trails: &[Trail]) -> Result<String, FigureError> {
    let count = u32::try_from(trails.len().max(1)).unwrap_or(1);
    page(title, (WIDTH, HEADER + STRIP + count * ROW_PX), |area| {
        let (strip, rows) = area.split_vertically(STRIP);
        let entries = [
            (Sample::Numbered, "goals".to_owned()),
            (Sample::Series(0), "tool".to_owned()),
            (Sample::Line(GREY), "how far the tool stayed from its goal".to_owned()),
        ];
        legend_row(&strip, &entries)?;
        let rows = rows.split_evenly((trails.len().max(1), 1));
        for (index, (trail, row)) in trails.iter().zip(&rows).enumerate() {
            let views = row.split_evenly((1, 2));
            view(&views[0], &format!("{}, from above", trail.name), [1, 0], goals_mm, trails, index)?;
            view(&views[1], "from the robot's right", [0, 2], goals_mm, trails, index)?;
        }
        Ok(())
    })
}

/// Projection of trail `index` onto coordinates `[horizontal, vertical]` (0 x, 1 y, 2 z); the axes cover all trails.
fn view<'b>(
    area: &Area<'b>,
    title: &str,
    [h, v]: [usize; 2],
    goals: &[[f64; 3]],
    trails: &[Trail],
    index: usize,
) -> Drawn<'b> {
    let all = || goals.iter().chain(trails.iter().flat_map(|trail| &trail.positions_mm));
    let (width, height) = area.dim_in_pixel();
    let room = [width.saturating_sub(LEFT + RIGHT).max(1), height.saturating_sub(TOP + BOTTOM).max(1)];
    let [across, up] = to_one_scale([range_of(all().map(|p| p[h])), range_of(all().map(|p| p[v]))], room);
    let names = ["x, forward (mm)", "y, to the left (mm)", "z, up (mm)"];
    // Seen from above, the robot's left is on the left: y runs backwards.
    let across = if h == 1 { [across[1], across[0]] } else { across };
    let axis = |coordinate: usize, range| Axis {
        label: names[coordinate].to_owned(),
        range,
        ticks: 6,
        decimals: 0,
        scale: Scale::Linear,
    };
    let chart = panel(area, title, &axis(h, across), &axis(v, up))?;
    let flat = |positions: &[[f64; 3]]| positions.iter().map(|p| (p[h], p[v])).collect::<Vec<_>>();
    let (goals, reached) = (flat(goals), flat(&trails[index].positions_mm));
    for (goal, tool) in goals.iter().zip(&reached) {
        plain_line(&chart, &[*goal, *tool], GREY, 3)?;
    }
    line(area, &chart, index, &reached)?;
    number_goals(area, &chart, &goals)
}

/// Draws a ring at every goal, and numbers, with one label for goals that lie together.
fn number_goals<'b>(area: &Area<'b>, chart: &Chart<'_, 'b>, goals: &[(f64, f64)]) -> Drawn<'b> {
    let places: Vec<(i32, i32)> = goals.iter().map(|goal| pixel(area, chart, *goal)).collect();
    places.iter().try_for_each(|place| ring(area, *place, 9, INK))?;
    for (place, members) in together(&places, TOGETHER_PX) {
        let numbers: Vec<String> = members.iter().map(|goal| (goal + 1).to_string()).collect();
        label(area, (place.0, place.1 - 30), &numbers.join(" "))?;
    }
    Ok(())
}

/// Groups places closer than `within` to the first of a group; returns that first place with the indices.
fn together(places: &[(i32, i32)], within: i32) -> Vec<((i32, i32), Vec<usize>)> {
    let mut groups: Vec<((i32, i32), Vec<usize>)> = Vec::new();
    for (index, place) in places.iter().enumerate() {
        let near = |(first, _): &&mut ((i32, i32), Vec<usize>)| {
            (first.0 - place.0).abs() < within && (first.1 - place.1).abs() < within
        };
        match groups.iter_mut().find(near) {
            Some((_, members)) => members.push(index),
            None => groups.push((*place, vec![index])),
        }
    }
    groups
}

/// Widens one of the ranges so that both axes have the same scale.
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

    #[test]
    fn goals_that_lie_together_share_a_label() {
        let groups = together(&[(0, 0), (100, 0), (5, 39), (0, 40)], 40);
        assert_eq!(groups, [((0, 0), vec![0, 2]), ((100, 0), vec![1]), ((0, 40), vec![3])]);
    }
}
