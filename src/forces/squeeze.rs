//! Squeeze films between balls and races ([*Normal force*](crate::equations#normal-force)): the law is [`Squeeze`], the gap that of the
//! smooth race with its waves, along the common normal. A spall under the ball, or the ball's own damage, does not thin it.

use nalgebra::Vector3;

use super::{Account, Damper, Force, ForceSums, Instant, RingWrench, State, Table, Use};
use crate::contact::{Motion, Pair, Raise, Section, Squeeze, TiltedRing, cross};
use crate::model::{BodyId, Dof, Model, Race, RowModel, SqueezeModel};
use crate::simd::{Number, Simd, Vector, Wide};

/// Squeeze films of all rows.
#[derive(Debug)]
pub(crate) struct SqueezeFilms;

impl Force for SqueezeFilms {
    fn name(&self) -> &'static str {
        "squeeze films"
    }

    fn contribution(&self) -> &'static str {
        "damping"
    }

    fn is_rare(&self) -> bool {
        true
    }

    fn used(&self, model: &Model) -> Use {
        Use::evaluated(model.rows.iter().any(|row| row.squeeze.is_some()))
    }

    fn add(&self, model: &Model, at: &Instant<'_>, sums: &mut ForceSums<'_>) {
        for row in &model.rows[..at.rows] {
            let Some(squeeze) = &row.squeeze else {
                continue;
            };
            if at.rings.is_some() || row.pairs.iter().any(|pair| !pair.waves.is_round()) {
                add_one_by_one(model, row, &squeeze.film, at, sums);
                continue;
            }
            let on_rings = model.instructions.run_wide(RowFilms {
                squeeze,
                row,
                state: at.state,
                forces: sums.on,
            });
            for race in Race::BOTH {
                let wrench = RingWrench {
                    force: Vector3::from(on_rings[race]) * at.times,
                    moment: Vector3::zeros(),
                };
                sums.add(race, &wrench);
            }
        }
    }

    fn account(&self, model: &Model, y: &[f64]) -> Account {
        let mut account = Account::default();
        for row in &model.rows {
            let Some(SqueezeModel { film, .. }) = &row.squeeze else {
                continue;
            };
            for ball in row.balls() {
                for race in Race::BOTH {
                    let [at, ring] = model.facing(y, ball, race);
                    let radius = model.balls[ball].side.radius;
                    let squeezed = before(film, &row.pairs[race], radius, &at, &ring);
                    account.damping += squeezed.force * squeezed.closing;
                }
            }
        }
        account
    }

    fn dampers(&self, model: &Model) -> Vec<Damper> {
        let of = |row: &RowModel| {
            let body = row.first_body();
            let film = &row.squeeze.as_ref()?.film;
            Some(Damper {
                name: format!("row{}.contact.squeeze", model.balls[row.first].row),
                body,
                rate: 2.0 * film.damping / model.bodies[body].mass[Dof::X],
            })
        };
        model.rows.iter().filter_map(of).collect()
    }
}

/// Film between a ball and a race: force that presses them apart \[N\], speed at which the gap closes \[m/s\], and the common normal,
/// out of the ball.
struct Squeezed<T> {
    force: T,
    closing: T,
    normal: [T; 3],
}

impl<T: Number> Squeezed<T> {
    /// The film of a ball at a place and a velocity of the ring's frame, on a race that is raised there \[m\], and rises \[m/s\].
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn new<const FMA: bool>(
        film: &Squeeze,
        pair: &Pair,
        radius: T,
        [[x, y, z], [vx, vy, vz]]: [[T; 3]; 2],
        [raise, rises]: [T; 2],
    ) -> Self {
        let race = &pair.race;
        let distance = x.mul_add::<FMA>(x, y * y).sqrt();
        let over = distance.same(1.0) / distance;
        let (nx, ny) = (x * over, y * over);
        let e = (distance + -race.a - raise) * race.sigma;
        let section = Section::new::<FMA, false>(radius, x.same(race.r), e, -z + race.centre);
        let (in_plane, along) = section.normal.share();
        let outwards = in_plane * race.sigma;
        let parting = vx.mul_add::<FMA>(nx, vy * ny) - rises;
        let closing = parting.mul_add::<FMA>(outwards, vz * along);
        Self {
            force: film.force_of(-section.approach, closing),
            closing,
            normal: [outwards * nx, outwards * ny, along],
        }
    }

    /// Force on the ring.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn on_ring(&self) -> [T; 3] {
        let [x, y, z] = self.normal;
        [x * self.force, y * self.force, z * self.force]
    }
}

/// The film between a ball and a race in the motions that their contact sees.
fn before(film: &Squeeze, pair: &Pair, radius: f64, ball: &Motion, ring: &Motion) -> Squeezed<f64> {
    let seen = ball.seen_from(ring);
    let mut waves = [0.0; 2];
    if !pair.waves.is_round() {
        let Raise { height, slope } = pair.waves.raise(ring.angle_of(seen.direction()));
        let turns = cross(seen.centre, seen.velocity) / seen.centre.norm_squared() - ring.omega;
        waves = [height, slope * turns];
    }
    let (place, velocity) = (seen.centre, seen.velocity);
    let motion = [
        [place.x, place.y, seen.z],
        [velocity.x, velocity.y, seen.vz],
    ];
    Squeezed::new::<false>(film, pair, radius, motion, waves)
}

/// Adds the films of a row on rings that tilt, or have waves.
fn add_one_by_one(
    model: &Model,
    row: &RowModel,
    film: &Squeeze,
    at: &Instant<'_>,
    sums: &mut ForceSums<'_>,
) {
    for ball in row.balls() {
        let body = BodyId::ball(ball);
        let radius = model.balls[ball].side.radius;
        let motion = at.state.motion(body);
        for race in Race::BOTH {
            let tilted: Option<&TiltedRing> = at.rings.map(|rings| rings[race]);
            let [seen, ring] = match tilted {
                Some(ring) => ring.facing(&motion),
                None => [motion, at.state.motion(race.ring())],
            };
            let own = before(film, &row.pairs[race], radius, &seen, &ring).on_ring();
            let mut wrench = RingWrench {
                force: Vector3::from(own),
                moment: Vector3::zeros(),
            };
            if let Some(ring) = tilted {
                wrench.force = ring.rotation.frame.to_scene(&wrench.force);
                wrench.moment = ring.arm(&motion).cross(&wrench.force) * at.times;
            }
            for (dof, force) in Dof::TRANSLATIONS.into_iter().zip(wrench.force.iter()) {
                *sums.on.get_mut(body, dof) -= force;
            }
            wrench.force *= at.times;
            sums.add(race, &wrench);
        }
    }
}

/// Films of a row on smooth rings that stay parallel.
struct RowFilms<'a> {
    squeeze: &'a SqueezeModel,
    row: &'a RowModel,
    state: &'a State,
    forces: &'a mut Table,
}

impl Wide for RowFilms<'_> {
    /// Forces on the rings.
    type Output = [[f64; 3]; 2];

    // Compiled for the instruction set that runs it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [[f64; 3]; 2] {
        let Self {
            squeeze,
            row,
            state,
            forces,
        } = self;
        let zero = Vector::all(simd, 0.0);
        let (places, speeds) = (state.q.directions(), state.v.directions());
        let [fx, fy, fz, _] = forces.directions_mut();
        let first = row.first_body().index();
        let mut on_rings = [[zero; 3]; 2];
        // Plain loops: closures over registers are not always taken into the function that has the instructions.
        for at in (0..row.count).step_by(Vector::<S>::LANES) {
            let body = first + at;
            let left = Vector::all(simd, (row.count - at) as f64 - 0.5);
            let there = Vector::count(simd).below(left);
            let radius = Vector::load(simd, &squeeze.radii[at..]);
            let mut on_balls = [zero; 3];
            for race in Race::BOTH {
                let ring = race.ring().index();
                let (mut place, mut velocity) = ([zero; 3], [zero; 3]);
                for i in 0..3 {
                    let own = Vector::load(simd, &places[i][body..]);
                    place[i] = own - Vector::all(simd, places[i][ring]);
                    let own = Vector::load(simd, &speeds[i][body..]);
                    velocity[i] = own - Vector::all(simd, speeds[i][ring]);
                }
                let pair = &row.pairs[race];
                let motion = [place, velocity];
                let own =
                    Squeezed::new::<true>(&squeeze.film, pair, radius, motion, [zero; 2]).on_ring();
                for i in 0..3 {
                    let force = there.choose(own[i], zero);
                    on_rings[race][i] += force;
                    on_balls[i] = on_balls[i] - force;
                }
            }
            for (along, force) in [&mut *fx, &mut *fy, &mut *fz].into_iter().zip(on_balls) {
                let to = &mut along[body..];
                (Vector::load(simd, to) + force).store(to);
            }
        }
        let mut sums = [[0.0; 3]; 2];
        for (sums, of) in sums.iter_mut().zip(on_rings) {
            for (sum, of) in sums.iter_mut().zip(of) {
                *sum = of.sum();
            }
        }
        sums
    }
}
