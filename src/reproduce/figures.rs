//! The paper's figures, drawn from the runs of its tables.
//!
//! Figures 5 and 7 show a single run: the one of each cell with the median discrepancy, so that neither luck nor
//! misfortune is drawn.

use super::figure::{
    Accumulation, AccumulationPanel, Coverage, FigureError, Generalization, Trail, accumulation, coverage,
    demonstrations, trails,
};
use super::paper::PaperCell;
use crate::framework::demonstration::{Demonstration, Finding, ReadOptions, Stream, read};
use crate::framework::execution::ProblemError;
use crate::framework::experiment::{Experiment, RunError, RunId, result};
use crate::framework::generalization::{GeneralizeError, GeneralizeSpec, RbfError, RbfSpec, generalize, interpolate};
use crate::framework::robot::{Chain, RobotModel};
use crate::framework::world;

/// The synthetic wax demonstrations of the examples; the paper's own were not published.
const WAX: [(&str, &str); 4] = [
    ("demo-1", include_str!("../../examples/demonstrations/wax/demo-1.csv")),
    ("demo-2", include_str!("../../examples/demonstrations/wax/demo-2.csv")),
    ("demo-3", include_str!("../../examples/demonstrations/wax/demo-3.csv")),
    ("demo-4", include_str!("../../examples/demonstrations/wax/demo-4.csv")),
];

/// T_min that gives the nine goals of the paper's wax, s.
const WAX_T_MIN_S: f64 = 1.0;

/// Number of points of an interpolated curve.
const CURVE_POINTS: usize = 400;

/// Reasons why a figure cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum PaperFigureError {
    /// A shipped demonstration was rejected.
    #[error("figure 2: demonstration {name} is rejected: {findings:?}")]
    Demonstration {
        /// Name of the demonstration.
        name: &'static str,
        /// Findings that reject it.
        findings: Vec<Finding>,
    },
    /// The demonstrations cannot be generalized.
    #[error("figure 2: {0}")]
    Generalize(#[from] GeneralizeError),
    /// The goals cannot be interpolated.
    #[error("figure 2: {0}")]
    Curve(#[from] RbfError),
    /// A run to be shown failed.
    #[error("{0}")]
    Run(#[from] RunError),
    /// The world of a run cannot be rebuilt.
    #[error("{0}")]
    Problem(#[from] Box<ProblemError>),
    /// The drawing failed.
    #[error("{0}")]
    Figure(#[from] FigureError),
    /// A table needed for the figure has no finished run.
    #[error("figure {figure} needs finished runs of table {table}: run the whole experiment")]
    Missing {
        /// Number of the figure.
        figure: u8,
        /// Number of the table.
        table: u8,
    },
}

/// Demonstrations shown in figure 2.
fn wax_demonstrations() -> Result<Vec<Demonstration>, PaperFigureError> {
    let read_one = |(name, text): &(&'static str, &str)| {
        let options = ReadOptions { name: Some((*name).to_owned()), ..ReadOptions::default() };
        let refused = |findings| PaperFigureError::Demonstration { name, findings };
        read(text.as_bytes(), &options).map(|(demonstration, _)| demonstration).map_err(refused)
    };
    WAX.iter().map(read_one).collect()
}

/// Figure 2: `shown` demonstrations in grey and their generalization.
///
/// # Errors
/// [`PaperFigureError`] if they cannot be generalized.
pub fn figure_2(shown: &[Demonstration], spec: &GeneralizeSpec) -> Result<String, PaperFigureError> {
    let generalized = generalize(shown, spec)?;
    let curve = interpolate(&generalized.goals, CURVE_POINTS, &RbfSpec::default())?;
    let (mean_s, n) = (generalized.mean_duration_s, generalized.goals.len());
    // A goal stands for the middle of its bin; the curve runs from the first to the last.
    let first_s = mean_s / (2 * n) as f64;
    let spread = |count: usize, k: usize| {
        let share = if count > 1 { k as f64 / (count - 1) as f64 } else { 0.5 };
        first_s + share * (mean_s - 2.0 * first_s)
    };
    let features = generalized.goals.features().iter().enumerate().map(|(column, feature)| Generalization {
        feature: feature.clone(),
        demonstrations: shown.iter().map(|demonstration| scaled(demonstration, &feature.name, mean_s)).collect(),
        curve: curve.rows().enumerate().map(|(k, row)| (spread(CURVE_POINTS, k), row[column])).collect(),
        goals: generalized.goals.rows().enumerate().map(|(k, row)| (spread(n, k), row[column])).collect(),
    });
    let title = format!("Figure 2. Wax: {} synthetic demonstrations generalized to {n} goals", shown.len());
    Ok(demonstrations(&title, &features.collect::<Vec<_>>())?)
}

/// The samples of one feature, with time scaled to `mean_s`.
fn scaled(demonstration: &Demonstration, feature: &str, mean_s: f64) -> Vec<(f64, f64)> {
    let find = |stream: &&Stream| stream.features().iter().any(|f| f.name == feature);
    let Some(stream) = demonstration.streams.iter().find(find) else { return Vec::new() };
    let column = stream.features().iter().position(|f| f.name == feature).unwrap_or(0);
    let (start_s, stretch) = (stream.time_s()[0], mean_s / stream.duration_s());
    let sample = |k: usize| ((stream.time_s()[k] - start_s) * stretch, stream.row(k)[column]);
    (0..stream.len()).map(sample).collect()
}

/// Figures 2 and 4 to 10 by number, from `experiment`, which ran all six tables. Which tables figures 8, 9 and 10 draw
/// is inferred from the tables.
///
/// # Errors
/// [`PaperFigureError`] if a run cannot be repeated or a figure cannot be drawn.
pub fn figures(experiment: &Experiment, cells: &[PaperCell]) -> Result<Vec<(u8, String)>, PaperFigureError> {
    let curves = |table: u8| panel(experiment, cells, table);
    let what = "evaluations until each goal is done";
    let wax = wax_demonstrations()?;
    let mut drawn = vec![(2, figure_2(&wax, &GeneralizeSpec::new(WAX_T_MIN_S))?)];
    drawn.push((4, accumulation(&format!("Figure 4. Wax: {what}"), &[curves(1)])?));
    drawn.push((5, trail_figure(experiment, cells)?));
    drawn.push((6, accumulation(&format!("Figure 6. Paint: {what}"), &[curves(2)])?));
    drawn.push((7, wall_figure(experiment, cells)?));
    drawn.push((8, accumulation(&format!("Figure 8. Wax in a box: {what}"), &[curves(3)])?));
    drawn.push((9, accumulation(&format!("Figure 9. Wax with limited velocity: {what}"), &[curves(4)])?));
    let title = format!("Figure 10. Paint with constraints: {what}");
    drawn.push((10, accumulation(&title, &[curves(5), curves(6)])?));
    Ok(drawn)
}

fn of_table(cells: &[PaperCell], table: u8) -> impl Iterator<Item = (u32, &PaperCell)> {
    (0u32..).zip(cells).filter(move |(_, cell)| cell.table == table)
}

fn panel(experiment: &Experiment, cells: &[PaperCell], table: u8) -> AccumulationPanel {
    let results = experiment.table();
    let title = match table {
        1 | 2 => "methods",
        3 | 5 => "box, by dilatation",
        _ => "velocity limit in the population (deg)",
    };
    let curve = |(index, cell): (u32, &PaperCell)| Accumulation {
        name: cell.setting.clone(),
        cumulative: results[index as usize].cumulative.clone(),
        raw: Some(cell.raw.evaluations),
    };
    AccumulationPanel { title: title.to_owned(), curves: of_table(cells, table).map(curve).collect() }
}

/// The finished run of a cell with the median discrepancy (the lower of two).
fn median_run(experiment: &Experiment, cell: u32) -> Option<RunId> {
    let mut rows: Vec<_> = experiment.rows_of(cell).filter(|row| !row.invalid).collect();
    rows.sort_by(|a, b| a.discrepancy.total_cmp(&b.discrepancy).then(a.id.cmp(&b.id)));
    rows.get(rows.len().saturating_sub(1) / 2).map(|row| row.id)
}

fn trail_figure(experiment: &Experiment, cells: &[PaperCell]) -> Result<String, PaperFigureError> {
    let point = |row: &[f64]| [row[0], row[1], row[2]];
    let (mut shown, mut goals) = (Vec::new(), Vec::new());
    for (index, cell) in of_table(cells, 1) {
        let Some(id) = median_run(experiment, index) else { continue };
        let run = result(experiment.plan(), id)?;
        let name = format!("{}: {:.0} mm", cell.setting, run.discrepancy);
        shown.push(Trail { name, positions_mm: run.goals.iter().map(|goal| point(&goal.observation)).collect() });
        goals = experiment.plan().cells[index as usize].problem.goals.rows().map(point).collect();
    }
    if shown.is_empty() {
        return Err(PaperFigureError::Missing { figure: 5, table: 1 });
    }
    Ok(trails("Figure 5. Wax: where the tool went (runs of median discrepancy)", &goals, &shown)?)
}

fn rebuild(error: impl Into<ProblemError>) -> PaperFigureError {
    PaperFigureError::Problem(Box::new(error.into()))
}

fn wall_figure(experiment: &Experiment, cells: &[PaperCell]) -> Result<String, PaperFigureError> {
    let missing = PaperFigureError::Missing { figure: 7, table: 2 };
    let Some((index, cell)) = of_table(cells, 2).next() else { return Err(missing) };
    let Some(id) = median_run(experiment, index) else { return Err(missing) };
    let run = result(experiment.plan(), id)?;
    let problem = &experiment.plan().cells[index as usize].problem;
    let Some(wall) = problem.world.properties().surface else { return Err(missing) };
    let chain = Chain::new(&RobotModel::from_urdf(&problem.urdf).map_err(rebuild)?, &problem.robot).map_err(rebuild)?;
    let mut world = world::build(&problem.world, &chain).map_err(rebuild)?;
    let (rows, columns) = (wall.rows, wall.columns);
    let mut observation = [0.0];
    let (mut done, mut achieved) = (Vec::new(), Vec::new());
    for goal in &run.goals {
        world.commit(&goal.joints, &mut observation);
        achieved.push(observation[0]);
        let painted = |cell| world.cells().is_some_and(|cells| cells.contains(cell));
        done.push((0..rows * columns).map(painted).collect());
    }
    let reference = problem.goals.rows().map(|row| row[0]).collect();
    let title = format!("Figure 7. Paint, {}: the wall goal by goal (run of median discrepancy)", cell.setting);
    Ok(coverage(&title, &Coverage { rows, columns, done, reference, achieved })?)
}
