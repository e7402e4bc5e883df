//! Ranges of the numbers of all parts of a scene, for the schema of documents.

use std::collections::BTreeMap;
use std::ops::Bound;

use serde_json::{Map, Value, json};

use super::numbers::BoundedNumber;
use super::{
    CageLinks, CageRing, Cap, Contact, CoupledSupport, Damage, Defect, Dent, Drive, Floor,
    Friction, GothicArch, Load, Lubricant, Material, Mode, Mount, NormalLaw, Patch, Pit,
    RaceProfile, Ring, RingName, Row, Scene, Slices, SlicesProbe, Solver, SqueezeFilm, SteepPatch,
    Surface, TableForce, Texture, Unbalance, Waviness, WidthProfile,
};

/// What JSON Schema says of the numbers of each part, by the part and its field: `minimum`, `maximum`, `exclusiveMinimum`,
/// `exclusiveMaximum`; of lists under `items`. Ranges that depend on other fields are not there.
///
/// ```
/// let ranges = ballrace::scene::ranges();
/// assert_eq!(ranges["Row"]["ball_count"]["maximum"], 1000.0);
/// ```
pub fn ranges() -> BTreeMap<&'static str, BTreeMap<&'static str, Value>> {
    let numbers = parts().into_iter();
    let fields = |(part, numbers): PartNumbers| {
        let field = |number: BoundedNumber| (number.field, keywords(&number));
        (part, numbers.into_iter().map(field).collect())
    };
    numbers.map(fields).collect()
}

fn keywords(number: &BoundedNumber) -> Value {
    let low = match number.range.0 {
        Bound::Included(x) => Some(("minimum", x)),
        Bound::Excluded(x) => Some(("exclusiveMinimum", x)),
        Bound::Unbounded => None,
    };
    let high = match number.range.1 {
        Bound::Included(x) => Some(("maximum", x)),
        Bound::Excluded(x) => Some(("exclusiveMaximum", x)),
        Bound::Unbounded => None,
    };
    let both = low.into_iter().chain(high).filter(|(_, x)| x.is_finite());
    let found: Map<String, Value> = both.map(|(word, x)| (word.to_owned(), json!(x))).collect();
    match number.item {
        None => found.into(),
        Some(_) => json!({ "items": found }),
    }
}

/// Numbers of a part by its name.
type PartNumbers = (&'static str, Vec<BoundedNumber>);

/// The numbers of every part that has any, whatever their values.
fn parts() -> Vec<PartNumbers> {
    let all = [of_bearings(), of_contacts(), of_loads(), of_defects()];
    all.into_iter().flatten().collect()
}

const X: f64 = f64::NAN;

fn of_bearings() -> Vec<PartNumbers> {
    let profile = RaceProfile::new(Vec::new(), Vec::new());
    let support = CoupledSupport::new([[X; 6]; 6]);
    let links = CageLinks {
        stiffness: X,
        damping: X,
        play: X,
    };
    let spring = Mount::Spring {
        stiffness: X,
        damping: X,
    };
    vec![
        ("Row", Row::new(1, X, X, X, X).numbers()),
        ("RaceProfile", profile.numbers()),
        ("GothicArch", GothicArch::new(X).numbers()),
        ("Waviness", Waviness::new(1, X, X).numbers().into()),
        ("Texture", Texture::default().numbers().into()),
        ("Ring", Ring::default().numbers().into()),
        ("Spring", spring.numbers(false)),
        ("CoupledSupport", support.numbers().into()),
        ("Mode", Mode::new(X, X, X, [X; 3]).numbers()),
        ("Material", Material::default().numbers().into()),
        ("Cage", links.numbers().into()),
        ("CageRing", CageRing::default().numbers().into()),
    ]
}

fn of_contacts() -> Vec<PartNumbers> {
    let coulomb = Friction::Coulomb {
        coefficient: X,
        slip_speed: X,
    };
    let stribeck = Friction::Stribeck {
        static_coefficient: X,
        kinetic_coefficient: X,
        stribeck_speed: X,
        slip_speed: X,
    };
    let traction = Friction::Traction {
        a: X,
        b: X,
        c: X,
        d: X,
        slip_speed: X,
    };
    let friction = |of: Friction| of.numbers().map_or_else(Vec::new, |(_, numbers)| numbers);
    let oil = Lubricant::new(X, X, X);
    let of_oil = oil.numbers_of_oil().into_iter().chain(oil.numbers());
    vec![
        ("Contact", Contact::default().numbers().into()),
        ("SqueezeFilm", SqueezeFilm::default().numbers().into()),
        ("Iso16281", NormalLaw::iso16281().numbers().1),
        ("FixedSlices", vec![Slices::Fixed(1).numbers()]),
        ("FittedSlices", vec![Slices::Fitted(1).numbers()]),
        ("AccurateSlices", vec![Slices::Accuracy(X).numbers()]),
        ("Coulomb", friction(coulomb)),
        ("Stribeck", friction(stribeck)),
        ("Traction", friction(traction)),
        ("Lubricant", of_oil.collect()),
    ]
}

fn of_loads() -> Vec<PartNumbers> {
    let ring = RingName::Outer;
    let table = TableForce::new(ring, [X; 3], [], []);
    let torque = Drive::Torque {
        value: X.into(),
        initial_speed: X,
    };
    vec![
        ("TorqueDrive", torque.numbers().into_iter().collect()),
        ("Scene", Scene::new(Vec::new(), torque).numbers()),
        ("Load", Load::new(ring, [X; 3], X).numbers()),
        ("Unbalance", Unbalance::new(ring, X, X).numbers().into()),
        ("TableForce", table.numbers()),
        ("SlicesProbe", SlicesProbe::at([]).numbers()),
        ("Solver", Solver::default().numbers().into()),
    ]
}

fn of_defects() -> Vec<PartNumbers> {
    let dent = Dent::of_width(X).depth(X);
    let defect = Defect::of(dent.clone(), Surface::OuterRace, X);
    let profile = WidthProfile::new(Vec::new(), Vec::new());
    let damage = |of: Damage| of.numbers();
    vec![
        ("Defect", defect.numbers().into()),
        ("Patch", damage(Patch::of_width(X).into())),
        ("SteepPatch", damage(SteepPatch::of_width(X).into())),
        ("Cap", damage(Cap::of_width(X).into())),
        ("Pit", damage(Pit::of_width(X).into())),
        ("Dent", damage(dent.into())),
        ("Floor", Floor::new(X, 1).numbers().into()),
        ("WidthProfile", profile.numbers()),
    ]
}
