"""``--to fmu``: a Functional Mock-up Unit for co-simulation and model exchange, without Python and without a compiler.

The FMU has the recorded model as data and the prebuilt interpreter of the package; its sources are in it. Variables are
those of every export; ``friction_torque`` has the sign of the motion. What differs is rest: friction goes through
zero over the speed of regularisation, so that a solver gets a continuous torque.
"""

from __future__ import annotations

import dataclasses
import hashlib
import io
import uuid
import zipfile
from collections.abc import Mapping
from typing import NamedTuple
from xml.etree import ElementTree as xml

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import (
    Export,
    Option,
    Target,
    Values,
    WorstError,
    data,
    readme,
    refusal,
    warning,
    worst_errors,
)
from ballscrew.exports.programs import interpreter
from ballscrew.exports.programs.interpreter import program_file
from ballscrew.exports.subject import TEMPERATURE, HandOver

#: The speed over which friction goes through zero, rad/s, as in ``data/exports/fmi_model.c``.
REGULARISATION_SPEED = 0.01
#: From so many times that speed on the tanh is 1 to the last digit.
_MOVING = 20.0
#: The name of the model in an FMU, of its library and of its file.
IDENTIFIER = "ballscrew"
_SOURCES = (*interpreter.SOURCES, "fmi_model.c")
_HEADERS = (*interpreter.HEADERS, "fmi_model.h")
#: The exponents of the base units, as FMI writes units.
_BASE_UNITS: Mapping[str, Mapping[str, int]] = {
    "N": {"kg": 1, "m": 1, "s": -2},
    "N m": {"kg": 1, "m": 2, "s": -2},
    "rad/s": {"rad": 1, "s": -1},
    "K": {"K": 1},
    "W": {"kg": 1, "m": 2, "s": -3},
    "m": {"m": 1},
    "Pa": {"kg": 1, "m": -1, "s": -2},
    "Pa s": {"kg": 1, "m": -1, "s": -1},
    "1/Pa": {"kg": -1, "m": 1, "s": 2},
    "N/m": {"kg": 1, "s": -2},
    "m/s": {"m": 1, "s": -1},
    "rad": {"rad": 1},
    "kg/m^3": {"kg": 1, "m": -3},
    "s": {"s": 1},
}
#: The output that has the friction with its sign.
_DRIVE = "drive_torque"
_FRICTION_TORQUE = "friction torque with its sign, which is that of the speed; continuous through rest"
_REGULARISATION = (
    "speed over which friction goes through zero, as tanh; 0 takes the sign of the speed. "
    "Warning: continuous friction holds nothing, a load at rest creeps; holding_torque tells what holds"
)


class Variable(NamedTuple):
    """A variable of an FMU; its value reference is its place among them."""

    name: str
    causality: str
    variability: str
    unit: str
    description: str
    start: float | None = None
    least: float | None = None
    greatest: float | None = None


def export(job: HandOver) -> Export:
    """The model as an FMU of version 2.0 or 3.0.

    Raises :class:`~ballscrew.basis.errors.InputError` for another version, and for derivatives.
    """
    version = job.options["version"]
    if version not in (2, 3):
        raise refusal("version", "must be 2 or 3", str(version), "2 is read by most tools")
    if job.derivatives:
        raise refusal("derivatives", "an FMU has none here", "", "leave them out, or take the source (--to c)")
    program = program_file(job)
    listed = variables(job)
    token = uuid.UUID(hashlib.sha256(program + repr(listed).encode()).hexdigest()[:32])
    text = readme(job, f"FMU {version}.0", _NOTES)
    page = f"<!DOCTYPE html>\n<title>ballscrew</title>\n<pre>\n{_escaped(text)}</pre>\n"
    documentation = {"README.txt": text} if version == 2 else {"index.html": page}
    sources = (*_SOURCES, *_HEADERS, f"fmi{version}.c")
    content = {
        "modelDescription.xml": _document(_description(job, listed, f"{{{token}}}", version)),
        **_libraries(version),
        "resources/program.bin": program,
        **{f"sources/{name}": data(name) for name in sources},
        **{f"documentation/{name}": written.encode() for name, written in documentation.items()},
    }
    if version == 3:
        content["sources/buildDescription.xml"] = _document(_build_description())
    slow, moving = (
        units.in_unit(speed, "rad/s", 6) for speed in (REGULARISATION_SPEED, _MOVING * REGULARISATION_SPEED)
    )
    rest = (
        f"friction passes through zero over {slow} (parameter regularisation_speed), so that below {moving} "
        "drive_torque lacks a part of it, next to rest all, and a load at rest creeps: where holding matters, "
        "brake where holding_torque says so"
    )
    warnings = [warning("rest", "regularisation_speed", rest)]
    return Export.of(job, "fmu", {f"{IDENTIFIER}.fmu": _archive(content)}, errors_of_fmu(job), warnings=warnings)


FMU = Target(export, {"version": Option(2, "version of the standard, 2 or 3")})


def errors_of_fmu(job: HandOver) -> tuple[WorstError, ...]:
    """The worst error of the FMU; empty where no prebuilt library runs on this machine.

    ``drive_torque`` has the friction that goes through zero, and once more its error in motion, from twenty times the
    speed of regularisation on.
    """
    if not interpreter.runs_here():
        return ()
    points, outputs = interpreter.program_at_points(job)
    exact = job.evaluate(points)
    continuous = {**outputs, _DRIVE: with_regularisation(points[OPERATION[1]], outputs)}
    errors = worst_errors(job, lambda _: continuous, points=points, exact=exact)
    moving = np.abs(points[OPERATION[1]]) >= _MOVING * REGULARISATION_SPEED
    if not np.any(moving):
        return errors
    there, at, true = ({n: v[moving] for n, v in values.items()} for values in (continuous, points, exact))
    (in_motion,) = worst_errors(job, lambda _: there, points=at, exact=true, outputs=[_DRIVE])
    return *errors, dataclasses.replace(in_motion, output=f"{_DRIVE}_in_motion")


def with_regularisation(speed: NDArray[np.float64], outputs: Values) -> NDArray[np.float64]:
    """The drive torque that the FMU makes of the outputs of the program, at the usual speed of regularisation."""
    return outputs["ideal_torque"] + np.tanh(speed / REGULARISATION_SPEED) * outputs["screw_torque"]


_NOTES = """\
screw_torque is the size of the friction. friction_torque is tanh(screw_speed / regularisation_speed) times it, and
drive_torque is ideal_torque + friction_torque: from twenty times the regularisation speed on those of the model to the
last digit. Below, both lack the share 1 - tanh(|screw_speed| / regularisation_speed) of the friction: 0.01 % at five
times the regularisation speed, 0.5 % at three times, 4 % at twice, 24 % at it, and next to rest all.
regularisation_speed = 0 takes the sign of the speed.

The library for Linux on x86-64 was run. Those for Windows, macOS and Linux on ARM were cross-compiled and never run:
where one does not load, compile all files of the folder sources, with the C library and libm. It needs no Python, and
one thread for each instance.
"""


def _libraries(version: int) -> dict[str, bytes]:
    """The prebuilt libraries at their places in an FMU of a version of the standard."""
    return {
        f"binaries/{platforms[version - 2]}/{path.rpartition('/')[2]}": data(path)
        for path, platforms in interpreter.LIBRARIES.items()
        if platforms[version - 2]
    }


def variables(job: HandOver) -> tuple[Variable, ...]:
    """The variables in the order of their value references: inputs, regularisation speed, outputs, friction torque."""
    limits, listed = job.formula_range, list[Variable]()
    for entry in job.inputs:
        is_input = entry.name in (*OPERATION, TEMPERATURE)
        kind = ("input", "continuous") if is_input else ("parameter", "tunable")
        ends = [end if np.isfinite(end) else None for end in limits[entry.name]]
        listed.append(Variable(entry.name, *kind, entry.quantity.unit, job.meanings[entry.name], entry.value, *ends))
    listed.append(
        Variable("regularisation_speed", "parameter", "tunable", "rad/s", _REGULARISATION, REGULARISATION_SPEED, 0.0)
    )
    for name in job.output_names:
        listed.append(Variable(name, "output", "continuous", job.units[name], job.meanings[name]))
    listed.append(Variable("friction_torque", "output", "continuous", "N m", _FRICTION_TORQUE))
    return tuple(listed)


def _description(job: HandOver, listed: tuple[Variable, ...], token: str, version: int) -> xml.Element:
    """The description of version 2.0 or 3.0: what differs is the token's name, sources, types, and how variables are
    referred to.
    """
    is_2 = version == 2
    heading = {
        "fmiVersion": f"{version}.0",
        "guid" if is_2 else "instantiationToken": token,
        "modelName": IDENTIFIER,
        "description": f"Friction of a ball screw, model {job.subject.model.label}",
        "generationTool": f"ballscrew {job.provenance['version']}",
        "variableNamingConvention": "flat",
        **({"numberOfEventIndicators": "0"} if is_2 else {}),
    }
    root = xml.Element("fmiModelDescription", heading)
    for kind in ("ModelExchange", "CoSimulation"):
        flags = {"modelIdentifier": IDENTIFIER, f"canGetAndSetFMU{'state' if is_2 else 'State'}": "true"}
        flags |= {"canHandleVariableCommunicationStepSize": "true"} if kind == "CoSimulation" else {}
        interface = xml.SubElement(root, kind, flags)
        if is_2:
            _files(xml.SubElement(interface, "SourceFiles"), "File", "fmi2.c")
    _units(root, listed)
    xml.SubElement(root, "DefaultExperiment", {"startTime": "0", "stopTime": "1", "stepSize": "0.001"})
    parent = xml.SubElement(root, "ModelVariables")
    if not is_2:
        time = {"name": "time", "valueReference": str(len(listed)), "causality": "independent"}
        xml.SubElement(parent, "Float64", {**time, "variability": "continuous"})
    for reference, variable in enumerate(listed):
        attributes = {
            "name": variable.name,
            "valueReference": str(reference),
            "description": variable.description,
            "causality": variable.causality,
            "variability": variable.variability,
        }
        if is_2:
            xml.SubElement(xml.SubElement(parent, "ScalarVariable", attributes), "Real", _of_type(variable))
        else:
            xml.SubElement(parent, "Float64", attributes | _of_type(variable))
    structure = xml.SubElement(root, "ModelStructure")
    outputs = [reference for reference, variable in enumerate(listed) if variable.causality == "output"]
    for kind in ("Output", "InitialUnknown"):
        unknowns = xml.SubElement(structure, f"{kind}s") if is_2 else structure
        for reference in outputs:
            if is_2:
                xml.SubElement(unknowns, "Unknown", {"index": str(reference + 1)})
            else:
                xml.SubElement(unknowns, kind, {"valueReference": str(reference)})
    return root


def _files(parent: xml.Element, tag: str, main: str) -> None:
    """The sources that make the library."""
    for name in (main, *_SOURCES):
        xml.SubElement(parent, tag, {"name": name})


def _build_description() -> xml.Element:
    """The sources that make the library, for version 3.0."""
    root = xml.Element("fmiBuildDescription", {"fmiVersion": "3.0"})
    configuration = xml.SubElement(root, "BuildConfiguration", {"modelIdentifier": IDENTIFIER})
    files = xml.SubElement(configuration, "SourceFileSet", {"language": "C99"})
    _files(files, "SourceFile", "fmi3.c")
    return root


def _units(root: xml.Element, listed: tuple[Variable, ...]) -> None:
    definitions = xml.SubElement(root, "UnitDefinitions")
    for unit in dict.fromkeys(variable.unit for variable in listed if variable.unit in _BASE_UNITS):
        exponents = {name: str(power) for name, power in _BASE_UNITS[unit].items()}
        xml.SubElement(xml.SubElement(definitions, "Unit", {"name": unit}), "BaseUnit", exponents)


def _of_type(variable: Variable) -> dict[str, str]:
    unit = {"unit": variable.unit} if variable.unit in _BASE_UNITS else {}
    numbers = {"min": variable.least, "max": variable.greatest, "start": variable.start}
    return unit | {name: repr(float(value)) for name, value in numbers.items() if value is not None}


def _document(root: xml.Element) -> bytes:
    xml.indent(root)
    return xml.tostring(root, encoding="UTF-8", xml_declaration=True)


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;")


def _archive(content: Mapping[str, bytes]) -> bytes:
    """Files as a ZIP archive, the same bytes each time."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, held in content.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(entry, held)
    return stream.getvalue()
