//! A robot that deviates from its description: scaled link lengths and a shifted base.

use super::chain::Chain;
use nalgebra::Vector3;

impl Chain {
    /// Number of links whose length [`Chain::distorted`] may change: one after each moving joint.
    #[must_use]
    pub fn link_count(&self) -> usize {
        self.steps.len()
    }

    /// Copy of this chain in which the translation of link i (from moving joint i to the next one, or to the tool) is
    /// scaled by `link_scales[i]` (1 if missing) and the base is shifted by `base_shift_m` (base frame, metres).
    #[must_use]
    pub fn distorted(&self, link_scales: &[f64], base_shift_m: [f64; 3]) -> Self {
        let mut chain = self.clone();
        let scale = |link: usize| link_scales.get(link).copied().unwrap_or(1.0);
        for (index, step) in chain.steps.iter_mut().enumerate() {
            if index == 0 {
                step.translation += Vector3::from(base_shift_m);
            } else {
                step.translation *= scale(index - 1);
            }
        }
        let last = chain.steps.len();
        chain.tool.translation.vector *= scale(last.saturating_sub(1));
        if last == 0 {
            chain.tool.translation.vector += Vector3::from(base_shift_m);
        }
        chain
    }
}

#[cfg(test)]
mod tests {
    use crate::robot::{Chain, RobotModel, RobotSpec, tool_position};

    const TWO_LINKS: &str = r#"<robot name="two"><link name="a"/><link name="b"/><link name="c"/><link name="t"/>
        <joint name="j1" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
          <limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
        <joint name="j2" type="revolute"><parent link="b"/><child link="c"/><origin xyz="0 0 2"/><axis xyz="0 1 0"/>
          <limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
        <joint name="tip" type="fixed"><parent link="c"/><child link="t"/><origin xyz="0 0 3"/></joint></robot>"#;

    #[test]
    fn each_link_scales_and_the_base_shifts() {
        let model = RobotModel::from_urdf(TWO_LINKS).unwrap();
        let chain = Chain::new(&model, &RobotSpec::default()).unwrap();
        assert_eq!(chain.link_count(), 2);
        let real = chain.distorted(&[1.1, 0.9], [0.5, 0.0, -0.25]);
        let p = tool_position(&real, &[0.0, 0.0]);
        assert!((p - nalgebra::Vector3::new(0.5, 0.0, 0.75 + 2.2 + 2.7)).norm() < 1e-12, "{p}");
        assert_eq!(chain.distorted(&[], [0.0; 3]), chain);
    }
}
