//! Two ways that must agree: what a run leaves out, contacts by eights and one by one, records in blocks, settled starts.

#[path = "../common/mod.rs"]
mod common;

mod blocks;
mod cage_ring;
mod kernel;
mod pieces;
mod reduction;
mod settle;
mod touched;
mod turning;
mod unlike_rows;
