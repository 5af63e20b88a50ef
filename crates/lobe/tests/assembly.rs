//! A look at the machine code: no kernel holds a call or a way to panic, and a lobe that is absent costs nothing.
//!
//! One missing `#[inline(always)]` has cost a factor of seven before; no test of values would notice.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Compiles `checks/kernels` optimised, with many codegen units and without LTO, as a user's build has it.
fn compile(name: &str, arguments: &[&str]) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    // Beside this test's own build: never inside it, where cargo holds a lock.
    let target: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    // From scratch: one file for each codegen unit, and none from an earlier build.
    let _ = std::fs::remove_dir_all(&target);
    let output = Command::new(env!("CARGO"))
        .current_dir(&root)
        .args(["rustc", "--quiet", "--package", "lobe-kernels", "--lib", "--target-dir"])
        .arg(&target)
        .args(arguments)
        .args(["--", "--emit", "asm", "-C", "debuginfo=0", "-C", "codegen-units=16"])
        .env_remove("RUSTFLAGS")
        // None at all: neither the user's nor those of the workspace, which change the names that are looked for below.
        .env("CARGO_ENCODED_RUSTFLAGS", "")
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let files = walk(&target).into_iter().filter(|p| p.extension().is_some_and(|e| e == "s"));
    files.map(|p| std::fs::read_to_string(p).expect("readable")).collect()
}

fn walk(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    entries.flat_map(|p| if p.is_dir() { walk(&p) } else { vec![p] }).collect()
}

/// The functions of an assembly file: name, instructions. An alias (`a = b`) has those of its target.
fn functions(assembly: &str) -> BTreeMap<String, Vec<String>> {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut aliases = Vec::new();
    let mut current: Option<String> = None;
    for line in assembly.lines() {
        if let Some((alias, target)) = line.split_once(" = ") {
            if line.starts_with("_ZN") {
                aliases.push((plain_name(alias), plain_name(target)));
            }
        } else if let Some(label) = line.strip_suffix(':').filter(|l| l.starts_with("_ZN")) {
            current = Some(plain_name(label));
        } else if line.starts_with(".Lfunc_end") {
            current = None;
        } else if let Some(name) = &current {
            let instruction = line.trim();
            if line.starts_with('\t') && !instruction.starts_with('.') {
                found.entry(name.clone()).or_default().push(instruction.to_owned());
            }
        }
    }
    for (alias, target) in aliases {
        if let Some(body) = found.get(&target).cloned() {
            found.insert(alias, body);
        }
    }
    found
}

/// `_ZN12lobe_kernels5phong4eval17h0123456789abcdefE` → `phong::eval`.
fn plain_name(mangled: &str) -> String {
    let mut rest = mangled.trim_start_matches("_ZN");
    let mut parts = Vec::new();
    while let Some(digits) = rest.find(|c: char| !c.is_ascii_digit()).filter(|&n| n > 0) {
        let length: usize = rest[..digits].parse().unwrap_or(0);
        let (part, after) = rest[digits..].split_at(length.min(rest.len() - digits));
        parts.push(part);
        rest = after;
    }
    parts.retain(|p| *p != "lobe_kernels" && !p.starts_with("17h") && !(p.len() == 17 && p.starts_with('h')));
    parts.join("::")
}

const EXPECTED: [&str; 15] = [
    "lambert::eval",
    "lambert::eval_cos",
    "phong::eval",
    "blinn_phong::eval",
    "blinn_phong_common::eval_cos",
    "phong_highlight::eval_cos",
    "blinn_torrance_highlight::eval",
    "lambert_and_blinn_phong::eval",
    "microfacet_ggx::eval",
    "microfacet_metallic_roughness::eval_cos",
    "microfacet_coat::eval",
    "core_functions::pow",
    "core_functions::halfway",
    "core_functions::from_normal_tangent",
    "core_functions::lecture_blinn_torrance",
];

/// The functions that take a square root: without `std`, at `opt-level = "s"`, they call `libm::sqrtf`. No lobe does
/// but those of microfacets, which need the length of `l + v`.
const WITH_ROOT: [&str; 6] =
    ["microfacet", "normalize", "halfway", "from_normal_tangent", "interpolate_normal", "point_light"];

fn check(assembly: &str, root_may_be_a_call: bool) -> BTreeMap<String, Vec<String>> {
    let functions = functions(assembly);
    for name in EXPECTED {
        assert!(functions.get(name).is_some_and(|body| body.len() > 5), "{name} not found in {:?}", functions.keys());
    }
    for (name, body) in &functions {
        if root_may_be_a_call && WITH_ROOT.iter().any(|root| name.contains(root)) {
            continue;
        }
        let calls: Vec<_> =
            body.iter().filter(|i| i.starts_with("call") || i.starts_with("jmp\t_") || i.starts_with("bl\t")).collect();
        assert!(calls.is_empty(), "{name} is not all in one piece: {calls:?}");
    }
    functions
}

#[test]
fn kernels_hold_no_call_and_absent_lobes_cost_nothing() {
    let functions = check(&compile("speed", &["--release"]), false);
    for (with, without) in [("lambert_and_black", "lambert"), ("blinn_phong_and_black", "blinn_phong")] {
        for method in ["eval", "eval_cos"] {
            let [with, without] = [with, without].map(|lobe| functions[&format!("{lobe}::{method}")].len());
            assert_eq!(with, without, "{method}: a lobe that is not there costs instructions");
        }
    }
    // The horizon is asked once for a sum, not once for each lobe.
    let [sum, one] = ["lambert_and_blinn_phong::eval", "blinn_phong::eval"].map(|name| functions[name].len());
    assert!(sum < one + 20, "{sum} instructions for the sum, {one} for its larger part");
}

#[test]
fn lobes_hold_no_call_at_opt_level_s() {
    let assembly = compile("size", &["--release", "--config", "profile.release.opt-level='s'"]);
    check(&assembly, true);
}
