#!/bin/sh
# Opens reports in a headless browser and does what a reader does: tests/python/check_report.py.
# Usage: sh .ci/report.sh REPORT.html ...   Pictures of what was seen are left in target/report.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/.ci/venv.sh"

# The browser comes from the system: a version of Playwright's own would have to be fetched from elsewhere.
has_browser() {
    command -v chromium >/dev/null || command -v chromium-browser >/dev/null || command -v google-chrome >/dev/null
}
if ! has_browser; then
    if ! command -v apt-get >/dev/null; then
        printf 'install Chromium to test the report\n'
        exit 1
    fi
    export DEBIAN_FRONTEND=noninteractive
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends chromium fonts-dejavu-core >/dev/null
fi

venv_needs "playwright==1.65.2 pillow==13.0.0"
"$venv/bin/python" "$root/tests/python/check_report.py" --shots "$root/target/report" "$@"
