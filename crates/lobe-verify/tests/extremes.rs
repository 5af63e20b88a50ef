//! The models of the catalogue at the extremes, with a small budget; `lobe verify --extremes` has a large one.

use lobe::{Brdf, Lambert, Real, Rgb, Vec3};
use lobe_models::models;
use lobe_verify::extremes::{Effort, FaultKind, Outcome, Promises, extremes};

#[test]
fn every_model_keeps_its_promises() {
    let mut broken = Vec::new();
    for model in models() {
        let outcome = Outcome::of(model, Effort::QUICK, &|_| ());
        let found = &outcome.findings;
        assert!(found.compared() > 10_000, "{}: only {} values compared", model.name, found.compared());
        if !outcome.holds() {
            let faults: Vec<_> = found.faults.iter().map(|f| format!("{}: {}", f.kind, f.first)).collect();
            let worst = found.worst.as_ref().map(ToString::to_string).unwrap_or_default();
            broken.push(format!(
                "{}: 99 %: {:.2e}, {:.2} of the bound {worst} {faults:?}",
                model.name,
                found.percentile_99(),
                found.worst_part()
            ));
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// Lambert with a mistake that only one kind of input shows.
struct Flawed<F>(F);

impl<R: Real, F: Fn(R, Vec3<R>, Vec3<R>) -> R> Brdf<R> for Flawed<F> {
    fn eval(&self, l: Vec3<R>, v: Vec3<R>) -> Rgb<R> {
        let f = Lambert::new(Rgb::splat(l.z.lift(0.5))).eval(l, v);
        Rgb::new(f.r, (self.0)(f.g, l, v), f.b)
    }
}

fn kinds(flaw: impl Fn(f32, Vec3, Vec3) -> f32) -> (Vec<FaultKind>, f64) {
    let good = Lambert::new(Rgb::splat(0.5_f64));
    let found = extremes(&Flawed(flaw), &good, Promises::default(), &|_, _| 2e-5, Effort::QUICK);
    (found.faults.iter().map(|fault| fault.kind).collect(), found.worst_part())
}

/// What is broken is found: each promise, once.
#[test]
fn flaws_are_found() {
    let (none, part) = kinds(|f, _, _| f);
    assert!(none.is_empty() && part < 0.1, "{none:?} {part}");
    // A NaN where the directions are nearly opposite: 0/0 of a naive half vector.
    let opposite = |l: Vec3, v: Vec3| (l + v).length_squared() < 1e-30;
    assert_eq!(kinds(|f, l, v| if opposite(l, v) { f32::NAN } else { f }).0, [FaultKind::NotFinite]);
    assert_eq!(kinds(|f, l, v| if l == v { -f } else { f }).0, [FaultKind::Negative]);
    assert!(kinds(|f, l, _| f * (1.0 + 1e-6 * l.z)).0.contains(&FaultKind::NotReciprocal));
    // One bit in a narrow region.
    let narrow = |f: f32, l: Vec3, v: Vec3| if (l.z - v.z).abs() < 1e-7 && l.x * v.x < 0.0 { f * 1.0001 } else { f };
    assert!(kinds(narrow).1 > 4.0);
}

/// The search goes where no grid point is: an error that is large in one place only, with a slope that leads there.
#[test]
fn the_search_climbs() {
    let spike = |f: f32, l: Vec3, v: Vec3| {
        let away = (l.x * v.y - l.y * v.x - 0.123).abs() + (l.z + v.z - 1.357).abs();
        f * (1.0 + 1e-2 / (1.0 + 1e3 * away))
    };
    let good = Lambert::new(Rgb::splat(0.5_f64));
    let promises = Promises { reciprocal: false, finite: true };
    let found = extremes(&Flawed(spike), &good, promises, &|_, _| 1e-2, Effort::QUICK);
    let on_grid = found.worst_on_grid.as_ref().map_or(0.0, |case| case.part);
    assert!(on_grid < 0.5 && found.worst_part() > 0.9, "{on_grid} {}", found.worst_part());
}

/// The same numbers every time, whatever the threads do.
#[test]
fn the_outcome_can_be_repeated() {
    let model = lobe_models::model("microfacet").expect("there is one");
    let effort = Effort { lobes: 40, pairs: 100, random: 20, climbs: 8, steps: 100 };
    let [a, b] = [(); 2].map(|()| Outcome::of(model, effort, &|_| ()).findings);
    assert_eq!(a.compared(), b.compared());
    assert_eq!((a.median(), a.percentile_99(), a.worst_part()), (b.median(), b.percentile_99(), b.worst_part()));
    assert_eq!(a.worst.map(|case| case.to_string()), b.worst.map(|case| case.to_string()));
}
