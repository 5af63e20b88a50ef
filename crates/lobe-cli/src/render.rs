//! `lobe render`: one view of a scene, as a picture.

use crate::args::RenderArgs;
use crate::contact;
use crate::error::Failure;
use crate::output;
use crate::progress::{Progress, Waiting};
use crate::spec;
use lobe_scene::image::{Depth, Display, MAX_PIXELS, Tone, check_ending};
use lobe_scene::procedural::show_material;
use lobe_scene::{
    Image, Light, LoadOptions, Renderer, Scene, Settings, ShadingModel, View, check_writable, default_scene, load, path,
};
use serde_json::json;
use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

/// Runs the verb.
pub(crate) fn run(args: &RenderArgs, quiet: bool, json: bool) -> Result<(), Failure> {
    // What can be known to fail is known before the work.
    check_ending(&args.output).map_err(|error| Failure::Usage(error.to_string()))?;
    let png = args.output.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if !png && (args.deep || args.exposure != 0.0) {
        return Err(Failure::Usage(format!(
            "--deep and --exposure are for .png; {} is linear and whole already: leave them out",
            args.output.display()
        )));
    }
    if !png && args.tone != Tone::None {
        return Err(Failure::Usage(format!("--tone is for .png; {} is linear: leave it out", args.output.display())));
    }
    let [width, height] = args.size.unwrap_or([args.width, args.height]);
    let pixels = u64::from(width) * u64::from(height);
    if pixels > MAX_PIXELS {
        let size = format!("{width}x{height}");
        return Err(Failure::Usage(format!(
            "a picture of {size} has {pixels} pixels; at most {MAX_PIXELS} are possible"
        )));
    }
    if args.model.is_some() && args.material.is_none() && !args.contact_sheet {
        return Err(Failure::Usage("--model is for --material or --contact-sheet; name a material too".to_owned()));
    }
    let material =
        args.material.as_deref().map(|name| spec::material_argument(name, args.model.as_deref())).transpose()?;
    check_writable(&args.output)?;
    if args.contact_sheet {
        return contact::run(args, png, quiet, json);
    }
    let scene = match (&material, &args.scene) {
        (Some(material), None) => show_material(material)?,
        _ => open(args.scene.as_deref(), args.shading.as_deref(), quiet)?,
    };
    if !quiet {
        for warning in &scene.warnings {
            let _ = writeln!(std::io::stderr(), "warning: {warning}");
        }
    }
    let mut view = view(&scene, args.view.as_deref())?;
    if let (Some(material), Some(_)) = (material, &args.scene) {
        view.materials = std::iter::once((View::ALL.to_owned(), material)).collect();
    }
    view.camera = args.camera.or(view.camera);
    relight(&mut view, &scene, args, width as f32 / height as f32);
    let settings = Settings { width, height, samples: args.samples, precision: args.precision, ..Settings::default() };
    let environment = args.environment_map.as_deref().map(path::Environment::load).transpose()?;
    let start = Instant::now();
    let renderer = prepare(&scene, quiet)?;
    let (image, nan_samples) = if args.path {
        let Settings { width, height, samples, .. } = settings;
        let (max_depth, seed) = (args.depth, args.seed);
        let options =
            path::Options { width, height, samples, seed, max_depth, environment, ..path::Options::default() };
        let rendered = take_by_paths(&renderer, &view, &options, &view.name, quiet)?;
        (rendered.image, rendered.nan_samples)
    } else {
        (take(&renderer, &view, &settings, &view.name, quiet)?, 0)
    };
    if nan_samples > 0 && !quiet {
        let _ = writeln!(std::io::stderr(), "warning: {nan_samples} samples were no radiance and are left out");
    }
    let seconds = start.elapsed().as_secs_f64();
    let depth = if args.deep { Depth::Sixteen } else { Depth::Eight };
    image.save(&args.output, &Display { exposure: view.exposure + args.exposure, depth, tone: args.tone })?;

    let (path, triangles) = (args.output.display(), scene.triangle_count());
    if json {
        let facts = json!({
            "written": path.to_string(),
            "view": view.name,
            "width": settings.width,
            "height": settings.height,
            "samples": settings.samples,
            "precision": settings.precision.name(),
            "paths": args.path,
            "nan_samples": nan_samples,
            "triangles": triangles,
            "seconds": seconds,
            "warnings": scene.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
        });
        return output::print(format!("{facts:#}\n").as_bytes());
    }
    if quiet {
        return Ok(());
    }
    let of = if args.path { " of paths" } else { "" };
    let size = format!("{}x{}, {} samples{of}", settings.width, settings.height, settings.samples);
    let line = format!("{path}: view `{}`, {size}, {triangles} triangles, {seconds:.2} s\n", view.name);
    output::print(line.as_bytes())
}

/// Puts the lights and the environment that were asked for in the place of those of the view.
fn relight(view: &mut View, scene: &Scene, args: &RenderArgs, aspect: f32) {
    if args.light.is_empty() && args.environment.is_none() {
        return;
    }
    let Some((low, high)) = scene.bounds() else { return };
    let is_ambient = |light: &Light| matches!(light, Light::Ambient(_));
    let old = view.lights_for(&view.camera_for(low, high, aspect));
    let (mut ambient, mut lights): (Vec<_>, Vec<_>) = old.into_iter().partition(is_ambient);
    if !args.light.is_empty() {
        lights.clone_from(&args.light);
    }
    if let Some(environment) = args.environment {
        view.background = environment;
        ambient = vec![Light::Ambient(environment.mean())];
    }
    lights.extend(ambient);
    view.lights = Some(lights);
}

/// The scene of a file, or the built-in one.
pub(crate) fn open(path: Option<&Path>, shading: Option<&str>, quiet: bool) -> Result<Scene, Failure> {
    let _waiting = Waiting::new("reading", quiet);
    let shading_model = shading.map(|name| name.parse::<ShadingModel>().map_err(|e| Failure::Usage(e.to_string())));
    let options = LoadOptions { shading_model: shading_model.transpose()?, ..LoadOptions::default() };
    Ok(match path {
        Some(path) => load(path, &options)?,
        None => default_scene(&options)?,
    })
}

/// The tree for the rays.
pub(crate) fn prepare(scene: &Scene, quiet: bool) -> Result<Renderer<'_>, Failure> {
    let _waiting = Waiting::new("tree", quiet);
    Ok(Renderer::new(scene)?)
}

/// The view of this name, or the first.
fn view(scene: &Scene, name: Option<&str>) -> Result<View, Failure> {
    match name {
        Some(name) => scene.view(name).cloned().map_err(|error| Failure::Usage(error.to_string())),
        None => Ok(scene.views.first().cloned().unwrap_or_default()),
    }
}

/// Takes the picture, with a progress bar if it takes long.
pub(crate) fn take(
    renderer: &Renderer<'_>,
    view: &View,
    settings: &Settings,
    label: &str,
    quiet: bool,
) -> Result<Image, Failure> {
    let bar = Progress::new(label, u64::from(settings.height), quiet);
    Ok(renderer.render(view, settings, Some(&|done, _| bar.set(done)))?)
}

/// Takes the picture by paths, with a progress bar if it takes long.
pub(crate) fn take_by_paths(
    renderer: &Renderer<'_>,
    view: &View,
    options: &path::Options,
    label: &str,
    quiet: bool,
) -> Result<path::Rendered, Failure> {
    let passes = path::rows(options);
    let bar = Progress::new(label, passes, quiet);
    Ok(path::render_with(renderer, view, options, Some(&|done, _| bar.set(done)))?)
}
