//! `lobe report`: renders, plots and checks, and writes it all into one page.

pub(crate) mod checks;
mod furnace;
mod materials;
mod page;
mod pictures;
mod random;
mod sampling;
mod trade;

use crate::args::ReportArgs;
use crate::error::Failure;
use crate::output;
use crate::plot::{self, Cut, Facets, Series, Setting, svg::Svg};
use crate::progress::Progress;
use crate::render;
use crate::spec;
use checks::Check;
use materials::{MaterialFacts, Shown, Whole};
use pictures::{Between, Picture};
use serde::Serialize;
use std::fmt::Write as _;
use std::io::Write as _;
use std::time::Instant;
use trade::Trade;

/// Everything that the page shows, and `report.json` holds.
#[derive(Debug, Serialize)]
pub(crate) struct Facts {
    /// The version of `lobe`.
    pub(crate) version: &'static str,
    /// The command that makes this report again.
    pub(crate) command: String,
    pub(crate) scene: SceneFacts,
    pub(crate) views: Vec<Picture>,
    /// The first view with the light between surfaces.
    pub(crate) between: Between,
    pub(crate) materials: Vec<MaterialFacts>,
    pub(crate) checks: Vec<Check>,
    /// Nothing where no material has lobes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) trade: Option<Trade>,
    pub(crate) warnings: Vec<String>,
    pub(crate) seconds: Seconds,
}

/// The scene in numbers.
#[derive(Debug, Serialize)]
pub(crate) struct SceneFacts {
    /// The file, or "built-in".
    pub(crate) source: String,
    pub(crate) triangles: usize,
    pub(crate) meshes: usize,
}

/// How long things took.
#[derive(Debug, Serialize)]
pub(crate) struct Seconds {
    pub(crate) load: f64,
    pub(crate) render: f64,
    /// Of the picture by paths.
    pub(crate) paths: f64,
    pub(crate) energy: f64,
    pub(crate) checks: f64,
    pub(crate) trade: f64,
    pub(crate) total: f64,
}

/// A plot with what it shows.
pub(crate) struct Plot {
    pub(crate) title: String,
    pub(crate) caption: String,
    pub(crate) svg: Svg,
    /// Whether it takes the whole width of the page.
    pub(crate) wide: bool,
}

impl Plot {
    fn new(title: impl Into<String>, caption: impl Into<String>, svg: Svg) -> Self {
        Self { title: title.into(), caption: caption.into(), svg, wide: false }
    }
}

/// Runs the verb.
pub(crate) fn run(args: &ReportArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    let start = Instant::now();
    // A wrong scene or folder is known before the work.
    let scene = render::open(args.scene.as_deref(), args.shading.as_deref(), quiet)?;
    let renderer = render::prepare(&scene, quiet)?;
    let load = start.elapsed().as_secs_f64();
    let [page_path, facts_path] = ["index.html", "report.json"].map(|name| args.output.join(name));
    output::make_folder(&args.output, &[&page_path, &facts_path])?;
    if !quiet {
        for warning in &scene.warnings {
            let _ = writeln!(std::io::stderr(), "warning: {warning}");
        }
    }

    let start_render = Instant::now();
    let size = (args.width, args.samples);
    let (views, between, more_warnings) = pictures::take(&scene, &renderer, size, args.scene.is_none(), quiet)?;
    let render = start_render.elapsed().as_secs_f64() - between.traced.seconds;

    let start_energy = Instant::now();
    let shown = materials::shown(&scene);
    let bar = Progress::new("energy", shown.len() as u64, quiet);
    let mut materials = materials::facts(&shown, &|| bar.advance(1));
    materials::keep_the_first_balls(&mut materials);
    drop(bar);
    let energy = start_energy.elapsed().as_secs_f64();

    let start_checks = Instant::now();
    let bar = Progress::new("checks", checks::COUNT, quiet);
    let checks = checks::all(&|| bar.advance(1));
    drop(bar);
    let check_seconds = start_checks.elapsed().as_secs_f64();

    // After all that runs on many cores: what works beside it would be in the times.
    let start_trade = Instant::now();
    let trade = trade::measure(&scene, quiet);
    let trade_seconds = start_trade.elapsed().as_secs_f64();

    let mut plots = plots(&shown);
    plots.extend(albedo_plot(&materials));
    let warnings = scene.warnings.iter().map(ToString::to_string).chain(more_warnings).collect();
    let total = start.elapsed().as_secs_f64();
    let paths = between.traced.seconds;
    let facts = Facts {
        version: env!("CARGO_PKG_VERSION"),
        command: command(args),
        scene: SceneFacts {
            source: args.scene.as_ref().map_or("built-in".to_owned(), |path| path.display().to_string()),
            triangles: scene.triangle_count(),
            meshes: scene.meshes.len(),
        },
        views,
        between,
        materials,
        checks,
        trade,
        warnings,
        seconds: Seconds { load, render, paths, energy, checks: check_seconds, trade: trade_seconds, total },
    };
    let facts_json = serde_json::to_string_pretty(&facts)
        .map_err(|error| Failure::Write(format!("report.json: cannot write this as JSON: {error}; report this")))?;

    let page = page::html(&facts, &plots);
    let facts_text = format!("{facts_json}\n");
    lobe_scene::write_all_atomically(&[(&page_path, page.as_bytes()), (&facts_path, facts_text.as_bytes())])?;
    if json {
        output::print(facts_text.as_bytes())?;
    } else if !quiet {
        output::print(summary(&facts, &page_path.display().to_string()).as_bytes())?;
    }
    // The page is written either way; a material that gains energy is the scene's affair, a broken promise is ours.
    match facts.checks.iter().find(|check| !check.holds) {
        None => Ok(()),
        Some(check) => Err(Failure::Check(format!("{}: this promise is broken: {}", check.name, check.promise))),
    }
}

/// The command line that makes the same report.
fn command(args: &ReportArgs) -> String {
    let quoted = |text: &str| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "._-/+=:,".contains(c);
        if !text.is_empty() && text.chars().all(plain) {
            text.to_owned()
        } else {
            format!("'{}'", text.replace('\'', "'\\''"))
        }
    };
    let mut command = "lobe report".to_owned();
    if let Some(scene) = &args.scene {
        let _ = write!(command, " {}", quoted(&scene.display().to_string()));
    }
    let _ = write!(command, " -o {}", quoted(&args.output.display().to_string()));
    if let Some(shading) = &args.shading {
        let _ = write!(command, " --shading {}", quoted(shading));
    }
    let _ = write!(command, " --samples {} --width {}", args.samples, args.width);
    command
}

/// The plots: the lecture's comparison, the lobes as BRDFs, and those of the scene.
fn plots(shown: &[Shown<'_>]) -> Vec<Plot> {
    const Q: f64 = 50.0;
    let mut plots = Vec::new();
    for (incidence, caption) in [
        (
            55.0,
            "At the same exponent the half-vector lobe is about twice as wide, because the angle to h is half of the angle to \
             r. With four times the exponent it falls on the mirror lobe, but only in the plane of incidence: across it, it is \
             narrower.",
        ),
        (
            85.0,
            "Towards grazing light the half-vector lobe becomes a narrow upright streak, as one sees on wet roads; the mirror \
             lobe stays round, and nearly half of it is below the surface. No exponent makes one into the other.",
        ),
    ] {
        let title = format!("Mirror lobe and half-vector lobe, light at {incidence}°");
        plots.push(Plot::new(title, caption, plot::compare_panel(Q, incidence)));
    }

    let presets = ["mirror-lobe", "half-vector-lobe"].map(spec::from_argument);
    if let [Ok(mirror), Ok(half)] = presets {
        let brdfs = [mirror.build::<f64>(), half.build::<f64>()];
        let names = ["phong q=50", "blinn-phong q=50"];
        let series: Vec<Series<'_>> =
            names.iter().zip(&brdfs).map(|(name, brdf)| Series { name: (*name).to_owned(), brdf: &**brdf }).collect();
        let setting = Setting { incidence: 55.0, cosine: false, log: false };
        plots.push(Plot::new(
            "The same two as BRDFs",
            "Normalised to reflect the same part of the light at normal incidence, the wider lobe is the lower one. Values in sr⁻¹.",
            plot::polar(&series, setting),
        ));
        plots.extend(scene_curves(shown));
        let grazing = Setting { incidence: 75.0, cosine: false, log: false };
        for (one, caption) in series.iter().zip([
            "The mirror lobe is a body of revolution around r, cut off by the surface.",
            "The half-vector lobe is a blade: high in the plane of incidence, thin across it.",
        ]) {
            let title = format!("{} in three dimensions, light at 75°", one.name);
            plots.push(Plot::new(title, caption, plot::surface(one, grazing)));
        }
    }
    plots.extend(model_plots(shown));
    plots
}

/// As many of a list as there are line styles, spread over it.
fn spread<T>(all: &[T]) -> impl Iterator<Item = &T> {
    let count = all.len().min(plot::svg::SERIES);
    (0..count).filter_map(move |i| all.get(i * all.len() / count))
}

/// The materials of the scene itself that have a highlight.
fn scene_curves(shown: &[Shown<'_>]) -> Option<Plot> {
    let own = shown.iter().filter(|shown| shown.lobes.is_none()).map(|shown| &shown.material);
    let shiny: Vec<(&str, Whole)> = own
        .map(|material| (material.name.as_str(), Whole::of(material)))
        .filter(|(_, whole)| whole.has_highlight())
        .collect();
    if shiny.is_empty() {
        return None;
    }
    let series: Vec<Series<'_>> =
        spread(&shiny).map(|(name, whole)| Series { name: whole.legend(name), brdf: whole }).collect();
    let left_out = match shiny.len() - series.len() {
        0 => String::new(),
        more => format!(" {more} more materials with a highlight are not shown."),
    };
    Some(Plot::new(
        "The scene's materials over the viewing angle",
        format!("On a logarithmic scale, light at 55°: the diffuse floor and the highlight on it.{left_out}"),
        plot::curve(&series, Setting { incidence: 55.0, cosine: false, log: true }),
    ))
}

/// The albedo of the scene's materials over the angle of the view: of each the largest of red, green and blue.
fn albedo_plot(materials: &[MaterialFacts]) -> Option<Plot> {
    let known: Vec<_> = materials.iter().filter(|material| !material.curve.is_empty()).collect();
    let largest = |rgb: &[f64; 3]| rgb.iter().fold(0.0_f64, |max, &x| max.max(x));
    let curves: Vec<(String, Vec<(f64, f64)>)> = spread(&known)
        .map(|material| {
            let points = material.curve.iter().map(|(angle, rgb)| (*angle, largest(rgb)));
            (material.name.clone(), points.collect())
        })
        .collect();
    if curves.is_empty() {
        return None;
    }
    let left_out = match known.len() - curves.len() {
        0 => String::new(),
        more => format!(" {more} more materials are not shown."),
    };
    Some(Plot::new(
        "What the materials reflect of a white world",
        format!("The directional albedo. Above 1 a surface sends out more than it receives.{left_out}"),
        plot::albedo_curves("Albedo over the angle of the view", &curves),
    ))
}

/// What a view puts in the place of the scene's materials: the models side by side, what they are made of, and one of
/// them under several angles.
fn model_plots(shown: &[Shown<'_>]) -> Vec<Plot> {
    let setting = Setting { incidence: 55.0, cosine: false, log: true };
    let named: Vec<_> = shown.iter().filter_map(|shown| Some((shown, shown.lobes?))).collect();
    let mut plots = Vec::new();
    let wholes: Vec<_> = named.iter().map(|(shown, _)| (&shown.material.name, Whole::of(&shown.material))).collect();
    let series: Vec<Series<'_>> =
        spread(&wholes).map(|(name, whole)| Series { name: (*name).clone(), brdf: whole }).collect();
    let Some(first) = series.first() else { return plots };
    plots.push(Plot::new(
        "Models side by side, light at 55°",
        "The radius is logarithmic: each ring is ten times the one inside it. The round part is the diffuse floor; \
         what stands out of it is the highlight.",
        plot::polar(&series, setting),
    ));
    plots.push(Plot::new(
        format!("Slices of {}", first.name),
        "One material for four angles of the light, in the plane of incidence: how the highlight grows and moves \
         towards grazing light.",
        plot::slices(first, setting),
    ));
    let facets: Vec<_> =
        named.iter().filter_map(|(shown, lobes)| Some((&shown.material.name, Facets::of(lobes).ok()?))).collect();
    let cuts: Vec<Cut> = spread(&facets).flat_map(|(name, facets)| facets.cuts(name)).collect();
    if let Some((name, middle)) = facets.get(facets.len() / 2) {
        plots.push(Plot::new(
            "The distributions of the facets' normals",
            "Each to its own peak, on a logarithmic radius. Beckmann's ends early, GGX has a tail to the horizon.",
            plot::distribution(&cuts, true),
        ));
        let whole = named.iter().find(|(shown, _)| shown.material.name == **name);
        let whole = whole.map(|(shown, _)| Whole::of(&shown.material));
        if let Some(brdf) = &whole {
            let series = Series { name: (*name).clone(), brdf };
            if let Ok(svg) = plot::image(&series, Setting { log: false, ..setting }) {
                plots.push(Plot::new(
                    format!("Image slice of {name}"),
                    "All of it at a glance: the highlight at the left edge, Fresnel's grazing light at the top, light that goes \
                     back to where it came from at the bottom.",
                    svg,
                ));
            }
            plots.push(Plot::new(
                format!("{name} in three dimensions, light at 55°"),
                "The lobe of the microfacets, with the outer ring at its peak.",
                plot::surface(&series, Setting { log: false, ..setting }),
            ));
        }
        plots.push(Plot {
            wide: true,
            ..Plot::new(
                format!("The terms of {name}"),
                "What a microfacet lobe is the product of: how many facets face h, which part of them is both lit and \
                 seen, and how much each reflects.",
                plot::terms(name, middle),
            )
        });
    }
    plots
}

/// Ten lines for the terminal.
fn summary(facts: &Facts, page: &str) -> String {
    let gaining: Vec<&str> =
        facts.materials.iter().filter(|m| m.gains_energy).map(|material| material.name.as_str()).collect();
    let energy = match gaining.len() {
        0 => "all conserve energy".to_owned(),
        count => format!("{count} gain energy: {}", gaining.iter().take(4).copied().collect::<Vec<_>>().join(", ")),
    };
    let more = if gaining.len() > 4 { ", …" } else { "" };
    let mut text = String::new();
    let scene = &facts.scene;
    let meshes = if scene.meshes == 1 { "mesh" } else { "meshes" };
    let _ = writeln!(text, "scene      {}: {} triangles in {} {meshes}", scene.source, scene.triangles, scene.meshes);
    let names: Vec<&str> = facts.views.iter().map(|view| view.name.as_str()).collect();
    let _ = writeln!(text, "views      {} in {:.1} s: {}", names.len(), facts.seconds.render, names.join(", "));
    let _ = writeln!(text, "materials  {}; {energy}{more}", facts.materials.len());
    for check in &facts.checks {
        let verdict = if check.holds { "holds " } else { "BROKEN" };
        let _ = writeln!(text, "{verdict}     {}", check.name);
    }
    let _ = writeln!(text, "warnings   {}", facts.warnings.len());
    let _ = writeln!(text, "page       {page}  ({:.1} s in all)", facts.seconds.total);
    text
}
