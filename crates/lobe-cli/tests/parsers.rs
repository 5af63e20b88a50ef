//! No text makes the parsers panic.

use lobe_cli::{eval, spec};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_bytes_are_a_line_or_an_error(line in proptest::collection::vec(any::<u8>(), 0..200), normalize: bool) {
        let _ = eval::parse_line::<f32>(&line, normalize);
        let _ = eval::parse_line::<f64>(&line, normalize);
    }

    #[test]
    fn any_six_numbers_are_a_pair_of_unit_vectors_or_an_error(numbers: [f64; 6], normalize: bool) {
        let line = numbers.map(|x| format!("{x:e}")).join(",");
        if let Ok(line) = eval::parse_line::<f64>(line.as_bytes(), normalize) {
            let eval::Line::Pair(l, v) = line else { panic!("numbers are no comment") };
            prop_assert!((l.length() - 1.0).abs() <= 1.1e-5 && (v.length() - 1.0).abs() <= 1.1e-5);
        }
    }

    #[test]
    fn any_text_is_a_brdf_or_one_line_of_error(text in ".*") {
        if let Err(failure) = spec::parse(&text, "x") {
            prop_assert!(failure.to_string().starts_with("x:") && failure.to_string().lines().count() == 1);
        }
    }

    /// Close to right: the words of the format in any order.
    #[test]
    fn any_words_are_a_brdf_or_an_error(words in proptest::collection::vec(
        proptest::sample::select(vec![
            "{", "}", "[", "]", ",", ":", "\"lobes\"", "\"model\"", "\"phong\"", "\"ks\"", "\"q\"", "1", "-1", "1e400", "null",
            "\"lambert\"", "\"albedo\"", "\"name\"", "{\"lobes\": [{\"model\": \"phong\", \"ks\":", "\"normalization\"",
        ]), 0..24,
    )) {
        if let Ok(spec) = spec::parse(&words.concat(), "x") {
            let _ = (spec.build::<f32>(), spec.description(), spec.warnings());
        }
    }
}
