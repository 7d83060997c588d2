#!/usr/bin/env bash
# The targets of the fuzzer: always on the committed corpus and on mutations of it, and where there is a C++ compiler, for
# some seconds each with the fuzzer itself. FUZZ_SECONDS: seconds per target (8).
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${FUZZ_SECONDS:-8}

# The profile is that of the project's tests, so their target folder has the dependencies already; the fuzzer itself runs
# with checks of overflow.
CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target} \
    cargo test --release --manifest-path fuzz/Cargo.toml --no-default-features --locked

if ! command -v c++ >/dev/null; then
    printf 'skipped: libFuzzer needs a C++ compiler; only the corpus and its mutations were run\n'
    exit 0
fi

# As cargo-fuzz builds without a sanitizer, which saves installing it. Flags are for the named target only, so that build
# scripts and macros are left alone.
coverage='-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 -Cllvm-args=-sanitizer-coverage-inline-8bit-counters
    -Cllvm-args=-sanitizer-coverage-pc-table -Cllvm-args=-sanitizer-coverage-trace-compares'
host=$(rustc -vV | sed -n 's/^host: //p')
CARGO_TARGET_DIR=fuzz/target CARGO_PROFILE_DEV_DEBUG=0 RUSTFLAGS=$(printf '%s ' --cfg fuzzing $coverage) \
    cargo build --manifest-path fuzz/Cargo.toml --locked --bins --target "$host"

for target in stl vtp case prepare; do
    # What is found new goes to a folder of its own, not to the corpus.
    found=fuzz/target/corpus/$target
    mkdir -p "$found" "fuzz/artifacts/$target"
    flags=(-max_total_time="$seconds" -max_len=8192 -timeout=5 -rss_limit_mb=1024 -malloc_limit_mb=256)
    if [ -f "fuzz/$target.dict" ]; then flags+=(-dict="fuzz/$target.dict"); fi
    printf 'fuzzing %s for %s s\n' "$target" "$seconds"
    timeout $((seconds + 60)) "fuzz/target/$host/debug/$target" "$found" "fuzz/corpus/$target" "${flags[@]}" \
        -verbosity=0 -print_final_stats=1 -artifact_prefix="fuzz/artifacts/$target/" 2>&1 | grep -v '# Uses:'
done
