//! The same bits for any number of threads, and effort that does not drift unseen.

use ballrace::scene::{Slices, presets};
use ballrace::{Run, simulate};

fn bits(threads: usize) -> Vec<u64> {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.contact.slices = Slices::Fixed(50);
    let run = Run {
        duration: 2e-3,
        threads,
        settle: Some(0.0),
        ..Run::default()
    };
    let out = simulate(&scene, &run).unwrap();
    out.columns
        .iter()
        .flat_map(|column| column.values.iter().map(|x| x.to_bits()))
        .collect()
}

/// Analytic: sums have one order.
#[test]
fn threads_do_not_change_a_bit() {
    let one = bits(1);
    assert_eq!(one, bits(2));
    assert_eq!(one, bits(8));
}

/// Golden: effort of a millisecond of each preset. A change here wants a line in the changelog; re-mint by
/// copying the printed numbers.
#[test]
fn effort_is_pinned() {
    let run = Run {
        duration: 1e-3,
        threads: 1,
        settle: Some(0.0),
        ..Run::default()
    };
    for (scene, steps) in [
        (presets::wheel_bearing(3000.0), (142, 3)),
        (presets::deep_groove_6205(500.0, 0.0, 1800.0), (302, 3)),
    ] {
        let out = simulate(&scene, &run).unwrap();
        let stats = out.stats;
        println!("{}: {stats:?}", scene.name);
        assert_eq!((stats.accepted, stats.rejected), steps, "{}", scene.name);
        // One a step; one at the start, and one for the length of the first step.
        assert_eq!(stats.nfev, stats.accepted + stats.rejected + 2);
    }
}
