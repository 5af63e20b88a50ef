//! A line of `lobe eval`: two unit vectors, nothing, or an error in one line; the same for all number types.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lobe_cli::eval::{Line, Scalar, parse_line};

fn check<R: Scalar>(line: &[u8], normalize: bool) {
    match parse_line::<R>(line, normalize) {
        Ok(Line::Pair(l, v)) => {
            for direction in [l, v] {
                let length = direction.map(R::wide).length();
                assert!((length - 1.0).abs() <= R::LENGTH_TOLERANCE, "{direction:?}");
            }
        }
        Ok(Line::Skip) => {}
        Err(problem) => assert_eq!(problem.lines().count(), 1, "{problem}"),
    }
}

fuzz_target!(|input: &[u8]| {
    // A line is what stands before the end of the line.
    let line = input.split(|&byte| byte == b'\n').next().unwrap_or_default();
    for normalize in [false, true] {
        check::<f32>(line, normalize);
        check::<f64>(line, normalize);
        check::<lobe::Half>(line, normalize);
    }
});
