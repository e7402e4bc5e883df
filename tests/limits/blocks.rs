//! A record that leaves in blocks is the record that is kept, and takes no more memory however long it is.

use std::ops::ControlFlow::{self, Break, Continue};

use ballrace::scene::{ContactsProbe, Scene, presets};
use ballrace::{Block, Error, Run, Signals, simulate, simulate_into, simulate_with_progress};

/// So many columns that a block has some hundred samples: filtered motion, and points of contacts.
fn scene() -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    for k in 0..40 {
        let contacts = ContactsProbe::of_row(0).into();
        scene.probes.insert(format!("contacts{k}"), contacts);
    }
    scene
}

fn run() -> Run {
    Run {
        duration: 0.035,
        settle: Some(0.0),
        ..Run::default()
    }
}

fn go_on(_: f64) -> ControlFlow<()> {
    Continue(())
}

/// Truth: the record that [`simulate`] keeps.
#[test]
fn blocks_are_the_record_that_is_kept() {
    let kept = simulate(&scene(), &run()).unwrap();
    assert!(kept.provenance.oversampling > 1, "nothing is filtered");
    let (mut at, mut blocks) = (0, 0);
    let mut sink = |block: Block| {
        let rows = at..at + block.t.len();
        assert_eq!(block.t, kept.t[rows.clone()]);
        for (column, whole) in block.columns.iter().zip(&kept.columns) {
            assert_eq!((&column.name, &column.unit), (&whole.name, &whole.unit));
            let (found, wanted) = (column.values.iter(), whole.values[rows.clone()].iter());
            assert!(
                found.map(|x| x.to_bits()).eq(wanted.map(|x| x.to_bits())),
                "{}",
                column.name
            );
        }
        (at, blocks) = (rows.end, blocks + 1);
        Continue(())
    };
    let rest = simulate_into(&scene(), &run(), &mut sink, &mut go_on).unwrap();
    assert_eq!(at, kept.t.len());
    assert!(blocks > 2, "{blocks}");
    let counts = |signals: &Signals| {
        let stats = signals.stats;
        (stats.accepted, stats.nfev, stats.acceleration_residual)
    };
    assert_eq!(counts(&rest), counts(&kept));
    assert_eq!(rest.provenance, kept.provenance);
    assert_eq!(rest.warnings(), kept.warnings());
    assert!(rest.t.is_empty() && rest.columns.iter().all(|column| column.values.is_empty()));
}

#[test]
fn a_sink_may_stop_the_run() {
    for stop_at in [1, 2] {
        let mut blocks = 0;
        let mut sink = |_| {
            blocks += 1;
            if blocks == stop_at {
                Break(())
            } else {
                Continue(())
            }
        };
        let ended = simulate_into(&scene(), &run(), &mut sink, &mut go_on);
        assert!(matches!(ended, Err(Error::Interrupted { .. })), "{ended:?}");
        assert_eq!(blocks, stop_at);
    }
    // In the block that the end of a run leaves.
    let short = Run {
        duration: 1e-3,
        ..run()
    };
    let ended = simulate_into(&scene(), &short, &mut |_| Break(()), &mut go_on);
    assert!(matches!(ended, Err(Error::Interrupted { .. })), "{ended:?}");
}

/// Limit: of memory that no machine has, where all samples are kept; a block is a block.
#[test]
fn a_long_record_counts_as_a_block() {
    let long = Run {
        duration: 1e6,
        fs: 1e6,
        ..run()
    };
    let kept = simulate_with_progress(&scene(), &long, &mut |_| Break(()));
    assert!(matches!(kept, Err(Error::Memory { .. })), "{kept:?}");
    let streamed = simulate_into(&scene(), &long, &mut |_| Continue(()), &mut |_| Break(()));
    assert!(
        matches!(streamed, Err(Error::Interrupted { .. })),
        "{streamed:?}"
    );
}
