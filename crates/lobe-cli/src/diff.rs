//! `lobe diff`: how far two pictures are apart, in numbers and to the eye.

use crate::args::DiffArgs;
use crate::error::Failure;
use crate::output;
use lobe_scene::image::{Display, check_ending};
use lobe_scene::{Image, check_writable};
use lobe_trade::delta_e;
use serde_json::json;

/// ΔE 2000 that the picture of the difference shows in its brightest colour: everybody sees it.
const BRIGHTEST: f64 = 10.0;

/// Runs the verb.
pub(crate) fn run(args: &DiffArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    if let Some(path) = &args.output {
        check_ending(path).map_err(|error| Failure::Usage(error.to_string()))?;
        check_writable(path)?;
    }
    let (a, b) = (Image::load(&args.a)?, Image::load(&args.b)?);
    if (a.width(), a.height()) != (b.width(), b.height()) {
        return Err(Failure::Input(format!(
            "{} is {}x{} and {} is {}x{}; give two pictures of one size",
            args.a.display(),
            a.width(),
            a.height(),
            args.b.display(),
            b.width(),
            b.height()
        )));
    }
    let gain = args.exposure.exp2();
    let mut found = Found::default();
    let mut deltas = Vec::with_capacity(a.pixels().len());
    for (index, (&a, &b)) in a.pixels().iter().zip(b.pixels()).enumerate() {
        let shown = |pixel: [f32; 3]| pixel.map(|x| f64::from(x * gain).clamp(0.0, 1.0));
        let linear = a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs())).fold(0.0, larger);
        let (delta, steps) = delta_e(shown(a), shown(b));
        found.add(index, linear, delta, steps);
        deltas.push(delta);
    }
    found.finish(&mut deltas.clone());
    if let Some(path) = &args.output {
        let mut map = Image::new(a.width(), a.height())?;
        for (pixel, delta) in map.pixels_mut().iter_mut().zip(&deltas) {
            *pixel = heat(delta / BRIGHTEST);
        }
        map.save(path, &Display::default())?;
    }
    let [x, y] = [found.place % a.width() as usize, found.place / a.width() as usize];
    if json {
        let facts = json!({
            "a": args.a.display().to_string(),
            "b": args.b.display().to_string(),
            "width": a.width(),
            "height": a.height(),
            "linear": {"mean": number(found.linear_mean), "worst": number(found.linear)},
            "delta_e_2000": {"mean": number(found.mean), "p99": number(found.p99), "worst": number(found.worst)},
            "steps_of_8_bits": found.steps,
            "differing_pixels": found.differing,
            "worst_pixel": [x, y],
        });
        output::print(format!("{facts:#}\n").as_bytes())?;
    } else if !quiet {
        let Found { linear, linear_mean, mean, p99, worst, steps, differing, .. } = &found;
        let all = deltas.len();
        output::print(
            format!(
                "linear      mean {linear_mean:.3e}, worst {linear:.3e}\n\
                 Delta E     mean {mean:.3}, p99 {p99:.3}, worst {worst:.3} at {x},{y}\n\
                 8 bits      {steps} steps at most; {differing} of {all} pixels differ\n"
            )
            .as_bytes(),
        )?;
    }
    match args.max {
        Some(max) if found.worst.is_nan() || found.worst > max => {
            Err(Failure::Check(format!("the worst Delta E is {:.3} at {x},{y}; at most {max} is allowed", found.worst)))
        }
        _ => Ok(()),
    }
}

/// The larger one; NaN if one of them is.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// A number of JSON, which has no infinity.
fn number(x: f64) -> serde_json::Value {
    if x.is_finite() { json!(x) } else { json!(x.to_string()) }
}

/// What is known of all pixels.
#[derive(Default)]
struct Found {
    linear: f64,
    linear_mean: f64,
    mean: f64,
    p99: f64,
    worst: f64,
    place: usize,
    steps: u8,
    differing: usize,
    count: usize,
}

impl Found {
    fn add(&mut self, index: usize, linear: f64, delta: f64, steps: u8) {
        self.count += 1;
        self.linear = larger(linear, self.linear);
        self.linear_mean += linear;
        self.mean += delta;
        self.differing += usize::from(linear.is_nan() || linear > 0.0);
        self.steps = self.steps.max(steps);
        if delta.is_nan() || delta > self.worst {
            (self.worst, self.place) = (delta, index);
        }
    }

    /// Sums become means.
    fn finish(&mut self, deltas: &mut [f64]) {
        let count = self.count.max(1);
        self.linear_mean /= count as f64;
        self.mean /= count as f64;
        let at = (count - 1) * 99 / 100;
        if at < deltas.len() {
            self.p99 = *deltas.select_nth_unstable_by(at, f64::total_cmp).1;
        }
    }
}

/// A colour from black by way of blue, red and yellow to white, for 0 to 1; brighter means more in grey, too.
fn heat(x: f64) -> [f32; 3] {
    const STOPS: [[f32; 3]; 5] = [[0.0; 3], [0.05, 0.03, 0.35], [0.6, 0.05, 0.15], [0.95, 0.5, 0.03], [1.0, 1.0, 0.85]];
    if x.is_nan() {
        return [1.0, 0.0, 1.0];
    }
    let at = x.clamp(0.0, 1.0) as f32 * (STOPS.len() - 1) as f32;
    let low = (at as usize).min(STOPS.len() - 2);
    let part = at - low as f32;
    std::array::from_fn(|i| STOPS[low][i] + (STOPS[low + 1][i] - STOPS[low][i]) * part)
}
