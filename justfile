# Short names for plain cargo commands; `just` lists them. Nothing needs just: copy the command instead.

[private]
default:
    @just --list

# Run a case and write its report.
demo case="cases/pipe":
    cargo run --release -- run {{case}}

# All tests with release optimisation and the debug assertions of the dev profile.
test:
    cargo test --workspace

# What a change must pass before it lands.
check:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings
    RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps
    cargo test -p vaso-tests --test tidy

# Licences, advisories and sources of the dependencies; needs cargo-deny.
deny:
    cargo deny check

# Micro-benchmarks.
bench:
    cargo bench -p vaso-benches

# The documentation of the crates, and the reference of case.toml made from its schema.
docs:
    cargo run -p vaso-scene --example case_reference > docs/case-reference.md
    cargo doc --workspace --no-deps
