#!/bin/sh
# Builds the book of docs/ into target/book, and follows every link in it, places within pages included.
# MDBOOK: an mdbook 0.5 to take instead of the wheel, which is there for Linux on x86-64 alone.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/.ci/venv.sh"

venv_needs ""
if [ -z "${MDBOOK:-}" ]; then
    MDBOOK="$venv/bin/mdbook"
    if [ "$("$MDBOOK" --version 2>/dev/null)" != "mdbook v0.5.4" ]; then
        "$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --require-hashes -r "$root/.ci/mdbook.txt"
    fi
fi

rm -rf "$root/target/book"
mkdir -p "$root/target"
log="$root/target/book.log"
"$MDBOOK" build "$root/docs" 2>"$log" || { cat "$log"; exit 1; }
# What it cannot include or understand it only warns of.
if grep -E 'WARN|ERROR' "$log"; then exit 1; fi
"$venv/bin/python" "$root/tests/python/check_book.py" "$root/target/book"
