//! Whether the curves of crash tests are there: tests that need them are told as ignored where they are not, not as passed.

use std::path::PathBuf;

fn main() {
    println!("cargo:rustc-check-cfg=cfg(crash_tests)");
    println!("cargo:rerun-if-env-changed=OCCUPANT_CRASH_TESTS");
    let beside = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared/reference/tests");
    let folder = std::env::var_os("OCCUPANT_CRASH_TESTS").map_or_else(beside, PathBuf::from);
    // a folder that comes later counts too
    println!("cargo:rerun-if-changed={}", folder.display());
    if folder.is_dir() {
        println!("cargo:rustc-cfg=crash_tests");
        println!("cargo:rustc-env=CRASH_TESTS={}", folder.display());
    }
}
