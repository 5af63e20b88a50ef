//! The bytes of machine code of a function, from the symbols of the program that runs.

use crate::measure::Number;
use lobe::number::{Approximate, Coarse, Fast};
use lobe_models::{AnyPrecision, Function, Material};
use object::{Object as _, ObjectSymbol as _, SymbolKind};
use std::collections::{BTreeSet, HashMap};

/// The functions of this program that evaluate lobes, with the bytes of each.
pub(crate) struct Code {
    /// By the whole name.
    scalars: HashMap<String, u64>,
    /// Those that are made for a kernel: the loop is the largest whose name holds its arguments.
    loops: Vec<(String, u64)>,
}

impl Code {
    /// Of the program that runs; or why nothing is known of it.
    pub(crate) fn of_this_program() -> Result<Self, String> {
        let data = std::env::current_exe().and_then(std::fs::read);
        Self::of_program(&data.map_err(|error| format!("this program cannot read itself: {error}"))?)
    }

    /// Of the program whose file has these bytes.
    fn of_program(data: &[u8]) -> Result<Self, String> {
        let file = object::File::parse(data).map_err(|_| {
            "sizes are only read from the symbols of ELF, and this program has another format".to_owned()
        })?;
        let mut code = Self { scalars: HashMap::new(), loops: Vec::new() };
        for symbol in file.symbols() {
            // A large program has a hundred times more names than are looked for. The names of version v0 begin with
            // `_R`, and have the words of a path as they are, each after its length.
            let Ok(name) = symbol.name() else { continue };
            let (scalar, register_loop) = (name.contains("8eval_cos"), name.contains("9registers"));
            if !name.starts_with("_R") || !(scalar || register_loop) || symbol.kind() != SymbolKind::Text {
                continue;
            }
            let Ok(name) = rustc_demangle::try_demangle(name) else { continue };
            let (name, bytes) = (format!("{name:#}"), symbol.size());
            if register_loop {
                code.loops.push((name, bytes));
            } else {
                // Where a compiler made several copies, one is called.
                let largest = code.scalars.entry(name).or_default();
                *largest = bytes.max(*largest);
            }
        }
        if code.scalars.is_empty() && code.loops.is_empty() {
            return Err(
                "this program has no names that tell: it was stripped, or built without `-C symbol-mangling-version=v0`"
                    .to_owned(),
            );
        }
        Ok(code)
    }

    /// Of what evaluates the material, each function once; `None` if one of them is not found.
    ///
    /// Of two functions with the same instructions a compiler may keep one, and its name alone: where a lobe asks for
    /// nothing that the precisions differ in, the name of another precision stands for the one that is looked for.
    pub(crate) fn bytes(&self, material: &Material, number: Number) -> Option<u64> {
        let others = match number {
            Number::Fast => vec![Number::Coarse, Number::F32],
            Number::Coarse => vec![Number::Fast, Number::F32],
            Number::F32 => vec![Number::Fast, Number::Coarse],
            Number::F64 => Vec::new(),
            Number::Lanes { level, name, precision } => {
                // The nearest first: precise has the least in common with the others.
                let rest = AnyPrecision::ALL.into_iter().rev().filter(|other| *other != precision);
                rest.map(|precision| Number::Lanes { level, name, precision }).collect()
            }
        };
        // The lobes are in the same order in all of them.
        let named: Vec<_> = std::iter::once(number).chain(others).map(|number| functions(material, number)).collect();
        let (first, register) = (named.first()?, register(number));
        let mut once = BTreeSet::new();
        let sizes = (0..first.len()).filter(|&lobe| once.insert(first[lobe])).map(|lobe| {
            let names = named.iter().filter_map(|functions| functions.get(lobe));
            names.into_iter().find_map(|function| self.of_function(*function, register))
        });
        let sum: Option<u64> = sizes.sum();
        // A size of zero is none: an assembler that was told nothing.
        sum.filter(|bytes| *bytes > 0)
    }

    fn of_function(&self, function: Function, register: Option<&str>) -> Option<u64> {
        match function {
            Function::Scalar { .. } => self.scalars.get(&function.to_string()).copied(),
            Function::Lanes { .. } => {
                let arguments = format!("::{}>, {function}, ", register?);
                let made_for_it = self.loops.iter().filter(|(name, _)| name.contains(&arguments));
                made_for_it.map(|(_, bytes)| *bytes).max()
            }
        }
    }
}

/// What evaluates the lobes of the material, one for each.
fn functions(material: &Material, number: Number) -> Vec<Function> {
    match number {
        Number::F32 => material.functions::<f32>(),
        Number::F64 => material.functions::<f64>(),
        Number::Fast => material.functions::<Approximate<f32, Fast>>(),
        Number::Coarse => material.functions::<Approximate<f32, Coarse>>(),
        Number::Lanes { precision, .. } => material.batch().functions(precision),
    }
}

/// The type that the registers of a level are made with, without its module.
fn register(number: Number) -> Option<&'static str> {
    let Number::Lanes { name, .. } = number else { return None };
    Some(match name {
        "sse4.2" => "Sse4_2",
        "avx2" => "Avx2",
        "avx512" => "Avx512",
        "neon" => "Neon",
        "simd128" => "WasmSimd128",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    /// The code of the test that runs; nothing where it cannot be known.
    fn code() -> Option<Code> {
        match Code::of_this_program() {
            Ok(code) => Some(code),
            // The flags of the workspace, which ask for names that tell, are not there where others take their place.
            Err(why) if !cfg!(target_os = "linux") || std::env::var_os("RUSTFLAGS").is_some() => {
                println!("not looked at: {why}");
                None
            }
            Err(why) => panic!("{why}"),
        }
    }

    fn material(lobes: &str) -> Material {
        Material::from_json(&format!(r#"{{"lobes": [{lobes}]}}"#)).expect("a material")
    }

    const LAMBERT: &str = r#"{"model": "lambert", "albedo": 0.5}"#;
    const GGX: &str = r#"{"model": "microfacet", "alpha": 0.3, "f0": 0.04}"#;

    #[test]
    fn every_form_of_every_model_has_a_size_in_every_number() {
        let Some(code) = code() else { return };
        let mut missing = Vec::new();
        for subject in catalogue() {
            for (form, number) in
                subject.forms.iter().flat_map(|form| Number::all().into_iter().map(move |n| (form, n)))
            {
                if code.bytes(&form.material, number).is_none() {
                    missing.push(format!("{} {} {}", subject.name, form.name, number.name()));
                }
            }
        }
        assert!(missing.is_empty(), "{missing:#?}");
    }

    #[test]
    fn lobes_add_up_and_ggx_is_larger_than_lambert() {
        let Some(code) = code() else { return };
        for number in Number::all() {
            let bytes = |lobes: &str| code.bytes(&material(lobes), number).expect("a size");
            let (lambert, ggx) = (bytes(LAMBERT), bytes(GGX));
            println!("{}: {lambert} {ggx}", number.name());
            assert!(20 < lambert && lambert < ggx && ggx < 100_000, "{}: {lambert} {ggx}", number.name());
            assert_eq!(bytes(&format!("{LAMBERT}, {GGX}")), lambert + ggx, "{}", number.name());
            // Two of one kind share their code.
            assert_eq!(bytes(&format!("{LAMBERT}, {LAMBERT}")), lambert, "{}", number.name());
        }
    }

    /// Point by point is the scalar at every level.
    #[test]
    fn what_runs_point_by_point_has_the_size_of_the_scalar() {
        let Some(code) = code() else { return };
        let blinn = material(r#"{"model": "microfacet", "alpha": 0.3, "f0": 0.04, "distribution": "blinn"}"#);
        let scalar = code.bytes(&blinn, Number::F32).expect("a size");
        for number in Number::all().into_iter().filter(|number| !matches!(number, Number::F64)) {
            assert_eq!(code.bytes(&blinn, number), Some(scalar), "{}", number.name());
        }
    }

    #[test]
    fn every_level_of_this_machine_is_known_by_its_registers() {
        for number in Number::all() {
            let Number::Lanes { level, .. } = number else { continue };
            let register = register(number).expect("there is one");
            assert!(format!("{level:?}").starts_with(register), "{number:?}");
        }
    }

    #[test]
    fn what_is_no_program_is_an_error() {
        let why = |data: &[u8]| Code::of_program(data).err().expect("an error");
        assert!(why(b"").contains("another format"));
        assert!(why(b"MZ and no more").contains("another format"));
        let own = std::env::current_exe().and_then(std::fs::read).expect("readable");
        // Its head alone, and a program of which a half was overwritten: no size, and no panic.
        for part in [&own[..64], &own[..own.len() / 2]] {
            assert!(Code::of_program(part).is_err());
        }
        let mut broken = own.clone();
        let half = broken.len() / 2;
        broken[half..].fill(0xff);
        let _ = Code::of_program(&broken);
    }

    /// A program without symbols: a header of ELF for 64 bits and nothing behind it.
    #[test]
    fn a_stripped_program_says_so() {
        let mut header = [0_u8; 64];
        header[..7].copy_from_slice(b"\x7fELF\x02\x01\x01");
        // An executable of x86-64, of version 1; the header has 64 bytes.
        (header[16], header[18], header[20], header[52]) = (2, 62, 1, 64);
        assert!(Code::of_program(&header).err().expect("an error").contains("stripped"));
    }
}
