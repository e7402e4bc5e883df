//! Oil, as far as it is judged without an equilibrium.

use super::{Doubt, millimetres};
use crate::base::quantities::number;
use crate::scene::{Drive, Lubricant, Probe, Scene};

/// Temperatures at which greases and oils of bearings are used \[K\]: −30 to 150 °C.
const TEMPERATURE: [f64; 2] = [243.0, 424.0];
/// Roughness of both surfaces together \[m\]: races and balls have 0.01 to 0.2 µm, worn ones up to 1 µm.
const ROUGHNESS: [f64; 2] = [5e-9, 2e-6];
/// Free oil in front of a contact \[m\]; what is more is flooded.
const LAYER: f64 = 5e-3;
/// Least slip scale \[m/s\] from which a torque that is asked for is doubted: it takes 8 to 19 % of it away.
const SLIP_FLOOR: f64 = 2e-2;
/// Least slip scale that vibration may be computed with \[m/s\]: what is more makes no run faster.
const LARGEST_SLIP_FLOOR: f64 = 5e-2;

/// Length of a contact's ellipse over its width, to which formulas of films were fitted or reach safely.
const ELLIPTICITY: [f64; 2] = [1.0, 12.0];
/// Moes' L to which the film's damping was fitted.
const MOES: [f64; 2] = [2.0, 20.0];
/// λ below which asperities bear all, and nothing is left of a film.
const LAMBDA: f64 = 0.2;
/// Pressure up to which the formulas of traction were compared with measured oils \[Pa\].
const PRESSURE: f64 = 3e9;

/// Slip up to which a film's traction holds \[m/s\].
const SLIP: f64 = 0.5;

/// Numbers by which a film's formulas are judged.
pub(crate) struct FilmJudged {
    /// Length of the ellipse over its width.
    pub ellipticity: f64,
    /// Moes' L of a film that damps.
    pub moes: Option<f64>,
    /// λ at the reference speed.
    pub lambda: f64,
    /// Largest pressure under the reference load \[Pa\]; absent where it is doubted already.
    pub pressure: Option<f64>,
}

impl Doubt {
    /// Doubts about a film at a place such as `row 0, outer film`.
    pub(crate) fn film(place: &str, judged: &FilmJudged) -> Vec<Self> {
        let mut found = Vec::new();
        let mut add = |what: &str, value: String, usual: &str| {
            found.push(Self::new(format!("{place}, {what}"), value, usual));
        };
        let outside = |x: f64, [least, most]: [f64; 2]| !(least..=most).contains(&x);
        if outside(judged.ellipticity, ELLIPTICITY) {
            let usual = "formulas of films hold for contacts 1 to 12 times as long as wide";
            add("length over width", number(judged.ellipticity), usual);
        }
        if let Some(moes) = judged.moes.filter(|moes| outside(*moes, MOES)) {
            let usual = "the film's damping was fitted to L from 2 to 20";
            add("Moes' L", number(moes), usual);
        }
        if judged.lambda < LAMBDA {
            let usual = "below 0.2 asperities bear the load, and a film's formulas do not hold; colder or thicker oil, a \
                         higher speed or smoother surfaces raise it";
            add("λ", number(judged.lambda), usual);
        }
        if let Some(pressure) = judged.pressure.filter(|pressure| *pressure > PRESSURE) {
            let usual = "traction of oils is known up to 3 GPa";
            add("pressure", format!("{:.2} GPa", 1e-9 * pressure), usual);
        }
        found
    }

    /// Doubt about the slip of contacts under films \[m/s\], if it is too fast for their formulas.
    pub(crate) fn film_slip(slip: f64) -> Option<Self> {
        let usual = "above 0.5 m/s oil heats in the contact and has less friction than is computed; more load, thicker oil or a \
                     lower speed reduce the slip";
        (slip > SLIP).then(|| {
            Self::new(
                "slip of contacts".to_owned(),
                format!("{} m/s", number(slip)),
                usual,
            )
        })
    }
}

pub(super) fn look(scene: &Scene, found: &mut Vec<Doubt>) {
    let of_torque = asks_for_torque(scene);
    if let Some(own) = &scene.lubricant {
        lubricant("lubricant", own, of_torque, found);
    }
    for (i, row) in scene.rows.iter().enumerate() {
        if let Some(own) = &row.lubricant {
            lubricant(&format!("rows[{i}].lubricant"), own, of_torque, found);
        }
    }
}

/// Whether friction torque decides the motion, or is recorded.
fn asks_for_torque(scene: &Scene) -> bool {
    let torque = |probe: &Probe| {
        matches!(
            probe,
            Probe::Torque {} | Probe::Lubrication { .. } | Probe::Energy {}
        )
    };
    matches!(scene.drive, Drive::Torque { .. }) || scene.probes.values().any(torque)
}

fn lubricant(path: &str, lubricant: &Lubricant, of_torque: bool, found: &mut Vec<Doubt>) {
    let mut add = |field: &str, value: String, usual: &str| {
        found.push(Doubt::new(format!("{path}.{field}"), value, usual));
    };
    let within = |x: f64, [least, most]: [f64; 2]| (least..=most).contains(&x);
    let Lubricant {
        temperature,
        roughness,
        slip_floor,
        ..
    } = *lubricant;
    if !within(temperature, TEMPERATURE) {
        let usual = "oils of bearings are used from -30 to 150 °C";
        let value = format!("{} °C", number(temperature - 273.15));
        add("temperature", value, usual);
    }
    if !within(roughness, ROUGHNESS) {
        let usual = "races and balls together have 0.01 to 0.3 µm; lengths are in metres";
        let value = format!("{} µm", number(1e6 * roughness));
        add("roughness", value, usual);
    }
    if let Some(layer) = lubricant.oil_layer.thickness()
        && layer > LAYER
    {
        let usual = "a layer that thick is \"flooded\"; lengths are in metres";
        add("oil_layer", millimetres(layer), usual);
    }
    let usual = if slip_floor > LARGEST_SLIP_FLOOR {
        "above 0.05 m/s it makes no run faster, and takes up to a quarter of the friction torque away; speeds are in \
         metres a second"
    } else if slip_floor > SLIP_FLOOR && of_torque {
        "takes more than a tenth of the friction torque away, which this scene records or is driven by"
    } else {
        return;
    };
    add("slip_floor", format!("{} m/s", number(slip_floor)), usual);
}
