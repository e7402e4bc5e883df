//! The cage: springs and dampers that keep the centres of neighbouring balls of a row at their distance ℓ₀, slack within ± p/2
//! of it ([*Cage*](crate::equations#cage-supports-loads-drive)).
//!
//! ```text
//! F = k_c (ℓ − ℓ₀ ∓ p/2) + c_c dℓ/dt        energy k_c (ℓ − ℓ₀ ∓ p/2)²/2        power c_c (dℓ/dt)²
//! ```

use super::super::{
    Account, Asymmetry, Damper, Force, ForceSums, Instant, RingWrench, State, Table, Use,
};
use crate::contact::Motion;
use crate::model::{BodyId, Dof, Model, Race, RowModel};
use crate::scene;
use crate::simd::{Simd, Vector, Wide};

/// Forces of all links of the cage.
#[derive(Debug)]
pub(crate) struct LinkForces;

impl Force for LinkForces {
    fn name(&self) -> &'static str {
        "cage links"
    }

    fn contribution(&self) -> &'static str {
        "cage"
    }

    fn used(&self, model: &Model) -> Use {
        Use::evaluated(model.scene.cage_links().is_some())
    }

    #[inline]
    fn add(&self, model: &Model, at: &Instant<'_>, sums: &mut ForceSums<'_>) {
        if let Some(cage) = model.scene.cage_links() {
            for row in &model.rows[..at.rows] {
                model.instructions.run_wide(Links {
                    cage,
                    row,
                    state: at.state,
                    forces: sums.on,
                });
            }
        }
    }

    fn account(&self, model: &Model, y: &[f64]) -> Account {
        let mut account = Account::default();
        for link in model.rows.iter().flat_map(|row| of_row(model, y, row)) {
            account.cage += link.energy;
            account.power += link.power;
        }
        account
    }

    fn dampers(&self, model: &Model) -> Vec<Damper> {
        let of = |row: usize| Damper {
            name: format!("row{row}.cage"),
            body: model.rows[row].first_body(),
            rate: rate(model, row),
        };
        (0..model.rows.len()).map(of).collect()
    }

    fn at_start(&self, _model: &Model, _race: Race) -> RingWrench {
        RingWrench::default()
    }

    fn asymmetry(&self, _model: &Model) -> Asymmetry {
        Asymmetry::default()
    }
}

/// A cage link between two balls: force on the first (positive in tension), stored energy and dissipated power.
pub(crate) struct Link {
    pub force: f64,
    pub energy: f64,
    pub power: f64,
}

/// The link between two balls, [*Cage*](crate::equations#cage-supports-loads-drive).
#[inline]
pub(crate) fn link(cage: &scene::CageLinks, nominal: f64, first: &Motion, second: &Motion) -> Link {
    let apart = second.centre - first.centre;
    let extension = apart.norm() - nominal;
    let half = cage.play / 2.0;
    if cage.play > 0.0 && extension.abs() <= half {
        return Link {
            force: 0.0,
            energy: 0.0,
            power: 0.0,
        };
    }
    let beyond = extension - half.copysign(extension);
    let rate = (second.velocity - first.velocity).dot(&(apart / apart.norm()));
    Link {
        force: cage.stiffness * beyond + cage.damping * rate,
        energy: 0.5 * cage.stiffness * beyond * beyond,
        power: cage.damping * rate * rate,
    }
}

/// Links of a row: each from a ball to its neighbour, and the last one back to the first.
struct Links<'a> {
    cage: &'a scene::CageLinks,
    row: &'a RowModel,
    state: &'a State,
    forces: &'a mut Table,
}

impl Wide for Links<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            cage,
            row,
            state,
            forces,
        } = self;
        let all = |x: f64| Vector::all(simd, x);
        let (from, balls) = (row.first_body().index(), row.count);
        let [x, y, ..] = state.q.directions();
        let [vx, vy, ..] = state.v.directions();
        let of = [x, y, vx, vy];
        let zero = all(0.0);
        // Two balls have one link.
        let mut closing = [zero; 2];
        if balls > 2 {
            let mut apart = [zero; 4];
            for (apart, of) in apart.iter_mut().zip(of) {
                *apart = all(of[from] - of[from + balls - 1]);
            }
            closing = pull(cage, row.cage_distance, apart);
        }
        let mut before = closing;
        let [fx, fy, ..] = forces.directions_mut();
        for at in (0..balls).step_by(Vector::<S>::LANES) {
            let body = from + at;
            let mut apart = [zero; 4];
            for (apart, of) in apart.iter_mut().zip(of) {
                *apart = Vector::load(simd, &of[body + 1..]) - Vector::load(simd, &of[body..]);
            }
            let linked = pull(cage, row.cage_distance, apart);
            let lane = Vector::count(simd);
            let left = (balls - at) as f64;
            let (open, there) = (lane.below(all(left - 1.5)), lane.below(all(left - 0.5)));
            for (i, along) in [&mut *fx, &mut *fy].into_iter().enumerate() {
                let next = there.choose(open.choose(linked[i], closing[i]), zero);
                let force = next - there.choose(next.after(before[i]), zero);
                before[i] = next;
                let to = &mut along[body..];
                (Vector::load(simd, to) + force).store(to);
            }
        }
    }
}

/// Force of a [`link`] on the first of two balls along x and y, from how far the second is apart and how fast it departs.
#[inline(always)]
pub(crate) fn pull<S: Simd>(
    cage: &scene::CageLinks,
    nominal: f64,
    [dx, dy, dvx, dvy]: [Vector<S>; 4],
) -> [Vector<S>; 2] {
    let all = |x: f64| dx.same(x);
    let half = all(0.5 * cage.play);
    let over = all(1.0) / dx.mul_add(dx, dy * dy).sqrt();
    let (nx, ny) = (dx * over, dy * over);
    let extension = dx.mul_add(nx, dy * ny) - all(nominal);
    let rate = dvx.mul_add(nx, dvy * ny);
    let mut beyond = extension;
    if cage.play > 0.0 {
        beyond = extension - extension.or_more(-half).or_less(half);
    }
    let mut tension = beyond.mul_add(all(cage.stiffness), rate * all(cage.damping));
    if cage.play > 0.0 {
        let engaged = half.below(extension).or(extension.below(-half));
        tension = engaged.choose(tension, all(0.0));
    }
    [tension * nx, tension * ny]
}

/// The links of a row in a state; none without a cage.
pub(crate) fn of_row(model: &Model, y: &[f64], row: &RowModel) -> Vec<Link> {
    let motion = |ball| model.layout().motion(y, BodyId::ball(ball));
    let links = model.scene.cage_links().into_iter().flat_map(|cage| {
        let of = move |(i, j)| link(cage, row.cage_distance, &motion(i), &motion(j));
        row.links().map(of)
    });
    links.collect()
}

/// Rate at which the cage damps a ball of a row \[1/s\]: by two links, at most 4 c_c/m.
fn rate(model: &Model, row: usize) -> f64 {
    let ball = &model.bodies[model.rows[row].first_body()];
    let cage = model.scene.cage_links();
    cage.map_or(0.0, |cage| 4.0 * cage.damping / ball.mass[Dof::X])
}
