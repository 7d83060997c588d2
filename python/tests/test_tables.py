"""Tables and the summary, and pictures of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import vaso


def test_columns_have_names_units_and_the_digits_of_the_file(pipe: vaso.Result) -> None:
    table = pipe.openings
    assert list(table)[0] == "time_s" and set(table.units) == set(table)
    assert table.units["inlet.flow_m3_s"] == "m^3/s" and table.units["inlet.pressure_pa"] == "Pa" and table.units["time_s"] == "s"
    by_numpy = np.genfromtxt(table.path, delimiter=",", skip_header=1)
    np.testing.assert_array_equal(np.stack(list(table.values()), axis=1), by_numpy)
    structured = table.array()
    np.testing.assert_array_equal(structured["outlet.flow_m3_s"], table["outlet.flow_m3_s"])
    # In at one end is out of the other, once sound has settled; the sign is that of the way out.
    late = table["time_s"] > 0.15
    assert table["inlet.flow_m3_s"][late].mean() < 0 < table["outlet.flow_m3_s"][late].mean()
    assert list(pipe.probes.of("axis")) == ["pressure_pa", "u_m_s", "v_m_s", "w_m_s"]
    with pytest.raises(KeyError, match="nothing of `outlat`; it has inlet, outlet"):
        table.of("outlat")
    with pytest.raises(KeyError, match="no column `time`; it has time_s"):
        table["time"]


def test_a_line_that_a_kill_has_torn_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "openings.csv"
    path.write_text('time_s,"a, b.flow_m3_s",status\n0.1,,fine\n0.2,-1e-7,fine\n0.3,4')
    table = vaso.Table(path)
    np.testing.assert_array_equal(table["a, b.flow_m3_s"], [np.nan, -1e-7])
    assert table.texts == {"status": ["fine", "fine"]}
    path.write_text("time_s,a\n0.1\n")
    with pytest.raises(vaso.OutputError, match="row 2 has 1 cells for 2 columns"):
        vaso.Table(path)
    path.write_text("")
    with pytest.raises(vaso.OutputError, match="the header is missing"):
        vaso.Table(path)


def test_the_summary_is_told_and_what_is_no_output_refused(pipe: vaso.Result, tmp_path: Path) -> None:
    summary = pipe.summary
    assert summary["status"] == "completed" and summary["time_s"] == pytest.approx(0.2)
    assert pipe.spacing == 1e-3 and pipe.report.is_file()
    assert summary["particles"]["fluid"] == pipe.fluid.counts[-1]
    with pytest.raises(vaso.OutputError, match="no such folder"):
        vaso.Result(tmp_path / "nowhere")
    empty = vaso.Result(tmp_path)
    with pytest.raises(vaso.OutputError, match="is this the output folder of a run"):
        empty.summary
    with pytest.raises(vaso.OutputError, match="the case has no"):
        empty.probes
    with pytest.raises(vaso.OutputError, match="output.fields"):
        empty.wall


def test_pictures_show_the_numbers(pipe: vaso.Result) -> None:
    figure = vaso.plot_openings(pipe)
    flow, pressure = figure.axes
    lines = {line.get_label(): line.get_ydata() for line in flow.get_lines()}
    np.testing.assert_allclose(lines["inlet"], pipe.openings["inlet.flow_m3_s"] * 1e6)
    assert pressure.get_lines()[1].get_ydata() == pytest.approx(pipe.openings["inlet.pressure_pa"] / 133.322387415)
    cut = pipe.slice("Pressure", [0, 0, 0.01], pixel=1e-3)
    image = vaso.plot_slice(cut).axes[0].get_images()[0]
    np.testing.assert_array_equal(np.ma.filled(image.get_array(), np.nan), cut.values)
    # The middle of the first pixel is at its place in mm.
    assert image.get_extent()[0] == pytest.approx(1e3 * cut.right[0] - 0.5)
