//! Runs cases on threads of its own and returns their outcomes, with a bounded number in progress.
//!
//! With a shared pool, campaigns in one process (a Dask worker has several) would
//! wait for each other, and a forked child would inherit a pool without its threads. A stop reaches a case in its static
//! solves and between its steps; where one evaluation takes long, its thread ends by itself after it.

use std::ops::ControlFlow;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use super::{Case, Outcome};
use crate::base::clock;
use crate::base::error::{Error, Result};
use crate::base::interrupt::Interrupt;
use crate::base::memory;
use crate::base::pool::STACK;
use crate::features::FeatureOptions;

/// How long the calling thread waits at most before it looks up.
const ATTENTION: Duration = Duration::from_millis(50);

/// How long a stop waits at most for cases that finish meanwhile, of what Ctrl-C may take: half a second \[s\].
const PATIENCE: f64 = 0.15;

/// Cases handed out a thread: one that runs and one that waits, or has finished and waits to be seen.
const AHEAD: usize = 2;
/// Records of a case that are there at once: its samples, and what its features are computed from.
const RECORDS: f64 = 2.0;

/// Runs cases as they come from an iterator, on `threads` threads (0: all cores).
///
/// `watch` is called on this thread at least about every 50 ms with the outcomes that have come in since, in any
/// order (see [`Outcome::index`]), or none; it may stop everything. Cases interrupted by that are not reported;
/// those that finish within 150 ms are, in one last call. No more than two cases a thread are held at a time, and each
/// has its part of the memory that there is at the beginning. Where the crate is built without its feature `parallel`, cases run
/// one after the other on this thread, and `watch` is called after each.
///
/// # Errors
/// [`Error::Argument`] for more than 1024 threads, or more than the system grants.
pub fn stream(
    cases: impl Iterator<Item = Case>,
    threads: usize,
    options: &FeatureOptions,
    watch: &mut dyn FnMut(Vec<Outcome>) -> ControlFlow<()>,
) -> Result<()> {
    let threads = count(threads)?;
    if cfg!(not(feature = "parallel")) {
        in_turn(cases, options, watch);
        return Ok(());
    }
    let (hand_out, queue) = channel::<(usize, Case)>();
    let (hand_in, outcomes) = channel::<Outcome>();
    let shared = Arc::new(Shared {
        queue: Mutex::new(queue),
        options: options.clone(),
        stop: Interrupt::new(),
        memory: memory::available() / (RECORDS * AHEAD as f64 * threads as f64),
    });
    for i in 0..threads {
        let (shared, hand_in) = (Arc::clone(&shared), hand_in.clone());
        // Where one cannot be had, the queue ends with this function's return, and so do the threads there are.
        std::thread::Builder::new()
            .name(format!("ballrace-case-{i}"))
            .stack_size(STACK)
            .spawn(move || work(&shared, &hand_in))
            .map_err(|e| {
                let allowed = format!("a number of threads the system grants ({e})");
                Error::argument("threads", threads, allowed)
            })?;
    }
    drop(hand_in);
    feed(
        cases,
        AHEAD * threads,
        hand_out,
        &outcomes,
        &shared.stop,
        watch,
    );
    Ok(())
}

/// Runs cases one after the other on this thread.
fn in_turn(
    cases: impl Iterator<Item = Case>,
    options: &FeatureOptions,
    watch: &mut dyn FnMut(Vec<Outcome>) -> ControlFlow<()>,
) {
    let (stop, memory) = (Interrupt::new(), memory::available() / RECORDS);
    for (index, case) in cases.enumerate() {
        let outcome = memory::within(memory, || case.outcome(index, options, &stop));
        if watch(vec![outcome]).is_break() {
            return;
        }
    }
}

/// State that the threads have in common.
struct Shared {
    queue: Mutex<Receiver<(usize, Case)>>,
    options: FeatureOptions,
    stop: Interrupt,
    /// Memory that each case may set aside \[bytes\].
    memory: f64,
}

/// Number of threads asked for, or of cores.
fn count(threads: usize) -> Result<usize> {
    match threads {
        0 => Ok(std::thread::available_parallelism().map_or(1, std::num::NonZero::get)),
        1..=1024 => Ok(threads),
        _ => Err(Error::argument(
            "threads",
            threads,
            "0 to 1024; 0: one for each core",
        )),
    }
}

/// The loop of one thread: cases until there are no more.
fn work(shared: &Shared, hand_in: &Sender<Outcome>) {
    let Shared {
        queue,
        options,
        stop,
        memory,
    } = shared;
    loop {
        // The lock is let go before the case runs.
        let next = queue.lock().unwrap_or_else(PoisonError::into_inner).recv();
        let Ok((index, case)) = next else { return };
        if stop.is_set() {
            continue;
        }
        let outcome = memory::within(*memory, || case.outcome(index, options, stop));
        if matches!(outcome.result, Err(Error::Interrupted { .. }))
            || hand_in.send(outcome).is_err()
        {
            return;
        }
    }
}

/// The calling thread's part: keeps the queue filled and passes outcomes on.
fn feed(
    cases: impl Iterator<Item = Case>,
    window: usize,
    hand_out: Sender<(usize, Case)>,
    outcomes: &Receiver<Outcome>,
    stop: &Interrupt,
    watch: &mut dyn FnMut(Vec<Outcome>) -> ControlFlow<()>,
) {
    let mut cases = cases.enumerate();
    let mut hand_out = Some(hand_out);
    let mut under_way = 0;
    loop {
        while let Some(open) = hand_out.as_ref().filter(|_| under_way < window) {
            match cases.next() {
                // The receiver lives as long as the scope.
                Some(case) => under_way += usize::from(open.send(case).is_ok()),
                None => hand_out = None,
            }
        }
        if under_way == 0 {
            return;
        }
        let done = gather(outcomes);
        under_way -= done.len();
        if watch(done).is_break() {
            break;
        }
    }
    stop.set();
    drop(hand_out);
    let last = await_last(outcomes);
    if !last.is_empty() {
        let _ = watch(last);
    }
}

/// Outcomes that come in until every thread has let go of its sender, or patience ends.
fn await_last(outcomes: &Receiver<Outcome>) -> Vec<Outcome> {
    let begun = clock::now();
    let left = || (PATIENCE - clock::since(begun)).clamp(0.0, PATIENCE);
    let next = || outcomes.recv_timeout(Duration::from_secs_f64(left()));
    std::iter::from_fn(|| next().ok()).collect()
}

/// Outcomes that have come in, or come in within the time of attention.
fn gather(outcomes: &Receiver<Outcome>) -> Vec<Outcome> {
    let mut done: Vec<Outcome> = outcomes.recv_timeout(ATTENTION).into_iter().collect();
    done.extend(outcomes.try_iter());
    done
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Run;
    use crate::scene::presets;

    /// Limit: cases in turn have the bits of cases on threads, and end where they are stopped.
    #[test]
    fn in_turn_is_as_on_threads() {
        let run = Run {
            duration: 1e-3,
            ..Run::default()
        };
        let cases = || {
            let scenes = [0.0, 1e9, 3000.0].map(presets::wheel_bearing);
            scenes
                .into_iter()
                .map(|scene| Case::new(scene, run.clone()))
        };
        let options = FeatureOptions::default();
        let mut shared = Vec::new();
        let mut watch = |done: Vec<Outcome>| {
            shared.extend(done);
            ControlFlow::Continue(())
        };
        stream(cases(), 2, &options, &mut watch).unwrap();
        shared.sort_by_key(|outcome| outcome.index);
        let mut alone = Vec::new();
        in_turn(cases(), &options, &mut |done| {
            alone.extend(done);
            ControlFlow::Continue(())
        });
        let features = |of: &[Outcome]| {
            let found = of.iter().map(|outcome| outcome.result.clone());
            found
                .map(|result| result.map(|finished| finished.features))
                .collect::<Vec<_>>()
        };
        assert_eq!(features(&alone), features(&shared));
        assert!(alone[0].result.is_ok() && alone[1].result.is_err());
        let mut seen = 0;
        in_turn(cases(), &options, &mut |done| {
            seen += done.len();
            ControlFlow::Break(())
        });
        assert_eq!(seen, 1);
    }

    /// A thread in a very long evaluation is not reached by the stop before its end.
    #[test]
    fn a_stop_does_not_wait_for_the_deaf() {
        let (deaf, outcomes) = channel::<Outcome>();
        assert!(await_last(&outcomes).is_empty());
        drop(deaf);
    }
}
