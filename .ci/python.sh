#!/bin/sh
# Makes the Python environment in which the tests open our files with VTK, the library behind ParaView, and validate cases
# against their JSON Schema.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/.ci/venv.sh"

venv_needs "$vtk jsonschema==4.26.0"
"$venv/bin/python" -c "import vtk, numpy, jsonschema; print('vtk', vtk.VTK_VERSION, 'numpy', numpy.__version__)"
