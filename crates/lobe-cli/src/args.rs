//! The command line.

use clap::{Args as ArgsOf, Parser, Subcommand, ValueEnum};
use lobe::Rgb;
use lobe_models::AnyPrecision;
use lobe_scene::image::Tone;
use lobe_scene::{Background, Camera, Light};
use std::path::PathBuf;

/// Shading lobes: look at them, evaluate them, check them.
///
/// Without a verb: `lobe report` of the scene that is built in, into ./lobe-report.
#[derive(Debug, Parser)]
#[command(name = "lobe", version, max_term_width = 100, after_help = AFTER_HELP)]
pub(crate) struct Args {
    /// What to do
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
    /// No progress bars, warnings or summary; errors, and what was asked for on standard output, stay
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Answer in JSON on standard output, for another program
    #[arg(long, global = true)]
    pub(crate) json: bool,
}

const AFTER_HELP: &str = "\
Examples:
  lobe                                          the report of the built-in scene
  lobe render scene.json -o out.png
  lobe plot --kind compare -o lobes.svg
  echo 0.6,0,0.8,-0.6,0,0.8 | lobe eval --brdf red-plastic

Exit codes:
  0  all is well
  1  a check failed: a promise of `report`, or a bound of `sweep` or `verify`, is broken
  2  the command line is wrong
  3  a file or a stream that was given is wrong
  4  something cannot be written";

/// The verbs.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render, plot and check a scene, and write it all into one page (the default verb)
    #[command(after_help = REPORT_HELP)]
    Report(ReportArgs),
    /// Render a view of a scene
    #[command(after_help = RENDER_HELP)]
    Render(RenderArgs),
    /// Compare two pictures: in numbers, and to the eye
    #[command(after_help = DIFF_HELP)]
    Diff(DiffArgs),
    /// Evaluate a BRDF for pairs of directions: CSV in, CSV out
    #[command(after_help = eval_help())]
    Eval(EvalArgs),
    /// List the models with their parameters
    #[command(after_help = MODELS_HELP)]
    Models(ModelsArgs),
    /// Draw lobes as SVG, for a paper or a page
    #[command(after_help = PLOT_HELP)]
    Plot(PlotArgs),
    /// Try all 2^32 arguments of the elementary functions of f32
    #[command(after_help = SWEEP_HELP)]
    Sweep(SweepArgs),
    /// Time every model in every number type, beside the error that is seen
    #[command(after_help = TRADE_HELP)]
    Trade(TradeArgs),
    /// Put the published formulas of engines through furnaces
    #[command(after_help = AUDIT_HELP)]
    Audit(AuditArgs),
    /// Hold every model to its error bound at the extremes of its domain
    #[command(after_help = VERIFY_HELP)]
    Verify(VerifyArgs),
    /// Draw directions of light for a viewer: CSV out
    #[command(after_help = SAMPLE_HELP)]
    Sample(SampleArgs),
    /// Print the completion script of a shell
    #[command(after_help = "Example:\n  lobe completions bash > ~/.local/share/bash-completion/completions/lobe")]
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

/// `lobe report`.
#[derive(Debug, ArgsOf)]
pub(crate) struct ReportArgs {
    /// The scene, .gltf, .glb, .obj or .json; the built-in one without it
    pub(crate) scene: Option<PathBuf>,
    /// The folder to write index.html and report.json into; made if it is not there
    #[arg(long, short, default_value = "lobe-report")]
    pub(crate) output: PathBuf,
    /// How Ks and Ns of the materials become a highlight: blinn-torrance, phong, normalized-phong or
    /// normalized-blinn-phong; as the scene says without it
    #[arg(long, value_name = "MODEL")]
    pub(crate) shading: Option<String>,
    /// Rays for each pixel, 1 to 4096
    #[arg(long, default_value_t = 4, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) samples: u32,
    /// Pixels in a row of the main picture, 64 to 4096; the others have two thirds of it
    #[arg(long, default_value_t = 960, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(64..=4096))]
    pub(crate) width: u32,
}

impl Default for ReportArgs {
    /// What `lobe` does without a verb; the values that clap fills in.
    fn default() -> Self {
        Self { scene: None, output: PathBuf::from("lobe-report"), shading: None, samples: 4, width: 960 }
    }
}

const REPORT_HELP: &str = "\
Writes DIR/index.html, one page that needs no other file, and DIR/report.json with the same facts.
The section on what digits cost is timed on this machine: run it when nothing else runs. `lobe trade` measures more.

Examples:
  lobe report
  lobe report scene.json -o out
  lobe report model.obj --shading normalized-blinn-phong --json > facts.json";

/// `lobe render`.
#[derive(Debug, ArgsOf)]
pub(crate) struct RenderArgs {
    /// The scene, .gltf, .glb, .obj or .json; the built-in one without it
    pub(crate) scene: Option<PathBuf>,
    /// The picture to write: .png (sRGB), .exr or .pfm (linear)
    #[arg(long, short)]
    pub(crate) output: PathBuf,
    /// The view, by name; the first one without it
    #[arg(long)]
    pub(crate) view: Option<String>,
    /// Pixels in a row
    #[arg(long, default_value_t = 1280, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=32768))]
    pub(crate) width: u32,
    /// Rows
    #[arg(long, default_value_t = 720, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=32768))]
    pub(crate) height: u32,
    /// Both at once, such as 640x360
    #[arg(long, value_name = "WxH", conflicts_with_all = ["width", "height"], value_parser = parse_size)]
    pub(crate) size: Option<[u32; 2]>,
    /// Another camera: EYE:TARGET, or EYE:TARGET:FOV with the angle in degrees, such as 0,1,5:0,1,0:40
    #[arg(long, value_name = "CAMERA", allow_hyphen_values = true, value_parser = parse_camera)]
    pub(crate) camera: Option<Camera>,
    /// A light in place of those of the view; may be given again. point:X,Y,Z:I, in W/sr, or sun:X,Y,Z:E, the direction
    /// to it and the irradiance; I and E are a number or R,G,B
    #[arg(long, value_name = "LIGHT", allow_hyphen_values = true, value_parser = parse_light)]
    pub(crate) light: Vec<Light>,
    /// The radiance around the scene: a number or R,G,B, or two of them, BOTTOM:TOP. Its mean is the
    /// ambient light
    #[arg(long, value_name = "RADIANCE", allow_hyphen_values = true, value_parser = parse_environment)]
    pub(crate) environment: Option<Background>,
    /// Trace paths: light that comes by way of other surfaces too, from all that shines. The view's ambient light, which stands
    /// for that, is left out
    #[arg(long, conflicts_with_all = ["precision", "contact_sheet"])]
    pub(crate) path: bool,
    /// How many surfaces may turn a path, 0 to 1024
    #[arg(long, default_value_t = 16, requires = "path", allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(0..=1024))]
    pub(crate) depth: u32,
    /// Which random numbers the paths take: the same seed gives the same picture, on any number of threads
    #[arg(long, default_value_t = 0, requires = "path", allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// The light around the scene, as a picture of the whole sphere: .exr, .pfm or .png, twice as wide as high, +y up and −z
    /// in the middle
    #[arg(long, value_name = "PICTURE", requires = "path", conflicts_with = "environment")]
    pub(crate) environment_map: Option<PathBuf>,
    /// How bright colours are brought into the range: none, reinhard, aces-fit or pbr-neutral (.png only)
    #[arg(long, default_value_t = Tone::None, value_parser = parse_tone)]
    pub(crate) tone: Tone,
    /// Rays for each pixel, 1 to 4096
    #[arg(long, alias = "spp", default_value_t = 4, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub(crate) samples: u32,
    /// How many digits the lobes are asked for: precise, fast or coarse
    #[arg(long, default_value_t = AnyPrecision::Precise, value_parser = parse_precision)]
    pub(crate) precision: AnyPrecision,
    /// Stops to add to the exposure of the view (.png only)
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true, value_parser = parse_stops)]
    pub(crate) exposure: f32,
    /// 16 bits a channel (.png only)
    #[arg(long)]
    pub(crate) deep: bool,
    /// Render in this material: a measured one such as dark-blue-paint (`lobe models --materials` lists them), a preset,
    /// JSON or @FILE. Without a scene, a sphere and a knot of it
    #[arg(long)]
    pub(crate) material: Option<String>,
    /// The model that a measured material is fitted with: cook-torrance, ward, lafortune, …
    #[arg(long, value_name = "MODEL")]
    pub(crate) model: Option<String>,
    /// Spheres of all measured materials, with their names (.png only)
    #[arg(long, conflicts_with_all = ["material", "scene", "view", "shading", "deep", "height"])]
    pub(crate) contact_sheet: bool,
    /// How Ks and Ns of the materials become a highlight: blinn-torrance, phong, normalized-phong or
    /// normalized-blinn-phong; as the scene says without it
    #[arg(long, value_name = "MODEL")]
    pub(crate) shading: Option<String>,
}

const RENDER_HELP: &str = "\
Examples:
  lobe render scene.json -o out.png
  lobe render scene.json --view top --samples 16 -o top.exr
  lobe render model.obj --shading normalized-phong -o model.png
  lobe render --material dark-blue-paint --model cook-torrance -o paint.png
  lobe render helmet.glb --size 640x640 --environment 0.2:0.8 --tone pbr-neutral -o helmet.png
  lobe render model.obj --camera 0,1,5:0,1,0 --light sun:1,1,1:3 -o model.png
  lobe render model.obj --material ggx-gold -o gold.png
  lobe render scene.json --path --samples 256 -o paths.png
  lobe render helmet.glb --path --environment-map sky.exr --samples 64 -o helmet.png
  lobe render --contact-sheet --model ward -o sheet.png";

/// A precision by its name.
fn parse_precision(text: &str) -> Result<AnyPrecision, String> {
    let all = AnyPrecision::ALL;
    all.into_iter().find(|precision| precision.name() == text).ok_or_else(|| {
        let names = all.map(AnyPrecision::name).join(", ");
        format!("it is one of {names}")
    })
}

/// A curve by its name.
fn parse_tone(text: &str) -> Result<Tone, String> {
    Tone::ALL.into_iter().find(|tone| tone.name() == text).ok_or_else(|| {
        let names = Tone::ALL.map(Tone::name).join(", ");
        format!("it is one of {names}")
    })
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    let sides = sides.filter(|sides: &[u32; 2]| sides.iter().all(|side| (1..=32768).contains(side)));
    sides.ok_or_else(|| "two numbers from 1 to 32768, such as 640x360".to_owned())
}

/// Three finite numbers with commas between them.
fn triple(text: &str) -> Option<[f32; 3]> {
    let mut parts = text.split(',').map(|part| part.trim().parse::<f32>().ok().filter(|x| x.is_finite()));
    let triple = [parts.next()??, parts.next()??, parts.next()??];
    parts.next().is_none().then_some(triple)
}

/// A grey or a colour of light.
fn radiance(text: &str) -> Option<Rgb> {
    let colour = match text.trim().parse::<f32>() {
        Ok(grey) => [grey; 3],
        Err(_) => triple(text)?,
    };
    colour.iter().all(|part| part.is_finite() && *part >= 0.0).then(|| colour.into())
}

fn parse_camera(text: &str) -> Result<Camera, String> {
    let expected = "EYE:TARGET or EYE:TARGET:FOV, such as 0,1,5:0,1,0:40";
    let mut parts = text.split(':');
    let points = parts.next().and_then(triple).zip(parts.next().and_then(triple));
    let (eye, target) = points.ok_or(expected)?;
    let fov_y_degrees = match (parts.next(), parts.next()) {
        (None, _) => 35.0,
        (Some(angle), None) => angle.parse().map_err(|_| expected)?,
        _ => return Err(expected.to_owned()),
    };
    let camera = Camera { eye: eye.into(), target: target.into(), fov_y_degrees, ..Camera::default() };
    camera.check().map_err(|error| error.to_string())?;
    Ok(camera)
}

fn parse_light(text: &str) -> Result<Light, String> {
    let mut parts = text.splitn(3, ':');
    let (kind, place, strength) = (parts.next(), parts.next().and_then(triple), parts.next().and_then(radiance));
    match (kind, place, strength) {
        (Some("point"), Some(place), Some(intensity)) => {
            Ok(Light::Point { position: place.into(), intensity, radius: 0.0 })
        }
        (Some("sun"), Some(place), Some(irradiance)) if place != [0.0; 3] => {
            Ok(Light::Directional { to_light: place.into(), irradiance })
        }
        _ => Err("point:X,Y,Z:I or sun:X,Y,Z:E, such as point:2,4,3:90 or sun:0,1,1:3,2.8,2.5".to_owned()),
    }
}

fn parse_environment(text: &str) -> Result<Background, String> {
    let expected = || "a radiance such as 0.5 or 0.2,0.3,0.5, or two of them, BOTTOM:TOP".to_owned();
    match text.split_once(':') {
        None => radiance(text).map(Background::Solid).ok_or_else(expected),
        Some((bottom, top)) => match (radiance(bottom), radiance(top)) {
            (Some(bottom), Some(top)) => Ok(Background::Gradient { bottom, top }),
            _ => Err(expected()),
        },
    }
}

fn parse_stops(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(stops) if stops.abs() <= 100.0 => Ok(stops),
        _ => Err("a number of stops from -100 to 100, such as 1.5".to_owned()),
    }
}

/// `lobe diff`.
#[derive(Debug, ArgsOf)]
pub(crate) struct DiffArgs {
    /// A picture: .png (sRGB), .exr or .pfm (linear)
    pub(crate) a: PathBuf,
    /// Another one, of the same size
    pub(crate) b: PathBuf,
    /// Write a picture of Delta E 2000: black is none, white is 10 and more
    #[arg(long, short)]
    pub(crate) output: Option<PathBuf>,
    /// Stops of exposure with which both are looked at
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true, value_parser = parse_stops)]
    pub(crate) exposure: f32,
    /// Exit with code 1 if the worst Delta E is more than this
    #[arg(long, value_name = "DELTA_E", value_parser = parse_delta)]
    pub(crate) max: Option<f64>,
}

const DIFF_HELP: &str = "\
linear is the difference of the radiances; a PNG picture is taken as the radiance that its colours stand for. Delta E is CIE
Delta E 2000 of the colours as they are shown, clipped to 0 to 1: about 1 is just seen.

Examples:
  lobe render -o precise.exr && lobe render --precision fast -o fast.exr && lobe diff precise.exr fast.exr
  lobe diff before.png after.png --max 1 -o difference.png";

fn parse_delta(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(delta) if delta >= 0.0 => Ok(delta),
        _ => Err("a number that is not negative, such as 1".to_owned()),
    }
}

/// `lobe eval`.
#[derive(Debug, ArgsOf)]
pub(crate) struct EvalArgs {
    /// The BRDF: JSON, @FILE with JSON, or the name of a preset
    #[arg(long, default_value = "red-plastic")]
    pub(crate) brdf: String,
    /// The number type to read, compute and print in: f32, f64, fast or coarse, which trade digits
    /// for speed, or half, which rounds every operation to binary16
    #[arg(long, default_value = "f32", value_parser = parse_number)]
    pub(crate) number: Number,
    /// Scale directions to unit length first; without it a length off by more than 0.00001 (0.002 for half) is
    /// an error
    #[arg(long)]
    pub(crate) normalize: bool,
    /// List the presets and what they are made of
    #[arg(long)]
    pub(crate) list_presets: bool,
}

/// The models come from the catalogue: one that is added there is listed here.
fn eval_help() -> String {
    let names: Vec<_> = lobe_models::models().map(|model| model.name).collect();
    format!("{EVAL_HELP}{}", names.join(", "))
}

const EVAL_HELP: &str = "\
Standard input:  lx,ly,lz,vx,vy,vz on each line, the directions to the light and to the viewer in the local frame
                 of the surface (normal = +z), unit length. Blank lines, # comments and a header line are skipped.
Standard output: r,g,b of f_r in 1/sr on each line, with every digit that the number type has.

Examples:
  echo 0.6,0,0.8,-0.6,0,0.8 | lobe eval --brdf red-plastic
  lobe eval --brdf '{\"lobes\": [{\"model\": \"phong\", \"ks\": 0.5, \"q\": 50}]}' --number f64 < pairs.csv
  lobe eval --brdf @paint.json < pairs.csv > values.csv

A colour may be one number, a width alpha one or two ([ax, ay]). `lobe models` lists the parameters of each model.
Models: ";

/// `lobe models`.
#[derive(Debug, ArgsOf)]
pub(crate) struct ModelsArgs {
    /// One model, such as microfacet; all of them without it
    pub(crate) model: Option<String>,
    /// List the measured materials and the models that they are fitted with
    #[arg(long, conflicts_with = "model")]
    pub(crate) materials: bool,
}

const MODELS_HELP: &str = "\
Examples:
  lobe models
  lobe models microfacet
  lobe models --materials
  lobe models --json";

/// The number types that are there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Number {
    /// 32-bit floats.
    F32,
    /// 64-bit floats.
    F64,
    /// 16-bit floats, emulated.
    Half,
    /// 32-bit floats whose functions have about 13 digits.
    Fast,
    /// 32-bit floats whose functions have about 10 digits.
    Coarse,
}

fn parse_number(text: &str) -> Result<Number, String> {
    match text {
        "f32" => Ok(Number::F32),
        "f64" => Ok(Number::F64),
        "half" => Ok(Number::Half),
        "fast" => Ok(Number::Fast),
        "coarse" => Ok(Number::Coarse),
        "wide" => Err("lanes have the bits of f32; use f32, f64, fast, coarse or half".to_owned()),
        _ => Err("unknown number type; use f32, f64, fast, coarse or half".to_owned()),
    }
}

/// `lobe sample`.
#[derive(Debug, ArgsOf)]
pub(crate) struct SampleArgs {
    /// The BRDF: JSON, @FILE with JSON, or the name of a preset
    #[arg(long, default_value = "red-plastic")]
    pub(crate) brdf: String,
    /// The viewer: its angle to the normal in degrees, ANGLE or ANGLE:AZIMUTH, or a unit vector X,Y,Z of the local frame
    #[arg(long, default_value = "45", allow_negative_numbers = true, allow_hyphen_values = true, value_parser = parse_view)]
    pub(crate) view: [f64; 3],
    /// How many samples
    #[arg(long, short = 'n', default_value_t = 1000, allow_negative_numbers = true, value_parser = clap::value_parser!(u64).range(0..=4_000_000_000))]
    pub(crate) count: u64,
    /// Which numbers they are made of: the same seed gives the same samples
    #[arg(long, default_value_t = 0, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// Independent numbers, or an even sequence
    #[arg(long, value_enum, default_value = "random")]
    pub(crate) sequence: Sequence,
    /// The number type to compute and print in: f32 or f64
    #[arg(long, default_value = "f32", value_parser = parse_number)]
    pub(crate) number: Number,
    /// In place of samples: how many each sampler takes for 1 % of the albedo, for GGX by each method and for all models
    #[arg(long)]
    pub(crate) variance: bool,
}

/// Where the numbers of a sampler come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Sequence {
    /// Independent of each other
    Random,
    /// The sequence of Sobol'
    Sobol,
}

const SAMPLE_HELP: &str = "\
Standard output: kind,lx,ly,lz,r,g,b,pdf on each line: `scattered` with the direction to the light in the local frame
                 (normal = +z), its weight f_r cos/pdf and its density in 1/sr; `delta`, a mirror's direction and
                 reflectance; `rejected`, drawn below the horizon, which counts as a sample of weight 0.
Standard error:  the mean weight, which is the albedo, and what was rejected.

Examples:
  lobe sample --brdf ggx-gold --view 60 -n 10000 > samples.csv
  lobe sample --brdf '{\"lobes\": [{\"model\": \"phong\", \"ks\": 0.5, \"q\": 50}]}' --view 0.6,0,0.8 --sequence sobol -n 4096
  lobe sample --variance";

fn parse_view(text: &str) -> Result<[f64; 3], String> {
    const EXPECTED: &str =
        "degrees from the normal below 90, such as 60 or 60:45, or a unit vector above the surface, X,Y,Z";
    let numbers =
        |separator| text.split(separator).map(|part| part.trim().parse::<f64>()).collect::<Result<Vec<_>, _>>();
    if text.contains(',') {
        let view: [f64; 3] = numbers(',').ok().and_then(|v| v.try_into().ok()).ok_or(EXPECTED)?;
        let length = view.iter().map(|x| x * x).sum::<f64>().sqrt();
        let [_, _, z] = view;
        // As `lobe eval` has it: six decimals are within 1e-6 of unit length.
        return if (length - 1.0).abs() <= 1e-5 && z > 0.0 {
            Ok(view.map(|x| x / length))
        } else {
            Err(EXPECTED.to_owned())
        };
    }
    let (angle, azimuth) = match numbers(':').ok().as_deref() {
        Some([angle]) => (*angle, 0.0),
        Some([angle, azimuth]) => (*angle, *azimuth),
        _ => return Err(EXPECTED.to_owned()),
    };
    if !(0.0..90.0).contains(&angle) || !azimuth.is_finite() {
        return Err(EXPECTED.to_owned());
    }
    let ((sin, cos), (y, x)) = (angle.to_radians().sin_cos(), azimuth.to_radians().sin_cos());
    Ok([sin * x, sin * y, cos])
}

/// `lobe plot`.
#[derive(Debug, ArgsOf)]
pub(crate) struct PlotArgs {
    /// What to draw
    #[arg(long, value_enum, default_value = "polar", default_value_if("samples", "true", "samples"))]
    pub(crate) kind: Kind,
    /// Draw samples: short for --kind samples
    #[arg(long, conflicts_with = "kind")]
    pub(crate) samples: bool,
    /// The BRDFs: JSON, @FILE, a preset or a measured one such as ngan:pvc/ward. `surface`, `slices`, `image`, `terms`
    /// and `samples` draw one, `compare` none, the others up to six
    #[arg(value_name = "BRDF")]
    pub(crate) specs: Vec<String>,
    /// One more BRDF; may be given several times
    #[arg(long)]
    pub(crate) brdf: Vec<String>,
    /// The angle between the light and the normal, in degrees, from 0 to 89.9
    #[arg(long, default_value_t = 55.0, allow_negative_numbers = true, value_parser = parse_incidence)]
    pub(crate) incidence: f64,
    /// Draw f_r times the cosine of the outgoing direction, as a goniometer sees it (polar, curve, slices and surface)
    #[arg(long)]
    pub(crate) cosine: bool,
    /// A logarithmic scale: rings or lines for decades (polar, slices and distribution; `curve` has one anyway)
    #[arg(long)]
    pub(crate) log: bool,
    /// The exponent q of `compare`, from 0 to 250000
    #[arg(long, default_value_t = 50.0, allow_negative_numbers = true, value_parser = parse_exponent)]
    pub(crate) q: f64,
    /// The SVG file to write; - for standard output
    #[arg(long, short, default_value = "lobe.svg")]
    pub(crate) output: PathBuf,
}

const PLOT_HELP: &str = "\
Of a coloured lobe the luminance is drawn.

Examples:
  lobe plot paper red-plastic -o lobes.svg
  lobe plot ngan:pvc/cook-torrance ngan:pvc/ward ngan:pvc/blinn-phong --incidence 55 --log -o pvc.svg
  lobe plot --kind terms ggx-gold -o terms.svg
  lobe plot --kind distribution ggx-plastic ggx-gold --log -o distribution.svg
  lobe plot --kind slices ngan:pvc/cook-torrance --log -o slices.svg
  lobe plot --kind image ngan:gold-metallic-paint/cook-torrance -o image.svg
  lobe plot --kind compare --incidence 55 --q 50 -o compare.svg
  lobe plot --kind surface '{\"lobes\": [{\"model\": \"phong\", \"ks\": 1, \"q\": 20}]}' -o surface.svg
  lobe plot --kind samples ggx-gold --incidence 60 -o samples.svg
  lobe plot --kind curve glossy --incidence 80 -o - > curve.svg";

/// The kinds of plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    /// The lobes in the plane of incidence, as the distance from the point that is lit
    Polar,
    /// The lecture's comparison: mirror lobe against half-vector lobe, at the incidence given and at 85°
    Compare,
    /// One lobe in three dimensions
    Surface,
    /// The value over the angle, on a logarithmic scale
    Curve,
    /// One BRDF over the angle of the viewer, for light at 0°, 30°, 60° and 80°
    Slices,
    /// One isotropic BRDF whole, as a picture over the angles of the halfway vector and of the light to it
    Image,
    /// The distribution, the masking and the Fresnel term of a microfacet lobe
    Terms,
    /// The distributions of microfacet lobes around the normal, each to its own peak
    Distribution,
    /// Directions of light that one BRDF draws for a viewer at --incidence, over what it reflects from there
    Samples,
}

fn parse_incidence(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(degrees) if (0.0..=89.9).contains(&degrees) => Ok(degrees),
        _ => Err("an angle in degrees from 0 to 89.9, such as 55".to_owned()),
    }
}

fn parse_exponent(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        // The half-vector lobe is drawn at 4q too, and the domain ends at a million.
        Ok(q) if (0.0..=250_000.0).contains(&q) => Ok(q),
        _ => Err("an exponent from 0 to 250000, such as 50".to_owned()),
    }
}

/// `lobe sweep`.
#[derive(Debug, ArgsOf)]
pub(crate) struct SweepArgs {
    /// One function, such as log2; all of them without it
    pub(crate) function: Option<String>,
    /// Try only every N-th bit pattern
    #[arg(long, default_value_t = 1, allow_negative_numbers = true, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) stride: u32,
    /// What is swept: f32 itself, or the numbers that trade digits for speed, as scalars and at every SIMD level
    #[arg(long, value_enum, default_value_t = SweptPrecision::Precise)]
    pub(crate) precision: SweptPrecision,
    /// Print the tables of docs/numerics.md
    #[arg(long)]
    pub(crate) markdown: bool,
}

/// Which precisions a sweep tries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum SweptPrecision {
    Precise,
    Fast,
    Coarse,
    All,
}

const SWEEP_HELP: &str = "\
All 2^32 arguments of all functions take some minutes on a few cores. Exit code 1 if a bound is broken.
Errors are in ulps for the precision precise, and relative to the exact value for fast and coarse.

Examples:
  lobe sweep log2
  lobe sweep --precision fast --stride 64
  lobe sweep --stride 1009 --json";

/// `lobe trade`.
#[derive(Debug, ArgsOf)]
pub(crate) struct TradeArgs {
    /// A scene, .gltf, .glb, .obj or .json, whose materials are measured; the whole catalogue without it
    pub(crate) scene: Option<PathBuf>,
    /// Only the cheapest way to each material of the scene that is seen to be off by at most this, such as 1/255
    #[arg(long, requires = "scene", allow_negative_numbers = true, value_parser = parse_budget)]
    pub(crate) budget: Option<f64>,
    /// Only this one of the catalogue, such as ward or \"microfacet ggx conductor\"
    #[arg(long, conflicts_with = "scene", value_name = "NAME")]
    pub(crate) only: Option<String>,
    /// Some seconds instead of some minutes; the times are rough
    #[arg(long)]
    pub(crate) quick: bool,
    /// Write the table as CSV
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Write the table as a page in Markdown
    #[arg(long, value_name = "FILE")]
    pub(crate) markdown: Option<PathBuf>,
    /// Write a plot of time against error for each material into this folder
    #[arg(long, value_name = "FOLDER")]
    pub(crate) svg: Option<PathBuf>,
}

const TRADE_HELP: &str = "\
Each material is run as it is, and with approximations in place of its parts, where there are some: in f64, f32, fast
and coarse, and in lanes of each SIMD level, precise, fast and coarse.

ns is the time of one evaluation from the cache, with quartiles, stream the time from 64 MiB of memory, M/s all what all
cores do in a second, in millions. bytes is the machine code of the functions that evaluate the lobes, without what they
call; - where it is not known, and then the last line says why. median, p99 and worst are relative errors against f64,
albedo that of the directional albedo. The last three are what is seen on a sphere under three lights: CIE Delta E 2000,
and the largest difference in steps of eight bits.

Examples:
  lobe trade
  lobe trade --only ward --quick
  lobe trade --csv trade.csv --svg plots --markdown trade.md
  lobe trade scene.json --budget 1/255";

/// A part of white: `1/255`, or `0.004`.
fn parse_budget(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = match text.split_once('/') {
        Some((a, b)) => number(a).zip(number(b)).map(|(a, b)| a / b),
        None => number(text),
    };
    match value {
        Some(budget) if (0.0..=1.0).contains(&budget) => Ok(budget),
        _ => Err("a part of white from 0 to 1, such as 1/255 or 0.01".to_owned()),
    }
}

/// `lobe audit`.
#[derive(Debug, ArgsOf)]
pub(crate) struct AuditArgs {
    /// A few roughnesses and views, in some seconds
    #[arg(long)]
    pub(crate) fast: bool,
    /// Write the tables as a page in Markdown
    #[arg(long, value_name = "FILE")]
    pub(crate) markdown: Option<PathBuf>,
    /// Write a plot of the white furnace of each engine into this folder
    #[arg(long, value_name = "FOLDER")]
    pub(crate) svg: Option<PathBuf>,
}

const AUDIT_HELP: &str = "\
The formulas for direct light of Filament, bevy, three.js, Unreal, Godot, Unity's URP, MaterialX and the glTF sample viewer, as
they are published, in f64: what a white metal and a white dielectric reflect in a white world, how far f(l, v) is from
f(v, l), and how far gold is from GGX with Smith's correlated masking and Schlick's term.

Examples:
  lobe audit
  lobe audit --fast --json
  lobe audit --markdown audit.md --svg audit";

/// `lobe verify`.
#[derive(Debug, ArgsOf)]
pub(crate) struct VerifyArgs {
    /// One model, such as phong; all of them without it
    pub(crate) model: Option<String>,
    /// A BRDF in place of our models: JSON, @FILE, or a preset
    #[arg(long, conflicts_with_all = ["model", "extremes", "compare", "half", "terms"])]
    pub(crate) brdf: Option<String>,
    /// A table of samples, CSV with lx,ly,lz,vx,vy,vz,r,g,b on each line
    #[arg(long, value_name = "FILE", conflicts_with_all = ["model", "brdf", "extremes", "compare", "half", "terms"])]
    pub(crate) table: Option<PathBuf>,
    /// A program that reads and writes the lines of `lobe eval`, with its arguments; to be given last
    #[arg(long, value_name = "COMMAND", num_args = 1.., allow_hyphen_values = true,
        conflicts_with_all = ["model", "brdf", "table", "extremes", "compare", "half", "terms"])]
    pub(crate) program: Vec<String>,
    /// The certificates alone
    #[arg(long, conflicts_with_all = ["model", "brdf", "table", "program", "extremes", "compare", "half", "terms"])]
    pub(crate) certificates: bool,
    /// The planted faults alone, and which check catches each
    #[arg(long, conflicts_with_all = ["model", "brdf", "table", "program", "certificates", "extremes", "compare", "half", "terms"])]
    pub(crate) mutants: bool,
    /// f32 against f64 over a grid of extremes, at random, and where a search finds the worst
    #[arg(long)]
    pub(crate) extremes: bool,
    /// The GGX distribution as others write it, each form in f32 against f64
    #[arg(long, conflicts_with_all = ["extremes", "model", "fast", "half", "terms"])]
    pub(crate) compare: bool,
    /// Which models survive when every operation is rounded to binary16, as in a shader's mediump
    #[arg(long, conflicts_with_all = ["extremes", "fast", "terms"])]
    pub(crate) half: bool,
    /// The terms of microfacet models alone: D, G1 and F in f32 against f64
    #[arg(long, conflicts_with_all = ["extremes", "model"])]
    pub(crate) terms: bool,
    /// The samplers: whether directions are drawn with the density that is told, of all our models, of one, of --brdf, or with
    /// --mutants of planted faults
    #[arg(long, conflicts_with_all = ["table", "program", "certificates", "extremes", "compare", "half", "terms"])]
    pub(crate) sampling: bool,
    /// Try only a small part
    #[arg(long)]
    pub(crate) fast: bool,
}

const VERIFY_HELP: &str = "\
Without a flag: what any BRDF must have (finite, not negative, black below the horizon, the same both ways, no energy
gained, ...) for all our models, certificates for whole boxes of views and parameters, and planted faults that must be
caught. With --brdf, --table or --program the same properties of yours; each failure comes with its worst and its
simplest input.

Exit code 1 if a claim does not hold, 3 if a table or a program gives no values. With --extremes: 4e-6 at the 99th
percentile and 2e-5 at worst, relative to f64 of the same inputs, or the bound that the documentation derives for a model.

Examples:
  lobe verify --fast
  lobe verify microfacet
  lobe verify --brdf @paint.json
  lobe verify --table samples.csv
  lobe verify --fast --program python3 brdf.py
  lobe verify --certificates --json
  lobe verify --sampling --fast
  lobe verify --sampling --brdf ggx-gold
  lobe verify --sampling --mutants
  lobe verify --extremes phong --json
  lobe verify --terms
  lobe verify --compare
  lobe verify --half microfacet";
