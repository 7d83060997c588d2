#!/bin/sh
# Documents point at what exists: links to files of the project, the sources that ARCHITECTURE.md names, and the pages of the book.
set -eu
cd "$(dirname "$0")/.."

fail=0
complain() {
    printf '%s\n' "$1"
    fail=1
}

for page in $(git ls-files '*.md'); do
    folder=$(dirname "$page")
    # Targets of [text](target), without places within a page and without the web.
    for target in $(grep -o '](\([^)#[:space:]]*\)' "$page" | sed 's/^](//' | grep -v '^[a-z]*://' || true); do
        [ -e "$folder/$target" ] || complain "$page: there is no $target"
    done
done

sources=$(git ls-files '*.rs')
for name in $(grep -o '`[a-z0-9_]*\.rs`' ARCHITECTURE.md | tr -d '`' | sort -u); do
    printf '%s\n' "$sources" | grep -q "/$name\$" || complain "ARCHITECTURE.md: there is no $name"
done

# The book has every page, and what it includes is there.
for page in $(git ls-files 'docs/*.md' | sed 's/^docs\///' | grep -vx 'SUMMARY.md'); do
    grep -qF "]($page)" docs/SUMMARY.md || complain "docs/SUMMARY.md: $page is missing"
done
for part in $(grep -oh '{{#include [^:}]*' docs/*.md | sed 's/.* //'); do
    [ -e "docs/$part" ] || complain "docs: there is no $part to include"
done

[ "$fail" -eq 0 ] && printf 'links, names of files and pages of the book are right\n'
exit "$fail"
