#!/usr/bin/env bash
# The targets of the fuzzer: always on the committed corpus and on mutations of it, and where cargo-fuzz is or can be
# installed, for some seconds each with the fuzzer itself. FUZZ_SECONDS: seconds per target (12).
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${FUZZ_SECONDS:-12}
targets='stl vtp case prepare'

# The profile is that of the project's tests, so their target folder has the dependencies already.
CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target} \
    cargo test --manifest-path fuzz/Cargo.toml --no-default-features --locked

tools=$PWD/target/tools
PATH=$tools/bin:$PATH
if ! cargo fuzz --version >/dev/null 2>&1; then
    if ! timeout 180 cargo install cargo-fuzz --version 0.13.2 --locked --quiet --root "$tools"; then
        printf 'skipped: cargo-fuzz is not there and cannot be installed; only the corpus and its mutations were run\n'
        exit 0
    fi
fi
if ! command -v c++ >/dev/null; then
    printf 'skipped: libFuzzer needs a C++ compiler; only the corpus and its mutations were run\n'
    exit 0
fi

# Without a sanitizer, which would need nightly: the code has no memory to misuse, panics and hangs show all the same.
unset CARGO_TARGET_DIR
cargo fuzz build --sanitizer none
for target in $targets; do
    # What is found new goes to a folder of its own, not to the corpus.
    found=fuzz/target/corpus/$target
    mkdir -p "$found"
    dictionary=fuzz/$target.dict
    flags=(-max_total_time="$seconds" -max_len=8192 -timeout=5 -rss_limit_mb=1024 -malloc_limit_mb=256)
    if [ -f "$dictionary" ]; then flags+=(-dict="$dictionary"); fi
    timeout $((seconds + 60)) cargo fuzz run --sanitizer none "$target" "$found" "fuzz/corpus/$target" -- \
        "${flags[@]}" -print_final_stats=1 2>&1 | grep -v -e 'NEW ' -e 'REDUCE ' -e 'RELOAD ' -e '^INFO' -e pulse
done
