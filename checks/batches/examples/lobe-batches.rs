//! Runs batch kernels, so that something else can count what they do.
//!
//! ```text
//! lobe-batches                            lists the kernels, a line each
//! lobe-batches KERNEL PRECISION TIMES     runs one of them at AVX2, so many times on 4096 points
//! ```

use lobe::batch::{Level, levels};
use lobe::{Rgb, Vec3};
use lobe_batches::KERNELS;
use std::process::ExitCode;

/// What fills the registers, so that no buffer of a tail is counted.
const POINTS: usize = 4096;

fn main() -> ExitCode {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("lobe-batches: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<(), String> {
    let [kernel, precision, times] = arguments else {
        if !arguments.is_empty() {
            return Err("give no arguments, or KERNEL PRECISION TIMES".to_owned());
        }
        for named in KERNELS {
            println!("{}\t{}\t{}", named.kernel, named.precision, named.type_name);
        }
        return Ok(());
    };
    let named = KERNELS.iter().find(|named| named.kernel == kernel && named.precision == precision);
    let named =
        named.ok_or_else(|| format!("no kernel `{kernel}` at `{precision}`; without arguments they are listed"))?;
    let times: usize = times.parse().map_err(|_| format!("the number of times is `{times}`, not a whole number"))?;

    // Directions above the horizon, on a spiral: no branch depends on them, so any would do.
    let directions = |turn: f32| -> [Vec<f32>; 3] {
        let along = |f: &dyn Fn(f32) -> f32| (0..POINTS).map(|i| f(i as f32 / POINTS as f32)).collect();
        [
            along(&|t| (t * turn).cos() * (1.0 - (0.1 + 0.9 * t).powi(2)).sqrt()),
            along(&|t| (t * turn).sin() * (1.0 - (0.1 + 0.9 * t).powi(2)).sqrt()),
            along(&|t| 0.1 + 0.9 * t),
        ]
    };
    let ([lx, ly, lz], [vx, vy, vz]) = (directions(29.0), directions(-17.0));
    let [mut r, mut g, mut b] = [0; 3].map(|_| vec![0.0_f32; POINTS]);
    let level = avx2()?;
    for _ in 0..times {
        let out = Rgb { r: &mut r[..], g: &mut g, b: &mut b };
        (named.run)(level, Vec3::new(&lx[..], &ly, &lz), Vec3::new(&vx[..], &vy, &vz), out);
    }
    println!("{}", r.iter().chain(&g).chain(&b).sum::<f32>());
    Ok(())
}

/// AVX2, whatever else there is: valgrind hides AVX-512.
fn avx2() -> Result<Level, String> {
    let found = levels(Level::new()).find(|(name, _)| *name == "avx2");
    found.map(|(_, level)| level).ok_or_else(|| "this machine has no AVX2".to_owned())
}
