//! The laws of one contact against closed forms.

use ballrace::compile;
use ballrace::contact::Shape;
use ballrace::contact::hertz::Hertz;
use ballrace::contact::{
    BallSide, ContactForce, Elastic, Law, Motion, Pair, Rules, Sink, Torus, Waves, ZoneSlices,
};
use ballrace::inspect;
use ballrace::scene::{Component, Friction, MotionProbe, NormalLaw, presets};
use ballrace::{Race, Start, start};

#[derive(Default)]
struct Total {
    radial: f64,
    axial: f64,
}

impl Sink for Total {
    fn force(&mut self, force: &ContactForce) {
        self.radial += force.normal * force.share.0;
        self.axial += force.normal * force.share.1;
    }
}

fn still(x: f64, z: f64) -> Motion {
    Motion::new(&[x, 0.0, z, 0.0], &[0.0; 4])
}

/// Magnitude of the force of the Hertz law at an approach and an operating angle.
fn hertz_force(slices: ZoneSlices, approach: f64, angle: f64) -> (f64, Hertz) {
    let steel = ballrace::scene::Material::default();
    let law = Hertz::new(1.0, 11.9e-3, 63e-3, 0.53, 0.0, &steel, &steel);
    let (r, radius) = (0.53 * 11.9e-3, 5.95e-3);
    let race = Torus {
        sigma: 1.0,
        a: 31.5e-3 - (r - radius),
        centre: 0.0,
        r,
        lowest: -r,
        highest: r,
    };
    let pair = Pair {
        race,
        shape: Shape::default(),
        waves: Waves::default(),
        law: Law::elastic(Elastic::Hertz(law)),
        slices,
        defects: Vec::new(),
    };
    let reach = r - radius + approach;
    let mut total = Total::default();
    let ball = BallSide::whole(radius);
    let place = still(race.a + reach * angle.cos(), reach * angle.sin());
    pair.evaluate(&ball, &place, &still(0.0, 0.0), &mut total);
    (total.radial.hypot(total.axial), law)
}

/// Analytic: F = K δ^{3/2} at every load and angle, exactly on fitted nodes and to 5e-3 on 50 fixed slices.
#[test]
fn hertz_law_is_hertz() {
    for approach in [2e-6, 10e-6, 50e-6] {
        for degrees in [0.0_f64, 15.0, 40.0] {
            let angle = degrees.to_radians();
            let (fitted, law) =
                hertz_force(ZoneSlices::Fitted(Rules::new(4, 1.0)), approach, angle);
            let exact = law.stiffness * approach.powf(1.5);
            assert!(
                (fitted / exact - 1.0).abs() < 1e-10,
                "{approach} {degrees}: {}",
                fitted / exact - 1.0
            );
            // A contact of a micrometre is as wide as a slice.
            if approach > 20e-6 {
                let (fixed, _) = hertz_force(ZoneSlices::Fixed(50), approach, angle);
                assert!(
                    (fixed / exact - 1.0).abs() < 5e-3,
                    "{degrees}: {}",
                    fixed / exact - 1.0
                );
            }
        }
    }
}

/// Analytic: Hertz's contact is flat, so a zone that reaches past the pole of ball and groove keeps all of F = K δ^{3/2}.
#[test]
fn hertz_law_has_no_pole() {
    for approach in [10e-6, 50e-6] {
        for degrees in [55.0_f64, 70.0, 80.0, 85.0] {
            let rules = Rules::new(6, 1.0);
            let (fitted, law) =
                hertz_force(ZoneSlices::Fitted(rules), approach, degrees.to_radians());
            let exact = law.stiffness * approach.powf(1.5);
            let off = fitted / exact - 1.0;
            assert!(off.abs() < 1e-10, "{approach} {degrees}: {off}");
        }
    }
    let (_, law) = hertz_force(ZoneSlices::Fitted(Rules::new(6, 1.0)), 50e-6, 1.2);
    assert!(law.half_zone(50e-6) > 20_f64.to_radians() * 5.95e-3);
}

/// Analytic: pure rolling at the nominal angle slips nowhere at the centres of both contacts.
#[test]
fn rolling_start_does_not_slip() {
    let mut scene = presets::wheel_bearing(0.0);
    scene.defects.clear();
    // A press of a few micrometres at the nominal angle makes a short zone around the contact's centre.
    scene.contact.law = NormalLaw::Hertz;
    scene.friction = Friction::Coulomb {
        coefficient: 0.1,
        slip_speed: 0.1,
    };
    scene.rows[0].clearance = -4e-6;
    scene.probes = [(
        "outer".to_owned(),
        MotionProbe::of("outer").components([Component::X]).into(),
    )]
    .into();
    let model = compile(&scene).unwrap();
    let y = start(&model, &Start::Rolling).unwrap();
    for race in Race::BOTH {
        let contact = inspect::contact(&model, &y, 3, race).unwrap();
        assert!(contact.load > 1.0);
        assert!(
            (contact.angle.to_degrees() - 13.0).abs() < 0.2,
            "{contact:?}"
        );
        // The zone's ends slip a little (Heathcote), 1 % of the 2.3 m/s of ball and cage.
        assert!(contact.slip < 0.025, "{contact:?}");
        let mut skidding = y.clone();
        skidding[y.len() / 2 + 4 * 5 + 3] *= 0.9;
        assert!(
            inspect::contact(&model, &skidding, 3, race).unwrap().slip > 0.15,
            "a wrong spin must slip"
        );
    }
}
