//! The samplers of this workspace against their densities and their lobes.

use lobe_verify::sampling::{Effort, Suite, models};

fn all_hold(suite: &Suite) {
    println!("{suite}");
    for model in lobe_models::models() {
        let there = suite.reports.iter().any(|report| report.name.split(' ').next() == Some(model.name));
        assert!(there, "{} is not sampled", model.name);
    }
    assert!(suite.holds());
}

#[test]
fn samplers_of_all_models_hold() {
    // Along the normal and next to the horizon: the command has more views.
    all_hold(&models(Effort { views: 2, ..Effort::QUICK }));
}

/// `cargo test --release -p lobe-verify --test sampling -- --ignored --nocapture`.
#[test]
#[ignore = "three quarters of an hour"]
fn samplers_of_all_models_hold_in_full() {
    all_hold(&models(Effort::FULL));
}
