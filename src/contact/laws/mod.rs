//! The laws of a contact: where it is cut, what an element bears, how it is damped, how it rubs.
//!
//! Each law is written once, for any kind of number: for one contact, for eight side by side, and with derivatives.

pub mod cut;
pub mod damping;
pub mod elastic;
pub mod traction;

pub use cut::Cut;
pub use damping::Damping;
pub use elastic::Elastic;
pub use traction::Traction;

/// The laws that all contacts of a row's balls with one race follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// Elastic force of an element by its penetration.
    pub elastic: Elastic,
    /// Damping of the approach.
    pub damping: Damping,
    /// Friction, if any.
    pub traction: Option<Traction>,
}

impl Law {
    /// An elastic law alone.
    pub fn elastic(elastic: Elastic) -> Self {
        Self {
            elastic,
            damping: Damping {
                coefficient: 0.0,
                clamp_pull: true,
            },
            traction: None,
        }
    }

    /// Where the ball is cut: the elastic law knows.
    pub fn cut(&self) -> Cut {
        self.elastic.cut()
    }
}
