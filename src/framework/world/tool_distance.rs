//! The tool-distance world: the observation is the distance of the tool from a point, independent of earlier poses. It
//! suits actions that approach something, keep clear of it or circle around it, whatever the direction.

use super::{ToolDistanceSpec, World, WorldError, tool_position};
use crate::Feature;
use crate::range::Range;
use crate::robot::{Chain, tool_position as position};
use nalgebra::Vector3;

/// Largest coordinate of the point, metres.
const MAX_LENGTH_M: f64 = 1e4;

/// Feature `distance`, |p_BT - p| in the chosen unit.
#[derive(Debug, Clone)]
pub(super) struct ToolDistance {
    chain: Chain,
    features: [Feature; 1],
    point_m: Vector3<f64>,
    scale: f64,
}

/// Feature of a tool-distance world.
///
/// # Errors
/// [`WorldError`] for a unit that is not a length and a point that is not finite or implausibly far.
pub(super) fn features(spec: &ToolDistanceSpec) -> Result<[Feature; 1], WorldError> {
    tool_position::scale(&spec.unit)?;
    Range::from(-MAX_LENGTH_M..=MAX_LENGTH_M).check_each("point_m", Some("m"), &spec.point_m)?;
    Ok([Feature::new("distance", spec.unit.as_str())])
}

impl ToolDistance {
    pub(super) fn new(spec: &ToolDistanceSpec, chain: &Chain) -> Result<Self, WorldError> {
        Ok(Self {
            chain: chain.clone(),
            features: features(spec)?,
            point_m: Vector3::from(spec.point_m),
            scale: tool_position::scale(&spec.unit)?,
        })
    }
}

impl World for ToolDistance {
    fn features(&self) -> &[Feature] {
        &self.features
    }

    fn reset(&mut self) {}

    fn observe(&mut self, joints: &[f64], observation: &mut [f64]) {
        observation[0] = (position(&self.chain, joints) - self.point_m).norm() * self.scale;
    }

    fn commit(&mut self, joints: &[f64], observation: &mut [f64]) {
        self.observe(joints, observation);
    }
}

#[cfg(test)]
mod tests {
    use crate::Feature;
    use crate::execution::{Problem, run};
    use crate::generalization::Goals;
    use crate::preset::shipped;
    use crate::world::{WorldSpec, build, features};
    use proptest::prelude::*;
    use rstest::rstest;

    const SHIPPED: &str = "kind = \"tool_distance\"\npoint_m = [0.6, -0.5, 0.62]\nunit = \"mm\"\n";

    fn world(text: &str) -> WorldSpec {
        toml::from_str(text).unwrap()
    }

    fn problem() -> Problem {
        let mut problem = shipped("wax").unwrap().problem;
        problem.world = world(SHIPPED);
        problem
    }

    proptest! {
        /// Compared with the tool-position world: the distance between its observation and the point.
        #[test]
        fn it_is_the_length_of_the_way_to_the_point(joints in prop::array::uniform3(-0.26..1.74_f64)) {
            let chain = crate::execution::Iet::new(&shipped("wax").unwrap().problem, 1).unwrap().chain().clone();
            let (mut place, mut distance) = ([0.0; 3], [0.0]);
            build(&world("kind = \"tool_position\"\nunit = \"mm\""), &chain).unwrap().observe(&joints, &mut place);
            build(&world(SHIPPED), &chain).unwrap().observe(&joints, &mut distance);
            let squares = place.iter().zip([600.0, -500.0, 620.0]).map(|(p, q)| (p - q) * (p - q));
            prop_assert!((squares.sum::<f64>().sqrt() - distance[0]).abs() < 1e-9);
        }
    }

    /// Goals ten centimetres apart, which every method for smooth worlds reaches.
    #[rstest]
    #[case("model")]
    #[case("broyden")]
    #[case("cma_es")]
    fn a_tool_comes_nearer(#[case] method: &str) {
        let mut problem = problem();
        problem.goals =
            Goals::new(vec![Feature::new("distance", "mm")], &[vec![600.0], vec![500.0], vec![400.0]]).unwrap();
        let mut preset = shipped("wax").unwrap();
        assert!(preset.select_method(method));
        problem.execution.method = preset.problem.execution.method;
        let result = run(&problem, 1).unwrap();
        assert!(result.discrepancy < 30.0, "{method}: {} mm", result.discrepancy);
    }

    #[rstest]
    #[case("mm", "inf", "point_m is inf: give -10000 to 10000 m")]
    #[case("mm", "1e9", "point_m is 1000000000")]
    #[case("cm", "0.5", "unit is \"cm\"")]
    fn refuses(#[case] unit: &str, #[case] x: &str, #[case] told: &str) {
        let spec = world(&format!("kind = \"tool_distance\"\npoint_m = [{x}, 0.0, 0.0]\nunit = \"{unit}\""));
        let error = features(&spec).unwrap_err().to_string();
        assert!(error.contains(told), "{error}");
    }
}
