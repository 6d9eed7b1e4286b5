//! What will be simulated and whether the step suits it: the core of `occupant check`.
