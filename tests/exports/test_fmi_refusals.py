"""What an FMU refuses: calls that a faulty master makes get the status of an error, and change and end nothing."""

import json
import subprocess
import sys

import pytest

import ballscrew as bs
from ballscrew.exports.programs import interpreter
from ballscrew.exports.programs.interpreter import program_file

pytestmark = pytest.mark.skipif(not interpreter.runs_here(), reason="the prebuilt library is for Linux on x86-64")
#: In a process of its own, as a library that reads address zero ends it: the status of each call, and times.
MASTER = """
import ctypes, json, math, sys

library, folder = ctypes.CDLL(sys.argv[1]), sys.argv[2].encode()
pointer, double, size = ctypes.c_void_p, ctypes.c_double, ctypes.c_size_t
nothing = ctypes.POINTER(pointer)()
fmi2Instantiate, fmi3Instantiate = library.fmi2Instantiate, library.fmi3InstantiateCoSimulation
fmi2Instantiate.restype = fmi3Instantiate.restype = pointer
two = pointer(fmi2Instantiate(b"screw", 1, b"", folder, None, 0, 0))
three = pointer(fmi3Instantiate(b"screw", b"", folder, *[ctypes.c_bool(False)] * 4, None, size(0), None, None, None))
assert two and three
flags, last = [ctypes.byref(ctypes.c_bool()) for _ in range(3)], double(-1.0)
found = {}


def time_of(version):
    value, place = double(), ctypes.c_uint32(int(sys.argv[3]))
    if version == 2:
        assert library.fmi2GetReal(two, ctypes.byref(place), size(1), ctypes.byref(value)) == 0
    else:
        assert library.fmi3GetFloat64(three, ctypes.byref(place), size(1), ctypes.byref(value), size(1)) == 0
    return value.value


def step(version, time, length):
    if version == 2:
        return library.fmi2DoStep(two, double(time), double(length), 1)
    return library.fmi3DoStep(three, double(time), double(length), ctypes.c_bool(True), *flags, ctypes.byref(last))


for version, one, word in ((2, two, "FMUstate"), (3, three, "FMUState")):
    call = lambda name: getattr(library, f"fmi{version}{name}")
    get, back, free = call(f"Get{word}"), call(f"Set{word}"), call(f"Free{word}")
    state = pointer()
    assert step(version, 0.0, 0.25) == 0 and time_of(version) == 0.25
    assert get(one, ctypes.byref(state)) == 0
    said = found[version] = {
        "set nothing": back(one, None), "set in nothing": back(None, state), "get into nothing": get(one, nothing),
        "get of nothing": get(None, ctypes.byref(pointer())), "free nowhere": free(one, nothing),
        "free nothing": free(one, ctypes.byref(pointer())),
        "size of nothing": call(f"Serialized{word}Size")(one, None, None),
        "bytes of nothing": call(f"Serialize{word}")(one, None, None, size(0)),
        "state of nothing": call(("DeSerialize" if version == 2 else "Deserialize") + word)(one, None, size(0), None),
        "reset nothing": call("Reset")(None), "enter nothing": call("EnterEventMode")(None),
        "time of nothing": call("SetTime")(None, double(1.0)),
        "time is no number": call("SetTime")(one, double(math.nan)),
        "no values": call("GetReal" if version == 2 else "GetFloat64")(one, None, size(1), None, size(1)),
    }
    for length in (-0.01, 0.0, math.nan, math.inf, -math.inf):
        said[f"step {length}"] = step(version, 0.25, length)
    for time in (math.nan, math.inf, -math.inf):
        said[f"step from {time}"] = step(version, time, 0.01)
    said["time"] = time_of(version)
    assert back(one, state) == 0 and free(one, ctypes.byref(state)) == 0 and not state
    said["step after"] = step(version, 0.25, 0.01)
    said["time after"] = time_of(version)
print(json.dumps(found))
"""
#: What the standard wants ignored.
IGNORED = {"free nowhere", "free nothing"}
ERROR = 3


@pytest.fixture(scope="module")
def said(handed_over, tmp_path_factory):
    handed = handed_over(bs.FrictionModel.olaru2005(), bs.SingleNut())
    folder = tmp_path_factory.mktemp("resources")
    (folder / "program.bin").write_bytes(program_file(handed))
    time = len(handed.input_names) + len(handed.output_names) + 2
    library = interpreter.prebuilt_library()._name
    command = [sys.executable, "-c", MASTER, library, str(folder), str(time)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, (ran.returncode, ran.stderr)
    return json.loads(ran.stdout)


@pytest.mark.parametrize("version", ["2", "3"])
def test_what_a_master_must_not_do_is_an_error(said, version):
    statuses = {name: status for name, status in said[version].items() if name != "time" and "after" not in name}
    assert len(statuses) == 22
    assert {name for name, status in statuses.items() if status != ERROR} == IGNORED
    assert all(statuses[name] == 0 for name in IGNORED)


@pytest.mark.parametrize("version", ["2", "3"])
def test_what_is_refused_changes_nothing(said, version):
    assert (said[version]["time"], said[version]["step after"], said[version]["time after"]) == (0.25, 0, 0.26)
