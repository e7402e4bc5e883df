//! Cases in, outcomes out, with a bounded number on the way.
//!
//! The threads are the campaign's own and end with it. A shared pool would let campaigns in one process (a Dask
//! worker has several) wait for each other, and a forked child would inherit one without its threads.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::{Case, Outcome};
use crate::error::{Error, Result};
use crate::features::FeatureOptions;

/// How long the calling thread waits at most before it looks up.
const ATTENTION: Duration = Duration::from_millis(50);

/// Cases handed out a thread: one that runs and one that waits.
const AHEAD: usize = 2;

/// Runs cases as they come from an iterator, on `threads` threads (0: all cores).
///
/// `watch` is called on this thread at least about every 50 ms with the outcomes that have come in since, in any
/// order (see [`Outcome::index`]), or none; it may stop everything. Cases interrupted by that are not reported;
/// those that finish meanwhile are, in one last call. No more than two cases a thread are held at a time.
///
/// # Errors
/// [`Error::Scene`] for more than 1024 threads, or more than the system grants.
pub fn stream(
    cases: impl Iterator<Item = Case>,
    threads: usize,
    options: &FeatureOptions,
    watch: &mut dyn FnMut(Vec<Outcome>) -> ControlFlow<()>,
) -> Result<()> {
    let threads = count(threads)?;
    let stop = AtomicBool::new(false);
    let (hand_out, queue) = channel::<(usize, Case)>();
    let queue = Mutex::new(queue);
    let (hand_in, outcomes) = channel::<Outcome>();
    std::thread::scope(|scope| {
        for i in 0..threads {
            let (queue, stop, hand_in) = (&queue, &stop, hand_in.clone());
            std::thread::Builder::new()
                .name(format!("ballrace-case-{i}"))
                .spawn_scoped(scope, move || work(queue, &hand_in, options, stop))
                .map_err(|e| {
                    // The queue ends with this function's return, and so do the threads there are.
                    stop.store(true, Ordering::Relaxed);
                    let allowed = format!("a number of threads the system grants ({e})");
                    Error::scene("threads", threads, allowed)
                })?;
        }
        drop(hand_in);
        feed(cases, AHEAD * threads, hand_out, &outcomes, &stop, watch);
        Ok(())
    })
}

/// Number of threads asked for, or of cores.
fn count(threads: usize) -> Result<usize> {
    match threads {
        0 => Ok(std::thread::available_parallelism().map_or(1, std::num::NonZero::get)),
        1..=1024 => Ok(threads),
        _ => Err(Error::scene("threads", threads, "at most 1024; 0 chooses")),
    }
}

/// One thread's life: cases until there are no more.
fn work(
    queue: &Mutex<Receiver<(usize, Case)>>,
    hand_in: &Sender<Outcome>,
    options: &FeatureOptions,
    stop: &AtomicBool,
) {
    loop {
        // The lock is let go before the case runs.
        let next = queue.lock().unwrap_or_else(PoisonError::into_inner).recv();
        let Ok((index, case)) = next else { return };
        if stop.load(Ordering::Relaxed) {
            continue;
        }
        let outcome = case.outcome(index, options, stop);
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
    stop: &AtomicBool,
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
    stop.store(true, Ordering::Relaxed);
    drop(hand_out);
    // Ends when every thread has let go of its sender.
    let last: Vec<Outcome> = outcomes.iter().collect();
    if !last.is_empty() {
        let _ = watch(last);
    }
}

/// What has come in, or within the time of attention comes in.
fn gather(outcomes: &Receiver<Outcome>) -> Vec<Outcome> {
    let mut done: Vec<Outcome> = outcomes.recv_timeout(ATTENTION).into_iter().collect();
    done.extend(outcomes.try_iter());
    done
}
