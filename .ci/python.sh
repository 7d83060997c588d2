#!/bin/sh
# Makes the Python environment in which the tests open our files with VTK, the library behind ParaView, and validate cases
# against their JSON Schema.
# Running it again changes nothing once the pinned versions are there.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
venv="$root/.venv"
pins="vtk==9.7.2 numpy==2.4.6 jsonschema==4.26.0"

if [ ! -x "$venv/bin/python" ]; then
    python3 -m venv "$venv"
fi
if ! "$venv/bin/python" - $pins <<'PYTHON'
import sys
from importlib.metadata import PackageNotFoundError, version

def present(pin):
    name, wanted = pin.split("==")
    try:
        return version(name) == wanted
    except PackageNotFoundError:
        return False

sys.exit(0 if all(map(present, sys.argv[1:])) else 1)
PYTHON
then
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check $pins
fi
"$venv/bin/python" -c "import vtk, numpy, jsonschema; print('vtk', vtk.VTK_VERSION, 'numpy', numpy.__version__)"
