//! The command `occupant`.

fn main() {}
