//! Waves of a race's radius: those that are listed, and texture.

use std::sync::Arc;

use super::{HeightTable, Raise};
use crate::scene::Waviness;
use crate::simd::{LANES, Lanes, direction};

/// Waves: the radius of a race or ball beside that of its round shape, a few waves or a table of many.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Waves {
    list: Vec<Waviness>,
    /// Table in place of the list.
    table: Option<Arc<HeightTable>>,
}

impl Waves {
    /// The waves of a list, wave by wave.
    pub fn of(list: Vec<Waviness>) -> Self {
        Self { list, table: None }
    }

    /// The waves of a table.
    pub(crate) fn tabulated(table: HeightTable) -> Self {
        Self {
            list: Vec::new(),
            table: Some(Arc::new(table)),
        }
    }

    /// The table, if the waves are one.
    pub(crate) fn table(&self) -> Option<&HeightTable> {
        self.table.as_deref()
    }

    /// Whether the surface is round.
    pub fn is_round(&self) -> bool {
        self.list.is_empty() && self.table.is_none()
    }

    /// Raise of the radius \[m\] at an angle in the body's own frame \[rad\].
    pub fn at(&self, angle: f64) -> f64 {
        self.raise(angle).height
    }

    /// The same with its derivative by the angle.
    pub(crate) fn raise(&self, angle: f64) -> Raise<f64> {
        if let Some(table) = &self.table {
            return table.raise(angle);
        }
        let mut raise = Raise::default();
        for w in &self.list {
            let order = f64::from(w.order);
            let (sin, cos) = (order * angle + w.phase).sin_cos();
            raise.height += w.amplitude * cos;
            raise.slope -= w.amplitude * order * sin;
        }
        raise
    }

    /// Raises under eight balls at places across the ring's axis, of a ring whose mark has turned by an angle \[rad\].
    #[inline(always)]
    pub(crate) fn under<const FMA: bool>(&self, [x, y]: [Lanes; 2], turned: f64) -> Raise<Lanes> {
        if let Some(table) = &self.table {
            return table.raises::<FMA>(direction::<FMA>(x, y) + -turned);
        }
        let mut raises = Raise::default();
        if !self.list.is_empty() {
            for lane in 0..LANES {
                raises.set(lane, self.raise(y[lane].atan2(x[lane]) - turned));
            }
        }
        raises
    }

    /// Second derivative of the radius by the angle \[m\].
    pub fn bend(&self, angle: f64) -> f64 {
        if let Some(table) = &self.table {
            return table.bend(angle);
        }
        let of = |w: &Waviness| {
            let order = f64::from(w.order);
            -order * order * w.amplitude * (order * angle + w.phase).cos()
        };
        self.list.iter().map(of).sum()
    }
}
