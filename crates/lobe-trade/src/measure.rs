//! Time and error of each form of a subject in each number type.

use crate::code::Code;
use crate::picture::{Seen, Sphere, compare, exposure, picture};
use crate::subject::Subject;
use lobe::batch::{Level, levels};
use lobe::number::{Approximate, Coarse, Fast};
use lobe::{Rgb, Vec3};
use lobe_models::{AnyBatch, AnyBrdf, AnyPrecision, AnySampler, Material, Number as Scalar, SampleNumber};
use std::f64::consts::{PI, TAU};
use std::sync::Barrier;
use std::time::{Duration, Instant};

/// A number type that a material is run in.
#[derive(Clone, Copy, Debug)]
pub enum Number {
    /// The scalar `f32`.
    F32,
    /// The scalar `f64`.
    F64,
    /// The scalar `Approximate<f32, Fast>`.
    Fast,
    /// The scalar `Approximate<f32, Coarse>`.
    Coarse,
    /// Lanes of `f32`.
    Lanes {
        /// How wide they are.
        level: Level,
        /// The name of the level.
        name: &'static str,
        /// What they trade.
        precision: AnyPrecision,
    },
}

impl Number {
    /// All that this machine has, the scalars first.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let lanes = |(name, level)| AnyPrecision::ALL.map(|precision| Self::Lanes { level, name, precision });
        [Self::F64, Self::F32, Self::Fast, Self::Coarse]
            .into_iter()
            .chain(levels(Level::new()).flat_map(lanes))
            .collect()
    }

    /// Its name in the table: `f32`, or `avx2 fast`.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::F32 => "f32".to_owned(),
            Self::F64 => "f64".to_owned(),
            Self::Fast => "fast".to_owned(),
            Self::Coarse => "coarse".to_owned(),
            Self::Lanes { name, precision, .. } => format!("{name} {precision}"),
        }
    }
}

/// How long and how closely is looked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// How often each time is taken.
    pub rounds: usize,
    /// How long each takes at least.
    pub block: Duration,
    /// How many bytes are streamed, inputs and outputs together.
    pub stream: usize,
    /// How often. With 0 these times are NaN.
    pub stream_rounds: usize,
    /// How long all cores run at once. With zero they do not, and what they do in a second is NaN.
    pub parallel: Duration,
    /// How many pairs of directions an error is taken from.
    pub pairs: usize,
    /// The pixels in a row of the picture of the sphere.
    pub sphere: u32,
}

impl Effort {
    /// For a table that is kept: some seconds for each material.
    #[must_use]
    pub const fn full() -> Self {
        Self {
            rounds: 15,
            block: Duration::from_micros(150),
            stream: 64 << 20,
            stream_rounds: 2,
            parallel: Duration::from_millis(10),
            pairs: 4096,
            sphere: 96,
        }
    }

    /// For a test: the errors are near, the times are only just times.
    #[must_use]
    pub const fn quick() -> Self {
        Self {
            rounds: 3,
            block: Duration::from_micros(10),
            stream: 1 << 20,
            stream_rounds: 1,
            parallel: Duration::from_micros(200),
            pairs: 512,
            sphere: 24,
        }
    }
}

/// A median with the quartiles around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quartiles {
    /// A quarter is below.
    pub low: f64,
    /// A half is.
    pub median: f64,
    /// Three quarters are.
    pub high: f64,
}

impl Quartiles {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let at = |part: f64| {
            let place = part * (values.len().saturating_sub(1)) as f64;
            let (below, above) = (place.floor() as usize, place.ceil() as usize);
            let value = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
            value(below) + (value(above) - value(below)) * place.fract()
        };
        Self { low: at(0.25), median: at(0.5), high: at(0.75) }
    }

    /// The distance of the quartiles, as a part of the median.
    #[must_use]
    pub fn spread(&self) -> f64 {
        (self.high - self.low) / self.median
    }
}

/// Relative errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Half are below.
    pub median: f64,
    /// 99 of 100 are.
    pub p99: f64,
    /// The largest.
    pub worst: f64,
}

/// What was found for a form of a subject in a number type.
#[derive(Clone, Debug)]
pub struct Row {
    /// The name of the subject.
    pub subject: String,
    /// The name of the form.
    pub form: String,
    /// The number type.
    pub number: Number,
    /// Nanoseconds for an evaluation, from buffers that stay in the cache.
    pub resident: Quartiles,
    /// Nanoseconds for a sample: a direction, its weight and its density. `None` in the numbers that the catalogue has no samplers
    /// in, which are all but the scalars `f32` and `f64`.
    pub sample: Option<Quartiles>,
    /// Nanoseconds for an evaluation, from buffers that do not.
    pub streaming: Quartiles,
    /// Evaluations a second of all cores together.
    pub all_cores: f64,
    /// Bytes of the functions that evaluate the lobes, each once; what they call is not included. `None` if it is not
    /// known, see [`Bench::no_code`].
    pub code: Option<u64>,
    /// The error of `eval_cos`.
    pub error: Errors,
    /// The largest relative error of the directional albedo.
    pub albedo: f64,
    /// The error that is seen.
    pub seen: Seen,
}

/// Whether the times of these rows are not to be trusted: the quartiles of more than a quarter of them are further apart
/// than a tenth of the median.
#[must_use]
pub fn is_noisy(rows: &[Row]) -> bool {
    let unsteady = rows.iter().filter(|row| row.resident.spread() > 0.1).count();
    4 * unsteady > rows.len()
}

/// The directions to the light and to the viewer.
type Pair = (Vec3<f64>, Vec3<f64>);

/// Directions, irradiances and results of some points.
#[derive(Clone)]
struct Points<R> {
    l: [Vec<R>; 3],
    v: [Vec<R>; 3],
    irradiance: [Vec<R>; 3],
    out: [Vec<R>; 3],
}

impl<R: Scalar> Points<R> {
    /// The pairs from `first` on, over and over.
    fn new(pairs: &[Pair], first: usize, count: usize) -> Self {
        let numbers = |of: &dyn Fn(usize) -> f64| (0..count).map(|i| R::from_f64(of(i))).collect::<Vec<_>>();
        let pair = |i: usize| pairs[(first + i) % pairs.len()];
        let vector =
            |of: &dyn Fn(usize) -> Vec3<f64>| [numbers(&|i| of(i).x), numbers(&|i| of(i).y), numbers(&|i| of(i).z)];
        let light = |k: usize| numbers(&|i| 0.5 + ((i + k) % 7) as f64 / 8.0);
        Self {
            l: vector(&|i| pair(i).0),
            v: vector(&|i| pair(i).1),
            irradiance: [light(0), light(1), light(2)],
            out: [numbers(&|_| 0.0), numbers(&|_| 0.0), numbers(&|_| 0.0)],
        }
    }

    fn len(&self) -> usize {
        self.l[0].len()
    }

    /// `out += eval_cos · E`, point by point.
    fn shade(&mut self, brdf: &AnyBrdf<R>) {
        let Self { l, v, irradiance: e, out } = self;
        let [r, g, b] = out;
        for (i, ((r, g), b)) in r.iter_mut().zip(g).zip(b).enumerate() {
            let l = Vec3::new(l[0][i], l[1][i], l[2][i]);
            let v = Vec3::new(v[0][i], v[1][i], v[2][i]);
            let f = brdf.eval_cos(l, v);
            (*r, *g, *b) = (*r + f.r * e[0][i], *g + f.g * e[1][i], *b + f.b * e[2][i]);
        }
    }
}

impl Points<f32> {
    fn shade_lanes(&mut self, batch: &AnyBatch, level: Level, precision: AnyPrecision) {
        let Self { l, v, irradiance: [er, eg, eb], out: [r, g, b] } = self;
        // Their lengths are one by construction.
        let _ = batch.shade(level, precision, vector(l), vector(v), Rgb { r: er, g: eg, b: eb }, Rgb { r, g, b });
    }
}

fn vector([x, y, z]: &[Vec<f32>; 3]) -> Vec3<&[f32]> {
    Vec3::new(x, y, z)
}

/// Viewers, the three numbers that a sample is drawn from, and the samples.
struct Draws<R> {
    v: [Vec<R>; 3],
    u: [Vec<R>; 3],
    out: Vec<(Vec3<R>, Rgb<R>, R)>,
}

impl<R: SampleNumber> Draws<R> {
    /// For the viewers of as many pairs.
    fn new(pairs: &[Pair], random: &mut impl FnMut() -> f64) -> Self {
        let viewer = |c: fn(Vec3<f64>) -> f64| pairs.iter().map(|pair| R::from_f64(c(pair.1))).collect();
        let mut numbers = || pairs.iter().map(|_| R::from_f64(random())).collect();
        let zero = R::from_f64(0.0);
        Self {
            v: [viewer(|v| v.x), viewer(|v| v.y), viewer(|v| v.z)],
            u: [numbers(), numbers(), numbers()],
            out: vec![(Vec3::new(zero, zero, zero), Rgb::splat(zero), zero); pairs.len()],
        }
    }

    fn all(pairs: &[Pair]) -> Vec<Self> {
        let mut random = random(2);
        let pair = |i: usize| pairs[i % pairs.len()];
        (0..BUFFERS)
            .map(|k| Self::new(&(0..POINTS).map(|i| pair(k * POINTS + i)).collect::<Vec<_>>(), &mut random))
            .collect()
    }

    /// A sample for each point.
    fn sample(&mut self, sampler: &AnySampler<R>) {
        let Self { v, u, out } = self;
        for (i, out) in out.iter_mut().enumerate() {
            let sampled = sampler.sample(Vec3::new(v[0][i], v[1][i], v[2][i]), [u[0][i], u[1][i], u[2][i]]);
            *out = (sampled.l, sampled.weight, sampled.pdf);
        }
    }
}

/// The points of all kinds of timing in one scalar type.
#[derive(Clone)]
struct Buffers<R> {
    resident: Vec<Points<R>>,
    stream: Points<R>,
}

impl<R: Scalar> Buffers<R> {
    fn new(pairs: &[Pair], stream: usize) -> Self {
        let resident = (0..BUFFERS).map(|i| Points::new(pairs, i * POINTS, POINTS)).collect();
        // Nine numbers are read for a point and three written.
        Self { resident, stream: Points::new(pairs, 0, stream / (12 * size_of::<R>())) }
    }
}

/// The points of a buffer that stays in the cache; a renderer's tile has as many.
const POINTS: usize = 256;
/// How many such buffers are used in turn.
const BUFFERS: usize = 8;

/// A form, built in a number type.
enum Runner {
    F32(AnyBrdf<f32>),
    F64(AnyBrdf<f64>),
    Fast(AnyBrdf<Approximate<f32, Fast>>),
    Coarse(AnyBrdf<Approximate<f32, Coarse>>),
    Lanes(AnyBatch, Level, AnyPrecision),
}

impl Runner {
    fn new(material: &Material, number: Number) -> Self {
        match number {
            Number::F32 => Self::F32(material.build()),
            Number::F64 => Self::F64(material.build()),
            Number::Fast => Self::Fast(material.build()),
            Number::Coarse => Self::Coarse(material.build()),
            Number::Lanes { level, precision, .. } => Self::Lanes(material.batch(), level, precision),
        }
    }

    /// `eval_cos` of each pair, which are numbers of `f32`.
    fn eval_cos(&self, l: &[Vec<f32>; 3], v: &[Vec<f32>; 3]) -> Vec<[f64; 3]> {
        match self {
            Self::F32(brdf) => each(brdf, l, v, f64::from),
            Self::F64(brdf) => each(brdf, l, v, |x| x),
            Self::Fast(brdf) => each(brdf, l, v, |x| f64::from(x.value())),
            Self::Coarse(brdf) => each(brdf, l, v, |x| f64::from(x.value())),
            Self::Lanes(batch, level, precision) => {
                let count = l[0].len();
                let [mut r, mut g, mut b] = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
                let out = Rgb { r: &mut r[..], g: &mut g, b: &mut b };
                // Their lengths are one by construction.
                let _ = batch.eval_cos(*level, *precision, vector(l), vector(v), out);
                (0..count).map(|i| [r[i], g[i], b[i]].map(f64::from)).collect()
            }
        }
    }
}

/// The sampler of a form, in the scalars that have one.
enum Sampler {
    F32(AnySampler<f32>),
    F64(AnySampler<f64>),
}

impl Sampler {
    fn new(material: &Material, number: Number) -> Option<Self> {
        match number {
            Number::F32 => Some(Self::F32(material.sampler())),
            Number::F64 => Some(Self::F64(material.sampler())),
            Number::Fast | Number::Coarse | Number::Lanes { .. } => None,
        }
    }
}

/// What is timed from buffers that stay in the cache.
enum Job<'a> {
    Shade(&'a Runner),
    Sample(&'a Sampler),
}

fn each<R: Scalar>(brdf: &AnyBrdf<R>, l: &[Vec<f32>; 3], v: &[Vec<f32>; 3], to: impl Fn(R) -> f64) -> Vec<[f64; 3]> {
    let at = |w: &[Vec<f32>; 3], i: usize| Vec3::new(w[0][i], w[1][i], w[2][i]).map(|c| R::from_f64(f64::from(c)));
    (0..l[0].len()).map(|i| <[R; 3]>::from(brdf.eval_cos(at(l, i), at(v, i))).map(&to)).collect()
}

/// The buffers, the directions and the picture, made once for all subjects.
pub struct Bench {
    effort: Effort,
    f32: Buffers<f32>,
    f64: Buffers<f64>,
    fast: Buffers<Approximate<f32, Fast>>,
    coarse: Buffers<Approximate<f32, Coarse>>,
    draws: (Vec<Draws<f32>>, Vec<Draws<f64>>),
    pairs: ([Vec<f32>; 3], [Vec<f32>; 3]),
    quadrature: Quadrature,
    sphere: Sphere,
    /// Or why it is not known.
    code: Result<Code, String>,
}

impl std::fmt::Debug for Bench {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Bench").field("effort", &self.effort).finish_non_exhaustive()
    }
}

impl Bench {
    /// A bench for this effort.
    #[must_use]
    pub fn new(effort: Effort) -> Self {
        let pairs = pairs(effort.pairs.max(1));
        let columns = |of: fn(&Pair) -> Vec3<f64>| {
            [|w: Vec3<f64>| w.x, |w: Vec3<f64>| w.y, |w: Vec3<f64>| w.z]
                .map(|c| pairs.iter().map(|pair| c(of(pair)) as f32).collect())
        };
        Self {
            effort,
            f32: Buffers::new(&pairs, effort.stream),
            f64: Buffers::new(&pairs, effort.stream),
            fast: Buffers::new(&pairs, effort.stream),
            coarse: Buffers::new(&pairs, effort.stream),
            draws: (Draws::all(&pairs), Draws::all(&pairs)),
            pairs: (columns(|pair| pair.0), columns(|pair| pair.1)),
            quadrature: Quadrature::new(),
            sphere: Sphere::new(effort.sphere),
            code: Code::of_this_program(),
        }
    }

    /// Why no row has [`Row::code`], in a line. Where this is `None` a row may still lack it: if the program has no function
    /// of the name that it should have.
    #[must_use]
    pub fn no_code(&self) -> Option<&str> {
        self.code.as_ref().err().map(String::as_str)
    }

    /// Times and compares every form of the subject in each of the numbers.
    pub fn measure(&mut self, subject: &Subject, numbers: &[Number]) -> Vec<Row> {
        let Some(reference) = subject.forms.first() else { return Vec::new() };
        let reference = Reference::new(self, &Runner::new(&reference.material, Number::F64));
        let runs: Vec<_> = subject
            .forms
            .iter()
            .flat_map(|form| numbers.iter().map(move |&number| (form, number, Runner::new(&form.material, number))))
            .collect();
        let samplers: Vec<_> = runs.iter().map(|(form, number, _)| Sampler::new(&form.material, *number)).collect();
        // Samples in turn with evaluations, so that both can be compared.
        let jobs: Vec<_> = runs.iter().map(|(.., runner)| Job::Shade(runner)).collect();
        let jobs: Vec<_> = jobs.into_iter().chain(samplers.iter().flatten().map(Job::Sample)).collect();
        let mut resident = self.time(&jobs, Self::resident, self.effort.rounds, self.effort.block);
        let mut samples = resident.split_off(runs.len()).into_iter();
        let samples = samplers.iter().map(|sampler| sampler.as_ref().and_then(|_| samples.next()));
        let runners: Vec<_> = runs.iter().map(|(.., runner)| runner).collect();
        let streaming =
            self.time(&runners, |bench, runner| bench.streaming(runner), self.effort.stream_rounds, Duration::ZERO);
        let times = resident.into_iter().zip(streaming).zip(samples);
        runs.iter()
            .zip(times)
            .map(|((form, number, runner), ((resident, streaming), sample))| Row {
                subject: subject.name.clone(),
                form: form.name.clone(),
                number: *number,
                resident,
                sample,
                streaming,
                all_cores: self.all_cores(runner),
                code: self.code.as_ref().ok().and_then(|code| code.bytes(&form.material, *number)),
                error: reference.error(self, runner),
                albedo: reference.albedo(self, runner),
                seen: reference.seen(self, runner),
            })
            .collect()
    }

    /// The resident buffers once; how many points they have.
    fn resident(&mut self, job: &Job<'_>) -> usize {
        fn all<P>(points: &mut [P], work: impl Fn(&mut P)) -> usize {
            points.iter_mut().for_each(work);
            BUFFERS * POINTS
        }
        let runner = match job {
            Job::Shade(runner) => runner,
            Job::Sample(Sampler::F32(sampler)) => return all(&mut self.draws.0, |draws| draws.sample(sampler)),
            Job::Sample(Sampler::F64(sampler)) => return all(&mut self.draws.1, |draws| draws.sample(sampler)),
        };
        match runner {
            Runner::F32(brdf) => all(&mut self.f32.resident, |points| points.shade(brdf)),
            Runner::F64(brdf) => all(&mut self.f64.resident, |points| points.shade(brdf)),
            Runner::Fast(brdf) => all(&mut self.fast.resident, |points| points.shade(brdf)),
            Runner::Coarse(brdf) => all(&mut self.coarse.resident, |points| points.shade(brdf)),
            Runner::Lanes(batch, level, precision) => {
                all(&mut self.f32.resident, |points| points.shade_lanes(batch, *level, *precision))
            }
        }
    }

    /// The stream once; how many points it has.
    fn streaming(&mut self, runner: &Runner) -> usize {
        fn once<R: Scalar>(points: &mut Points<R>, shade: impl Fn(&mut Points<R>)) -> usize {
            shade(points);
            points.len()
        }
        match runner {
            Runner::F32(brdf) => once(&mut self.f32.stream, |points| points.shade(brdf)),
            Runner::F64(brdf) => once(&mut self.f64.stream, |points| points.shade(brdf)),
            Runner::Fast(brdf) => once(&mut self.fast.stream, |points| points.shade(brdf)),
            Runner::Coarse(brdf) => once(&mut self.coarse.stream, |points| points.shade(brdf)),
            Runner::Lanes(batch, level, precision) => {
                once(&mut self.f32.stream, |points| points.shade_lanes(batch, *level, *precision))
            }
        }
    }

    /// Nanoseconds for a point of each job, in turn: what disturbs the machine for a while disturbs all alike.
    fn time<J>(
        &mut self,
        jobs: &[J],
        pass: impl Fn(&mut Self, &J) -> usize,
        rounds: usize,
        block: Duration,
    ) -> Vec<Quartiles> {
        // The first pass warms up, and says how many make a block.
        let passes: Vec<u32> = jobs
            .iter()
            .map(|job| {
                let start = Instant::now();
                pass(self, job);
                let once = start.elapsed().as_secs_f64().max(1e-9);
                (block.as_secs_f64() / once).ceil().max(1.0) as u32
            })
            .collect();
        let mut times = vec![Vec::with_capacity(rounds); jobs.len()];
        for round in 0..rounds {
            for k in 0..jobs.len() {
                let index = (k + round) % jobs.len();
                let (start, mut points) = (Instant::now(), 0);
                for _ in 0..passes[index] {
                    points += pass(self, &jobs[index]);
                }
                times[index].push(start.elapsed().as_secs_f64() * 1e9 / points as f64);
            }
        }
        times.into_iter().map(Quartiles::of).collect()
    }

    /// Evaluations a second of all cores together.
    fn all_cores(&self, runner: &Runner) -> f64 {
        fn run<R: Scalar>(points: &[Points<R>], time: Duration, shade: impl Fn(&mut Points<R>) + Sync) -> f64 {
            let threads = std::thread::available_parallelism().map_or(1, usize::from);
            let barrier = Barrier::new(threads);
            std::thread::scope(|scope| {
                let work = || {
                    let mut own = points.to_vec();
                    own.iter_mut().for_each(&shade);
                    barrier.wait();
                    let (start, mut count) = (Instant::now(), 0_usize);
                    loop {
                        own.iter_mut().for_each(&shade);
                        count += BUFFERS * POINTS;
                        let elapsed = start.elapsed();
                        if elapsed >= time {
                            return count as f64 / elapsed.as_secs_f64();
                        }
                    }
                };
                let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
                // A thread that panicked has said so, and has done nothing.
                handles.into_iter().map(|handle| handle.join().unwrap_or(0.0)).sum()
            })
        }
        let time = self.effort.parallel;
        if time.is_zero() {
            return f64::NAN;
        }
        match runner {
            Runner::F32(brdf) => run(&self.f32.resident, time, |points| points.shade(brdf)),
            Runner::F64(brdf) => run(&self.f64.resident, time, |points| points.shade(brdf)),
            Runner::Fast(brdf) => run(&self.fast.resident, time, |points| points.shade(brdf)),
            Runner::Coarse(brdf) => run(&self.coarse.resident, time, |points| points.shade(brdf)),
            Runner::Lanes(batch, level, precision) => {
                run(&self.f32.resident, time, |points| points.shade_lanes(batch, *level, *precision))
            }
        }
    }
}

/// What errors are measured against.
struct Reference {
    values: Vec<[f64; 3]>,
    albedos: Vec<[f64; 3]>,
    picture: Vec<Rgb<f64>>,
    exposure: f64,
}

impl Reference {
    fn new(bench: &Bench, exact: &Runner) -> Self {
        let picture = picture(&bench.sphere, &exact.eval_cos(&bench.sphere.l, &bench.sphere.v));
        Self {
            values: exact.eval_cos(&bench.pairs.0, &bench.pairs.1),
            albedos: bench.quadrature.albedos(exact),
            exposure: exposure(&picture),
            picture,
        }
    }

    fn error(&self, bench: &Bench, runner: &Runner) -> Errors {
        let found = runner.eval_cos(&bench.pairs.0, &bench.pairs.1);
        // Below, nobody sees anything, and an exponential has the error of its argument.
        let floor = 1e-4 * self.values.iter().flatten().fold(0.0, |max: f64, &x| if x > max { x } else { max });
        let mut errors: Vec<f64> = found
            .iter()
            .flatten()
            .zip(self.values.iter().flatten())
            .filter(|(_, exact)| **exact > floor && exact.is_finite())
            .map(|(found, exact)| relative(*found, *exact))
            .collect();
        errors.sort_by(f64::total_cmp);
        let at = |part: f64| {
            let index = (part * errors.len() as f64) as usize;
            errors.get(index.min(errors.len().saturating_sub(1))).copied().unwrap_or(0.0)
        };
        Errors { median: at(0.5), p99: at(0.99), worst: at(1.0) }
    }

    fn albedo(&self, bench: &Bench, runner: &Runner) -> f64 {
        let found = bench.quadrature.albedos(runner);
        let pairs = found.iter().flatten().zip(self.albedos.iter().flatten());
        pairs.filter(|(_, exact)| **exact > 0.0).map(|(found, exact)| relative(*found, *exact)).fold(0.0, f64::max)
    }

    fn seen(&self, bench: &Bench, runner: &Runner) -> Seen {
        let found = picture(&bench.sphere, &runner.eval_cos(&bench.sphere.l, &bench.sphere.v));
        compare(&found, &self.picture, self.exposure)
    }
}

/// `|a − b|/b`; infinite if `a` is not a number.
fn relative(a: f64, b: f64) -> f64 {
    let error = (a - b).abs() / b;
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Points and weights for the directional albedo of some viewers.
struct Quadrature {
    l: [Vec<f32>; 3],
    v: [Vec<f32>; 3],
    weights: Vec<f64>,
}

impl Quadrature {
    const RINGS: u32 = 96;
    const SECTORS: u32 = 24;

    /// In polar coordinates around the mirror direction, with a logarithmic radius, so that sharp lobes are met too.
    fn new() -> Self {
        const SMALLEST: f64 = 1e-4;
        let step = (PI / SMALLEST).ln() / f64::from(Self::RINGS);
        let mut all = Self { l: Default::default(), v: Default::default(), weights: Vec::new() };
        let push = |to: &mut [Vec<f32>; 3], w: Vec3<f64>| {
            to.iter_mut().zip(<[f64; 3]>::from(w)).for_each(|(to, c)| to.push(c as f32));
        };
        for theta in [0.0_f64, 60.0, 80.0].map(f64::to_radians) {
            let v = Vec3::new(theta.sin(), 0.0, theta.cos());
            let pole = Vec3::new(-v.x, 0.0, v.z);
            let (right, up) = (Vec3::new(v.z, 0.0, v.x), Vec3::new(0.0, 1.0, 0.0));
            for ring in 0..Self::RINGS {
                let angle = SMALLEST * ((f64::from(ring) + 0.5) * step).exp();
                for sector in 0..Self::SECTORS {
                    let (sine, cosine) = ((f64::from(sector) + 0.5) * TAU / f64::from(Self::SECTORS)).sin_cos();
                    push(&mut all.l, pole * angle.cos() + (right * cosine + up * sine) * angle.sin());
                    push(&mut all.v, v);
                    all.weights.push(angle.sin() * angle * step * TAU / f64::from(Self::SECTORS));
                }
            }
        }
        all
    }

    /// Of each viewer.
    fn albedos(&self, runner: &Runner) -> Vec<[f64; 3]> {
        let values = runner.eval_cos(&self.l, &self.v);
        let viewer = (Self::RINGS * Self::SECTORS) as usize;
        let sum = |part: (&[[f64; 3]], &[f64])| {
            part.0.iter().zip(part.1).fold([0.0; 3], |sum, (f, weight)| [0, 1, 2].map(|i| sum[i] + f[i] * weight))
        };
        values.chunks(viewer).zip(self.weights.chunks(viewer)).map(sum).collect()
    }
}

/// Numbers of `[0, 1)` in 24 bits.
fn random(seed: u32) -> impl FnMut() -> f64 {
    let mut bits = seed;
    move || {
        // Numerical Recipes' generator; its high bits will do.
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(bits >> 8) / f64::from(1 << 24)
    }
}

/// Pairs of directions above the horizon; every other one near the mirror direction of its viewer. Numbers of `f32`.
fn pairs(count: usize) -> Vec<Pair> {
    let mut random = random(1);
    let unit = |z: f64, phi: f64| {
        let r = (1.0 - z * z).max(0.0).sqrt();
        Vec3::new(r * phi.cos(), r * phi.sin(), z)
    };
    // Down to 1° above the horizon.
    const LOWEST: f64 = 0.017;
    let mut all = Vec::with_capacity(count);
    while all.len() < count {
        let v = unit(LOWEST + (1.0 - LOWEST) * random(), TAU * random());
        let l = if all.len() % 2 == 0 {
            unit(LOWEST + (1.0 - LOWEST) * random(), TAU * random())
        } else {
            let around = unit(2.0 * random() - 1.0, TAU * random());
            (Vec3::new(-v.x, -v.y, v.z) + around * 10.0_f64.powf(-3.0 * random())).normalize()
        };
        if l.z >= LOWEST {
            let rounded = |w: Vec3<f64>| w.map(|c| f64::from(c as f32));
            all.push((rounded(l), rounded(v)));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use lobe_models::preset;

    #[test]
    fn quartiles_are_between() {
        let of = Quartiles::of(vec![5.0, 1.0, 2.0, 4.0, 3.0]);
        assert_eq!(of, Quartiles { low: 2.0, median: 3.0, high: 4.0 });
        assert_eq!(Quartiles::of(vec![1.0, 2.0]).median, 1.5);
    }

    #[test]
    fn precise_lanes_have_the_error_of_the_scalar_and_less_precise_ones_a_larger() {
        let subject = Subject::of_material(&preset("ggx-gold").expect("there is one"));
        let rows = Bench::new(Effort::quick()).measure(&subject, &Number::all());
        let exact: Vec<_> = rows.iter().filter(|row| row.form == "exact").collect();
        let find = |name: &str| exact.iter().find(|row| row.number.name() == name).expect("a row");
        assert_eq!((find("f64").error.worst, find("f64").seen), (0.0, Seen::default()));
        let f32 = find("f32");
        assert!(f32.error.worst > 0.0 && f32.error.worst < 2e-5 && f32.seen.steps <= 1);
        for (name, _) in levels(Level::new()) {
            let [precise, fast, coarse] = ["precise", "fast", "coarse"].map(|p| find(&format!("{name} {p}")).error.p99);
            assert_eq!(precise, f32.error.p99, "{name}");
            assert!(precise < fast && fast <= coarse && coarse < 0.02, "{name}: {fast} {coarse}");
        }
        let hammon = rows.iter().find(|row| row.form == "Hammon for Smith").expect("a row");
        assert!(hammon.error.worst > 0.1 && hammon.error.worst < 0.4 && hammon.seen.steps > 1, "{hammon:?}");
        assert!(rows.iter().all(|row| row.resident.median > 0.0 && row.streaming.median > 0.0 && row.all_cores > 0.0));
        for row in &rows {
            let sampled = matches!(row.number, Number::F32 | Number::F64);
            assert!(row.sample.is_some() == sampled && row.sample.is_none_or(|ns| ns.median > 0.0), "{row:?}");
        }
    }

    /// What is timed is what the sampler of the material gives, of viewers and numbers that differ from point to point.
    #[test]
    fn a_pass_over_the_draws_samples_each_point() {
        let material = preset("ggx-gold").expect("there is one");
        let mut bench = Bench::new(Effort::quick());
        let sampler = Sampler::new(&material, Number::F32).expect("f32 has one");
        assert_eq!(bench.resident(&Job::Sample(&sampler)), BUFFERS * POINTS);
        let (sampler, draws) = (material.sampler::<f32>(), &bench.draws.0);
        assert_eq!(draws.len(), BUFFERS);
        let mut directions = Vec::new();
        for Draws { v, u, out } in draws {
            assert_eq!(out.len(), POINTS);
            for (i, &(l, weight, pdf)) in out.iter().enumerate() {
                let one = sampler.sample(Vec3::new(v[0][i], v[1][i], v[2][i]), [u[0][i], u[1][i], u[2][i]]);
                assert_eq!((l, weight, pdf), (one.l, one.weight, one.pdf));
                directions.push([l.x, l.y, l.z].map(f32::to_bits));
            }
        }
        directions.sort_unstable();
        directions.dedup();
        assert!(directions.len() > BUFFERS * POINTS * 9 / 10, "{}", directions.len());
    }

    /// What the quadrature gives is the albedo: of a white Lambert 1.
    #[test]
    fn the_quadrature_integrates() {
        let white = Material::from_json(r#"{"lobes": [{"model": "lambert", "albedo": 1}]}"#).expect("a material");
        for albedo in Quadrature::new().albedos(&Runner::new(&white, Number::F64)) {
            assert!((albedo[1] - 1.0).abs() < 0.02, "{albedo:?}");
        }
        assert!(!catalogue().is_empty());
    }
}
