//! The cage: links between neighbouring balls ([`links`]), or a rigid ring with pockets ([`ring`]).

mod centre;
pub(crate) mod links;
mod pocket;
pub(crate) mod ring;
