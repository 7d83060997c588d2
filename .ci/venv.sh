# Sourced: the Python environment that checks share, `.venv` of the project.
#
#     . "$root/.ci/venv.sh"
#     venv_needs "$vtk jsonschema==4.26.0"      # afterwards $venv/bin/python has them
#
# Asks no registry once the pinned versions are there. Expects the root of the project in $root.

venv="$root/.venv"
# What several checks need, in one version.
vtk="vtk==9.7.2 numpy==2.4.6"

venv_needs() {
    [ -x "$venv/bin/python" ] || python3 -m venv "$venv"
    # The list is one word a pin, on purpose.
    # shellcheck disable=SC2086
    "$venv/bin/python" - $1 <<'PYTHON' || "$venv/bin/python" -m pip install --quiet --disable-pip-version-check $1
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
}
