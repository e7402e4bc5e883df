//! The samples of a record that are in memory: all of a run, or those that no block has handed over yet.

use serde::{Deserialize, Serialize};

use std::collections::TryReserveError;
use std::mem;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use super::Column;
use super::filter::HALF;
use crate::base::words::{Remembered, Words};

/// Samples of a block at most; its times are half a megabyte.
const MOST: usize = 1 << 16;
/// Samples of a block at least, well above those that the filter still works on.
const LEAST: usize = 256;
/// Size of a block as far as that allows \[bytes\].
const SIZE: usize = 16 << 20;

/// Consecutive samples of a record, which are what they are in a record that is kept whole.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Block {
    /// Times k / fs, going on where the block before has ended \[s\].
    pub t: Vec<f64>,
    /// The signals, each as long as `t`; the same names and units in all blocks of a run.
    pub columns: Vec<Column>,
}

/// Takes the blocks of a record in their order, and may stop the run.
pub(crate) type BlockSink<'a> = &'a mut (dyn FnMut(Block) -> ControlFlow<()> + Send + 'a);

/// Handling of the samples of a record.
pub(crate) enum Keep<'a> {
    /// Samples that all stay.
    All,
    /// Samples that leave block by block.
    Left(Mutex<BlockSink<'a>>),
    /// Samples that stay until they are taken.
    Taken,
}

impl Keep<'_> {
    /// Whether all samples stay.
    pub fn is_all(&self) -> bool {
        matches!(self, Self::All)
    }
}

/// Samples of a block of so many columns.
fn block_rows(columns: usize) -> usize {
    (SIZE / (size_of::<f64>() * (columns + 1))).clamp(LEAST, MOST)
}

/// Samples that are in memory of a record that leaves in blocks: the block that fills and the one that was taken, and
/// at the end of the first those that the filter still works on.
pub(super) fn rows_in_memory(columns: usize, count: usize) -> usize {
    count.min(2 * (block_rows(columns) + 2 * HALF))
}

/// The samples that are held.
pub(crate) struct Held<'a> {
    /// Samples of the whole run.
    count: usize,
    /// The sample in row 0.
    first: usize,
    keep: Keep<'a>,
    /// Samples of a block.
    pub(super) block: usize,
    pub t: Vec<f64>,
    pub columns: Vec<Column>,
}

impl<'a> Held<'a> {
    /// The blocks of `count` samples.
    pub fn new(columns: Vec<Column>, count: usize, keep: Keep<'a>) -> Self {
        Self {
            count,
            first: 0,
            keep,
            block: block_rows(columns.len()),
            t: Vec::new(),
            columns,
        }
    }

    /// Samples of the whole run.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Samples that have been read at their own times.
    pub fn sampled(&self) -> usize {
        self.first + self.t.len()
    }

    /// Rows to set aside.
    pub fn rows(&self) -> usize {
        if self.keep.is_all() {
            self.count
        } else {
            self.count.min(self.block + 2 * HALF)
        }
    }

    /// Sets memory aside for the times and all columns.
    ///
    /// # Errors
    /// The system does not grant it.
    pub fn reserve(&mut self) -> Result<(), TryReserveError> {
        let rows = self.rows();
        let columns = self.columns.iter_mut().map(|column| &mut column.values);
        let mut all = columns.chain([&mut self.t]);
        all.try_for_each(|values| values.try_reserve_exact(rows))
    }

    /// Opens the blocks: zeros stand in some columns where sums are to grow, at the samples before `end`, or at all where all are kept.
    pub fn open(&mut self, columns: &[usize], end: usize) {
        let end = if self.keep.is_all() { self.count } else { end };
        let rows = end.min(self.count).saturating_sub(self.first);
        for column in columns {
            let values = &mut self.columns[*column].values;
            if values.len() < rows {
                values.resize(rows, 0.0);
            }
        }
    }

    /// Hands over the blocks that are full of samples before `finished`, or all of these samples at the end of the run.
    /// Returns how many samples have left, or that the run is to stop.
    pub fn leave(&mut self, finished: usize) -> ControlFlow<(), usize> {
        let Keep::Left(sink) = &mut self.keep else {
            return ControlFlow::Continue(0);
        };
        let (most, mut left) = (self.block, 0);
        loop {
            let rows = most.min(finished.saturating_sub(self.first));
            if rows == 0 || rows < most && finished < self.count {
                return ControlFlow::Continue(left);
            }
            let block = Block {
                t: taken(&mut self.t, rows, most),
                columns: self
                    .columns
                    .iter_mut()
                    .map(|of| Column {
                        name: of.name.clone(),
                        unit: of.unit.clone(),
                        values: taken(&mut of.values, rows, most),
                    })
                    .collect(),
            };
            self.first += rows;
            left += rows;
            sink.get_mut().unwrap_or_else(PoisonError::into_inner)(block)?;
        }
    }
}

impl Held<'_> {
    /// Samples that are finished and lie before `end`, from where the last ones were taken.
    pub fn take(&mut self, finished: usize, end: usize) -> Block {
        let rows = finished.min(end).saturating_sub(self.first);
        self.first += rows;
        let part = |values: &mut Vec<f64>| values.drain(..rows).collect();
        Block {
            t: part(&mut self.t),
            columns: self
                .columns
                .iter_mut()
                .map(|of| Column {
                    name: of.name.clone(),
                    unit: of.unit.clone(),
                    values: part(&mut of.values),
                })
                .collect(),
        }
    }

    /// Ends the record before the sample `end`.
    pub fn end_at(&mut self, end: usize) {
        self.count = end;
        let rows = end.saturating_sub(self.first);
        self.t.truncate(rows);
        for column in &mut self.columns {
            column.values.truncate(rows);
        }
    }
}

impl Remembered for Held<'_> {
    fn pass(&mut self, words: &mut Words) {
        self.first.pass(words);
        self.t.pass(words);
        for column in &mut self.columns {
            column.values.pass(words);
        }
    }
}

/// The first values, whose memory goes with them; the others are moved to the front of memory for a block.
fn taken(values: &mut Vec<f64>, rows: usize, most: usize) -> Vec<f64> {
    let mut rest = Vec::with_capacity((values.len() - rows).max(most + 2 * HALF));
    rest.extend_from_slice(&values[rows..]);
    values.truncate(rows);
    mem::replace(values, rest)
}
