"""A process that has loaded libraries and the physics; its forks run the commands of pages and make generated parts.

A fork loads questions, faces, exports and evidence by itself.
"""

import contextlib
import importlib
import sys
from pathlib import Path

LIBRARIES = (
    "emcee", "h5py", "httpx", "llvmlite.binding", "matplotlib.backends.backend_agg", "matplotlib.backends.backend_svg",
    "numpy", "pandas", "pint", "pydantic", "rich.markdown", "rich.table", "scipy.integrate", "scipy.interpolate",
    "scipy.linalg", "scipy.optimize", "scipy.special", "scipy.stats", "tomlkit", "typer", "typer.rich_utils",
    "xarray", "xlsxwriter", "zarr",
)  # fmt: skip


CASE = Path(__file__).parents[2] / "src" / "ballscrew" / "data" / "starts" / "feed_axis.toml"


def load() -> None:
    """Load libraries, units, oils and the schema of cases, and compute one case."""
    for name in LIBRARIES:
        with contextlib.suppress(ImportError):  # an extra that is not installed
            importlib.import_module(name)
    from ballscrew.cases.case_files import case_file
    from ballscrew.engine.evaluation import evaluation  # noqa: F401  (is loaded)

    case = case_file.load(CASE)
    case.model(case.screw, case.lubricant, axial_load=1e3, screw_speed=10.0)


if __name__ == "__main__":
    from support import fork_server

    load()
    fork_server.serve(sys.argv[1])
