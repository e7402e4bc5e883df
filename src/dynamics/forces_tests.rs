//! Analytic: each force of the list is what it says of itself. Its account answers for its work, its wrench at the start is what it adds
//! there, and what it says of symmetries holds. A force without a scene here fails, so that none is left out.

use nalgebra::Vector3;

use super::rhs;
use crate::forces::{self, Account, Force, ForceSums, Instant, State, Table, Use, drag};
use crate::model::{BodyId, Dof, Model, Race};
use crate::scene::{
    Cage, CageRing, Drive, Friction, Load, Lubricant, Mode, Moment, Mount, Profile, RingName, Row,
    Scene, SqueezeFilm, Structure, Support, TableForce, TimeFunction, Unbalance,
};
use crate::statics::compile;
use crate::statics::start::{Start, start};

/// A row between rings that nothing holds, the inner one driven, with no other force than contacts.
fn bare() -> Scene {
    let mut scene = Scene::new(
        vec![Row::new(9, 7.94e-3, 39.04e-3, 0.525, 0.515)],
        Drive::Speed(190.0.into()),
    );
    (scene.gravity, scene.cage, scene.friction) = ([0.0; 3], None, Friction::None);
    let free = || Some(Mount::Free);
    scene.outer_ring.support = Support::new([free(), free(), free(), free()]);
    scene.inner_ring.support = Support::new([free(), free(), free(), None]);
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        (ring.mass, ring.inertia) = (Some(0.2), Some(1e-4));
    }
    scene
}

fn with(change: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = bare();
    change(&mut scene);
    scene
}

/// Scene with rings that may tilt, else as given.
fn tilting(mut scene: Scene) -> Scene {
    for ring in [&mut scene.outer_ring, &mut scene.inner_ring] {
        let free = || Some(Mount::Free);
        (ring.support.tilt_x, ring.support.tilt_y) = (free(), free());
        ring.transverse_inertia = Some(7e-5);
    }
    scene
}

fn pushed(direction: [f64; 3], size: impl Into<TimeFunction>, place: Option<[f64; 3]>) -> Scene {
    with(|scene| {
        let mut load = Load::new(RingName::Inner, direction, size);
        load.at = place;
        scene.loads.insert("push".to_owned(), load);
    })
}

fn caged(change: impl FnOnce(&mut CageRing)) -> Scene {
    let mut ring = CageRing::default();
    change(&mut ring);
    with(|scene| scene.cage = Some(Cage::ring(ring)))
}

fn on_springs(scene: &mut Scene) {
    let spring = || {
        Some(Mount::Spring {
            stiffness: 1e7,
            damping: 200.0,
        })
    };
    scene.outer_ring.support = Support::new([spring(), spring(), spring(), Some(Mount::Free)]);
}

fn seated(seat: [f64; 3]) -> Scene {
    with(|scene| {
        on_springs(scene);
        scene.structure = Some(Structure::new(vec![Mode::new(900.0, 0.03, 2.0, seat)]));
    })
}

fn pulled(direction: [f64; 3]) -> Scene {
    with(|scene| {
        let table = TableForce::new(RingName::Outer, direction, [-1e-3, 1e-3], [90.0, -30.0]);
        scene.table_forces.insert("pull".to_owned(), table);
    })
}

fn unbalanced(place: Option<f64>) -> Scene {
    with(|scene| {
        let mut unbalance = Unbalance::new(RingName::Inner, 2e-4, 0.7);
        unbalance.axial_position = place;
        scene.unbalances.insert("key".to_owned(), unbalance);
    })
}

/// Scenes that have a force, with and without the effects that break symmetries.
fn scenes(force: &dyn Force) -> Vec<Scene> {
    let sine = TimeFunction::Profile(Profile::Sine {
        mean: 300.0,
        amplitude: 50.0,
        frequency: 90.0,
        phase: 0.4,
    });
    match force.name() {
        "cage links" => [0.0, 50e-6]
            .map(|play| with(|scene| scene.cage = Some(Cage::new(1e6, 20.0, play))))
            .into(),
        "cage ring" => vec![
            caged(|_| {}),
            caged(|ring| (ring.eccentricity, ring.pocket_clearance) = (1e-4, Some(20e-6))),
        ],
        "drag" => vec![with(|scene| {
            let mut oil = Lubricant::named("vg68", 328.15);
            (oil.fill, oil.reference_load) = (0.3, Some(100.0));
            scene.lubricant = Some(oil);
        })],
        "squeeze films" => vec![with(|scene| {
            scene.contact.squeeze = Some(SqueezeFilm::default());
        })],
        "support" => vec![with(on_springs), tilting(with(on_springs))],
        "structure" => vec![seated([0.5, 1.0, 0.0]), seated([0.5, 1.0, 0.4])],
        "gravity" => [[0.0, -9.81, 0.0], [1.0, 2.0, 9.0]]
            .map(|gravity| with(|scene| scene.gravity = gravity))
            .into(),
        "load" => vec![
            pushed([0.6, -0.8, 0.0], 500.0, None),
            pushed([0.0, 0.6, 0.8], sine, None),
            tilting(pushed([0.6, -0.8, 0.0], 500.0, Some([0.0, 0.0, 4e-3]))),
            tilting(with(|scene| {
                let moment = Moment::new(RingName::Inner, [0.0, 1.0, 0.0], 2.0);
                scene.moments.insert("turn".to_owned(), moment);
            })),
        ],
        "drive" => vec![with(|scene| {
            scene.drive = Drive::Torque {
                value: 2.0.into(),
                initial_speed: 190.0,
            };
        })],
        "ring forces" => vec![pulled([0.6, 0.8, 0.0]), tilting(pulled([0.0, 0.6, 0.8]))],
        "unbalance" => vec![unbalanced(None), tilting(unbalanced(Some(5e-3)))],
        other => panic!("{other} has no scene in this test"),
    }
}

/// Each force with its scenes' models.
fn each() -> impl Iterator<Item = (&'static dyn Force, Model)> {
    let models = |force: &'static dyn Force| {
        let scenes = scenes(force).into_iter();
        scenes.map(move |scene| (force, compile(&scene).unwrap()))
    };
    forces::ALL.into_iter().flat_map(models)
}

/// A state in which all moves, to some way from where it starts, in the plane or out of it too.
fn stirred(model: &Model, in_plane: bool) -> Vec<f64> {
    let mut y = start(model, &Start::Rolling).unwrap();
    let layout = model.layout();
    for (k, (body, dof)) in layout.degrees().enumerate() {
        let is_out = matches!(dof, Dof::Z | Dof::TiltX | Dof::TiltY);
        let (place, speed) = match dof {
            _ if is_out && in_plane => continue,
            Dof::TiltX | Dof::TiltY => (1e-4, 1.0),
            Dof::Theta => (0.1, 20.0),
            _ => (60e-6, 0.2),
        };
        y[layout.at(body, dof)] += place * (1.3 * k as f64).sin();
        y[layout.speed_at(body, dof)] += speed * (1.7 * k as f64 + 1.0).sin();
    }
    model.follow_given(0.0, &mut y);
    y
}

/// Forces and moments that a force adds in a state: on all bodies, and as moments on rings that may tilt.
struct Added {
    on: Table,
    moments: Option<[Vector3<f64>; 2]>,
    state: State,
}

impl Added {
    fn new(force: &dyn Force, model: &Model, y: &[f64]) -> Self {
        let mut state = State::new(model);
        state.read(y);
        let mut on = Table::zeros(model.bodies.len());
        let spatial = model.is_spatial();
        let mut moments = spatial.then(|| [Vector3::zeros(); 2]);
        let tilted = spatial.then(|| Race::BOTH.map(|race| state.tilted(model, race)));
        let at = Instant {
            t: 0.0,
            state: &state,
            rows: model.rows.len(),
            times: 1.0,
            springs: &model.springs,
            rings: tilted.as_ref().map(<[_; 2]>::each_ref),
        };
        let mut others = Table::zeros(model.bodies.len());
        if force.waits_for_others() {
            // Contacts among them.
            let parts = super::contributions(model, 0.0, y);
            let own = force.contribution();
            for (_, part) in parts.iter().filter(|(name, _)| *name != own) {
                for (body, numbers) in model.layout().bodies().zip(part.chunks_exact(4)) {
                    others.add(body, &std::array::from_fn(|i| numbers[i]));
                }
            }
        }
        let mut sums = ForceSums {
            on: &mut on,
            moments: moments.as_mut(),
        };
        force.add_constant(model, &mut sums);
        force.add(model, &at, &mut sums);
        for race in Race::BOTH {
            let others = others.of(race.ring());
            if let Some(wrench) = force.given_others(model, &at, race, &others) {
                sums.add(race, &wrench);
            }
        }
        Self { on, moments, state }
    }

    /// Work on all bodies, and the sum of its parts without their signs \[W\].
    fn work(&self, model: &Model, y: &[f64]) -> [f64; 2] {
        let [mut work, mut size] = [0.0; 2];
        let mut count = |part: f64| (work, size) = (work + part, size + part.abs());
        for body in model.layout().bodies() {
            for dof in Dof::ALL {
                count(self.on.get(body, dof) * self.state.v.get(body, dof));
            }
        }
        for (race, moment) in Race::BOTH.into_iter().zip(self.moments.iter().flatten()) {
            count(moment.dot(&model.tilted(y, race).rotation.angular_velocity()));
        }
        [work, size]
    }

    fn on_ring(&self, race: Race) -> Vector3<f64> {
        Dof::TRANSLATIONS
            .map(|dof| self.on.get(race.ring(), dof))
            .into()
    }

    /// Largest force along z on any body \[N\].
    fn along_z(&self, model: &Model) -> f64 {
        let bodies = model.layout().bodies();
        bodies.fold(0.0, |most, body: BodyId| {
            f64::max(most, self.on.get(body, Dof::Z).abs())
        })
    }

    /// Largest moment that tilts a ring \[N m\].
    fn tilting(&self) -> f64 {
        let moments = self.moments.iter().flatten();
        moments.fold(0.0, |most, moment| f64::max(most, moment.xy().norm()))
    }

    fn is_nothing(&self, model: &Model) -> bool {
        let none = |body: BodyId| self.on.of(body) == [0.0; 4];
        let moments = self.moments.iter().flatten();
        model.layout().bodies().all(none) && moments.clone().all(|of| *of == Vector3::zeros())
    }
}

/// Stored energy of an account \[J\].
fn stored(of: &Account) -> f64 {
    let Account {
        kinetic,
        support,
        cage,
        gravity,
        power: _,
        damping: _,
    } = of;
    kinetic + support + cage + gravity
}

/// Truth: work on the bodies is what is stored less, less what is dissipated; only loads and drives bring energy in.
#[test]
fn the_account_of_a_force_answers_for_its_work() {
    // Of what depends on all other forces, the moment about the axis of a driven ring that tilts changes nothing and is not computed.
    let is_whole =
        |(force, model): &(&dyn Force, Model)| !(force.waits_for_others() && model.is_spatial());
    for (force, model) in each().filter(is_whole) {
        let y = stirred(&model, false);
        let mut dy = vec![0.0; y.len()];
        rhs(&model, 0.0, &y, &mut dy);
        let after = |time: f64| {
            let moved: Vec<f64> = y.iter().zip(&dy).map(|(y, dy)| y + time * dy).collect();
            stored(&force.account(&model, &moved))
        };
        let step = 1e-9;
        let rate = (after(step) - after(-step)) / (2.0 * step);
        let account = force.account(&model, &y);
        let [work, size] = Added::new(force, &model, &y).work(&model, &y);
        assert!(size > 0.0, "{} does nothing", force.name());
        let taken = account.power + account.damping;
        let wanted = match force.name() {
            "load" | "drive" => work,
            // The oil's, which has no account.
            "drag" => -drag::power(&model, &y, 0),
            _ => 0.0,
        };
        let off = (work + rate + taken - wanted).abs() / size;
        assert!(
            off < 1e-5,
            "{}: {off:e} of {size} W; work {work}, rate {rate}, taken {taken}",
            force.name()
        );
        if taken > 0.0 {
            let all = forces::ALL
                .into_iter()
                .flat_map(|force| force.dampers(&model));
            let fastest = all.map(|damper| damper.rate).fold(0.0, f64::max);
            assert!(fastest > 0.0, "{} lists no damper", force.name());
        }
    }
}

/// Truth: what it adds to rings at their places at the start, springs of supports at rest.
#[test]
fn a_force_at_the_start_is_what_it_adds_there() {
    for (force, model) in each() {
        let y = start(&model, &Start::Rolling).unwrap();
        let added = Added::new(force, &model, &y);
        for race in Race::BOTH {
            let [tilt, rates] = [model.rings[race].tilt, [0.0; 2]];
            let motion = model.layout().motion(&y, race.ring());
            let ring = crate::scene::RingMotion {
                angles: [tilt[0], tilt[1], motion.theta],
                rates: [rates[0], rates[1], motion.omega],
                ..Default::default()
            };
            let said =
                force.at_start(&model, race).force + force.at_place(&model, race, &ring).force;
            let found = added.on_ring(race);
            let off = (said - found).norm();
            assert!(
                off <= 1e-9 * (1.0 + found.norm()),
                "{} on the {:?} ring: {said:?} for {found:?} N",
                force.name(),
                RingName::from(race)
            );
        }
    }
}

/// Truth: in a bearing that is alike on both sides of its plane, what is said to be along z or to tilt is there, and nothing else is.
#[test]
fn a_force_breaks_the_symmetries_that_it_says() {
    for (force, model) in each() {
        let y = stirred(&model, true);
        let said = force.asymmetry(&model);
        let added = Added::new(force, &model, &y);
        let (along_z, tilting) = (added.along_z(&model), added.tilting());
        let name = force.name();
        assert_eq!(said.along_z.is_some(), along_z > 0.0, "{name}: {along_z} N");
        if said.tilting.is_none() {
            assert!(tilting < 1e-9, "{name} tilts a ring by {tilting} N m");
        }
        if !said.turns_with_ring {
            let mut turned = y.clone();
            turned[model.layout().at(BodyId::INNER, Dof::Theta)] += 0.7;
            let turned = Added::new(force, &model, &turned);
            let same = |body: BodyId| added.on.of(body) == turned.on.of(body);
            assert!(
                model.layout().bodies().all(same),
                "{name} turns with the ring"
            );
        }
    }
}

/// Truth: a force that a scene does not have adds nothing, and is none of those of a scene with contacts alone.
#[test]
fn a_force_is_used_where_it_adds_something() {
    let bare = compile(&bare()).unwrap();
    for force in forces::ALL {
        assert_eq!(force.used(&bare), Use::Absent, "{}", force.name());
    }
    for (owner, model) in each() {
        assert_ne!(owner.used(&model), Use::Absent, "{}", owner.name());
        let y = stirred(&model, false);
        for force in forces::ALL {
            let added = Added::new(force, &model, &y);
            let account = force.account(&model, &y);
            let is_absent = force.used(&model) == Use::Absent;
            let does_nothing = added.is_nothing(&model) && account == Account::default();
            let names = [force.name(), owner.name()];
            assert_eq!(is_absent, does_nothing, "{names:?}");
        }
    }
}
