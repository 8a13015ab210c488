//! Properties of worlds. Methods, results and pages ask for them in place of the kind of world, so that a new kind
//! needs to state them only once.

/// Properties of a world that methods and jobs may rely on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WorldProperties {
    /// Whether the features follow the pose without jumps.
    pub smooth: bool,
    /// The surface over which effects accumulate; `None` if they do not.
    pub surface: Option<Surface>,
}

/// A surface whose cells are covered one after another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Surface {
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Whether it can be reset between trials.
    pub resets: bool,
    /// Whether an observation shows the covered cells, not only their share.
    pub cells_seen: bool,
}

impl Surface {
    /// Number of cells of the surface.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.columns * self.rows
    }
}

impl WorldProperties {
    /// Whether the world can be reset to its state before a trial.
    #[must_use]
    pub fn resets(&self) -> bool {
        self.surface.is_none_or(|surface| surface.resets)
    }
}
