//! The functions of `Fast` and `Coarse` keep their promises, as scalars and at every level of this machine: a dense sample
//! and all boundaries here, all 2³² with `lobe sweep --precision all`.

use lobe_verify::rough::{FUNCTIONS, PRECISIONS, Promise, sweep, sweep_boundaries, ways};

#[test]
fn rough_functions_are_within_their_bounds() {
    let ways = ways(&PRECISIONS);
    for function in FUNCTIONS {
        // A prime, so that no pattern of the low bits is left out.
        for found in [sweep(function, &ways, 1009, &|_| ()), sweep_boundaries(function, &ways)] {
            for (way, worst) in ways.iter().zip(found) {
                let allowed = function.promise(way.precision).expect("both are there").allowed;
                assert!(worst.tried > 100_000, "{}: only {} tried", function.name, worst.tried);
                assert!(worst.error <= allowed, "{} {way:?}: {worst:?}", function.name);
            }
        }
    }
}

#[test]
fn a_sweep_finds_what_must_not_be() {
    let [exp2, .., recip, _] = FUNCTIONS else { panic!("the first and the last but one are known") };
    assert_eq!((exp2.name, recip.name), ("exp2", "recip"));
    let way = &ways(&PRECISIONS)[..1];
    type Lanes = fn(&[f32], &mut [f32]);
    let wrong: [Lanes; 3] = [
        // A NaN and an infinity from a finite argument, 0 where the result is a normal number.
        |_, out| out.fill(f32::NAN),
        |x, out| x.iter().zip(out).for_each(|(&x, out)| *out = if x == 1.0 { f32::INFINITY } else { x.exp2() }),
        |x, out| x.iter().zip(out).for_each(|(&x, out)| *out = if x == -1.0 { 0.0 } else { x.exp2() }),
    ];
    for (scalar, error) in wrong.into_iter().zip([f64::INFINITY, f64::INFINITY, 1.0]) {
        let function = lobe_verify::rough::Function { fast: Promise { scalar, ..exp2.fast }, ..*exp2 };
        assert_eq!(sweep_boundaries(&function, way)[0].error, error);
    }
    // A NaN that is lost.
    let function = lobe_verify::rough::Function {
        fast: Promise {
            scalar: |x, out| x.iter().zip(out).for_each(|(x, out)| *out = x.max(-1.0).recip()),
            ..recip.fast
        },
        ..*recip
    };
    let worst = sweep_boundaries(&function, way)[0];
    assert_eq!((worst.error, worst.argument.is_nan()), (f64::INFINITY, true));
}

#[test]
fn the_table_in_the_docs_is_that_of_the_code() {
    let document = include_str!("../../../docs/numerics.md");
    for function in FUNCTIONS {
        for precision in PRECISIONS {
            let start = format!("| `{}` | {precision} |", function.name);
            let row = document.lines().find(|line| line.starts_with(&start));
            let row = row.unwrap_or_else(|| panic!("no row that starts with {start} in docs/numerics.md"));
            let cells: Vec<_> = row.trim_matches('|').split('|').map(str::trim).collect();
            let [_, _, measured @ .., allowed, domain] = &cells[..] else { panic!("too few cells: {row}") };
            let promise = function.promise(precision).expect("both are there").allowed;
            assert_eq!(allowed.parse(), Ok(promise), "{row}: the bound of the code is another");
            assert_eq!(*domain, function.domain_in_words, "{row}");
            assert!(measured.len() == 4, "{row}: the scalar and three levels");
            for cell in measured {
                let error: f64 = cell.parse().unwrap_or_else(|_| panic!("{row}: {cell} is no number"));
                assert!(error > 0.0 && error <= promise, "{row}: {error} is not within the bound");
            }
        }
    }
}
