//! The command `lobe`.

use std::process::ExitCode;

fn main() -> ExitCode {
    lobe_cli::main()
}
