//! `lobe plot`: lobes as SVG.

mod albedo;
mod chart;
mod compare;
mod curve;
mod image;
mod pareto;
mod polar;
mod samples;
mod surface;
pub(crate) mod svg;
mod terms;

pub(crate) use albedo::albedo_curves;
pub(crate) use compare::{compare, compare_panel};
pub(crate) use curve::{curve, slices};
pub(crate) use image::image;
pub(crate) use pareto::{Dot, front, pareto, pareto_panel};
pub(crate) use polar::{distribution, polar};
pub(crate) use samples::{DECADES, SHOWN, samples};
pub(crate) use surface::surface;
pub(crate) use terms::{Cut, Facets, terms};

use crate::args::{Kind, PlotArgs};
use crate::error::Failure;
use crate::output;
use crate::spec;
use clap::ValueEnum as _;
use lobe::{Brdf, Vec3};
use lobe_models::Material;
use serde_json::json;
use std::io::Write as _;
use svg::{Anchor, Point, Svg};

/// A BRDF with the name that it has in the legend.
pub(crate) struct Series<'a> {
    pub(crate) name: String,
    pub(crate) brdf: &'a dyn Brdf<f64>,
}

/// What all plots of BRDFs are told.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting {
    /// Between the light and the normal, in degrees.
    pub(crate) incidence: f64,
    /// Whether values are multiplied with the cosine of the outgoing direction.
    pub(crate) cosine: bool,
    /// Whether radii and heights are logarithmic, where a plot can be drawn either way.
    pub(crate) log: bool,
}

impl Setting {
    /// The direction to the light: on the left, in the plane of the picture.
    fn light(self) -> Vec3<f64> {
        direction(-self.incidence.to_radians())
    }

    /// The value that is drawn: the luminance of `f_r`, in sr⁻¹.
    fn value(self, brdf: &dyn Brdf<f64>, v: Vec3<f64>) -> f64 {
        let f = brdf.eval(self.light(), v).luminance();
        let f = if self.cosine { f * v.z.max(0.0) } else { f };
        // What overflows cannot be drawn.
        if f.is_finite() { f } else { 0.0 }
    }

    /// What the values are called.
    fn quantity(self) -> &'static str {
        if self.cosine { "*f*_{r} cos *θ* (sr⁻¹)" } else { "*f*_{r} (sr⁻¹)" }
    }
}

/// The direction in the plane of incidence at an angle from the normal, positive to the right.
fn direction(theta: f64) -> Vec3<f64> {
    Vec3::new(theta.sin(), 0.0, theta.cos())
}

/// The lobe in the plane of incidence: angles in radians with their values, dense around the mirror direction, where
/// the sharpest lobes have all that they are.
fn profile(series: &Series<'_>, setting: Setting) -> Vec<(f64, f64)> {
    const HORIZON: f64 = 89.99;
    let mirror = setting.incidence.to_radians();
    let even = (-720..=720).map(|i| (f64::from(i) * 0.125).clamp(-HORIZON, HORIZON).to_radians());
    let near = (0..=120).map(|i| 1e-4 * 10.0_f64.powf(f64::from(i) / 40.0));
    let near = near.flat_map(|offset| [mirror - offset, mirror + offset]).chain([mirror]);
    let mut angles: Vec<f64> = even.chain(near.filter(|angle| angle.abs() < HORIZON.to_radians())).collect();
    angles.sort_by(f64::total_cmp);
    angles.into_iter().map(|angle| (angle, setting.value(series.brdf, direction(angle)))).collect()
}

/// The largest value of all profiles.
fn peak(profiles: &[Vec<(f64, f64)>]) -> f64 {
    profiles.iter().flatten().fold(0.0, |max, &(_, value)| value.max(max))
}

/// The class of the line with this number.
fn line_class(index: usize) -> String {
    format!("c{}", index % svg::SERIES)
}

/// A row of a legend that begins at `first`.
fn legend(svg: &mut Svg, index: usize, first: Point, text: &str) {
    let (x, y) = (first.0, first.1 + 22.0 * index as f64);
    svg.line(&line_class(index), (x, y - 5.0), (x + 36.0, y - 5.0));
    svg.text("", (x + 46.0, y), Anchor::Start, text);
}

/// A name that fits into a legend.
fn short_name(name: &str, longest: usize) -> String {
    if name.chars().count() <= longest {
        return name.to_owned();
    }
    name.chars().take(longest.saturating_sub(1)).chain(['…']).collect()
}

/// Runs the verb.
pub(crate) fn run(args: &PlotArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    let setting = Setting { incidence: args.incidence, cosine: args.cosine, log: args.log };
    let ending = args.output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("svg"));
    if !ending && args.output.as_os_str() != "-" {
        let path = args.output.display();
        return Err(Failure::Usage(format!(
            "{path}: unknown kind of file; plots end in .svg, or - is standard output"
        )));
    }
    if args.log && matches!(args.kind, Kind::Compare | Kind::Surface | Kind::Terms | Kind::Samples) {
        let right = "leave it out, or take --kind polar, slices, image or distribution";
        return Err(Failure::Usage(format!("--log is not for --kind {}; {right}", kind_name(args.kind))));
    }
    let specs = specs(args)?;
    if !quiet {
        for warning in specs.iter().flat_map(Material::warnings) {
            let _ = writeln!(std::io::stderr(), "warning: {warning}");
        }
    }
    let brdfs: Vec<_> = specs.iter().map(|spec| spec.build::<f64>()).collect();
    let series: Vec<_> =
        specs.iter().zip(&brdfs).map(|(spec, brdf)| Series { name: legend_name(spec), brdf: &**brdf }).collect();
    let svg = match (args.kind, series.first(), specs.first()) {
        (Kind::Polar, ..) => polar(&series, setting),
        (Kind::Curve, ..) => curve(&series, setting),
        (Kind::Distribution, ..) => distribution(&cuts(&specs)?, args.log),
        (Kind::Surface, Some(first), _) => surface(first, setting),
        (Kind::Slices, Some(first), _) => slices(first, setting),
        (Kind::Image, Some(first), _) => image(first, setting)?,
        (Kind::Terms, _, Some(first)) => terms(&first.name, &Facets::of(first)?),
        (Kind::Samples, _, Some(first)) => samples::of(first, args.incidence)?,
        (Kind::Compare | Kind::Surface | Kind::Slices | Kind::Image | Kind::Terms | Kind::Samples, ..) => {
            compare(args.q, args.incidence)
        }
    };
    output::write_file(&args.output, svg.file().as_bytes())?;
    let to_stdout = args.output.as_os_str() == "-";
    match (to_stdout, json, quiet) {
        (true, _, _) | (false, false, true) => Ok(()),
        (false, true, _) => {
            output::print(format!("{}\n", json!({ "written": args.output.display().to_string() })).as_bytes())
        }
        (false, false, false) => output::print(format!("{}\n", args.output.display()).as_bytes()),
    }
}

/// The BRDFs to draw: those asked for, or a few that show what there is.
fn specs(args: &PlotArgs) -> Result<Vec<Material>, Failure> {
    let (default, most): (&[&str], usize) = match args.kind {
        Kind::Compare => (&[], 0),
        Kind::Polar | Kind::Curve => (&["mirror-lobe", "half-vector-lobe"], svg::SERIES),
        Kind::Distribution => (&["ggx-plastic", "ggx-gold"], svg::SERIES),
        Kind::Surface => (&["glossy"], 1),
        Kind::Slices | Kind::Image => (&["ggx-plastic"], 1),
        Kind::Terms | Kind::Samples => (&["ggx-gold"], 1),
    };
    let given: Vec<&str> = args.specs.iter().chain(&args.brdf).map(String::as_str).collect();
    if given.len() > most {
        let (kind, found) = (kind_name(args.kind), given.len());
        return Err(Failure::Usage(match args.kind {
            Kind::Compare => "--kind compare draws no --brdf; give --q, or --kind polar to draw BRDFs".to_owned(),
            _ => format!("{found} BRDFs; --kind {kind} draws at most {most}"),
        }));
    }
    let names = if given.is_empty() { default } else { &given };
    names.iter().copied().map(spec::from_argument).collect()
}

/// The name of a kind on the command line.
fn kind_name(kind: Kind) -> String {
    kind.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

/// The distributions of all materials; one that is anisotropic has two.
fn cuts(specs: &[Material]) -> Result<Vec<Cut>, Failure> {
    let mut cuts = Vec::new();
    for spec in specs {
        cuts.extend(Facets::of(spec)?.cuts(&legend_name(spec)));
    }
    Ok(cuts)
}

fn legend_name(spec: &Material) -> String {
    let made_of = spec.description();
    if made_of == spec.name { made_of } else { format!("{}: {made_of}", spec.name) }
}
