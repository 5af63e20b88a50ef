//! A look at the machine code of batches: the loop of a kernel holds no call, no scalar arithmetic, and little traffic with
//! the stack.
//!
//! One missing `#[inline(always)]`, or a loop over a slice that a compiler leaves a loop where it is asked for small code,
//! makes a batch several times slower; no test of values would notice.
#![cfg(target_arch = "x86_64")]

use lobe_batches::KERNELS;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Compiles this crate with many codegen units and without LTO, as a user's build has it.
fn compile(name: &str, arguments: &[&str]) -> Vec<Function> {
    // Beside this test's own build: never inside it, where cargo holds a lock.
    let target: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    // From scratch: one file for each codegen unit, and none from an earlier build.
    let _ = std::fs::remove_dir_all(&target);
    let output = Command::new(env!("CARGO"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["rustc", "--quiet", "--release", "--package", "lobe-batches", "--lib", "--target-dir"])
        .arg(&target)
        .args(arguments)
        .args(["--", "--emit", "asm", "-C", "debuginfo=0", "-C", "codegen-units=16"])
        // The names then say what a generic function was made for.
        .args(["-C", "symbol-mangling-version=v0"])
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let files = walk(&target).into_iter().filter(|p| p.extension().is_some_and(|e| e == "s"));
    files.flat_map(|p| functions(&std::fs::read_to_string(p).expect("readable"))).collect()
}

fn walk(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    entries.flat_map(|p| if p.is_dir() { walk(&p) } else { vec![p] }).collect()
}

/// A function: its name, and its instructions in blocks, each with the label that it starts at.
struct Function {
    name: String,
    blocks: Vec<(String, Vec<String>)>,
}

fn functions(assembly: &str) -> Vec<Function> {
    let mut found: Vec<Function> = Vec::new();
    let mut inside = false;
    for line in assembly.lines() {
        if line.starts_with("_R") && line.ends_with(':') {
            let name = format!("{:#}", rustc_demangle::demangle(line.trim_end_matches(':')));
            found.push(Function { name, blocks: vec![(String::new(), Vec::new())] });
            inside = true;
        } else if line.starts_with(".Lfunc_end") {
            inside = false;
        } else if let Some(function) = found.last_mut().filter(|_| inside) {
            let instruction = line.trim();
            if let Some(label) = line.strip_suffix(':') {
                function.blocks.push((label.to_owned(), Vec::new()));
            } else if line.starts_with('\t') && !instruction.starts_with(['.', '#']) {
                let blocks = &mut function.blocks;
                let (_, block) = blocks.last_mut().expect("the first block is there");
                block.push(instruction.to_owned());
                // What follows a jump is a block of its own.
                if instruction.starts_with('j') {
                    blocks.push((String::new(), Vec::new()));
                }
            }
        }
    }
    found
}

fn mnemonic(instruction: &str) -> &str {
    instruction.split_whitespace().next().unwrap_or_default()
}

/// Arithmetic on a whole register of numbers.
fn is_vector_arithmetic(instruction: &str) -> bool {
    let m = mnemonic(instruction);
    m.ends_with("ps") && ["add", "sub", "mul", "div", "sqrt", "rcp", "fma", "fnma", "fms"].iter().any(|a| m.contains(a))
}

/// Arithmetic on one number, which ought to be on a register of them.
fn is_scalar_arithmetic(instruction: &str) -> bool {
    let m = mnemonic(instruction);
    m.ends_with("ss") && !m.contains("mov") && !m.contains("broadcast")
}

fn is_call(instruction: &str) -> bool {
    let m = mnemonic(instruction);
    m.starts_with("call") || m.starts_with("jmp") && !instruction.contains(".L")
}

impl Function {
    /// Where control may go from each block.
    fn successors(&self) -> Vec<Vec<usize>> {
        let place: BTreeMap<&str, usize> =
            self.blocks.iter().enumerate().map(|(i, (label, _))| (label.as_str(), i)).collect();
        let of = |(i, (_, block)): (usize, &(String, Vec<String>))| {
            let last = block.last().map_or("", String::as_str);
            let target = last.split_whitespace().nth(1).and_then(|label| place.get(label)).copied();
            let jump = target.filter(|_| last.starts_with('j'));
            let ends = ["jmp", "ret", "ud2"].iter().any(|end| mnemonic(last).starts_with(end));
            jump.into_iter().chain((!ends && i + 1 < self.blocks.len()).then_some(i + 1)).collect()
        };
        self.blocks.iter().enumerate().map(of).collect()
    }

    /// The blocks that the loop with the most arithmetic goes through, those that it rarely goes through included: all
    /// from which control comes back.
    fn hot_loop(&self) -> Vec<&str> {
        let next = self.successors();
        let reached = |start: usize| {
            let (mut seen, mut open) = (vec![false; next.len()], next[start].clone());
            while let Some(i) = open.pop() {
                if !std::mem::replace(&mut seen[i], true) {
                    open.extend(&next[i]);
                }
            }
            seen
        };
        let reached: Vec<_> = (0..next.len()).map(reached).collect();
        let body = |i: usize| -> Vec<&str> {
            let blocks = (0..next.len()).filter(|&k| reached[i][k] && reached[k][i]);
            blocks.flat_map(|k| self.blocks[k].1.iter().map(String::as_str)).collect()
        };
        let counts = |i: &str| is_vector_arithmetic(i) || is_scalar_arithmetic(i);
        let arithmetic = |body: &Vec<&str>| body.iter().filter(|i| counts(i)).count();
        (0..next.len()).map(body).max_by_key(arithmetic).unwrap_or_default()
    }
}

/// What the loop of a kernel holds.
#[derive(Debug)]
struct Loop {
    instructions: usize,
    arithmetic: usize,
    calls: Vec<String>,
    scalar: Vec<String>,
    /// Instructions that write to the stack.
    spills: usize,
}

impl Loop {
    fn of(function: &Function) -> Self {
        let body = function.hot_loop();
        let those = |f: fn(&str) -> bool| body.iter().filter(|i| f(i)).map(|i| (*i).to_owned()).collect::<Vec<_>>();
        Self {
            instructions: body.len(),
            arithmetic: those(is_vector_arithmetic).len(),
            calls: those(is_call),
            scalar: those(is_scalar_arithmetic),
            spills: those(|i| i.ends_with("(%rsp)") && mnemonic(i).contains("mov")).len(),
        }
    }

    fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        if !self.calls.is_empty() {
            faults.push(format!("calls: {:?}", self.calls));
        }
        if !self.scalar.is_empty() {
            faults.push(format!("scalar arithmetic: {:?}", self.scalar));
        }
        if self.spills * 100 > MAX_SPILL_PERCENT * self.instructions {
            faults.push(format!("a spill storm: {} of {} instructions", self.spills, self.instructions));
        }
        faults
    }
}

/// Of a hundred instructions of a loop, how many may write to the stack. What a loop only reads from there, the parameters
/// of its lobe, costs next to nothing. The exact conductor at AVX2 has 13 of 264.
const MAX_SPILL_PERCENT: usize = 6;

/// A name without its modules: `lobe::brdf::phong::Phong` → `Phong`.
fn without_modules(name: &str) -> String {
    let mut short = String::new();
    let mut word = String::new();
    let mut rest = name.chars().peekable();
    while let Some(c) = rest.next() {
        if c.is_alphanumeric() || c == '_' {
            word.push(c);
        } else if c == ':' && !word.is_empty() && rest.next_if_eq(&':').is_some() {
            word.clear();
        } else {
            short.push_str(&word);
            word.clear();
            short.push(c);
        }
    }
    short + &word
}

/// The loop of the function that holds a kernel, of that type, for a level and at a precision.
fn find(functions: &[Function], level: &str, precision: &str, kernel: &str) -> Option<Loop> {
    let arguments = format!("<Wide<{level}>, {precision}, {kernel}, ");
    let loops = functions.iter().filter(|f| without_modules(&f.name).contains(&arguments)).map(Loop::of);
    loops.max_by_key(|found| found.arithmetic)
}

fn check(name: &str, arguments: &[&str]) {
    let functions = compile(name, arguments);
    let mut faults = Vec::new();
    for level in ["Avx2", "Avx512"] {
        for named in KERNELS {
            let precision = if named.precision == "fast" { "Fast" } else { "Precise" };
            let what = format!("{level} {} {}", named.kernel, named.precision);
            let found = find(&functions, level, precision, &format!("EvalCos<{}>", named.type_name));
            let found = found.unwrap_or_else(|| panic!("{what}: there is no such function"));
            let Loop { instructions, arithmetic, spills, scalar, .. } = &found;
            let scalar = scalar.len();
            println!(
                "{what}: {instructions} instructions, {arithmetic} arithmetic ones on lanes, {scalar} on one number, \
                 {spills} spills"
            );
            // Lambert's factor and three colours: less is not the loop.
            assert!(found.arithmetic >= 4, "{what}: {found:?}");
            faults.extend(found.faults().into_iter().map(|fault| format!("{what}: {fault}")));
        }
        // A check that cannot fail checks nothing.
        for (mutant, fault) in [("Calls", "calls"), ("Spills", "a spill storm")] {
            let found = find(&functions, level, "Precise", mutant).expect("the mutant is there");
            assert!(found.faults().iter().any(|f| f.starts_with(fault)), "{level}: {mutant} not found: {found:?}");
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));

    // The loop of the lowest level, which runs the scalar.
    let scalar = functions.iter().filter(|f| without_modules(&f.name).contains("<f32, Precise, EvalCos<Phong>, "));
    let found = scalar.map(Loop::of).max_by_key(|found| found.scalar.len()).expect("the scalar is there");
    assert!(found.faults().iter().any(|f| f.starts_with("scalar")), "{found:?}");
}

#[test]
fn loops_of_batches_hold_nothing_but_lanes() {
    check("speed", &[]);
}

#[test]
fn loops_of_batches_hold_nothing_but_lanes_at_opt_level_s() {
    check("size", &["--config", "profile.release.opt-level='s'"]);
}
