//! All bodies side by side, direction by direction: what an evaluation reads and what it adds up.

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use crate::contact::{Motion, V2};
use crate::simd::{LANES, Lanes};

/// A number a body along x, y, z and about z, each direction padded so that eight neighbours can be read from any
/// body.
#[derive(Debug, Clone)]
pub(super) struct Table {
    values: Vec<f64>,
    stride: usize,
}

impl Table {
    pub fn zeros(bodies: usize) -> Self {
        let stride = bodies + LANES;
        Self {
            values: vec![0.0; 4 * stride],
            stride,
        }
    }

    /// Takes over another one of the same size.
    pub fn copy_from(&mut self, other: &Self) {
        self.values.copy_from_slice(&other.values);
    }

    /// All bodies, along one direction.
    #[inline(always)]
    pub fn along(&self, direction: usize) -> &[f64] {
        &self.values[direction * self.stride..][..self.stride]
    }

    #[inline(always)]
    pub fn along_mut(&mut self, direction: usize) -> &mut [f64] {
        &mut self.values[direction * self.stride..][..self.stride]
    }

    /// All bodies, direction by direction.
    #[inline(always)]
    pub fn directions(&self) -> [&[f64]; 4] {
        std::array::from_fn(|direction| self.along(direction))
    }

    #[inline(always)]
    pub fn directions_mut(&mut self) -> [&mut [f64]; 4] {
        let mut chunks = self.values.chunks_exact_mut(self.stride);
        std::array::from_fn(|_| chunks.next().unwrap_or_default())
    }

    #[inline(always)]
    pub fn get(&self, body: usize, direction: usize) -> f64 {
        self.values[direction * self.stride + body]
    }

    #[inline(always)]
    pub fn get_mut(&mut self, body: usize, direction: usize) -> &mut f64 {
        &mut self.values[direction * self.stride + body]
    }

    /// The four numbers of a body.
    #[inline(always)]
    pub fn of(&self, body: usize) -> [f64; 4] {
        [
            self.get(body, 0),
            self.get(body, 1),
            self.get(body, 2),
            self.get(body, 3),
        ]
    }

    #[inline(always)]
    pub fn add(&mut self, body: usize, numbers: &[f64; 4]) {
        for (direction, number) in numbers.iter().enumerate() {
            *self.get_mut(body, direction) += number;
        }
    }

    /// Eight neighbours.
    #[inline(always)]
    pub fn eight(&self, first: usize, direction: usize) -> Lanes {
        Lanes::from_slice(&self.values[direction * self.stride + first..][..LANES])
    }

    /// Adds to eight neighbours.
    #[inline(always)]
    pub fn add_eight(&mut self, first: usize, direction: usize, lanes: Lanes) {
        let values = &mut self.values[direction * self.stride + first..][..LANES];
        (Lanes::from_slice(values) + lanes).to_slice(values);
    }

    /// Reads a half of a state vector as `Model` orders it, body by body.
    pub fn read(&mut self, half: &[f64]) {
        for (body, numbers) in half.as_chunks::<4>().0.iter().enumerate() {
            for (direction, number) in numbers.iter().enumerate() {
                *self.get_mut(body, direction) = *number;
            }
        }
    }
}

/// Where all bodies are and how they move.
#[derive(Debug, Clone)]
pub(super) struct State {
    pub q: Table,
    pub v: Table,
}

impl State {
    pub fn new(bodies: usize) -> Self {
        let mut q = Table::zeros(bodies);
        // No body: away from all axes, so that nothing divides by zero there.
        q.along_mut(0)[bodies..].fill(1.0);
        let v = Table::zeros(bodies);
        Self { q, v }
    }

    /// Reads a state vector as `Model` orders it, body by body.
    pub fn read(&mut self, y: &[f64]) {
        let (q, v) = y.split_at(y.len() / 2);
        self.q.read(q);
        self.v.read(v);
    }

    #[inline]
    pub fn motion(&self, body: usize) -> Motion {
        let ([x, y, z, theta], [vx, vy, vz, omega]) = (self.q.of(body), self.v.of(body));
        Motion {
            centre: V2::new(x, y),
            z,
            theta,
            velocity: V2::new(vx, vy),
            vz,
            omega,
        }
    }
}
