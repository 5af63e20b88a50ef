//! `lobe trade`: what digits cost in time and code, and what may be saved within an error that nobody sees.

use crate::args::TradeArgs;
use crate::error::Failure;
use crate::output;
use crate::plot::{Dot, pareto};
use crate::progress::Progress;
use crate::render;
use lobe::batch::{Level, levels};
use lobe::{Rgb, Shininess};
use lobe_models::{Lobe, Material, Value, model, nearest};
use lobe_scene::{Scene, Surface, check_writable};
use lobe_trade::{Bench, Effort, Number, Quartiles, Row, Subject, catalogue, is_noisy};
use serde_json::json;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

/// Runs the verb.
pub(crate) fn run(args: &TradeArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    let subjects = subjects(args, quiet)?;
    for file in [&args.csv, &args.markdown].into_iter().flatten() {
        check_writable(file)?;
    }
    if let Some(folder) = &args.svg {
        let names: Vec<_> = subjects.iter().map(|subject| folder.join(file_name(&subject.name))).collect();
        output::make_folder(folder, &names.iter().map(AsRef::as_ref).collect::<Vec<_>>())?;
    }

    let mut bench = Bench::new(if args.quick { Effort::quick() } else { Effort::full() });
    let numbers = Number::all();
    let bar = Progress::new("trade", subjects.len() as u64, quiet);
    let mut all = Vec::new();
    for (index, subject) in subjects.iter().enumerate() {
        let rows = bench.measure(subject, &numbers);
        bar.advance(1);
        if !json {
            let mut text = if index == 0 { machine() + "\n" } else { String::new() };
            match args.budget {
                Some(budget) => text += &choice(&rows, budget),
                None => text += &table(&rows),
            }
            bar.suspend(|| output::print(text.as_bytes()))?;
        }
        all.push(rows);
    }
    drop(bar);

    let flat: Vec<Row> = all.iter().flatten().cloned().collect();
    let no_code = no_code(&flat, bench.no_code());
    if let (Some(why), false, None) = (&no_code, json, args.budget) {
        output::print(format!("bytes: {why}\n").as_bytes())?;
    }
    if is_noisy(&flat) && !quiet {
        let _ = writeln!(
            std::io::stderr(),
            "warning: this machine was too busy for its times to be trusted; run it again when nothing else runs"
        );
    }
    if json {
        output::print(format!("{:#}\n", facts(&all, args.budget, no_code.as_deref())).as_bytes())?;
    }
    if let Some(path) = &args.csv {
        output::write_file(path, csv(&flat).as_bytes())?;
    }
    if let Some(path) = &args.markdown {
        output::write_file(path, markdown(&all, is_noisy(&flat), no_code.as_deref()).as_bytes())?;
    }
    if let Some(folder) = &args.svg {
        for rows in &all {
            let Some(first) = rows.first() else { continue };
            let svg = pareto(&first.subject, &dots(rows), &KINDS);
            output::write_file(&folder.join(file_name(&first.subject)), svg.file().as_bytes())?;
        }
    }
    Ok(())
}

/// What is to be measured: the materials of a scene, one of the catalogue, or all of that.
fn subjects(args: &TradeArgs, quiet: bool) -> Result<Vec<Subject>, Failure> {
    if let Some(path) = &args.scene {
        let all = of_scene(&render::open(Some(path), None, quiet)?);
        if all.is_empty() {
            let path = path.display();
            return Err(Failure::Input(format!("{path}: no material of this scene has lobes; give one that reflects")));
        }
        return Ok(all);
    }
    let all = catalogue();
    let Some(name) = &args.only else { return Ok(all) };
    let near = nearest(name, all.iter().map(|subject| subject.name.as_str()), 3).join(", ");
    match all.into_iter().find(|subject| subject.name == *name) {
        Some(subject) => Ok(vec![subject]),
        None => Err(Failure::Usage(format!("unknown subject `{name}` for --only; the nearest are {near}"))),
    }
}

/// The materials of a scene that have lobes.
pub(crate) fn of_scene(scene: &Scene) -> Vec<Subject> {
    // As the views show them: what one puts in the place of a material is a material of the scene too.
    let mut materials: Vec<Material> = Vec::new();
    for view in &scene.views {
        for material in view.materials_of(&scene.materials).iter() {
            let lobes = of_surface(&material.name, &material.surface);
            let Some(mut lobes) = lobes.filter(|lobes| !lobes.lobes.is_empty()) else { continue };
            let known = |lobes: &Material| materials.iter().any(|m| m.name == lobes.name && m.lobes == lobes.lobes);
            if known(&lobes) {
                continue;
            }
            if materials.iter().any(|other| other.name == lobes.name) {
                lobes.name = format!("{}, view {}", lobes.name, view.name);
            }
            materials.push(lobes);
        }
    }
    materials.iter().map(Subject::of_material).collect()
}

/// The lobes of a material of a scene, by the names of the catalogue; nothing for one that is black.
fn of_surface(name: &str, surface: &Surface) -> Option<Material> {
    let colour = |c: Rgb| Value::Colour(<[f32; 3]>::from(c).map(f64::from));
    let lambert = |albedo: Rgb| Lobe::weighted(model("lambert")?, &[("albedo", colour(albedo))]).ok();
    let highlight = |name: &str, ks: Rgb, q: Shininess| {
        Lobe::weighted(model(name)?, &[("ks", colour(ks)), ("q", Value::Number(f64::from(q.0)))]).ok()
    };
    let lobes = match surface {
        Surface::Diffuse(a) => vec![lambert(a.albedo())?],
        Surface::BlinnTorrance(sum) => {
            vec![lambert(sum.a.albedo())?, highlight("lecture-blinn-torrance", sum.b.ks(), sum.b.shininess())?]
        }
        Surface::Phong(sum) => {
            vec![lambert(sum.a.albedo())?, highlight("lecture-phong", sum.b.ks(), sum.b.shininess())?]
        }
        Surface::NormalizedPhong(sum) => {
            vec![lambert(sum.a.albedo())?, highlight("phong", sum.b.ks(), sum.b.shininess())?]
        }
        Surface::NormalizedBlinnPhong(sum) => {
            vec![lambert(sum.a.albedo())?, highlight("blinn-phong", sum.b.ks(), sum.b.shininess())?]
        }
        Surface::Gltf(material) => material.lobes(),
        Surface::Lobes(lobes) => lobes.material().lobes.clone(),
        _ => return None,
    };
    Some(Material { name: name.to_owned(), lobes })
}

/// The machine, as far as it matters for a time: no name of a host.
pub(crate) fn machine() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let names: Vec<_> = levels(Level::new()).map(|(name, _)| name).collect();
    let s = if cores == 1 { "" } else { "s" };
    format!("{}, {cores} core{s}, {}\n", processor(), names.join(", "))
}

/// The model of the processor, where the system tells it; else its architecture.
fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = info.lines().find_map(|line| line.strip_prefix("model name"));
    let name = line.and_then(|rest| rest.split_once(':')).map(|(_, name)| name.split_whitespace().collect::<Vec<_>>());
    name.map_or_else(|| std::env::consts::ARCH.to_owned(), |words| words.join(" "))
}

/// An error in three or four letters.
pub(crate) fn short(error: f64) -> String {
    if error == 0.0 { "0".to_owned() } else { format!("{error:.0e}") }
}

/// The bytes of the code, or that they are not known.
fn bytes(row: &Row) -> String {
    row.code.map_or_else(|| "-".to_owned(), |bytes| bytes.to_string())
}

/// The nanoseconds of a sample, or that none is timed.
fn sample(row: &Row) -> String {
    row.sample.map_or_else(|| "-".to_owned(), |ns| format!("{:.2}", ns.median))
}

/// Why some rows have no bytes of code, if so.
fn no_code(rows: &[Row], none_at_all: Option<&str>) -> Option<String> {
    let lacking = rows.iter().any(|row| row.code.is_none());
    let some = || lacking.then_some("where there is `-`, this program has no function of the name that was looked for");
    none_at_all.or_else(some).map(str::to_owned)
}

/// The form and the number, without what need not be said.
pub(crate) fn what(row: &Row) -> String {
    if row.form == EXACT { row.number.name() } else { format!("{}, {}", row.number.name(), row.form) }
}

const EXACT: &str = "exact";

fn table(rows: &[Row]) -> String {
    let mut text = String::new();
    let mut form = "";
    for row in rows {
        if form.is_empty() {
            let _ = writeln!(
                text,
                "{:<33} ns (quartiles)        sample  stream  M/s all   bytes   median  p99     worst   albedo  ΔE mean  worst  8 bit",
                row.subject
            );
        }
        if row.form != form {
            form = &row.form;
            if form != EXACT {
                let _ = writeln!(text, "  {form}");
            }
        }
        let (ns, seen) = (row.resident, row.seen);
        let _ = writeln!(
            text,
            "    {:<16} {:>18.2} {:<15} {:>7} {:>7.2} {:>8.0} {:>7}   {:<7} {:<7} {:<7} {:<7} {:>7.3} {:>6.2} {:>6}",
            row.number.name(),
            ns.median,
            format!("({:.2}–{:.2})", ns.low, ns.high),
            sample(row),
            row.streaming.median,
            row.all_cores * 1e-6,
            bytes(row),
            short(row.error.median),
            short(row.error.p99),
            short(row.error.worst),
            short(row.albedo),
            seen.mean,
            seen.worst,
            seen.steps
        );
    }
    text.push('\n');
    text
}

/// The rows that a choice is made between and measured against.
pub(crate) struct Choice<'a> {
    /// The cheapest within the budget.
    pub(crate) cheapest: Option<&'a Row>,
    /// The scalar `f32`, which is what a renderer has that thinks of nothing.
    pub(crate) scalar: Option<&'a Row>,
    /// The cheapest with all digits.
    precise: Option<&'a Row>,
}

impl<'a> Choice<'a> {
    pub(crate) fn of(rows: &'a [Row], budget: f64) -> Self {
        let cheapest = |good: &dyn Fn(&Row) -> bool| {
            let good = rows.iter().filter(|row| good(row));
            good.min_by(|a, b| a.resident.median.total_cmp(&b.resident.median))
        };
        let digits = |row: &Row| {
            let precise = lobe_models::AnyPrecision::Precise;
            row.form == EXACT && matches!(row.number, Number::Lanes { precision, .. } if precision == precise)
        };
        Self {
            // The budget may be 1/255 as it was typed: a hair more is no step.
            cheapest: cheapest(&|row| f64::from(row.seen.steps) <= budget * 255.0 + 1e-6),
            scalar: rows.iter().find(|row| row.form == EXACT && matches!(row.number, Number::F32)),
            precise: cheapest(&digits),
        }
    }
}

fn choice(rows: &[Row], budget: f64) -> String {
    let Some(first) = rows.first() else { return String::new() };
    let Choice { cheapest: Some(best), scalar, precise } = Choice::of(rows, budget) else {
        return format!("{}: nothing is within the budget\n", first.subject);
    };
    let time = |row: &Row| row.resident.median;
    let saves = |than: Option<&Row>| than.map_or(0.0, |than| 100.0 * (1.0 - time(best) / time(than)));
    format!(
        "{}: {}, {:.2} ns, off by {}/255 and ΔE {:.2} at worst; saves {:.0} % of the scalar f32, {:.0} % of precise lanes\n",
        first.subject,
        what(best),
        time(best),
        best.seen.steps,
        best.seen.worst,
        saves(scalar),
        saves(precise)
    )
}

fn row_facts(row: &Row) -> serde_json::Value {
    // JSON has no word for an infinity.
    let number = |x: f64| if x.is_finite() { json!(x) } else { json!(null) };
    let times = |ns: Quartiles| json!({ "median": ns.median, "low": ns.low, "high": ns.high });
    json!({
        "form": row.form,
        "number": row.number.name(),
        "ns": times(row.resident),
        "ns_sample": row.sample.map(times),
        "ns_streaming": times(row.streaming),
        "per_second_all_cores": row.all_cores,
        "code_bytes": row.code,
        "error": {
            "median": number(row.error.median), "p99": number(row.error.p99), "worst": number(row.error.worst),
        },
        "albedo_error": number(row.albedo),
        "delta_e_2000": { "mean": number(row.seen.mean), "worst": number(row.seen.worst) },
        "steps_of_8_bits": row.seen.steps,
    })
}

pub(crate) fn facts(all: &[Vec<Row>], budget: Option<f64>, no_code: Option<&str>) -> serde_json::Value {
    let subjects: Vec<_> = all
        .iter()
        .filter_map(|rows| {
            let mut fact = json!({
                "subject": rows.first()?.subject,
                "rows": rows.iter().map(row_facts).collect::<Vec<_>>(),
            });
            if let Some(budget) = budget {
                fact["choice"] = Choice::of(rows, budget).cheapest.map(row_facts).into();
            }
            Some(fact)
        })
        .collect();
    let names: Vec<_> = levels(Level::new()).map(|(name, _)| name).collect();
    json!({
        "processor": processor(),
        "cores": std::thread::available_parallelism().map_or(1, usize::from),
        "levels": names,
        "noisy": is_noisy(&all.iter().flatten().cloned().collect::<Vec<_>>()),
        "no_code": no_code,
        "subjects": subjects,
    })
}

fn csv(rows: &[Row]) -> String {
    let mut text = String::from(
        "subject,form,number,ns,ns_low,ns_high,ns_sample,ns_sample_low,ns_sample_high,ns_streaming,per_second_all_cores,error_median,error_p99,error_worst,\
         albedo_error,delta_e_mean,delta_e_worst,steps_of_8_bits,code_bytes\n",
    );
    // Names of materials come from files.
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    for row in rows {
        let (ns, error, seen) = (row.resident, row.error, row.seen);
        let _ = writeln!(
            text,
            "{},{},{},{:.4},{:.4},{:.4},{},{:.4},{:.0},{:e},{:e},{:e},{:e},{:e},{:e},{},{}",
            quoted(&row.subject),
            quoted(&row.form),
            row.number.name(),
            ns.median,
            ns.low,
            ns.high,
            row.sample.map_or_else(|| ",,".to_owned(), |ns| format!("{:.4},{:.4},{:.4}", ns.median, ns.low, ns.high)),
            row.streaming.median,
            row.all_cores,
            error.median,
            error.p99,
            error.worst,
            row.albedo,
            seen.mean,
            seen.worst,
            seen.steps,
            row.code.map_or_else(String::new, |bytes| bytes.to_string())
        );
    }
    text
}

const ABOUT: &str = "\
Made by `lobe trade --markdown`; `lobe trade --help` and the crate `lobe-trade` say what is measured and how.

- *ns*: nanoseconds for one evaluation of all three channels, times the cosine and the light, added to a pixel; from
  buffers that stay in the cache. Scalars are called through a pointer, point by point; lanes once for a buffer.
- *sample*: nanoseconds for one sample, a direction of light with its weight and its density, through a pointer too; in the
  scalars `f32` and `f64`.
- *stream*: evaluations from 64 MiB of other points each time.
- *M/s*: millions of evaluations a second, all cores together.
- *p99*, *worst*: the relative error of `eval_cos` against `f64` of the same inputs, above a ten-thousandth of the peak.
- *albedo*: the relative error of the directional albedo.
- *ΔE*: CIE ΔE 2000 at worst on a sphere under three lights; *8 bit*: the largest difference of a channel of sRGB there.
- *bytes*: the machine code of the functions that evaluate the lobes: `eval_cos` of a scalar, in lanes the loop over
  registers. What they call is not included. A microfacet lobe is one function with every masking and Fresnel term,
  but for the common ones in lanes.
";

fn markdown(all: &[Vec<Row>], noisy: bool, no_code: Option<&str>) -> String {
    let mut text = format!("# What digits cost\n\n{ABOUT}\nMeasured on: {}", machine());
    if noisy {
        text += "\n**The machine was busy meanwhile: the times are rough.**\n";
    }
    if let Some(why) = no_code {
        let _ = writeln!(text, "\nBytes: {why}.");
    }
    for rows in all {
        let Some(first) = rows.first() else { continue };
        let _ = write!(
            text,
            "\n## {}\n\n| form | number | ns | sample | stream | M/s | p99 | worst | albedo | ΔE | 8 bit | bytes |\n\
             |---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n",
            first.subject
        );
        for row in rows {
            let _ = writeln!(
                text,
                "| {} | {} | {:.2} | {} | {:.2} | {:.0} | {} | {} | {} | {:.2} | {} | {} |",
                row.form,
                row.number.name(),
                row.resident.median,
                sample(row),
                row.streaming.median,
                row.all_cores * 1e-6,
                short(row.error.p99),
                short(row.error.worst),
                short(row.albedo),
                row.seen.worst,
                row.seen.steps,
                bytes(row)
            );
        }
    }
    text
}

/// The colours of the plot.
pub(crate) const KINDS: [&str; 6] = ["f64", "f32", "other scalar", "precise", "fast", "coarse"];

pub(crate) fn dots(rows: &[Row]) -> Vec<Dot> {
    let kind = |number: Number| match number {
        Number::F64 => 0,
        Number::F32 => 1,
        Number::Fast | Number::Coarse => 2,
        Number::Lanes { precision, .. } => match precision {
            lobe_models::AnyPrecision::Precise => 3,
            lobe_models::AnyPrecision::Fast => 4,
            lobe_models::AnyPrecision::Coarse => 5,
        },
    };
    rows.iter()
        .map(|row| Dot { name: what(row), time: row.resident.median, error: row.error.p99, kind: kind(row.number) })
        .collect()
}

/// The name of the plot of a subject.
pub(crate) fn file_name(subject: &str) -> std::path::PathBuf {
    let safe: String = subject.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    Path::new(&safe).with_extension("svg")
}
