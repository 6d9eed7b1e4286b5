# Jobs of a developer, for https://just.systems; `just` lists them. Each also works without it: see CONTRIBUTING.md.

# list the jobs
default:
    @just --list --unsorted

# formatting and lints
check:
    .ci/run formatting lints

# all tests, or those whose name contains a word: just test belts::
test *words:
    cargo test --workspace {{words}}

# the crates' documentation and the book (needs mdbook), with all links checked
docs:
    .ci/run documentation

# the book while you write it
serve:
    mdbook serve docs --open

# times and instruction counts
bench:
    cargo bench --package occupant-bench
    .ci/run counts

# everything that must hold before a change lands
ci:
    .ci/run

# before a release: everything, then what moved against the command of the last release
release last-release:
    .ci/run
    cargo build --release --locked --package occupant-cli
    python3 tests/same_outputs.py {{last-release}} target/release/occupant
    python3 docs/gallery.py target/release/occupant
    git status --short docs/gallery
