//! Bytes as a study, opened by every command that reads one, up to the first run.
#![no_main]

use std::sync::Once;

use commands::{folder, give, write};
use libfuzzer_sys::fuzz_target;

const TEST: &[u8] = b"t[s],head.acceleration.x[g],belt.lap.force[N]\n0,0,0\n0.001,-1,20\n0.002,-2,30\n0.003,-2,30\n";

static BEGIN: Once = Once::new();

fuzz_target!(|bytes: &[u8]| {
    BEGIN.call_once(|| {
        folder();
        write("test.csv", TEST);
        // no folder can be made here: what was read is never run
        write("file", b"");
    });
    let name = if bytes.starts_with(b"{") { "study.json" } else { "study.toml" };
    write(name, bytes);
    give(&[
        &format!("sweep {name} -o file/out"),
        &format!("fit {name} --test test.csv -o file/out"),
        &format!("fit {name} -o file/out"),
    ]);
});
