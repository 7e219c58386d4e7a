"""What a notebook shows of results, cases, bands and sweeps."""

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from support.pictures import drawn, size
from support.synthetic_logs import log, truth

MODEL = bs.FrictionModel.olaru2005()
SPEEDS = np.linspace(1.0, 100.0, 7)


@pytest.fixture(scope="module")
def result():
    return MODEL(SCREW, OIL, axial_load=2000.0, screw_speed=60.0)


@pytest.fixture(scope="module")
def results():
    return MODEL(SCREW, OIL, axial_load=2000.0, screw_speed=SPEEDS)


@pytest.fixture(scope="module")
def swept():
    outputs = ["screw_torque", "efficiency", "valid"]
    return bs.sweep(MODEL, SCREW, OIL, axial_load=[0.0, 500.0, 2000.0], screw_speed=SPEEDS, outputs=outputs)


def test_a_point_is_shown_with_its_parts(result):
    shown = result._repr_html_()
    assert f"<td>friction torque on the screw</td><td>{result.screw_torque:.4g} N m</td>" in shown
    share = 100 * result.contributions["elastic_hysteresis"] / result.screw_torque
    assert f"<td>elastic hysteresis</td><td>{result.contributions['elastic_hysteresis']:.4g} N m</td>" in shown
    assert f"<td>{share:.1f} %</td>" in shown


def test_many_points_are_shown_with_their_ends(results):
    shown = results._repr_html_()
    low, high = results.screw_torque.min(), results.screw_torque.max()
    assert f"<td>{low:.4g} N m to {high:.4g} N m</td>" in shown
    assert f"<td>{int(results.valid.sum())} of 7</td>" in shown


def test_a_case_is_shown_with_its_design(example):
    shown = case_file.load(example)._repr_html_()
    assert "model olaru2005" in shown
    assert "lead 5 mm" in shown


def test_a_band_is_shown_with_its_intervals():
    uncertain = {"axial_load": bs.Normal(2000.0, 100.0)}
    band = bs.band(MODEL, SCREW, OIL, distributions=uncertain, axial_load=2000.0, screw_speed=60.0, samples=64)
    of = band["screw_torque"]
    assert f"<td>{of.both.low:.4g} N m to {of.both.high:.4g} N m</td>" in band._repr_html_()


def test_a_fit_is_its_estimates():
    fit = bs.fit(MODEL, SCREW, OIL, log(truth(), rows=60), ["boundary_friction_coefficient", "constant_torque"])
    for name, estimate in fit.estimates.items():
        assert f"\n{name}: {estimate.value:.6g}" in repr(fit)
        assert f"<td>{name}</td>" in fit._repr_html_()
    assert len(repr(fit).splitlines()) <= 10
    assert len(repr(fit)) < 1000


@pytest.mark.parametrize("method", ["sobol", "morris", "local"])
def test_a_sensitivity_is_its_inputs_the_largest_first(method):
    uncertain = {name: bs.Normal(value, 0.05 * value) for name, value in {"axial_load": 2e3, "lead": 5e-3}.items()}
    many = {f"{part}_roughness": bs.Normal(2e-7, 1e-9) for part in ("ball", "screw", "nut")}
    many |= {name: bs.Normal(0.54, 1e-4) for name in ("screw_conformity", "nut_conformity")}
    many |= {
        "viscosity": bs.Normal(0.1, 1e-3),
        "contact_angle": bs.Normal(0.78, 1e-3),
        "friction.decay": bs.Normal(1.4, 0.01),
    }
    found = bs.sensitivity(
        MODEL,
        SCREW,
        OIL,
        distributions=uncertain | many,
        method=method,
        samples=16 if method != "local" else None,
        screw_speed=60.0,
    )
    heading, first, *_, last = repr(found).splitlines()
    assert heading.startswith(f"Sensitivity of screw_torque, {method}: mean ")
    assert first.startswith(f"{found.inputs[0]}: ")
    assert last == "… and 2 more"
    assert len(repr(found).splitlines()) == 10
    shown = found._repr_html_()
    assert all(f"<td>{name}</td>" in shown for name in found.inputs)


def test_pictures_are_shown_and_saved(result, results, swept, tmp_path):
    # _repr_png_ is the name by which a notebook asks
    width, height = size(result.plot()._repr_png_())
    assert width > height
    parts = drawn(results.plot().save(tmp_path / "parts.svg"))
    assert "(N m)" in parts.text
    assert parts.panels[0].areas == sum(np.any(part) for part in results.contributions.values())
    assert "efficiency" in drawn(swept.ballscrew.plot_map("efficiency").save(tmp_path / "map.svg")).text
    assert size(swept.isel(axial_load=1).ballscrew.plot_map()._repr_png_())[0] > 500


def test_areas_are_the_parts_along_the_speed_in_its_unit(results):
    (panel,) = results.plot().figure.axes
    assert panel.get_xlim() == pytest.approx((SPEEDS[0] * 30 / np.pi, SPEEDS[-1] * 30 / np.pi))
    (total,) = panel.get_lines()
    assert total.get_ydata() == pytest.approx(results.screw_torque)
    top = max(area.get_paths()[0].vertices[:, 1].max() for area in panel.collections)
    assert top == pytest.approx(results.screw_torque.max())


def test_what_has_no_picture_says_what_has(results, swept, tmp_path):
    both = MODEL(SCREW, OIL, axial_load=np.array([1.0, 2.0]), screw_speed=np.array([1.0, 2.0]))
    with pytest.raises(bs.InputError, match="needs one load or one speed that varies"):
        both.plot()
    with pytest.raises(
        bs.InputError, match=r'plot_map\.output: is no output of this sweep .*did you mean "efficiency"'
    ):
        swept.ballscrew.plot_map("eficiency")
    with pytest.raises(bs.InputError, match="needs one or two axes"):
        swept.expand_dims(lead=[0.01]).ballscrew.plot_map()
    with pytest.raises(bs.InputError, match="unknown kind of file"):
        results.plot().save(tmp_path / "parts.docx")


def test_logs_are_read_as_the_command_reads_them(tmp_path):
    steady = tmp_path / "steady.csv"
    steady.write_text("axial load [kN],speed [rpm],friction torque [N mm]\n1,60,120\n2,60,150\n2,120,160\n")
    found = bs.read_log(steady)
    assert isinstance(found, bs.TorqueLog)
    assert found.axial_load == pytest.approx([1000.0, 2000.0, 2000.0])
    assert found.torque == pytest.approx([0.12, 0.15, 0.16])
    moving = tmp_path / "moving.csv"
    rows = [f"{0.01 * k},{np.sin(0.02 * k)},{k % 7}" for k in range(300)]
    moving.write_text("\n".join(["time [s],position [mm],motor torque [N m]", *rows, ""]))
    assert isinstance(bs.read_log(moving, lead=0.01), bs.MovingLog)
    with pytest.raises(bs.InputError, match=r"read_log\.lead: is needed"):
        bs.read_log(moving)


def test_axes_of_a_map_are_in_the_units_that_people_read():
    oil = bs.Lubricant.from_grade("ISO VG 100")
    swept = bs.sweep(
        bs.FrictionModel.corrected(), SCREW, oil, axial_load=2000.0, screw_speed=SPEEDS, temperature=[280.0, 300.0]
    )
    panel = swept.transpose("screw_speed", "temperature").ballscrew.plot_map().figure.axes[0]
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("oil temperature (degC)", "speed of the screw (rpm)")
    assert panel.get_xlim() == pytest.approx((280.0 - 273.15, 300.0 - 273.15))
    assert panel.get_ylim() == pytest.approx((30 / np.pi * SPEEDS[0], 30 / np.pi * SPEEDS[-1]))
    rough = bs.sweep(
        bs.FrictionModel.corrected(), SCREW, OIL, axial_load=[1e3, 2e3], screw_speed=9.0, lead=[5e-3, 1e-2]
    )
    panel = rough.ballscrew.plot_map().figure.axes[0]
    assert {panel.get_xlabel().rpartition(" ")[2], panel.get_ylabel().rpartition(" ")[2]} == {"(mm)", "(N)"}
