//! Ranges of the numbers of all parts of a scene, for the schema of documents.

use std::collections::BTreeMap;
use std::ops::Bound;

use serde_json::{Map, Value, json};

use super::numbers::{BoundedNumber, PartNumbers, UNSAID as X};
use super::{
    CageLinks, CageRing, CoupledSupport, Defect, Drive, Floor, GothicArch, Load, Lubricant,
    Material, Mode, Mount, Pit, RaceProfile, Ring, RingName, Row, Scene, SlicesProbe, Solver,
    Surface, TableForce, Texture, Unbalance, Waviness, WidthProfile,
};
use super::{contact, damage};

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

/// The numbers of every part that has any, whatever their values.
fn parts() -> Vec<PartNumbers> {
    let all = [of_bearings(), contact::parts(), of_loads(), of_defects()];
    all.into_iter().flatten().collect()
}

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

fn of_loads() -> Vec<PartNumbers> {
    let ring = RingName::Outer;
    let table = TableForce::new(ring, [X; 3], [], []);
    let oil = Lubricant::new(X, X, X);
    let of_oil = oil.numbers_of_oil().into_iter().chain(oil.numbers());
    let torque = Drive::Torque {
        value: X.into(),
        initial_speed: X,
    };
    vec![
        ("Lubricant", of_oil.collect()),
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
    let defect = Defect::of(Pit::of_width(X), Surface::OuterRace, X);
    let profile = WidthProfile::new(Vec::new(), Vec::new());
    let mut all = damage::parts();
    all.extend([
        ("Defect", defect.numbers().into()),
        ("Floor", Floor::new(X, 1).numbers().into()),
        ("WidthProfile", profile.numbers()),
    ]);
    all
}
