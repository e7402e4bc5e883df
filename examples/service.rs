//! A service at a machine: it reads a record, looks where its bearing's damage would show, and lets a simulated twin follow the load:
//! `cargo run --release --example service`.

use std::io::Read;

use ballrace::scene::{Cage, Drive, Friction, Load, RingName, Scene, catalogue};
use ballrace::{
    Error, FaultFrequencies, FeatureOptions, Run, Simulation, Snapshot, fault_frequencies,
    signal_features, squared_envelope_spectrum,
};

/// Sampling rate of the records \[Hz\], and the band in which the housing rings \[Hz\].
const FS: f64 = 20e3;
const BAND: [f64; 2] = [2e3, 4e3];

/// The bearing of the machine at a speed \[1/min\] under a load \[N\].
fn machine(designation: &str, rpm: f64, load: f64) -> Result<Scene, Error> {
    let row = catalogue::find(designation)?.row();
    let speed = rpm * std::f64::consts::TAU / 60.0;
    let mut scene = Scene::new(vec![row], Drive::Speed(speed.into()));
    scene.friction = Friction::Coulomb {
        coefficient: 0.05,
        slip_speed: 0.1,
    };
    scene.cage = Some(Cage::new(1e6, 20.0, 0.1e-3));
    scene.inner_ring.mass = Some(0.2);
    let down = Load::new(RingName::Inner, [0.0, -1.0, 0.0], load);
    scene.loads.insert("belt".to_owned(), down);
    scene.validate()?;
    Ok(scene)
}

/// Samples of a file of raw floats, little-endian.
fn samples(mut file: impl Read) -> std::io::Result<Vec<f64>> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes)?;
    let (numbers, _) = bytes.as_chunks::<8>();
    Ok(numbers
        .iter()
        .map(|bytes| f64::from_le_bytes(*bytes))
        .collect())
}

/// The levels of the envelope at the rates of the races, over the median of the spectrum; and the record's rms.
fn levels(x: &[f64], scene: &Scene, rates: &FaultFrequencies) -> Result<[f64; 3], Error> {
    let (f, value) = squared_envelope_spectrum(x, FS, Some(BAND))?;
    let mut sorted = value.clone();
    sorted.sort_by(f64::total_cmp);
    let floor = sorted[sorted.len() / 2];
    let level = |rate: f64| {
        let near = f
            .iter()
            .zip(&value)
            .filter(|(f, _)| (*f - rate).abs() < 0.02 * rate);
        near.map(|(_, value)| value / floor).fold(0.0, f64::max)
    };
    let found = signal_features(x, FS, "", Some(scene), &FeatureOptions::default())?;
    let rms = found.iter().find(|feature| feature.name == "rms");
    let rms = rms.and_then(|feature| feature.value).unwrap_or(f64::NAN);
    Ok([level(rates.bpfo), level(rates.bpfi), rms])
}

/// The twin goes on for some milliseconds under each load \[N\], over a restart of this program after each.
fn follow(scene: &Scene, loads: &[f64]) -> Result<usize, Error> {
    let run = Run {
        duration: Run::OPEN,
        ..Run::default()
    };
    let mut twin = Simulation::begin(scene, &run)?;
    for load in loads {
        twin.set_loads(&[("loads.belt.force", *load)])?;
        twin.advance(2e-3)?;
        let stored = twin.snapshot().to_json();
        twin = Simulation::restore(&Snapshot::from_json(&stored)?)?;
    }
    Ok(twin.finish()?.t.len())
}

/// The answer of the service to input that it cannot use: a status, and for the log the error's own words.
fn status(error: &Error) -> u16 {
    match error {
        Error::Argument { path, .. } if path == "designation" => 404,
        Error::Argument { .. }
        | Error::Scene { .. }
        | Error::Record { .. }
        | Error::Snapshot { .. } => 422,
        Error::Equilibrium { .. } | Error::Integration { .. } => 409,
        Error::Budget { .. } | Error::Memory { .. } | Error::Interrupted { .. } => 503,
        _ => 500,
    }
}

/// Serves one good request, and one of each kind that is bad.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = machine("6205", 1797.0, 500.0)?;
    let rates = fault_frequencies(&scene, 0)?;
    // What an accelerometer gives of a spall on the outer race: the housing rings at every ball.
    let ring = |since: f64| (-800.0 * since).exp() * (std::f64::consts::TAU * 3e3 * since).sin();
    let record: Vec<f64> = (0..20_000)
        .map(|i| ring((f64::from(i) / FS) % (1.0 / rates.bpfo)))
        .collect();
    let raw: Vec<u8> = record.iter().flat_map(|x| x.to_le_bytes()).collect();
    let x = samples(raw.as_slice())?;
    let [outer, inner, rms] = levels(&x, &scene, &rates)?;
    println!(
        "BPFO {:.2} Hz: {outer:.0} over the floor; BPFI {inner:.0}; rms {rms:.3}",
        rates.bpfo
    );
    assert!(outer > 100.0 && outer > 10.0 * inner);
    assert_eq!(follow(&scene, &[600.0, 900.0])?, 200);

    let hurt = [x[0], f64::NAN, x[2]].repeat(10);
    let answers = [
        machine("6205x9", 1797.0, 500.0).err(),
        machine("6205", f64::NAN, 500.0).err(),
        levels(&hurt, &scene, &rates).err(),
        follow(&scene, &[f64::NAN]).err(),
        Snapshot::from_json("{}").err(),
        fault_frequencies(&machine("6205", 1797.0, 1e9)?, 0).err(),
    ];
    let codes = answers.map(|error| error.as_ref().map_or(200, status));
    println!("answers: {codes:?}");
    assert_eq!(codes, [404, 422, 422, 422, 422, 409]);
    Ok(())
}
