//! The command `lobe`.

fn main() {}
