//! Defects of a scene as contacts meet them.

use crate::contact::hertz::Hertz;
use crate::contact::{Bed, Pair, PittedContact, SurfaceDefect};
use crate::scene::{Defect, Row};

/// A defect of a race, compiled.
pub(crate) fn race_defect(defect: &Defect, row: &Row, race: &Pair, hertz: &Hertz) -> SurfaceDefect {
    let middle = row.axial_position + offset(defect);
    let length = defect.damage.length().unwrap_or(0.0);
    let bed = Bed {
        middle,
        // Validation keeps the defect's middle inside the groove.
        radius: race.radius_at(middle).unwrap_or(race.race.a),
        least: least_radius(race, middle, length),
        contacts: [PittedContact::of(hertz); 2],
    };
    SurfaceDefect::within(defect, &bed)
}

/// The least radius of a race over a length about a place \[m\], to the step of a fine grid: one groove has it at an end or in its middle, a
/// curve through points anywhere.
fn least_radius(race: &Pair, middle: f64, length: f64) -> f64 {
    const PLACES: u32 = 64;
    let place = |k: u32| middle + length * (f64::from(k) / f64::from(PLACES) - 0.5);
    let radii = (0..=PLACES).filter_map(|k| race.radius_at(place(k)));
    radii.fold(race.radius_at(middle).unwrap_or(race.race.a), f64::min)
}

/// A defect of a ball of this radius, compiled, with its contacts with both races.
pub(crate) fn ball_defect(defect: &Defect, radius: f64, hertz: &[Hertz; 2]) -> SurfaceDefect {
    let reach = offset(defect).abs() + defect.damage.length().unwrap_or(0.0) / 2.0;
    let bed = Bed {
        middle: offset(defect),
        radius,
        least: (radius * radius - reach * reach).max(0.0).sqrt(),
        contacts: hertz.each_ref().map(PittedContact::of),
    };
    SurfaceDefect::within(defect, &bed)
}

fn offset(defect: &Defect) -> f64 {
    let number = defect.axial_offset.number();
    number.expect("defects are placed before a scene is compiled")
}

#[cfg(test)]
mod tests {
    use super::race_defect;
    use crate::contact::Motion;
    use crate::model::Race;
    use crate::scene::{Defect, Patch, Surface, presets};

    /// Analytic: a spall as long as the groove is wide is seen wherever a slice may meet it, and hardly further, though the race is not
    /// equally wide along it.
    #[test]
    fn a_defect_reaches_as_far_as_its_widest_slice() {
        let (width, length) = (3e-3, 5e-3);
        for (race, on) in [
            (Race::Outer, Surface::OuterRace),
            (Race::Inner, Surface::InnerRace),
        ] {
            for offset in [-0.5e-3, 0.0, 1e-3] {
                let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
                let model = crate::compile(&scene).unwrap();
                let row = &model.rows[0];
                let defect = Defect::of(
                    Patch::of_width(width).length(length).edge_radius(0.3e-3),
                    on,
                    0.0,
                )
                .at_offset(offset);
                let pair = &row.pairs[race];
                let defect = race_defect(&defect, &scene.rows[0], pair, &row.hertz[race]);
                let mut widest = 0.0_f64;
                for k in 0..=1000 {
                    let z = offset + length * (f64::from(k) / 1000.0 - 0.5) * 0.999;
                    let radius = pair.radius_at(z).unwrap();
                    let half = width / (2.0 * radius);
                    let covers = |offset| defect.covers(z, radius, offset, &Motion::default());
                    assert!(covers(0.999 * half) && !covers(1.001 * half), "{z}");
                    widest = widest.max(half);
                }
                let over = defect.reach / widest;
                assert!((1.0..1.02).contains(&over), "{on:?}, {offset}: {over}");
            }
        }
    }
}
