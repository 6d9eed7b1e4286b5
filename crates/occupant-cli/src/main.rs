//! The command `occupant`.

use std::process::ExitCode;

fn main() -> ExitCode {
    occupant_cli::main()
}
