//! Records in blocks, and what is read before t = 0.

use std::sync::Mutex;

use super::*;
use crate::integrate::{self, DORMAND_PRINCE, Options, Tolerance, integrate};
use crate::scene::{Probe, Scene, presets};
use crate::signals::Bandwidth;
use crate::signals::{BlockSink, Column};
use crate::statics::compile;
use crate::statics::start::{Start, start};

const FS: f64 = 50e3;
const COUNT: usize = 40;

/// Record of 40 samples of a run that begins at some time \[s\]: names, times and all columns.
fn recorded(
    scene: &Scene,
    from: f64,
    bandwidth: Bandwidth,
    sink: Option<BlockSink<'_>>,
) -> Vec<(String, Vec<f64>)> {
    let model = compile(scene).unwrap();
    let y0 = start(&model, &Start::Rolling).unwrap();
    let sampling = Sampling::new(bandwidth, FS, model.scales().frequency).unwrap();
    let mut dynamics = Dynamics::new(&model);
    let keep = sink.map_or(Keep::All, |sink| Keep::Left(Mutex::new(sink)));
    let mut recorder = Recorder::new(&model, sampling, COUNT, keep);
    recorder.held.block = 7;
    recorder.prepare(&dynamics, &y0).unwrap();
    recorder.first(&mut dynamics, from, &y0);
    let options = Options {
        max_step: 1.0 / model.scales().frequency,
        ..Options::default()
    };
    let span = (from, recorder.until(COUNT as f64 / FS) + 10.0 / FS);
    integrate(
        &mut dynamics,
        &DORMAND_PRINCE,
        span,
        &y0,
        &Tolerance::uniform(y0.len(), 1e-9, 1e-9).unwrap(),
        &options,
        &mut |dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>, _: &integrate::StepStatistics| {
            recorder.step(dynamics, step, step.t1())
        },
    )
    .unwrap();
    assert!(recorder.finish().is_continue());
    assert_eq!(recorder.held.sampled(), COUNT);
    named(recorder.held.t, recorder.held.columns)
}

fn named(t: Vec<f64>, columns: Vec<Column>) -> Vec<(String, Vec<f64>)> {
    let columns = columns.into_iter().map(|c| (c.name, c.values));
    std::iter::once(("t".to_owned(), t))
        .chain(columns)
        .collect()
}

/// Vertical acceleration of the outer ring.
fn acceleration(from: f64) -> Vec<f64> {
    let scene = presets::wheel_bearing(0.0);
    let columns = recorded(&scene, from, Bandwidth::Auto, None);
    let mut ay = columns.into_iter().filter(|(name, _)| name == "outer.ay");
    ay.next().unwrap().1
}

/// Truth: the record that is kept whole, of filtered columns and of points, in blocks that are shorter than the filter
/// reaches and do not divide it.
#[test]
fn blocks_are_the_whole_record_bit_by_bit() {
    let mut scene = presets::wheel_bearing(0.0);
    scene
        .probes
        .insert("cage".to_owned(), Probe::Cage { row: 0 });
    scene.probes.insert("energy".to_owned(), Probe::Energy {});
    for bandwidth in [Bandwidth::Auto, Bandwidth::Raw] {
        let whole = recorded(&scene, 0.0, bandwidth, None);
        let mut joined: Vec<(String, Vec<f64>)> = Vec::new();
        let mut lengths = Vec::new();
        let mut sink = |block: Block| {
            lengths.push(block.t.len());
            let columns = named(block.t, block.columns);
            if joined.is_empty() {
                joined = columns;
            } else {
                for (all, (name, values)) in joined.iter_mut().zip(columns) {
                    assert_eq!((&all.0, values.len()), (&name, lengths[lengths.len() - 1]));
                    all.1.extend(values);
                }
            }
            ControlFlow::Continue(())
        };
        let left = recorded(&scene, 0.0, bandwidth, Some(&mut sink));
        assert!(left.iter().all(|(_, values)| values.is_empty()));
        assert_eq!(lengths, [7, 7, 7, 7, 7, 5]);
        assert_eq!(joined.len(), whole.len());
        for ((name, values), (_, kept)) in joined.iter().zip(&whole) {
            assert!(
                values
                    .iter()
                    .map(|x| x.to_bits())
                    .eq(kept.iter().map(|x| x.to_bits())),
                "{name}"
            );
        }
    }
}

/// Limit: nothing here depends on time itself, so a run that begins 18 samples before 0 gives what one from 0 gives
/// later; what it read before 0 stands in the filter in the place of a reflection.
#[test]
fn times_before_zero_feed_the_first_samples() {
    let (from_zero, before) = (acceleration(0.0), acceleration(-18.0 / FS));
    let size = from_zero.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    for (later, early) in from_zero[18..].iter().zip(&before) {
        assert!((later - early).abs() < 1e-4 * size, "{later} {early}");
    }
}
