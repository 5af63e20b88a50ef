//! `lobe sample`: directions of light that a BRDF draws for a viewer, line by line; and what its samplers cost.

use crate::args::{Number, SampleArgs, Sequence};
use crate::error::Failure;
use crate::eval::Scalar;
use crate::output;
use crate::progress::Progress;
use crate::spec;
use lobe::distribution::Ggx;
use lobe::fresnel::Schlick;
use lobe::masking::SmithCorrelated;
use lobe::{Alpha, Brdf, Microfacet, Rgb, Vec3};
use lobe_models::{AnyBrdf, Material, SampleNumber, models};
use lobe_sampling::facets::{Bounded, ByDistribution, Caps, ProjectedDisc};
use lobe_sampling::{ByCosine, Outcome, Sample, SampleBy as _, Sampled};
use lobe_verify::sampling::{InDouble, Points, Sampler, Variance, variances, view};
use lobe_verify::subject::Precision;
use serde_json::{Value, json};
use std::io::{BufWriter, Write};

/// Runs the verb.
pub(crate) fn run(args: &SampleArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    if args.variance {
        return variance(json);
    }
    let spec = spec::from_argument(&args.brdf)?;
    if !quiet {
        for warning in spec.warnings() {
            let _ = writeln!(std::io::stderr(), "warning: {warning}");
        }
    }
    match args.number {
        Number::F32 => draw::<f32>(&spec, args, Precision::Single, quiet, json),
        Number::F64 => draw::<f64>(&spec, args, Precision::Double, quiet, json),
        _ => Err(Failure::Usage("samples are drawn in f32 or f64: give --number f32 or f64".to_owned())),
    }
}

/// The numbers that are drawn in.
trait Drawn: SampleNumber + Scalar + lobe::Real<Mask = bool> {}
impl Drawn for f32 {}
impl Drawn for f64 {}

/// What the samples came to.
#[derive(Default)]
struct Told {
    count: u64,
    rejected: u64,
    delta: u64,
    sum: [f64; 3],
    squares: [f64; 3],
}

impl Told {
    fn add(&mut self, weight: [f64; 3]) {
        self.count += 1;
        for ((sum, square), w) in self.sum.iter_mut().zip(&mut self.squares).zip(weight) {
            *sum += w;
            *square += w * w;
        }
    }

    /// The mean weight, and its standard error if the samples were independent.
    fn mean(&self) -> ([f64; 3], [f64; 3]) {
        let n = self.count.max(1) as f64;
        let mean = self.sum.map(|sum| sum / n);
        let error = std::array::from_fn(|i| ((self.squares[i] / n - mean[i] * mean[i]).max(0.0) / n).sqrt());
        (mean, error)
    }
}

fn draw<R: Drawn>(
    spec: &Material,
    args: &SampleArgs,
    precision: Precision,
    quiet: bool,
    json: bool,
) -> Result<(), Failure> {
    let sampler = spec.sampler::<R>();
    let v = Vec3::from(args.view.map(R::from_f64));
    let name = args.seed.to_string();
    let points = match args.sequence {
        Sequence::Random => Points::random(&name),
        Sequence::Sobol => Points::even(&name),
    };
    let bar = Progress::new("samples", args.count, quiet || args.count < 1_000_000);
    let mut out = BufWriter::with_capacity(1 << 16, std::io::stdout().lock());
    let mut told = Told::default();
    let count = usize::try_from(args.count).unwrap_or(usize::MAX);
    if !json && !output::stdout_result(out.write_all(b"kind,lx,ly,lz,r,g,b,pdf\n"))? {
        return Ok(());
    }
    for u in points.take(precision, count) {
        if told.count % 4096 == 4095 {
            bar.advance(4096);
        }
        let sampled = sampler.sample(v, u.map(R::from_f64));
        let outcome = sampled.outcome();
        told.add([sampled.weight.r, sampled.weight.g, sampled.weight.b].map(R::wide));
        told.rejected += u64::from(sampled.rejected);
        told.delta += u64::from(sampled.delta);
        if !output::stdout_result(print(&mut out, sampled, outcome, json))? {
            return Ok(());
        }
    }
    output::stdout_result(out.flush())?;
    drop(bar);
    if !quiet && told.count > 0 {
        let (mean, error) = told.mean();
        let share = |part: u64| part as f64 / told.count as f64;
        let [r, g, b] = std::array::from_fn(|i| format!("{:.5} ± {:.5}", mean[i], error[i]));
        let _ = writeln!(
            std::io::stderr(),
            "{} samples; mean weight {r}, {g}, {b}; rejected {:.3} %, deltas {:.3} %",
            told.count,
            100.0 * share(told.rejected),
            100.0 * share(told.delta)
        );
    }
    Ok(())
}

/// A line: what a rejected sample has not is left empty.
fn print<R: Drawn>(
    out: &mut impl Write,
    Sampled { l, weight, pdf, .. }: Sampled<R>,
    outcome: Outcome<R>,
    json: bool,
) -> std::io::Result<()> {
    let numbers = |list: &[R]| list.iter().map(|x| x.print()).collect::<Vec<_>>().join(",");
    let (l, weight, pdf) = (numbers(&[l.x, l.y, l.z]), numbers(&[weight.r, weight.g, weight.b]), pdf.print());
    match (outcome, json) {
        (Outcome::Scattered { .. }, false) => writeln!(out, "scattered,{l},{weight},{pdf}"),
        (Outcome::Delta { .. }, false) => writeln!(out, "delta,{l},{weight},"),
        (Outcome::Rejected, false) => writeln!(out, "rejected,,,,0,0,0,"),
        (Outcome::Scattered { .. }, true) => {
            writeln!(out, "{{\"kind\":\"scattered\",\"l\":[{l}],\"weight\":[{weight}],\"pdf\":{pdf}}}")
        }
        (Outcome::Delta { .. }, true) => {
            writeln!(out, "{{\"kind\":\"delta\",\"l\":[{l}],\"weight\":[{weight}]}}")
        }
        (Outcome::Rejected, true) => writeln!(out, "{{\"kind\":\"rejected\"}}"),
    }
}

/// Samplers by name.
type Named = Vec<(String, Box<dyn Sample<f64> + Send + Sync>)>;

/// A lobe behind its pointer.
struct Held(AnyBrdf<f64>);

impl Brdf<f64> for Held {
    fn eval(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.0.eval(l, v)
    }
    fn eval_cos(&self, l: Vec3<f64>, v: Vec3<f64>) -> Rgb<f64> {
        self.0.eval_cos(l, v)
    }
}

/// GGX by each method, and each model of the catalogue by its own sampler and by the cosine.
fn samplers() -> Named {
    let mut all: Named = Vec::new();
    for alpha in [0.05, 0.3, 1.0] {
        let white = Schlick::new(Rgb::splat(1.0_f64));
        let ggx = Microfacet::new(Ggx::new(Alpha(alpha)), SmithCorrelated, white);
        let mut add = |method: &str, sampler| all.push((format!("ggx, α = {alpha}: {method}"), sampler));
        add("bounded visible normals", Box::new(ggx.by(Bounded)));
        add("visible normals, caps", Box::new(ggx.by(Caps)));
        add("visible normals, disc", Box::new(ggx.by(ProjectedDisc)));
        add("D cos θ", Box::new(ggx.by(ByDistribution)));
        add("cosine", Box::new(ByCosine(ggx)));
    }
    for model in models() {
        let lobe = model.typical();
        all.push((model.name.to_owned(), lobe.sampler()));
        all.push((format!("{}: cosine", model.name), Box::new(ByCosine(Held(lobe.build())))));
    }
    all
}

/// The table of `--variance`, in Markdown: it stands in the documentation as it is printed.
fn variance(json: bool) -> Result<(), Failure> {
    let samplers = samplers();
    let views = [view(1.0, 30.0), view(0.5, 30.0), view(0.1, 30.0), view(0.01, 30.0)];
    let held: Vec<_> = samplers.iter().map(|(name, sampler)| (name.as_str(), InDouble(&**sampler))).collect();
    let list: Vec<_> = held.iter().map(|(name, sampler)| (*name, sampler as &dyn Sampler)).collect();
    let rows = variances(&list, &views);
    if json {
        let rows: Vec<_> = rows.iter().map(|row| json!(row)).collect();
        return output::print(format!("{:#}\n", Value::from(rows)).as_bytes());
    }
    let mut text = String::from("| samples for 1 % of the albedo | ");
    text += &views.map(|[_, _, z]| format!("cos θ = {z:.2}")).join(" | ");
    text += " | rejected at most |\n|---|---|---|---|---|---|\n";
    for (name, _) in &samplers {
        let mine: Vec<&Variance> = rows.iter().filter(|row| row.name == *name).collect();
        if mine.is_empty() {
            continue;
        }
        let cell = |v: &[f64; 3]| match mine.iter().find(|row| row.v == *v) {
            Some(row) if row.samples < 1e6 => format!("{:.0}", row.samples),
            Some(row) => format!("{:.0e}", row.samples),
            None => String::new(),
        };
        let rejected = mine.iter().map(|row| row.rejected).fold(0.0, f64::max);
        text += &format!("| {name} | {} | {:.1} % |\n", views.each_ref().map(cell).join(" | "), 100.0 * rejected);
    }
    output::print(text.as_bytes())
}
