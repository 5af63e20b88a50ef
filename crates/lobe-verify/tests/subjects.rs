//! Subjects that are not lobes of ours: closures that panic, programs that answer rightly and wrongly.

#![cfg(unix)]

use lobe::{Lambert, Rgb};
use lobe_verify::properties::{Claims, Effort, Outcome, Property, agrees_with, verify, verify_with};
use lobe_verify::subject::{InSingle, Program, Subject, SubjectError};
use std::time::{Duration, Instant};

/// A program of `awk`, that reads fields apart by commas.
fn awk(text: &str) -> Program {
    Program::new("awk", ["-F,", text])
}

const LAMBERT: &str = r#"{ f = ($3 > 0 && $6 > 0) ? 0.25464790894703254 : 0; printf "%.9g,%.9g,%.9g\n", f, f, f }"#;

/// What a program does wrong when it is asked for three pairs.
fn problem(program: &Program) -> String {
    let pairs = [[0.0, 0.0, 1.0, 0.0, 0.0, 1.0], [0.6, 0.0, 0.8, 0.0, 0.0, 1.0], [0.0, 0.6, 0.8, 0.0, 0.0, 1.0]];
    program.eval(&pairs).expect_err("a wrong program").to_string()
}

#[test]
fn a_sound_program_passes_and_agrees_with_its_original() {
    let program = awk(LAMBERT);
    let few = Effort { grid: 300, random: 300, views: 2, ..Effort::QUICK };
    let report = verify_with(&program, &Claims::OTHERS.isotropic(), few);
    println!("{report}");
    assert!(report.holds(), "{report}");
    assert_eq!(report.verdict(Property::Energy).map(|v| &v.outcome), Some(&Outcome::Holds));
    let ours = Lambert::new(Rgb::splat(0.8_f32));
    let verdict = agrees_with(&program, &InSingle(&ours), 1e-6, few);
    assert!(verdict.holds(), "{verdict}");
}

#[test]
fn a_program_that_prints_too_few_lines_is_told_with_the_line() {
    let text = problem(&awk("NR < 3 { print \"1,1,1\" }"));
    assert!(text.contains("ended with status 0 after line 2 of 3; it prints one line r,g,b for each line"), "{text}");
}

#[test]
fn a_program_that_dies_is_told_with_its_status_and_its_last_words() {
    let text = problem(&Program::new("sh", ["-c", "read line; echo 1,1,1; echo no such texture >&2; exit 3"]));
    assert!(text.contains("ended with status 3 after line 1 of 3"), "{text}");
    assert!(text.ends_with("it said: no such texture"), "{text}");
}

#[test]
fn a_program_that_is_killed_is_told_with_the_signal() {
    let text = problem(&Program::new("sh", ["-c", "kill -9 $$"]));
    assert!(text.contains("signal: 9") && text.contains("after line 0 of 3"), "{text}");
}

#[test]
fn a_program_that_hangs_is_killed() {
    let start = Instant::now();
    let hanging = Program::new("sh", ["-c", "echo 1,1,1; sleep 60"]).silent_for(Duration::from_millis(300));
    let text = problem(&hanging);
    assert!(text.contains("printed nothing for 0.3 s after line 1 of 3 and was killed"), "{text}");
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    // And once only, not for each property.
    let report = verify(&hanging);
    let broken = report.verdicts.iter().filter(|v| matches!(v.outcome, Outcome::Broken(_))).count();
    assert_eq!(broken, 1, "{report}");
}

#[test]
fn a_program_that_closes_its_output_and_hangs_is_killed() {
    let text = problem(
        &Program::new("sh", ["-c", "echo 1,1,1; exec >&- 2>&-; sleep 60"]).silent_for(Duration::from_millis(300)),
    );
    assert!(text.contains("after line 1 of 3 and was killed"), "{text}");
}

#[test]
fn answers_that_are_no_values_are_told_with_their_line() {
    let text = problem(&awk("NR == 2 { print \"Segmentation fault\"; next } { print \"1,1,1\" }"));
    assert!(text.contains("line 2 of its output: `Segmentation fault` has 1 field, not 3"), "{text}");
    assert!(text.contains("(here 0.6,0.0,0.8,0.0,0.0,1.0)"), "{text}");
    let text = problem(&awk("{ print NR == 3 ? \"1,1,x\" : \"1,1,1\" }"));
    assert!(text.contains("line 3 of its output: `x` is not a number"), "{text}");
    let text = problem(&awk("{ print \"1,1,1\"; print \"1,1,1\" }"));
    assert!(text.contains("line 4 of its output: there were 3 lines to answer, and this is one more"), "{text}");
}

#[test]
fn a_nan_is_told_with_the_line_that_it_answers() {
    let nan = r#"{ f = ($3 > 0 && $6 > 0) ? 0.1 : 0; if ($3 > 0.4 && $3 < 0.6) f = "nan"; print f "," f "," f }"#;
    let few = Effort { grid: 300, random: 0, views: 1, ..Effort::QUICK };
    let report = verify_with(&awk(nan), &Claims::OTHERS, few);
    let verdict = report.verdict(Property::Finite).unwrap();
    assert_eq!(verdict.outcome, Outcome::Fails);
    let worst = verdict.worst.as_ref().unwrap();
    assert!(worst.line.is_some() && worst.observed[0].value[0].is_nan(), "{verdict}");
    let simplest = verdict.simplest.as_ref().unwrap();
    assert_eq!(simplest.input(), "0.8660254,0.0,0.5,0.0,0.0,1.0", "{verdict}");
}

#[test]
fn a_program_that_is_not_there_is_told() {
    let text = problem(&Program::new("no-such-program", ["x"]));
    assert!(text.starts_with("cannot start `no-such-program x`: "), "{text}");
}

#[test]
fn a_large_batch_does_not_block_the_pipes() {
    let pairs = vec![[0.123_456_789, 0.0, 0.992_349_9, 0.0, 0.0, 1.0]; 200_000];
    assert!(Program::new("cat", ["/dev/null"]).eval(&pairs).is_err());
    assert_eq!(awk("{ print \"1,2,3\" }").eval(&pairs).unwrap().len(), pairs.len());
}

#[test]
fn a_panic_is_caught_at_the_simplest_pair_that_has_one() {
    let closure = |l: [f64; 3], v: [f64; 3]| {
        assert!(l[2] > 0.05, "no table for grazing light");
        if v[2] > 0.0 { [0.1; 3] } else { [0.0; 3] }
    };
    let report = verify(&closure);
    let Some(Outcome::Broken(SubjectError::Panicked { pair, message })) =
        report.verdict(Property::Finite).map(|v| v.outcome.clone())
    else {
        panic!("{report}");
    };
    assert_eq!(pair[2], 0.01, "{report}");
    assert_eq!(pair[3..], [0.0, 0.0, 1.0]);
    assert!(message.contains("subjects.rs") && message.ends_with("no table for grazing light"), "{message}");
    assert!(!report.holds());
}

#[test]
fn a_closure_of_a_textbook_passes() {
    let pi = std::f64::consts::PI;
    let report = verify(&|l: [f64; 3], v: [f64; 3]| [if l[2] > 0.0 && v[2] > 0.0 { 0.9 / pi } else { 0.0 }; 3]);
    println!("{report}");
    assert!(report.holds(), "{report}");
    let nan = report.verdict(Property::Nan).unwrap();
    assert_eq!(nan.outcome, Outcome::Measured);
}

lobe_verify::suite!(paper, Lambert::new(Rgb::splat(0.8_f32)), isotropic: Some(64.0));
lobe_verify::suite!(closure, |_: [f64; 3], _: [f64; 3]| [0.1; 3], below_horizon: false);
