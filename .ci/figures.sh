#!/bin/sh
# Runs the cases named, all without names, with the program of target/release or of VASO_BIN, and makes tables and pictures of their READMEs from that.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/.ci/venv.sh"

venv_needs "numpy==2.4.6 h5py==3.16.0 scipy==1.17.1 matplotlib==3.11.2"
cd "$root/cases"
[ $# -gt 0 ] || set -- aneurysm aorta carotid common-carotid curved-tube elastic-stenosis elastic-tube fda-nozzle pipe stenosis womersley
PYTHONPATH=$root/python/src "$venv/bin/python" -m unittest -q figures.test_formulas
for case in "$@"; do
    "${VASO_BIN:-$root/target/release/vaso}" run "$case" --force
done
PYTHONPATH=$root/python/src "$venv/bin/python" -m figures "$@"
