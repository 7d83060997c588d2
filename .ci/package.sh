#!/bin/sh
# The Python package: installs it as a user would, checks its types, and runs its tests, the example among them, with the program of
# target/release or of VASO_BIN.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/.ci/venv.sh"

venv_needs "$vtk h5py==3.16.0 matplotlib==3.11.2 scipy==1.17.1 pytest==9.2.0 mypy==2.4.1"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --force-reinstall --no-deps "$root/python"
cd "$root/python"
VASO_BIN=${VASO_BIN:-$root/target/release/vaso}
export VASO_BIN
"$venv/bin/python" -m mypy src
"$venv/bin/python" -m pytest
# The formulas behind the figures of the cases.
cd "$root/cases"
"$venv/bin/python" -m unittest -q figures.test_formulas
