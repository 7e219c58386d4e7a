"""Logs sent to the server: it answers what the command line prints, says what it took for what, and keeps nothing."""

import base64
import tempfile
import tomllib

import pytest

from ballscrew.faces.web.request_queue import RequestQueue
from support.commands import ROOT
from support.documents import assert_same

from .conftest import asking
from .test_equal_to_commands import document, written

pytestmark = pytest.mark.slow

EXAMPLES = ROOT / "examples"


@pytest.fixture(scope="module")
def client():
    with asking(requests=RequestQueue(time_limit=600)) as found:
        yield found


@pytest.fixture
def post(client):
    def one(address, body, status=200):
        found = client.post(f"/api/v1/{address}", json=body)
        assert found.status_code == status, found.text[:1000]
        return found.json()

    return one


@pytest.fixture
def folders(tmp_path, monkeypatch):
    """A folder for the files of commands, and the one in which the server may write for a while."""
    there = tmp_path / "temporary"
    there.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(there))
    yield tmp_path, there
    assert not list(there.iterdir())  # nothing of a request stays


def tables_of(name):
    return tomllib.loads((EXAMPLES / name).read_text(encoding="utf-8"))


def every(name, step, of=1):
    """Some rows of an example, as a file."""
    head, titles, *rows = (EXAMPLES / name).read_text(encoding="utf-8").splitlines()
    return "\n".join([head, titles, *(row for place, row in enumerate(rows) if place % step < of)]) + "\n"


def sent(name, text):
    return {"name": name, "text": text}


def on_disk(folder, name, text):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_fit(post, folders, tmp_path):
    """As the command; and the case with the calibration is the file that it writes."""
    folder, _ = folders
    text, to = every("rig_log.csv", 20, 3), folder / "fitted.toml"
    case = {**tables_of("rig.toml"), "model": {"name": "corrected"}}
    path = on_disk(folder, "rig log.csv", text)
    options = ["--free", "boundary_friction_coefficient,constant_torque", "--bounds", "constant_torque=0:1 N m"]
    to_file = ["--to", to, "--keep-going"]  # the numbers of this model are implausible
    expected = document("fit", path, "--case", written(case, tmp_path), *options, "--json", *to_file)
    body = {"case": case, "free": ["boundary_friction_coefficient", "constant_torque"],
            "bounds": {"constant_torque": "0:1 N m"}}  # fmt: skip
    found = post("fit", {**body, "log": sent("C:\\logs/rig log.csv", text)})
    extra = {name: found.pop(name) for name in ("sheet", "calibrated")}
    assert_same(found, expected)
    assert extra["sheet"]["title"].startswith("rig log.csv, model corrected")
    assert tomllib.loads(extra["calibrated"]["toml"]) == extra["calibrated"]["case"] == tomllib.loads(to.read_text())
    one = found["estimates"]["boundary_friction_coefficient"]
    assert one["low"] < one["value"] < one["high"]


def test_columns(post, folders):
    """Each is shown with what it is taken for; what is missing is named, and given by hand it is used."""
    text = "Messung 7\nM_x;v_ist;zeit;Bemerkung\n1,2;3;4;gut\n1,3;3;5;gut\n"
    body = {"case": tables_of("rig.toml"), "log": sent("x.csv", text)}
    found = post("log", body)
    assert [(one["heading"], one["taken_for"]) for one in found["columns"]] == [
        ("M_x", ""),
        ("v_ist", "feed_rate"),
        ("zeit", "time"),
        ("Bemerkung", ""),
    ]
    assert found["columns"][0]["cells"] == ["1,2", "1,3"]
    # without a load it is a log of no load
    assert found["missing"] == ["torque"]
    assert any(one["problem"] == "needs a unit" for one in found["faults"])
    assert found["free"][0]["name"] == "friction.boundary_friction_coefficient"
    by_hand = {"torque": "M_x [N m]", "screw_speed": "v_ist [rpm]", "axial_load": "5 kN", "time": "zeit [s]"}
    found = post("log", {**body, "columns": by_hand})
    assert (found["faults"], found["missing"], found["constants"]) == ([], [], {"axial_load": 5000.0})
    assert [one["taken_for"] for one in found["columns"]] == ["torque", "screw_speed", "time", ""]
    coded = {"name": "x.csv", "base64": base64.b64encode(text.encode("utf-16")).decode()}
    assert post("log", {**body, "columns": by_hand, "log": coded})["columns"] == found["columns"]
    moving = {**body, "log": sent("axis.csv", every("axis_log.csv", 1))}
    assert post("log", moving)["moving"] is True
    assert "is of a moving axis" in post("fit", moving, 422)["lines"][0]


def test_a_workbook(post, folders):
    """Read as the command reads it."""
    pytest.importorskip("python_calamine", reason='needs python-calamine, of the extra "data", to read a spreadsheet')
    openpyxl = pytest.importorskip("openpyxl", reason="needs openpyxl to write the spreadsheet that is sent")
    path = folders[0] / "log.xlsx"
    book = openpyxl.Workbook()
    for line in ("speed [rpm],axial load [N],torque [N m]", "50,1000,0.84", "100,1000,0.85"):
        book.active.append([float(cell) if cell[0].isdigit() else cell for cell in line.split(",")])
    book.save(path)
    file = {"name": "log.xlsx", "base64": base64.b64encode(path.read_bytes()).decode()}
    found = post("log", {"case": tables_of("rig.toml"), "log": file})
    assert [one["taken_for"] for one in found["columns"]] == ["screw_speed", "axial_load", "torque"]


def test_service(post, folders, tmp_path):
    folder, _ = folders
    texts = {name: every(f"nut_{name}.csv", 6) for name in ("new", "worn")}
    case = {**tables_of("service.toml"), "model": {"name": "olaru2005"}}
    paths = [on_disk(folder, f"{name}.csv", text) for name, text in texts.items()]
    expected = document("service", *paths, "--case", written(case, tmp_path), "--json", "--tolerance", "0.2")
    files = {name: sent(f"{name}.csv", text) for name, text in texts.items()}
    found = post("service", {"case": case, "tolerance": 0.2, **files})
    assert found.pop("sheet")["title"].startswith("new.csv, worn.csv")
    assert_same(found, expected)
    assert found["results"]["verdict"] == "lost"


@pytest.mark.parametrize(("target", "name"), [("c", "c.zip"), ("linuxcnc", "ballscrew.hal")])
def test_hand_over(post, folders, tmp_path, target, name):
    """The files are those that the command writes."""
    import io
    import zipfile

    out = folders[0] / "out"
    body = {"case": tables_of("olaru2005.toml"), "to": target, "ranges": {"axial_load": "-4:4 kN"}}
    case = written(body["case"], tmp_path)
    expected = document("hand-over", case, "--to", target, "--range", "axial_load=-4:4 kN", "-o", out, "--json")
    found = post("hand-over", body)
    file, words = (found.pop(name) for name in ("file", "words"))
    files = found["results"].pop("files")
    assert expected["results"].pop("files") == [str(out / one) for one in files]
    assert_same(found, expected)
    content = base64.b64decode(file["base64"])
    assert file["name"] == name
    if name.endswith(".zip"):
        archive = zipfile.ZipFile(io.BytesIO(content))
        assert {one: archive.read(one) for one in archive.namelist()} == {
            one: (out / one).read_bytes() for one in files
        }
    else:
        assert content == (out / files[0]).read_bytes()
    assert words["lines"][0].startswith("range")
    lines = [line.strip() for line in words["lines"] if not line.startswith("warning: ")]
    assert lines == words["ranges"]


def test_targets(client, post):
    """All that the command knows, with their choices; what a target lacks is said, and no target is refused at 500."""
    from ballscrew.exports.export import TARGETS

    found = client.get("/api/v1/targets").json()["targets"]
    assert [one["name"] for one in found] == [*TARGETS]
    case = tables_of("olaru2005.toml")
    refused = post("hand-over", {"case": case, "to": "table", "options": {"kinds": "doc"}}, 422)
    assert "--option kinds" in refused["lines"][0] or "kinds" in refused["lines"][0]
    assert "unknown target" in post("hand-over", {"case": case, "to": "excel"}, 422)["lines"][0]


@pytest.mark.parametrize(
    ("file", "words"),
    [
        ({"name": "x.csv"}, "needs one content"),
        ({"name": "x.csv", "text": "a", "base64": "YQ=="}, "needs one content"),
        ({"name": "x.csv", "base64": "no base64!"}, "is not base64"),
        ({"name": "x.csv", "text": ""}, "x.csv: is empty"),
        ({"name": "../../../etc/passwd", "text": "root"}, "passwd: has no heading that is known"),
        ({"name": "", "text": "a"}, "log.csv: has no heading"),
    ],
)
def test_faults_name_the_file_and_no_folder(post, folders, file, words):
    body = {"case": tables_of("rig.toml"), "log": file}
    for address in ("fit", "log"):
        if address == "log" and "heading" in words:
            continue  # there it is shown, and no fault of the request
        (line,) = post(address, body, 422)["lines"]
        assert words in line
        assert str(folders[1]) not in line
        assert "ballscrew-" not in line
