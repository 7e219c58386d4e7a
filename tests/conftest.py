"""What all tests share: the paper's screw, its oil, the models, and how hypothesis runs."""

import ctypes
import functools
import gc
import importlib.util
import math
import os
import subprocess
import sys
from pathlib import Path

# One thread of BLAS a worker, set before NumPy is loaded: with a worker on each processor, more would compete.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Tests start many processes. Without bytecode each of them compiles the package anew, and each worker the tests.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

import pytest
import typer.testing
from hypothesis import settings

import ballscrew as bs
from support.commands import new_process
from support.quick_kernels import SHIPPED, UNOPTIMISED, set_code_optimisation
from support.shared_commands import SharedCommands, hold

ROOT = Path(__file__).parents[1]

# A runner of commands makes all of them for each that it runs: once is enough.
typer.testing._get_command = functools.cache(typer.main.get_command)

# The same examples every time, so that a red test is the fault of a change. To search for new ones:
# pytest --hypothesis-profile=search tests/properties
settings.register_profile("ci", deadline=None, derandomize=True, max_examples=100)
settings.register_profile("search", deadline=None, derandomize=False, max_examples=2000)
settings.register_profile("long", deadline=None, derandomize=True, max_examples=500)
settings.load_profile("ci")

MODELS = {
    "olaru2005": bs.FrictionModel.olaru2005,
    "olaru2005-literal": lambda: bs.FrictionModel.olaru2005(literal_film_parameter=True),
    "corrected": bs.FrictionModel.corrected,
    "reference": bs.FrictionModel.reference,
}


#: Folders of tests with random parts, many of which no ball screw has.
RANDOM = (ROOT / "tests" / "oracles", ROOT / "tests" / "properties")


#: Growth of the resident memory, MB, after which a worker gives back what the tests of modules have left.
GROWTH = 200
#: Resident memory when it was last given back, MB.
_kept = [0.0]


@pytest.fixture(scope="module", autouse=True)
def memory_given_back():
    """What modules leave is given back to the system: compiled functions of JAX, and pages that the C library keeps.

    Without it each worker grows to the sum of what all its modules need at their most.
    """
    yield
    if _resident_memory() > _kept[0] + GROWTH:
        if "jax" in sys.modules:
            sys.modules["jax"].clear_caches()
        gc.collect()
        trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # of glibc alone
        if trim is not None:
            trim(0)
        _kept[0] = _resident_memory()


def _resident_memory() -> float:
    """Memory of this process, MB; zero where the system has no /proc."""
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    except OSError:
        return 0.0
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


@pytest.fixture(scope="session", autouse=True)
def kernel_cache(tmp_path_factory):
    """One folder of compiled kernels for all tests of a run, on all workers: never the user's own."""
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent  # that of this worker lies in that of the run
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("BALLSCREW_CACHE", str(folder / "kernels"))
        yield


@pytest.fixture(scope="session", autouse=True)
def quick_kernels():
    """Kernels without optimisation of their code, in a fifth of the time; ``as_shipped`` has that of the package.

    No bit of a result depends on it: ``tests/engine/evaluation/test_evaluation.py`` looks.
    """
    with pytest.MonkeyPatch.context() as patch:
        set_code_optimisation(patch, UNOPTIMISED)
        yield


@pytest.fixture
def as_shipped(quick_kernels):
    """Kernels as users have them."""
    with pytest.MonkeyPatch.context() as patch:
        set_code_optimisation(patch, SHIPPED)
        yield


@pytest.fixture(scope="session")
def commands(kernel_cache):
    """Runs commands of the program in processes that have their libraries at once."""
    return SharedCommands()


@pytest.fixture
def example() -> Path:
    return ROOT / "examples" / "olaru2005.toml"


@pytest.fixture
def ballscrew(commands, tmp_path):
    """Run the command line in a process of its own, in an empty folder."""

    def command(*arguments: object, environment: dict[str, str] | None = None) -> subprocess.CompletedProcess[str]:
        if any(name.startswith("PYTHON") for name in environment or {}):  # the interpreter reads it when it starts
            return new_process(arguments, folder=tmp_path, environment=environment)
        return commands.run(arguments, folder=tmp_path, environment=environment)

    return command


@pytest.fixture(scope="session")
def seed_screw() -> bs.BallScrew:
    """The paper's screw, of steel with an equivalent modulus of 2.26e11 Pa."""
    steel = bs.Material(young_modulus=2.26e11 * (1 - 0.3**2), poisson_ratio=0.3)
    return bs.BallScrew(
        pitch_circle_diameter=0.040,
        lead=0.005,
        ball_diameter=3.175e-3,
        loaded_balls=56,
        contact_angle=math.pi / 4,
        screw_conformity=0.515,
        nut_conformity=0.515,
        ball_roughness=0.08e-6,
        screw_roughness=0.3e-6,
        nut_roughness=0.3e-6,
        ball_material=steel,
        screw_material=steel,
        nut_material=steel,
    )


@pytest.fixture(scope="session")
def seed_oil() -> bs.Lubricant:
    """The oil of the reference cases."""
    return bs.Lubricant(viscosity=0.1, pressure_viscosity_coefficient=2.2e-8)


@pytest.fixture(params=["olaru2005", "corrected", "reference"])
def model(request: pytest.FixtureRequest) -> bs.FrictionModel:
    """Each of the three models in turn."""
    return MODELS[request.param]()


def pytest_configure(config):
    if "PYTEST_XDIST_WORKER" not in os.environ:
        hold(config)


@pytest.hookimpl(wrapper=True, optionalhook=True)  # only with pytest-xdist
def pytest_xdist_auto_num_workers():
    """One worker more than processors: tests that wait for a browser or a process leave their own to others."""
    return (yield) + (0 if "PYTEST_XDIST_AUTO_NUM_WORKERS" in os.environ else 1)


def pytest_collection_finish():
    """What is loaded by now lives to the end: without it, the garbage collector has a tenth of the work.

    To look for garbage after every 700 objects takes a fifth of the time in which a model is recorded, and finds none.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 10, 10)
    _kept[0] = _resident_memory()


def pytest_collection_modifyitems(items):
    """Warnings of parts that no ball screw has are errors, but in tests that mean them.

    Without the compiler, the tests that need it say so; those that measure speed have kernels as users have them.
    """
    for item in items:
        if item.get_closest_marker("long"):
            item.fixturenames = [*item.fixturenames, "as_shipped"]  # the list is that of all parameters
        if item.get_closest_marker("implausible") or item.path.parent in RANDOM:
            # parts that are meant to be odd, or drawn at random
            item.add_marker(pytest.mark.filterwarnings("ignore::ballscrew.ImplausibleInput"))
    if importlib.util.find_spec("llvmlite") is None:
        for item in items:
            if "compiles" in item.keywords:
                item.add_marker(pytest.mark.skip(reason="llvmlite is not installed (the extra fast)"))
