//! Friction of a contact on few nodes against 200 that have no weights of their own for it (`contact::quadrature`).

use crate::common;
use ballrace::contact::hertz::Hertz;
use ballrace::contact::iso16281::Iso16281;
use ballrace::contact::{
    BallSide, ContactForce, Damping, Elastic, Law, Motion, Pair, Rules, Shape, Sink, SurfaceDefect,
    Torus, Traction, Waves, ZoneSlices,
};
use ballrace::dynamics::contributions;
use ballrace::scene::{Defect, Friction, Material, Patch, Surface};
use ballrace::{Start, compile, start};
use common::{Noise, apart, soon_over_the_spall};

/// Ball radius \[m\].
const RADIUS: f64 = 6e-3;
const MU: f64 = 0.05;

/// A contact that slips.
#[derive(Debug, Clone)]
struct Case {
    pair: Pair,
    /// Axial place of the ball \[m\].
    z: f64,
    ball: Motion,
    ring: Motion,
}

/// Friction on the ball along x, y and z, normal force, and what friction takes out.
#[derive(Debug, Default)]
struct Sum {
    friction: [f64; 3],
    normal: f64,
    power: f64,
}

impl Sink for Sum {
    fn force(&mut self, force: &ContactForce) {
        for (sum, part) in self.friction.iter_mut().zip(force.friction_on_ball()) {
            *sum += part;
        }
        self.normal += force.normal;
        self.power += force.friction_power;
    }
}

impl Case {
    /// A ball on a race at a contact angle, pressed by `approach` \[m\]; it spins at 300 to 600 rad/s and rolls so that it slips
    /// by `slide` \[m/s\] at the common normal.
    fn new(elastic: Elastic, sigma: f64, angle: f64, approach: f64, slide: f64, spin: f64) -> Self {
        let race = Torus {
            sigma,
            a: 30e-3,
            centre: 0.0,
            r: 2.0 * 0.52 * RADIUS,
            lowest: -0.9 * RADIUS,
            highest: 0.9 * RADIUS,
        };
        let l = race.r - RADIUS + approach;
        let distance = race.a + sigma * l * angle.cos();
        // Slip at the normal: across + spin · arm, with the ring at rest.
        let arm = sigma * RADIUS * angle.cos();
        let z = l * angle.sin();
        let slid = sigma * slide - spin * arm;
        Self {
            z,
            ball: Motion::new(&[distance, 0.0, z, 0.0], &[0.003, slid, 0.005, spin]),
            ring: Motion::new(&[0.0; 4], &[0.0; 4]),
            pair: Pair {
                race,
                shape: Shape::default(),
                waves: Waves::default(),
                law: Law {
                    damping: Damping {
                        coefficient: 0.2,
                        clamp_pull: true,
                    },
                    ..Law::elastic(elastic)
                },
                slices: ZoneSlices::Fixed(10),
                defects: Vec::new(),
            },
        }
    }

    fn slip_speed(mut self, slip_speed: f64) -> Self {
        let coefficient = MU;
        self.pair.law.traction = Traction::new(&Friction::Coulomb {
            coefficient,
            slip_speed,
        });
        self
    }

    fn sum(&self, nodes: usize, finer: usize) -> Sum {
        let mut pair = self.pair.clone();
        let exponent = pair.law.elastic.exponent();
        pair.slices = ZoneSlices::Fitted(Rules::for_friction(nodes, exponent, finer));
        let mut sum = Sum::default();
        let side = BallSide::whole(RADIUS);
        pair.evaluate(&side, &self.ball, &self.ring, &mut sum);
        sum
    }

    /// Error of friction over μ ∫F, of nodes with weights for friction from rules of so many nodes more.
    fn error(&self, nodes: usize, finer: usize) -> [f64; 3] {
        let (few, many) = (self.sum(nodes, finer), self.sum(200, 0));
        assert!(few.power > 0.0, "{self:?}");
        assert!(many.normal > 0.0);
        [0, 1, 2].map(|i| (few.friction[i] - many.friction[i]) / (MU * many.normal))
    }
}

fn laws() -> [Elastic; 2] {
    [
        Elastic::Iso16281(Iso16281::new(3.5948e10, 0.5, 2.0 * RADIUS)),
        Elastic::Hertz(hertz()),
    ]
}

/// Steel on the outer race of these cases, at any angle.
fn hertz() -> Hertz {
    let steel = Material::default();
    Hertz::new(1.0, 2.0 * RADIUS, 60e-3, 0.52, 0.3, &steel, &steel)
}

/// A spall of 1 mm under the ball, from −z of some place on.
fn spall(end: f64) -> SurfaceDefect {
    let defect = Defect::of(
        Patch::of_width(1e-3).length(6e-3).edge_radius(0.3e-3),
        Surface::OuterRace,
        0.0,
    )
    .at_offset(0.0);
    SurfaceDefect::new(&defect, end - 3e-3, 36e-3)
}

fn random(law: Elastic, noise: &mut Noise, angles: [f64; 2]) -> Case {
    let sigma = noise.next().signum();
    let angle = noise.between(angles[0], angles[1]).to_radians();
    let approach = noise.between(5e-6, 30e-6);
    let slide = 0.1 * noise.next();
    Case::new(
        law,
        sigma,
        angle,
        approach,
        slide,
        noise.between(200.0, 600.0),
    )
}

/// What is random in a family of contacts.
struct Family {
    name: &'static str,
    /// Contact angles \[°\].
    angles: [f64; 2],
    slip_speed: f64,
    /// Whether a spall ends within the zone.
    cut: bool,
    /// Nodes beyond those of a rule, as a scene has them where slip sweeps over so many slip speeds.
    finer: usize,
}

impl Family {
    /// Greatest error of friction over μ ∫F.
    fn error(&self, nodes: usize, finer: usize) -> f64 {
        let (mut noise, mut worst) = (Noise(3), 0.0_f64);
        for _ in 0..20 {
            for law in laws() {
                let mut case = random(law, &mut noise, self.angles).slip_speed(self.slip_speed);
                if self.cut {
                    let race = &case.pair.race;
                    let middle = case.z / (race.r - RADIUS) * race.r;
                    case.pair.defects = vec![spall(middle + noise.between(-4e-4, 4e-4))];
                }
                worst = worst.max(size(case.error(nodes, finer)));
            }
        }
        worst
    }
}

fn size(parts: [f64; 3]) -> f64 {
    parts.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// Truth: 200 plain nodes. To 1e-3 on six and 1e-4 on eight nodes, where plain ones miss friction by percents.
#[test]
fn few_nodes_resolve_friction() {
    let family = |name, angles, slip_speed, cut, finer| Family {
        name,
        angles,
        slip_speed,
        cut,
        finer,
    };
    for family in [
        family("spin", [15.0, 40.0], 0.1, false, 20),
        family("level", [0.0, 0.0], 0.1, false, 20),
        family("two zeros", [-3.0, 3.0], 0.03, false, 20),
        family("steep", [-40.0, 40.0], 0.03, false, 70),
        family("very steep", [-40.0, 40.0], 0.025, false, 100),
        family("cut", [-40.0, 40.0], 0.1, true, 20),
    ] {
        let [six, eight] = [6, 8].map(|nodes| family.error(nodes, family.finer));
        let plain = family.error(6, 0);
        println!("{}: {plain:.1e} plain, {six:.1e}, {eight:.1e}", family.name);
        assert!(six < 1e-3 && eight < 1e-4, "{}", family.name);
    }
}

/// Along a path on which the zeros of slip come into the zone, meet and leave it, nothing jumps.
#[test]
fn friction_is_continuous() {
    for (law, angle) in laws().into_iter().flat_map(|law| [(law, 0.02), (law, 0.4)]) {
        let along = |k: i32| {
            let slide = f64::from(k) * 5e-4;
            let case = Case::new(law, 1.0, angle, 20e-6, slide, 500.0).slip_speed(0.03);
            case.error(6, 40)
        };
        let (mut before, mut steepest, mut worst) = (along(-1000), 0.0_f64, 0.0_f64);
        for k in -999..=1000 {
            let now = along(k);
            steepest = steepest.max(size([0, 1, 2].map(|i| now[i] - before[i])));
            worst = worst.max(size(now));
            before = now;
        }
        println!("{angle}: {worst:.1e}, {steepest:.1e} a step");
        // A step of 0.5 mm/s is a sixtieth of the slip speed.
        assert!(worst < 1e-3 && steepest < 1e-4);
    }
}

/// Friction of all contacts on the outer ring over its size, at states around a roll, with a spall under a ball and without.
#[test]
fn a_bearing_has_the_friction_of_many_nodes() {
    let friction = |nodes: usize| {
        let mut scene = soon_over_the_spall(3000.0);
        scene.contact.slices = ballrace::scene::Slices::Fitted(nodes);
        let model = compile(&scene).unwrap();
        let mut noise = Noise(1);
        let calm = start(&model, &Start::Equilibrium).unwrap();
        let mut all = Vec::new();
        for _ in 0..10 {
            let (mut y, half) = (calm.clone(), calm.len() / 2);
            for i in 0..half {
                let (place, speed) = if i % 4 < 3 { (2e-6, 0.01) } else { (0.02, 1.0) };
                y[i] += place * noise.next();
                y[half + i] += speed * noise.next();
            }
            let parts = contributions(&model, 0.0, &y);
            let of = parts.iter().find(|(name, _)| *name == "friction").unwrap();
            all.extend_from_slice(&of.1[..3]);
        }
        all
    };
    let truth = friction(64);
    for (nodes, most) in [(6, 1e-3), (8, 1e-4)] {
        let off = apart(&friction(nodes), &truth);
        println!("{nodes}: {off:.1e}");
        assert!(off < most, "{nodes}: {off:e}");
    }
}
