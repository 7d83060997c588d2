# Short names for plain cargo commands; `just` lists them. Nothing needs just: copy the command instead.

[private]
default:
    @just --list

# Run a case and write its report into its folder `out`.
demo case="cases/carotid":
    cargo run --release -- run {{case}} --force

# All tests, with the build that users run.
test:
    cargo test --release --workspace

# The same with checks of overflow and debug assertions; twice as long.
test-debug:
    cargo test --workspace

# What a change must pass before it lands, besides the tests.
check:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings
    RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps
    cargo test --release -p vaso-tests --test tidy

# The report of a case in a headless browser, as a reader uses it; pictures in target/report.
report-test report="cases/carotid/out/report.html":
    sh .ci/report.sh {{report}}

# Flows against formulas and published numbers, with the figures printed.
validate:
    cargo test --release -p vaso-tests --lib -- flows::validation flows::carotid --nocapture

# The same at the finest spacings; a quarter of an hour on two cores, the carotid with VASO_DATA set.
validate-long:
    cargo test --release -p vaso-tests --lib -- flows::validation flows::carotid flows::shear_thinning --ignored --nocapture

# Solids alone over long times: beams, columns, energy; half an hour on two cores, the columns with VASO_DATA set.
validate-solids:
    cargo test --release -p vaso-solid --tests -- --ignored --nocapture

# Shells alone: roofs, cylinders, hemispheres, energy over long times, relaxed tubes; five minutes on two cores.
validate-shells:
    cargo test --release -p vaso-shell --tests -- --include-ignored --nocapture
    cargo test --release -p vaso-tests --lib -- flows::shells --include-ignored --nocapture

# Blood in elastic tubes, with the figures printed; a quarter of an hour on two cores.
validate-walls:
    cargo test --release -p vaso-tests --lib -- flows::elastic_tube flows::fibers flows::moving_wall flows::openings flows::shell_walls --include-ignored --nocapture

# Micro-benchmarks.
bench:
    cargo bench -p vaso-benches

# The page of the speed, measured anew; five minutes on two quiet cores.
ladder:
    cargo bench -p vaso-benches --bench ladder -- --write

# The page of what each effect costs, measured anew; two minutes.
effects:
    cargo bench -p vaso-benches --bench effects -- --write

# The page of what runs were said to take and take, measured anew; five minutes on two quiet cores.
prediction:
    cargo bench -p vaso-benches --bench prediction -- --write

# The page of the validation with the cases named run anew (`all` for all, about an hour on two cores); wants VASO_DATA.
validation *cases:
    cargo run --release -p vaso-tests --example validation -- {{cases}}

# The page of the hard cases, with those named run anew (`all` for all, five minutes on two cores).
stability *cases:
    cargo run --release -p vaso-tests --example stability -- {{cases}}

# What accuracy costs in time, with the studies named run anew (`all` for all, a quarter of an hour on two cores).
accuracy *studies:
    cargo run --release -p vaso-tests --example accuracy -- {{studies}}

# The page of the generators with its pictures; some minutes on two cores.
generators:
    cargo run --release -p vaso-tests --example generators

# The reference and the JSON Schema of case.toml made from its schema, and the documentation of the crates.
docs:
    cargo run -p vaso-scene --example case_reference > docs/case-reference.md
    cargo run -- schema > docs/case.schema.json
    cargo doc --workspace --no-deps

# The messages of the wrong cases in tests/bad and the plans of the shipped ones in tests/plans, written anew: read the difference
# before it is committed.
bless:
    VASO_BLESS=1 cargo test --release -p vaso-driver --test bad --test cases

# A target of the fuzzer (stl, vtp, case, prepare) for some seconds; needs cargo-fuzz and a C++ compiler.
fuzz target="vtp" seconds="60":
    mkdir -p fuzz/target/corpus/{{target}}
    cargo fuzz run --sanitizer none {{target}} fuzz/target/corpus/{{target}} fuzz/corpus/{{target}} -- -max_len=8192 -timeout=5 -max_total_time={{seconds}}

# The cases named (all without names) run anew, and the tables and pictures of their READMEs made from that; half an hour on two cores, two of them want VASO_DATA.
cases-figures *cases:
    cargo build --release
    sh .ci/figures.sh {{cases}}

# The pages of docs as a book in target/book, with every link followed.
book:
    sh .ci/book.sh

# The Python package: installed, its types checked, its tests and its example run with target/release/vaso.
python-test:
    cargo build --release
    sh .ci/package.sh

# Licences, advisories and sources of the dependencies; needs cargo-deny.
deny:
    cargo deny check

# All that is checked for every change, as it is checked there.
ci:
    bash .ci/run

# Tests that are ignored for their length and belong to no other recipe: resuming every effect after kills, and generators turned and moved; minutes.
test-long:
    cargo test --release -p vaso-driver --test resume -- --ignored --nocapture
    cargo test --release -p vaso-generation --test invariance -- --ignored
