//! Walks the slices of a contact: fixed ones of either law, or the Hertz law's fitted nodes.

use super::pair::Contact;
use super::race::Meridian;
use super::{Fault, Sink, Slices};

/// Penetration δ − κ τ²/2 of the Hertz law.
pub(super) struct Gap {
    pub(super) approach: f64,
    pub(super) curvature: f64,
}

impl Gap {
    fn at(&self, tau: f64) -> f64 {
        self.approach - self.curvature * tau * tau / 2.0
    }
}

/// One slice or node, before it is known what it meets.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub(super) zeta: f64,
    pub(super) rho: f64,
    /// Place in the ring's frame.
    pub(super) z: f64,
    pub(super) width: f64,
    /// Healthy penetration that the law sees.
    pub(super) depth: f64,
    /// Radius of the round race at z.
    pub(super) torus_radius: f64,
}

impl<S: Sink> Contact<'_, S> {
    pub(super) fn iso_slices(&mut self, meridian: &Meridian) {
        let Slices::Fixed(count) = self.pair.slices else {
            return;
        };
        let radius = self.ball.radius;
        let Some((low, high)) = meridian.zone(radius) else {
            return;
        };
        let width = 2.0 * radius / count as f64;
        for zeta in fixed_places(radius, count, low, high) {
            let Some(node) = self.node(zeta, width) else {
                continue;
            };
            let depth = self.race_penetration(&node);
            self.slice(Node { depth, ..node });
        }
    }

    pub(super) fn hertz_fixed(&mut self, gap: &Gap, half: f64, count: usize) {
        let (cos, sin) = self.drop_common();
        let radius = self.ball.radius;
        let width = 2.0 * radius / count as f64;
        let (low, high) = (radius * sin - half * cos, radius * sin + half * cos);
        for zeta in fixed_places(radius, count, low.max(-radius), high.min(radius)) {
            let tau = (zeta - radius * sin) / cos;
            let Some(node) = self.node(zeta, width / cos) else {
                continue;
            };
            self.slice(Node {
                depth: gap.at(tau),
                ..node
            });
        }
    }

    /// The zone, cut at the ends of shoulders and of defects in reach, with nodes on every piece.
    pub(super) fn hertz_fitted(
        &mut self,
        gap: &Gap,
        half: f64,
        nodes: &[(f64, f64)],
        on_ball: f64,
        ball_faults: &[Fault],
    ) {
        let (cos, sin) = self.drop_common();
        let middle = self.ball.radius * sin;
        let pair = self.pair;
        let (on_ring, dz) = (self.on_ring, self.b.z - self.r.z);
        let tau_of = move |zeta: f64| (zeta - middle) / cos;
        let ends = |fault: &Fault| {
            [
                fault.middle - fault.length / 2.0,
                fault.middle + fault.length / 2.0,
            ]
        };
        let race = &pair.race;
        let shoulders = [race.centre + race.lowest, race.centre + race.highest];
        let on_race = pair
            .faults
            .iter()
            .filter(|fault| fault.in_reach(on_ring))
            .flat_map(ends);
        let on_ball = ball_faults
            .iter()
            .filter(|fault| fault.in_reach(on_ball))
            .flat_map(ends);
        // Few, so the next one is found by looking at all.
        let cuts = shoulders
            .into_iter()
            .chain(on_race)
            .map(|z| z - dz)
            .chain(on_ball)
            .map(tau_of);
        let mut low = -half;
        while low < half {
            let high = cuts.clone().filter(|&tau| tau > low).fold(half, f64::min);
            let (centre, radius) = (f64::midpoint(low, high), (high - low) / 2.0);
            for (x, weight) in nodes {
                let tau = centre + radius * x;
                let Some(node) = self.node(middle + tau * cos, radius * weight) else {
                    continue;
                };
                self.slice(Node {
                    depth: gap.at(tau),
                    ..node
                });
            }
            low = high;
        }
    }

    fn drop_common(&self) -> (f64, f64) {
        self.common.unwrap_or((1.0, 0.0))
    }

    fn node(&self, zeta: f64, width: f64) -> Option<Node> {
        let square = self.ball.radius * self.ball.radius - zeta * zeta;
        if square <= 0.0 {
            return None;
        }
        let z = self.b.z - self.r.z + zeta;
        let torus_radius = self.pair.race.radius(z)?;
        Some(Node {
            zeta,
            rho: square.sqrt(),
            z,
            width,
            depth: 0.0,
            torus_radius,
        })
    }

    /// s_k of model section 3: d + ρ − R_o or R_i + ρ − d.
    pub(super) fn race_penetration(&self, node: &Node) -> f64 {
        let radius = node.torus_radius + self.wave;
        self.pair.race.sigma * (self.distance - radius) + node.rho
    }
}

/// Middles of the fixed slices that may lie in a zone.
fn fixed_places(radius: f64, count: usize, low: f64, high: f64) -> impl Iterator<Item = f64> {
    let width = 2.0 * radius / count as f64;
    let place = move |k: usize| -radius + (k as f64 + 0.5) * width;
    // A float becomes the nearest index that exists; one slice more on either side decides for itself.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let index = |zeta: f64| ((zeta + radius) / width) as usize;
    (index(low).saturating_sub(1)..(index(high) + 2).min(count)).map(place)
}
