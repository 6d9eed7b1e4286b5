//! The example of the front page runs, and is as short as it is said to be.

#[path = "../examples/magnet.rs"]
#[allow(dead_code, reason = "its `main` is called")]
mod magnet;

#[test]
fn the_magnet_is_forty_lines_and_runs() {
    assert!(include_str!("../examples/magnet.rs").lines().count() <= 40);
    magnet::main().unwrap();
}
