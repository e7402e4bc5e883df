//! Squeeze films between balls and races ([*Normal force*](crate::equations#normal-force)): the law is [`Squeeze`], the gap that of the
//! sound race with its waves, along the common normal; of a race through points it is that of the torus like it. A spall under the ball, the
//! ball's own damage and its texture change nothing.

use nalgebra::Vector3;

use super::{Account, Asymmetry, Damper, Force, ForceSums, Instant, RingWrench, State, Table, Use};
use crate::contact::{Motion, Pair, Raise, Section, Squeeze, TiltedRing, cross};
use crate::model::{BodyId, Dof, Model, Race, RowModel, SqueezeModel};
use crate::simd::{LANES, Lanes, Mask, Number, Simd, Task, Vector, Wide};

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
            let films = RowFilms {
                squeeze,
                row,
                state: at.state,
                rings: at.rings,
                forces: sums.on,
            };
            let is_simple = |pair: &Pair| pair.waves.is_round() && pair.other_flank().is_none();
            let is_plain = at.rings.is_none() && row.pairs.iter().all(is_simple);
            let on_rings = if is_plain {
                model.instructions.run_wide(films)
            } else {
                model.instructions.run(films)
            };
            for race in Race::BOTH {
                let [force, moment] = on_rings[race];
                let [force, moment] = match at.rings {
                    // Along normals through the axis, about which nothing turns.
                    None => [force, Vector3::zeros()],
                    Some(rings) => rings[race].about_centre(&force, &moment),
                };
                let wrench = RingWrench {
                    force: force * at.times,
                    moment: moment * at.times,
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
                    for flank in row.pairs[race].flanks() {
                        let squeezed = before(film, flank, radius, &at, &ring);
                        account.damping += squeezed.force * squeezed.closing;
                    }
                }
            }
        }
        account
    }

    fn dampers(&self, model: &Model) -> Vec<Damper> {
        let of = |row: &RowModel| {
            Some(Damper {
                name: format!("row{}.contact.squeeze", model.balls[row.first].row),
                body: row.first_body(),
                rate: rate(model, row)?,
            })
        };
        model.rows.iter().filter_map(of).collect()
    }

    fn at_start(&self, _model: &Model, _race: Race) -> RingWrench {
        RingWrench::default()
    }

    fn asymmetry(&self, _model: &Model) -> Asymmetry {
        Asymmetry::default()
    }
}

/// Rate at which films on both sides end the motion of a ball of a row that just touches \[1/s\]; none without films.
fn rate(model: &Model, row: &RowModel) -> Option<f64> {
    let film = &row.squeeze.as_ref()?.film;
    Some(2.0 * film.damping / model.bodies[row.first_body()].mass[Dof::X])
}

/// The largest such rate of any row \[1/s\]; 0 without films.
pub(crate) fn fastest(model: &Model) -> f64 {
    let rates = model.rows.iter().filter_map(|row| rate(model, row));
    rates.fold(0.0, f64::max)
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

/// Films of a row: in registers on smooth and parallel tori, else eight balls at a time.
struct RowFilms<'a> {
    squeeze: &'a SqueezeModel,
    row: &'a RowModel,
    state: &'a State,
    /// Rings that may tilt; none where they stay parallel.
    rings: Option<[&'a TiltedRing; 2]>,
    forces: &'a mut Table,
}

impl RowFilms<'_> {
    /// Places and velocities of eight balls as a ring sees them, and the speed at which its mark turns there.
    #[inline(always)]
    fn seen<const FMA: bool>(&self, first: BodyId, race: Race) -> ([[Lanes; 3]; 2], f64) {
        let (q, v) = (&self.state.q, &self.state.v);
        let of = |half: &Table| Dof::TRANSLATIONS.map(|dof| half.eight(first, dof));
        let (place, velocity) = (of(q), of(v));
        if let Some(rings) = self.rings {
            let [place, velocity, _] = rings[race].see::<_, FMA>(place, velocity, [Lanes::ZERO; 3]);
            return ([place, velocity], 0.0);
        }
        let ring = race.ring();
        let from = |half: &Table, own: [Lanes; 3]| {
            let [x, y, z] = Dof::TRANSLATIONS.map(|dof| -half.get(ring, dof));
            [own[0] + x, own[1] + y, own[2] + z]
        };
        ([from(q, place), from(v, velocity)], v.get(ring, Dof::Theta))
    }

    /// Raise of a race under eight balls \[m\], and how fast they meet it rise \[m/s\].
    #[inline(always)]
    fn waves<const FMA: bool>(
        &self,
        race: Race,
        [[x, y, _], [vx, vy, _]]: [[Lanes; 3]; 2],
        omega: f64,
    ) -> [Lanes; 2] {
        let waves = &self.row.pairs[race].waves;
        if waves.is_round() {
            return [Lanes::ZERO; 2];
        }
        let Raise { height, slope } =
            waves.under::<FMA>([x, y], self.state.q.get(race.ring(), Dof::Theta));
        let turns = (x * vy - y * vx) / (x * x + y * y) + -omega;
        [height, slope * turns]
    }
}

impl Task for RowFilms<'_> {
    /// Force on each ring and its moment about the origin, in the ring's frame.
    type Output = [[Vector3<f64>; 2]; 2];

    #[inline(always)]
    fn run<const FMA: bool>(self) -> Self::Output {
        let (film, row) = (&self.squeeze.film, self.row);
        let mut sums = [[[Lanes::ZERO; 3]; 2]; 2];
        for from in (0..row.count).step_by(LANES) {
            let first = row.first_body().after(from);
            let there = Mask::from_fn(|lane| from + lane < row.count);
            let radius = Lanes::from_slice(&self.squeeze.radii[from..]);
            let mut on_balls = [Lanes::ZERO; 3];
            for race in Race::BOTH {
                let (motion, omega) = self.seen::<FMA>(first, race);
                let waves = self.waves::<FMA>(race, motion, omega);
                let mut own = [Lanes::ZERO; 3];
                for flank in row.pairs[race].flanks() {
                    let film = Squeezed::new::<FMA>(film, flank, radius, motion, waves);
                    for (sum, part) in own.iter_mut().zip(film.on_ring()) {
                        *sum += there.choose(part, Lanes::ZERO);
                    }
                }
                let ([x, y, z], [fx, fy, fz]) = (motion[0], own);
                let moment = [y * fz - z * fy, z * fx - x * fz, x * fy - y * fx];
                let on_ball = match self.rings {
                    None => own,
                    Some(rings) => rings[race].rotation.frame.all_to_scene::<_, FMA>(own),
                };
                for i in 0..3 {
                    sums[race][0][i] += own[i];
                    sums[race][1][i] += there.choose(moment[i], Lanes::ZERO);
                    on_balls[i] = on_balls[i] - on_ball[i];
                }
            }
            for (dof, force) in Dof::TRANSLATIONS.into_iter().zip(on_balls) {
                let to = &mut self.forces.along_mut(dof)[first.index()..];
                (Lanes::from_slice(to) + force).to_slice(to);
            }
        }
        sums.map(|ring| ring.map(|of| Vector3::from(of.map(Lanes::sum))))
    }
}

impl Wide for RowFilms<'_> {
    /// Force on each ring and no moment, as of the [`Task`].
    type Output = [[Vector3<f64>; 2]; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let (film, row) = (&self.squeeze.film, self.row);
        let zero = Vector::all(simd, 0.0);
        let (places, speeds) = (self.state.q.directions(), self.state.v.directions());
        let [fx, fy, fz, _] = self.forces.directions_mut();
        let first = row.first_body().index();
        let mut on_rings = [[zero; 3]; 2];
        // Plain loops: closures over registers are not always taken into the function that has the instructions.
        for from in (0..row.count).step_by(Vector::<S>::LANES) {
            let body = first + from;
            let left = Vector::all(simd, (row.count - from) as f64 - 0.5);
            let there = Vector::count(simd).below(left);
            let radius = Vector::load(simd, &self.squeeze.radii[from..]);
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
                let own = Squeezed::new::<true>(film, pair, radius, motion, [zero; 2]).on_ring();
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
        let mut sums = [[Vector3::zeros(); 2]; 2];
        for (sum, of) in sums.iter_mut().zip(on_rings) {
            for (i, of) in of.into_iter().enumerate() {
                sum[0][i] = of.sum();
            }
        }
        sums
    }
}
