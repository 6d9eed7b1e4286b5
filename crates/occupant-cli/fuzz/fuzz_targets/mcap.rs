//! Raw bytes as a result file, for every command that reads one.
#![no_main]

use std::path::Path;
use std::sync::Once;

use commands::{folder, give, write};
use libfuzzer_sys::fuzz_target;
use occupant_cli::mcap::StoredRun;
use occupant_cli::results::Results;

static BEGIN: Once = Once::new();

fuzz_target!(|bytes: &[u8]| {
    BEGIN.call_once(|| {
        folder();
    });
    if !StoredRun::read(bytes).is_ok_and(|run| !run.checkpoints.is_empty()) {
        return;
    }
    write("run.mcap", bytes);
    if Results::open(Path::new("run.mcap")).is_err() {
        return;
    }
    give(&[
        "measures run.mcap --filter sae-j211",
        "print run.mcap",
        "export run.mcap -o run.csv -f --interval 0.3ms",
        "plot run.mcap -o run.svg -f",
        "view run.mcap -o view.svg -f",
        "report run.mcap -o run.html -f",
        "compare run.mcap run.mcap",
        "risk run.mcap",
        "convert run.mcap --extend 0.1",
        "run case.toml --resume run.mcap --until 0.003 -o resumed.mcap -f -q",
    ]);
});
