//! Which factor the fits of Ngan et al. 2005 have in Cook-Torrance: `cargo run -p lobe-models --example which_cook_torrance`.
//!
//! At normal incidence neither V-cavities nor Ashikhmin and Shirley's model mask anything, and both have Schlick's
//! Fresnel term: there the two fits of a material should have the same peak.

use lobe_models::ngan;
use std::f64::consts::PI;

fn main() {
    let ratio = |material: &str| {
        let of = |model: &str| ngan::fit(material, model).expect("all are fitted with all").clone();
        let (cook, shirley) = (of("cook-torrance"), of("ashikhmin-shirley"));
        let number = |fit: &ngan::Fit, name: &str| fit.parameter(name).expect("it has one");
        let (m, q) = (number(&cook, "m"), number(&shirley, "q"));
        let beckmann = 1.0 / (PI * m * m);
        let peak = cook.ks[1] * number(&cook, "f0") * beckmann;
        peak / (shirley.ks[1] * number(&shirley, "f0") * (q + 1.0) / (8.0 * PI))
    };
    let mut ratios: Vec<f64> = ngan::materials().map(ratio).filter(|ratio| ratio.is_finite()).collect();
    ratios.sort_by(f64::total_cmp);
    println!("{} materials; quartiles and median of the peak over that of Ashikhmin-Shirley", ratios.len());
    for (what, factor) in
        [("1/4, D normalised", 0.25), ("1/pi, D normalised", 1.0 / PI), ("1/pi, D as printed, without its 1/pi", 1.0)]
    {
        let [low, median, high] = [1, 2, 3].map(|part| factor * ratios[ratios.len() * part / 4]);
        println!("{low:8.4} {median:8.4} {high:8.4}   {what}");
    }
}
