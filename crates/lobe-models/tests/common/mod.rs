//! What several tests share.

use lobe::Vec3;

/// Directions all over the hemisphere, none of them on a pole or an axis.
pub(crate) fn directions() -> Vec<Vec3<f64>> {
    let mut all = Vec::new();
    for i in 0..6 {
        for j in 0..7 {
            let (theta, phi) = (0.02 + 0.25 * f64::from(i), 0.9 * f64::from(j) + 0.1);
            all.push(Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()));
        }
    }
    all
}
