//! Which lobe the fits of Ngan et al. 2005 call Blinn-Phong: `cargo run -p lobe-models --example which_blinn_phong`.
//!
//! A lobe of the half vector that is as wide as Ward's has `q = 2/α²`, a mirror lobe a fourth of that. The exponents
//! are told apart by this, the factor by the height of the peak at normal incidence, which each model was fitted to.

use lobe_models::ngan;
use std::f64::consts::PI;

/// The quartiles of a list.
pub(crate) fn quartiles(mut list: Vec<f64>) -> [f64; 3] {
    list.sort_by(f64::total_cmp);
    [1, 2, 3].map(|part| list[list.len() * part / 4])
}

/// For each material with a highlight: the exponent over that of a half-vector lobe as wide as Ward's, and the peaks of
/// three factors over Ward's.
pub(crate) fn evidence() -> Vec<[f64; 4]> {
    let of = |material: &str, model: &str| ngan::fit(material, model).expect("all are fitted with all").clone();
    ngan::materials()
        .map(|material| (of(material, "blinn-phong"), of(material, "ward")))
        .filter(|(blinn, ward)| blinn.ks[1] > 0.0 && ward.ks[1] > 0.0)
        .map(|(blinn, ward)| {
            let q = blinn.parameter("q").expect("it has one");
            let alpha = ward.parameter("alpha").expect("it has one");
            let peak = ward.ks[1] / (4.0 * PI * alpha * alpha);
            let over = |factor: f64| blinn.ks[1] * factor / peak;
            let (mirror, common) = ((q + 2.0) / (2.0 * PI), (q + 8.0) / (8.0 * PI));
            [q * alpha * alpha / 2.0, over(mirror), over(common), over(1.0 / PI)]
        })
        .collect()
}

#[cfg_attr(test, allow(dead_code, reason = "the test only takes the figures"))]
fn main() {
    let evidence = evidence();
    println!("{} materials; quartiles and median of each ratio", evidence.len());
    for (index, what) in [
        "q / (2/alpha^2): 1 for a half-vector lobe, 1/4 for a mirror lobe",
        "peak with (q+2)/(2 pi) over Ward's",
        "peak with (q+8)/(8 pi) over Ward's",
        "peak with 1/pi, no normalisation, over Ward's",
    ]
    .into_iter()
    .enumerate()
    {
        let [low, median, high] = quartiles(evidence.iter().map(|row| row[index]).collect());
        println!("{low:8.4} {median:8.4} {high:8.4}   {what}");
    }
}
