//! Sets of cells of a grid, as bits.
//!
//! Layout, in memory and wherever a set is stored or sent: cells are numbered row by row, `row * columns + column`, and
//! packed 64 per word, lowest bit first. Words that a set does not have are empty, so that sets of different lengths
//! compare by their cells.

use serde::{Deserialize, Serialize};

/// Cells per word.
const WORD: usize = u64::BITS as usize;

/// A set of cells of a grid.
///
/// ```
/// use cgda_core::CellSet;
///
/// let mut painted = CellSet::empty(70);
/// assert!(painted.insert(69) && !painted.insert(69));
/// assert_eq!(painted.words(), [0, 1 << 5]);
/// ```
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct CellSet {
    words: Vec<u64>,
}

impl CellSet {
    /// The empty set, with room for `cells` cells.
    #[must_use]
    pub fn empty(cells: usize) -> Self {
        Self { words: vec![0; cells.div_ceil(WORD)] }
    }

    /// The set of the cells whose flag is set; the first flag is that of cell 0.
    #[must_use]
    pub fn from_flags(flags: impl IntoIterator<Item = bool>) -> Self {
        let mut words = Vec::new();
        for (cell, flag) in flags.into_iter().enumerate() {
            if cell % WORD == 0 {
                words.push(0);
            }
            words[cell / WORD] |= u64::from(flag) << (cell % WORD);
        }
        Self { words }
    }

    /// The words, in the layout of this module.
    #[must_use]
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// Whether `cell` is in the set.
    #[inline]
    #[must_use]
    pub fn contains(&self, cell: usize) -> bool {
        self.word(cell / WORD) >> (cell % WORD) & 1 == 1
    }

    /// Adds `cell`; returns whether it was new.
    ///
    /// # Panics
    /// If the set has no room for it.
    #[inline]
    pub fn insert(&mut self, cell: usize) -> bool {
        let (word, bit) = (&mut self.words[cell / WORD], 1 << (cell % WORD));
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }

    /// Removes all cells and keeps the room.
    pub fn clear(&mut self) {
        self.words.fill(0);
    }

    /// The cells in the set, in order.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        (0..self.words.len() * WORD).filter(|&cell| self.contains(cell))
    }

    /// Number of cells in the set.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.words.iter().map(|word| word.count_ones()).sum()
    }

    /// Number of cells in this set that are in none of `others`; does not allocate.
    #[inline]
    #[must_use]
    pub fn count_beyond<const N: usize>(&self, others: [&Self; N]) -> u32 {
        let beyond = |(index, word): (usize, &u64)| others.iter().fold(*word, |rest, other| rest & !other.word(index));
        self.words.iter().enumerate().map(beyond).map(u64::count_ones).sum()
    }

    /// The cells in this set that are not in `other`.
    #[must_use]
    pub fn difference(&self, other: &Self) -> Self {
        Self { words: self.words.iter().enumerate().map(|(index, word)| word & !other.word(index)).collect() }
    }

    /// Adds the cells of `other`; allocates only if this set has less room.
    pub fn extend(&mut self, other: &Self) {
        if self.words.len() < other.words.len() {
            self.words.resize(other.words.len(), 0);
        }
        self.words.iter_mut().zip(&other.words).for_each(|(word, added)| *word |= added);
    }

    #[inline]
    fn word(&self, index: usize) -> u64 {
        self.words.get(index).copied().unwrap_or(0)
    }
}

impl PartialEq for CellSet {
    fn eq(&self, other: &Self) -> bool {
        let longest = self.words.len().max(other.words.len());
        (0..longest).all(|index| self.word(index) == other.word(index))
    }
}

impl Eq for CellSet {}

impl From<Vec<u64>> for CellSet {
    fn from(words: Vec<u64>) -> Self {
        Self { words }
    }
}

impl From<CellSet> for Vec<u64> {
    fn from(set: CellSet) -> Self {
        set.words
    }
}

#[cfg(test)]
mod tests {
    use super::CellSet;
    use crate::method::whole_run::Trial;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    const CELLS: usize = 200;

    /// Cells of a grid of at most [`CELLS`].
    fn cells() -> impl Strategy<Value = BTreeSet<usize>> {
        prop::collection::btree_set(0..CELLS, 0..80)
    }

    fn set(cells: &BTreeSet<usize>) -> CellSet {
        let mut set = CellSet::empty(CELLS);
        for &cell in cells {
            set.insert(cell);
        }
        set
    }

    /// The same set, with no room to spare.
    fn short(cells: &BTreeSet<usize>) -> CellSet {
        let end = cells.last().map_or(0, |last| last + 1);
        CellSet::from_flags((0..end).map(|cell| cells.contains(&cell)))
    }

    fn model(set: &CellSet) -> BTreeSet<usize> {
        (0..CELLS + 100).filter(|&cell| set.contains(cell)).collect()
    }

    proptest! {
        #[test]
        fn it_holds_what_was_inserted(inserted in prop::collection::vec(0..CELLS, 0..80)) {
            let (mut set, mut known) = (CellSet::empty(CELLS), BTreeSet::new());
            for cell in inserted {
                prop_assert_eq!(set.insert(cell), known.insert(cell));
                prop_assert_eq!(set.count() as usize, known.len());
            }
            prop_assert_eq!(model(&set), known);
            set.clear();
            prop_assert_eq!(set, CellSet::default());
        }

        #[test]
        fn sets_combine_as_their_models_do(one in cells(), other in cells(), all in cells()) {
            for (a, b) in [(set(&one), set(&other)), (short(&one), short(&other))] {
                let beyond = a.difference(&b);
                prop_assert_eq!(model(&beyond), &one - &other);
                prop_assert_eq!(a.count_beyond([&b]), beyond.count());
                prop_assert_eq!(a == b, one == other);
                let mut both = a.clone();
                both.extend(&b);
                prop_assert_eq!(model(&both), &one | &other);
                prop_assert_eq!(set(&all).count_beyond([&a, &b]) as usize, (&all - &(&one | &other)).len());
            }
            prop_assert_eq!(set(&one), short(&one));
        }

        #[test]
        fn words_and_stored_text_give_the_set_back(cells in cells()) {
            let set = set(&cells);
            prop_assert_eq!(&CellSet::from(Vec::from(set.clone())), &set);
            let text = serde_json::to_string(&set).unwrap();
            prop_assert_eq!(&text, &serde_json::to_string(set.words()).unwrap(), "stored as its words");
            prop_assert_eq!(&serde_json::from_str::<CellSet>(&text).unwrap(), &set);
        }
    }

    /// Trials in checkpoints and stored logs keep their text.
    #[test]
    fn a_stored_trial_reads_and_writes_its_cells_as_words() {
        let text = r#"{"joints":[0.1],"observation":[18.75],"cells":[9223372036854775809,2],"goal":1}"#;
        let trial: Trial = serde_json::from_str(text).unwrap();
        assert_eq!(trial.cells.as_ref().map(CellSet::count), Some(3));
        assert_eq!(serde_json::to_string(&trial).unwrap(), text);
    }

    #[test]
    fn the_lowest_bit_of_the_first_word_is_cell_0() {
        let set: CellSet = serde_json::from_str("[9223372036854775809,2]").unwrap();
        assert_eq!(model(&set), BTreeSet::from([0, 63, 65]));
        assert_eq!(set, CellSet::from_flags((0..66).map(|cell| [0, 63, 65].contains(&cell))));
    }
}
