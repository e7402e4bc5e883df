//! Eight contacts gathered from anywhere, and evaluated together.

use super::{RingView, Single, View};
use crate::contact::{
    Across, BatchForces, Constants, Contour, EightContacts, FilmNumbers, FrictionWeights, Pair,
    Raise, RingLanes,
};
use crate::model::{Ball, BodyId, Model, Race};
use crate::simd::{LANES, Lanes, Mask, Task};

/// Constants of all contacts with one ring.
#[derive(Debug, Clone)]
pub(crate) struct SideConstants {
    /// Constants of each ball, by its number among all.
    pub balls: Vec<Constants<f64>>,
    /// Constants that the balls of a class of rows share, by class.
    classes: Vec<ClassConstants>,
    /// Films of rows, where they have any.
    films: Vec<Option<FilmNumbers<f64>>>,
    /// The rows of balls.
    rows: Vec<usize>,
}

/// Constants that the contacts of a class of rows share.
// Each is a question of its own.
#[allow(clippy::struct_excessive_bools)]
#[derive(Debug, Clone)]
struct ClassConstants {
    /// Constants of the first ball in all lanes.
    first: Constants<Lanes>,
    /// Whether the constants of all balls are the same but for the axial place, so that nothing else need be gathered.
    alike: bool,
    /// Whether any race has waves.
    wavy: bool,
    /// Whether any ball has a texture.
    textured: bool,
    /// The film of the first row in all lanes, if it has one.
    film: Option<FilmNumbers<Lanes>>,
    /// Whether the other rows have that very film.
    one_film: bool,
}

#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Touching {
    pub ball: usize,
    /// Height and slope of the race's waves under the ball, and of the ball's texture before the race.
    pub raise: Raise<f64>,
    pub swell: Raise<f64>,
}

/// Group of up to eight contacts, first those with the outer ring and then those with the inner; the last one fills the lanes that are left.
#[derive(Debug, Clone, Default)]
pub(super) struct Group {
    /// The class of their rows.
    class: usize,
    pub contacts: [Touching; LANES],
    pub count: usize,
    /// Lanes with the outer ring.
    outer: usize,
    pub forces: BatchForces,
    /// Angular velocities of the balls across the axis of a ring that may tilt \[rad/s\].
    pub turning: Across,
    /// Moments across the axis of a ring that may tilt, on balls in its frame, and on the ring about the frame's origin.
    pub across: [Across; 2],
    friction_weight: FrictionWeights,
}

impl Group {
    /// Takes over contacts with either ring, not more than eight and not none.
    pub fn take(&mut self, class: usize, [outer, inner]: [&[Touching]; 2]) {
        (self.class, self.count) = (class, outer.len() + inner.len());
        self.outer = if inner.is_empty() { LANES } else { outer.len() };
        self.contacts[..outer.len()].copy_from_slice(outer);
        self.contacts[outer.len()..self.count].copy_from_slice(inner);
        let last = self.contacts[self.count - 1];
        self.contacts[self.count..].fill(last);
    }

    /// The race of the contact in a lane.
    #[inline]
    pub fn race(&self, lane: usize) -> Race {
        if lane < self.outer {
            Race::Outer
        } else {
            Race::Inner
        }
    }

    /// Lanes with the outer ring, where others are with the inner.
    #[inline]
    fn both(&self) -> Option<Mask> {
        let outer = self.outer;
        (0 < outer && outer < LANES).then(|| Mask::from_fn(|lane| lane < outer))
    }
}

/// Whether contacts of the rows of a class with both races follow the same equations, so that they may be evaluated side by side.
pub(super) fn mixes(model: &Model, class: usize) -> bool {
    let [outer, inner] = &model.rows[class].pairs;
    let film = outer.law.film.is_some() || inner.law.film.is_some();
    model.rows[class].class == class && !film && outer.shape.is_torus() && outer.is_like(inner)
}

impl SideConstants {
    pub fn new(model: &Model, race: Race) -> Self {
        let of = |ball: &Ball| model.rows[ball.row].pairs[race].constants(ball.side.radius);
        let balls: Vec<_> = model.balls.iter().map(of).collect();
        let films: Vec<_> = model
            .rows
            .iter()
            .map(|row| numbers_of(&row.pairs[race]))
            .collect();
        let class = |class: usize| ClassConstants::new(model, race, &balls, &films, class);
        Self {
            classes: (0..model.rows.len()).map(class).collect(),
            balls,
            films,
            rows: model.balls.iter().map(|ball| ball.row).collect(),
        }
    }

    /// Takes over the radii of races and the numbers of their films.
    pub fn update_films(&mut self, model: &Model, race: Race) {
        for (of, ball) in self.balls.iter_mut().zip(&model.balls) {
            of.r = model.rows[ball.row].pairs[race].race.r;
        }
        for (class, of) in self.classes.iter_mut().enumerate() {
            of.first.r = Lanes::all(model.rows[class].pairs[race].race.r);
        }
        for (of, row) in self.films.iter_mut().zip(&model.rows) {
            *of = numbers_of(&row.pairs[race]);
        }
        for (class, of) in self.classes.iter_mut().enumerate() {
            of.film = in_all_lanes(self.films[class].as_ref());
        }
    }

    /// Gathers eight contacts as they are seen, into place: they are too large to be handed on by value.
    #[inline(always)]
    pub fn eight(
        &self,
        class: usize,
        contacts: &[Touching; LANES],
        view: &View<'_>,
        eight: &mut EightContacts,
    ) {
        let ClassConstants {
            first,
            alike,
            wavy,
            textured,
            film,
            one_film,
        } = &self.classes[class];
        let ([x, y, z, _], v) = (view.q.directions(), view.v.directions());
        let q = [x, y, z];
        (eight.constants, eight.wavy) = (*first, *wavy);
        if *textured {
            let mut swell = Raise::default();
            for (lane, contact) in contacts.iter().enumerate() {
                swell.set(lane, contact.swell);
            }
            eight.swell = Some(swell);
        }
        if film.is_some() {
            eight.film = *film;
        }
        for (lane, contact) in contacts.iter().enumerate() {
            let of = &self.balls[contact.ball];
            if *alike {
                eight.constants.centre[lane] = of.centre;
            } else {
                eight.constants.set(lane, of);
            }
            if !*one_film
                && let (Some(to), Some(film)) =
                    (&mut eight.film, &self.films[self.rows[contact.ball]])
            {
                to.set(lane, film);
            }
            if *wavy {
                eight.raise.set(lane, contact.raise);
            }
            let body = BodyId::ball(contact.ball).index();
            for (to, from) in eight.q.iter_mut().zip(q) {
                to[lane] = from[body];
            }
            for (to, from) in eight.v.iter_mut().zip(v) {
                to[lane] = from[body];
            }
        }
    }

    /// Gives lanes that are not `others` the constants and waves of contacts with this ring; places and speeds of balls are gathered.
    #[inline(always)]
    fn beside(
        &self,
        class: usize,
        contacts: &[Touching; LANES],
        others: Mask,
        eight: &mut EightContacts,
    ) {
        let of = &self.classes[class];
        eight.constants = eight.constants.or(others, &of.first);
        for lane in others.not().lanes() {
            let contact = &contacts[lane];
            if of.alike {
                eight.constants.centre[lane] = self.balls[contact.ball].centre;
            } else {
                eight.constants.set(lane, &self.balls[contact.ball]);
            }
            eight.raise.set(lane, contact.raise);
        }
        eight.wavy |= of.wavy;
    }
}

impl ClassConstants {
    fn new(
        model: &Model,
        race: Race,
        balls: &[Constants<f64>],
        films: &[Option<FilmNumbers<f64>>],
        class: usize,
    ) -> Self {
        let own = balls[model.rows[class].first];
        let mut first = Constants::default();
        (0..LANES).for_each(|lane| first.set(lane, &own));
        let rows = || model.rows.iter().filter(|row| row.class == class);
        let own_film = model.rows[class].pairs[race].law.film;
        let like = |other: &Constants<f64>| {
            let centre = own.centre;
            Constants { centre, ..*other } == own
        };
        Self {
            first,
            alike: rows().all(|row| balls[row.balls()].iter().all(like)),
            wavy: rows().any(|row| !row.pairs[race].waves.is_round()),
            textured: rows().any(|row| model.has_textured_balls(row)),
            film: in_all_lanes(films[class].as_ref()),
            one_film: rows().all(|row| row.pairs[race].law.film == own_film),
        }
    }
}

/// Numbers of the film on a race, if it has one.
fn numbers_of(pair: &Pair) -> Option<FilmNumbers<f64>> {
    pair.law.film.as_ref().map(FilmNumbers::new)
}

fn in_all_lanes(film: Option<&FilmNumbers<f64>>) -> Option<FilmNumbers<Lanes>> {
    let mut lanes = FilmNumbers::default();
    film.map(|film| {
        (0..LANES).for_each(|lane| lanes.set(lane, film));
        lanes
    })
}

/// Hands over the contacts that were not regular, to be evaluated one by one.
pub(super) fn leave(groups: &[Group], singles: &mut Vec<Single>) {
    for group in groups {
        let lanes = group
            .forces
            .left_out
            .lanes()
            .filter(|lane| *lane < group.count);
        singles.extend(lanes.map(|lane| Single::new(group.race(lane), group.contacts[lane].ball)));
    }
}

/// Evaluates a group on a race that is a hollow curve.
struct EightOnCurve<'a, const TILTED: bool>(Eight<'a, TILTED>, &'a Contour);

impl<const TILTED: bool> Task for EightOnCurve<'_, TILTED> {
    type Output = ();

    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Self(evaluated, contour) = self;
        let mut eight = EightContacts::default();
        evaluated.gather(&mut eight);
        let Eight { group, of } = evaluated;
        let model = of.model;
        let race = group.race(0);
        let (pair, view) = (&model.rows[group.class].pairs[race], &of.views[race]);
        let (instructions, weights) = (model.instructions, &mut group.friction_weight);
        let ring = &view.ring;
        if TILTED {
            let turning = group.turning;
            (group.forces, group.across) = pair.forces_on_curve_tilted::<FMA>(
                &eight,
                turning,
                ring,
                contour,
                instructions,
                weights,
            );
        } else {
            group.forces =
                pair.forces_on_curve::<FMA>(&eight, ring, contour, instructions, weights);
        }
    }
}

/// Evaluates groups.
#[derive(Clone, Copy)]
pub(super) struct EvaluateEight<'a> {
    pub constants: &'a [SideConstants; 2],
    pub symmetric: bool,
    pub model: &'a Model,
    pub views: &'a [View<'a>; 2],
}

impl EvaluateEight<'_> {
    /// Evaluates one group, as `TILTED` says before a ring that may tilt.
    pub fn run<const TILTED: bool>(&self, group: &mut Group) {
        let curve = self.model.rows[group.class].pairs[group.race(0)].hollow_curve();
        let (instructions, of) = (self.model.instructions, self);
        match curve {
            // Rings that tilt have no symmetry.
            None if self.symmetric => instructions.run(SymmetricEight(Eight { group, of })),
            None => instructions.run(Eight::<TILTED> { group, of }),
            Some(contour) => {
                let eight = Eight::<TILTED> { group, of };
                instructions.run(EightOnCurve(eight, contour));
            }
        }
    }
}

/// A group and what evaluates it.
struct Eight<'a, const TILTED: bool> {
    group: &'a mut Group,
    of: &'a EvaluateEight<'a>,
}

/// Turns forces on balls into the scene's frame, and moments on those that spin freely; on others they act about the ring's axis.
///
/// A program of its own: in that of the contacts the compiler would split whole registers.
pub(super) struct ToScene<'a> {
    pub group: &'a mut Group,
    pub ring: &'a RingView,
}

impl Task for ToScene<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const FMA: bool>(self) {
        let Self { group, ring } = self;
        let [x, y, z, _] = group.forces.ball;
        let force = ring.frame().all_to_scene::<_, FMA>([x, y, z]);
        group.forces.ball[..3].copy_from_slice(&force);
        if ring.balls_turn() {
            let [across, _] = &mut group.across;
            let moment = [across[0], across[1], group.forces.ball[3]];
            let [x, y, z] = ring.frame().all_to_scene::<_, FMA>(moment);
            (*across, group.forces.ball[3]) = ([x, y], z);
        }
    }
}

impl<const TILTED: bool> Eight<'_, TILTED> {
    /// Gathers the contacts.
    #[inline(always)]
    fn gather(&self, eight: &mut EightContacts) {
        let (group, race) = (&self.group, self.group.race(0));
        // Parallel rings see the same balls.
        let view = &self.of.views[race];
        self.of.constants[race].eight(group.class, &group.contacts, view, eight);
        if let Some(outer) = group.both() {
            self.of.constants[Race::Inner].beside(group.class, &group.contacts, outer, eight);
        }
        // Lanes left over must not count as pulling.
        for lane in group.count..LANES {
            eight.constants.radius[lane] *= 0.5;
        }
    }

    /// Evaluates them before rings that stand parallel.
    #[inline(always)]
    fn parallel<const FMA: bool, const SYMMETRIC: bool>(self) {
        let mut eight = EightContacts::default();
        self.gather(&mut eight);
        let Self { group, of } = self;
        let race = group.race(0);
        let pair = &of.model.rows[group.class].pairs[race];
        let mut ring = RingLanes::of(&of.views[race].ring, pair.race.sigma);
        if let Some(outer) = group.both() {
            let inner = RingLanes::of(&of.views[Race::Inner].ring, Race::Inner.sigma());
            ring = ring.or(outer, &inner);
        }
        let (instructions, weights) = (of.model.instructions, &mut group.friction_weight);
        group.forces = pair.forces::<FMA, SYMMETRIC>(&eight, &ring, instructions, weights);
    }
}

impl<const TILTED: bool> Task for Eight<'_, TILTED> {
    type Output = ();

    #[inline(always)]
    fn run<const FMA: bool>(self) {
        if !TILTED {
            self.parallel::<FMA, false>();
            return;
        }
        let mut eight = EightContacts::default();
        self.gather(&mut eight);
        let Self { group, of } = self;
        let race = group.race(0);
        let pair = &of.model.rows[group.class].pairs[race];
        let (instructions, weights) = (of.model.instructions, &mut group.friction_weight);
        let (turning, ring) = (group.turning, &of.views[race].ring);
        (group.forces, group.across) =
            pair.forces_tilted::<FMA>(&eight, turning, ring, instructions, weights);
    }
}

/// Evaluates groups of balls in the middle of their grooves.
struct SymmetricEight<'a>(Eight<'a, false>);

impl Task for SymmetricEight<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const FMA: bool>(self) {
        self.0.parallel::<FMA, true>();
    }
}
