//! Ratios of times: every contender runs once in each round, so that what disturbs the machine for a while disturbs all alike.

use lobe::batch::{Level, levels};
use std::hint::black_box;
use std::time::Instant;

/// Points in a batch that stays in the first cache: nine slices of 2 KiB.
pub const CACHED: usize = 256;
/// Batches of them, so that nothing is learnt about one.
pub const BUFFERS: usize = 4;

/// A contender: its name, and what it does with inputs and outputs.
pub type Run<'a, I, O> = (String, Box<dyn FnMut(&I, &mut O) + 'a>);

/// Runs every contender once per round, and prints the medians of their times and of their ratios to the first, these with their
/// quartiles. Each goes over inputs of several seeds in turn.
///
/// Does nothing unless the title holds one of the names that the program was called with, if there are any.
pub fn compare<I, O>(title: &str, count: usize, inputs: impl Fn(u64) -> I, mut out: O, runs: &mut [Run<'_, I, O>]) {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    if !wanted.is_empty() && !wanted.iter().any(|name| title.contains(name.as_str())) {
        return;
    }
    let test = std::env::args().any(|argument| argument == "--test");
    let inputs: Vec<I> = (0..BUFFERS).map(|seed| inputs(seed as u64)).collect();
    let rounds = if test { 2 } else { (40_000_000 / count / runs.len()).clamp(16, 600) / BUFFERS };
    let mut times = vec![Vec::new(); runs.len()];
    for _ in 0..rounds {
        for ((_, run), times) in runs.iter_mut().zip(&mut times) {
            let start = Instant::now();
            for input in &inputs {
                run(black_box(input), &mut out);
                black_box(&mut out);
            }
            times.push(start.elapsed().as_secs_f64() * 1e9 / (count * BUFFERS) as f64);
        }
    }
    println!("{title}");
    for ((name, _), mine) in runs.iter().zip(&times) {
        let ratios: Vec<f64> = times[0].iter().zip(mine).map(|(first, mine)| first / mine).collect();
        let (low, ratio, high) = quartiles(ratios);
        println!("  {name:<28} {:>8.3} ns  {ratio:>6.2} x  [{low:.2}, {high:.2}]", quartiles(mine.clone()).1);
    }
}

fn quartiles(mut values: Vec<f64>) -> (f64, f64, f64) {
    values.sort_by(f64::total_cmp);
    let at = |part: usize| values[(values.len() - 1) * part / 4];
    (at(1), at(2), at(3))
}

/// The best level of the machine, or the one that `LOBE_LEVEL` names, with its name.
///
/// # Panics
///
/// If it names none.
pub fn wanted_level() -> (&'static str, Level) {
    let mut all: Vec<_> = levels(Level::new()).collect();
    let wanted = std::env::var("LOBE_LEVEL");
    all.retain(|(name, _)| wanted.as_deref().is_ok_and(|wanted| wanted == *name) || wanted.is_err());
    all.pop().unwrap_or_else(|| panic!("LOBE_LEVEL={wanted:?} is no level of this machine"))
}
