"""Kernel means, against the program's own probes and against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import vaso

SPACING = 0.1
#: A cube of 20 particles along each edge, whose middle is at the origin.
LATTICE = SPACING * (np.stack(np.meshgrid(*[np.arange(20)] * 3, indexing="ij"), axis=-1).reshape(-1, 3) - 9.5)


def test_samples_are_those_of_the_probes(pipe: vaso.Result) -> None:
    at = {"axis": 0.0, "quarter": 0.79375e-3, "half": 1.5875e-3, "three-quarters": 2.38125e-3}
    points = [[x, 0.0, 15.875e-3] for x in at.values()]
    probes, series, compared = pipe.probes, pipe.fluid, 0
    for step, time in enumerate(series.times):
        for row in np.flatnonzero(probes["time_s"] == time):
            velocity, pressure = pipe.sample("Velocity", points, step), pipe.sample("Pressure", points, step)
            for k, name in enumerate(at):
                of = probes.of(name)
                told = np.array([of["u_m_s"][row], of["v_m_s"][row], of["w_m_s"][row]])
                # Files hold 24 bits.
                assert velocity[k] == pytest.approx(told, abs=1e-6 * 0.1)
                assert pressure[k] == pytest.approx(of["pressure_pa"][row], abs=1e-5 * max(1.0, abs(of["pressure_pa"][row])))
                compared += 1
    assert compared > 12


def test_a_linear_field_is_its_own_mean_on_a_lattice() -> None:
    slope = np.array([1.0, -2.0, 0.5])
    points = SPACING * np.array([[0.5, 0.5, 0.5], [-2.5, 3.5, 0.5]])  # where particles are, by symmetry exact
    mean, total = vaso.kernel_mean(LATTICE, LATTICE @ slope, points, SPACING)
    assert mean == pytest.approx(points @ slope, abs=1e-12)
    # The sum of the kernel over the cubic lattice, as in crates/kernels/src/wendland.rs.
    assert total == pytest.approx(1.0095, abs=1e-4)


def test_there_is_no_value_where_there_is_no_blood() -> None:
    mean, total = vaso.kernel_mean(LATTICE, LATTICE, [[0.0, 0.0, 1.0], [0.0, 0.0, 1.5], [90.0, -90.0, 0.0]], SPACING)
    # On the border of the cube, half a spacing beyond its last layer.
    assert total[0] == pytest.approx(0.5, abs=0.01)
    assert np.isfinite(mean[0]).all() and np.isnan(mean[1:]).all()
    assert total[1:].tolist() == [0.0, 0.0]
    nothing, _ = vaso.kernel_mean(np.empty((0, 3)), np.empty(0), [[0.0, 0.0, 0.0]], SPACING)
    assert np.isnan(nothing).all()
    with pytest.raises(ValueError, match="expected \\(m, 3\\)"):
        vaso.kernel_mean(LATTICE, LATTICE, [0.0, 0.0, 0.0], SPACING)


def test_pairs_are_those_of_a_search_among_all() -> None:
    random = np.random.default_rng(1)
    position, points = random.random((500, 3)), random.random((100, 3)) * 1.4 - 0.2
    values = random.random((500, 3))
    mean, total = vaso.kernel_mean(position, values, points, SPACING)
    u = np.clip(1.0 - np.linalg.norm(points[:, None] - position, axis=2) / (2.6 * SPACING), 0.0, None)
    weight = 21.0 / (16.0 * np.pi * 1.3**3) * u**4 * (5.0 - 4.0 * u)
    assert total == pytest.approx(weight.sum(axis=1), abs=1e-12)
    near = total > 0
    assert near.sum() > 50
    assert mean[near] == pytest.approx((weight @ values)[near] / total[near, None], rel=1e-9)


def test_a_slice_across_a_pipe_is_a_disc_with_the_flow_through_it(pipe: vaso.Result) -> None:
    cut = pipe.slice("Velocity", origin=[0.0, 0.0, 15.875e-3], normal=[0.0, 0.0, 2.0])
    assert cut.unit == "m/s" and cut.time == pipe.summary["time_s"]
    assert cut.values.shape == (len(cut.up), len(cut.right), 3) and cut.magnitude.shape == cut.values.shape[:2]
    pixel = (cut.right[1] - cut.right[0]) * (cut.up[1] - cut.up[0])
    inside = np.isfinite(cut.magnitude)
    area = inside.sum() * pixel
    # Pixels of a third of a spacing, six spacings across.
    assert area == pytest.approx(np.pi * 3.175e-3**2, rel=0.15)
    flow = cut.values[..., 2][inside].sum() * pixel
    # By what went through the openings in the second half of the run; the kernel is wide at this spacing.
    assert flow == pytest.approx(pipe.summary["openings"][0]["mean_flow_m3_s"], rel=0.15)
    # Along the pipe, its axis upwards.
    along = pipe.slice("Pressure", origin=[0.0, 0.0, 0.0], normal=[0.0, 1.0, 0.0], up=[0.0, 0.0, 1.0], pixel=1e-3)
    assert along.values.shape == (len(along.up), len(along.right)) and along.up[-1] == pytest.approx(32e-3, abs=1e-9)
    assert np.cross(along.axes[0], along.axes[1]) == pytest.approx([0.0, 1.0, 0.0])


def test_planes_that_make_no_sense_are_refused(pipe: vaso.Result) -> None:
    with pytest.raises(ValueError, match="the normal has a length"):
        pipe.slice("Velocity", [0, 0, 0], [0, 0, 0])
    with pytest.raises(ValueError, match="no blood is near the plane"):
        pipe.slice("Velocity", [0, 0, 1.0])
    with pytest.raises(ValueError, match="along the normal"):
        pipe.slice("Velocity", [0, 0, 0.01], [0, 0, 1], up=[0, 0, 3])
    with pytest.raises(ValueError, match="pixel"):
        pipe.slice("Velocity", [0, 0, 0.01], pixel=0.0)
