"""Formulas and marks, without a run: `python -m unittest figures.test_formulas`, in the folder `cases`."""

from __future__ import annotations

import tempfile
import tomllib
import unittest
from pathlib import Path

import numpy as np

from . import dean, elastic_tube, pulsatile, readme, stenosis
from .__main__ import CASES
from .case import harmonic, quantity, smooth, within

ROOT = Path(__file__).parent.parent


class Formulas(unittest.TestCase):
    def test_dean_agrees_with_the_series_of_dean(self) -> None:
        # Dean (1928): flow over that of a straight tube at the same gradient is 1 - 0.0306 (K / 576)^2, with K twice the square of the
        # Dean number of that tube. At a number of 5 the next term is less than a thousandth of this one.
        k = 2.0 * 5.0**2
        self.assertAlmostEqual(1.0 / dean.Flow(5.0).friction, 1.0 - 0.0306 * (k / 576.0) ** 2, delta=3e-6)

    def test_dean_does_not_depend_on_the_points(self) -> None:
        coarse = dean.Flow(70.0)
        n, m = dean.N, dean.M
        try:
            dean.N, dean.M = 31, 36
            self.assertAlmostEqual(coarse.friction, dean.Flow(70.0).friction, places=5)
        finally:
            dean.N, dean.M = n, m

    def test_friction_of_a_bend_agrees_with_ito_and_white(self) -> None:
        friction = dean.Flow(70.0).friction
        self.assertAlmostEqual(friction / dean.ito(70.0), 1.0, delta=0.02)
        self.assertAlmostEqual(friction / dean.white(70.0), 1.0, delta=0.02)

    def test_womersley_is_that_of_the_expected_values(self) -> None:
        # expect.toml has what mpmath gave.
        expected = tomllib.loads((ROOT / "womersley/expect.toml").read_text(encoding="utf-8"))["expect"]
        omega, radius = 2.0 * np.pi / 0.8, 5e-3
        alpha = pulsatile.womersley_number(radius, omega, 1060.0, 3.5e-3)
        scale = 30.0 / 30e-3 / (1060.0 * omega)
        flow = scale * abs(pulsatile.mean_velocity(alpha)) * np.pi * radius**2
        self.assertAlmostEqual(flow / quantity(expected[0]["value"]), 1.0, places=5)
        for r, row in zip([0.0, 0.5, 0.75], expected[1:]):
            self.assertAlmostEqual(scale * abs(pulsatile.velocity(alpha, r)) / quantity(row["value"]), 1.0, places=5)

    def test_an_elastic_tube_is_that_of_the_expected_values(self) -> None:
        case, expected = (tomllib.loads((ROOT / f"elastic-tube/{name}.toml").read_text(encoding="utf-8")) for name in ("case", "expect"))
        exact = elastic_tube.tube(case)
        for row in expected["expect"]:
            value = exact.velocity(elastic_tube.PROBES[row["probe"]])
            self.assertAlmostEqual(float(value) / quantity(row["value"]), 1.0, places=5)

    def test_a_stiff_elastic_tube_is_that_of_lame_and_fung(self) -> None:
        stiff = elastic_tube.Tube(young=60e6, thickness=0.3e-3, viscosity=0.15, flow=1.5e-6, outlet=900.0)
        a, b = elastic_tube.RADIUS, elastic_tube.RADIUS + 0.3e-3
        # Lame, plane strain, a wall that keeps its volume: u = 3 p a b^2 / (2 E (b^2 - a^2)); 1 % more for the ends.
        widening = 1.5 * 900.0 / 60e6 * a * b**2 / (b**2 - a**2)
        self.assertAlmostEqual((stiff.lumen(900.0) - a) / widening, 1.011, places=2)
        # Fung (1997), where the radius is a line in the pressure: a(0)^5 - a(L)^5 = 40 mu k Q L / pi, k = da/dp.
        ends = [stiff.lumen(p) for p in stiff.pressure(np.array([0.0, elastic_tube.LENGTH]))]
        expected = 40.0 * 0.15 * 1.011 * widening / 900.0 * 1.5e-6 * elastic_tube.LENGTH / np.pi
        self.assertAlmostEqual((ends[0] ** 5 - ends[1] ** 5) / expected, 1.0, places=2)

    def test_slow_pulses_shear_the_wall_as_poiseuille_says(self) -> None:
        t = np.linspace(0.0, 1e4, 50)
        waves = np.array([2.0, 1.0 + 0.5j]) * 1e-6
        slow = pulsatile.shear_of_flow(waves, t, 1e4, 1e-3, 1000.0, 4e-3)
        poiseuille = 4.0 * 4e-3 * pulsatile.series(waves, t, 1e4) / (np.pi * 1e-9)
        np.testing.assert_allclose(slow, poiseuille, atol=1e-3 * np.abs(poiseuille).max())

    def test_a_windkessel_obeys_its_equation(self) -> None:
        # (R_p + R_d) q + R_p R_d C q' = p + R_d C p'
        t = np.linspace(0.0, 1.0, 4001)
        waves = np.array([3.0, 2.0 - 1.0j, 0.5j])
        q, p = pulsatile.series(waves, t, 1.0), pulsatile.windkessel(waves, t, 1.0, 0.2, 1.5, 0.4)
        left = 1.7 * q + 0.2 * 1.5 * 0.4 * np.gradient(q, t)
        np.testing.assert_allclose(left[5:-5], (p + 1.5 * 0.4 * np.gradient(p, t))[5:-5], atol=1e-3)

    def test_friction_of_a_straight_tube_is_poiseuilles(self) -> None:
        fall = 8.0 * 3.5e-3 * 1e-6 / (np.pi * stenosis.RADIUS**4) * 5e-3
        self.assertAlmostEqual(stenosis.friction(1e-6, 3.5e-3, 10e-3, 15e-3) / fall, 1.0, places=9)

    def test_means_in_time(self) -> None:
        t = np.sort(np.random.default_rng(1).uniform(0.0, 2.0, 4000))
        wave = 1.0 + 3.0 * np.cos(np.pi * t - 0.7)
        c = harmonic(t, wave, (0.0, 2.0))
        self.assertAlmostEqual(abs(c), 3.0, delta=1e-2)
        self.assertAlmostEqual(np.angle(c), -0.7, delta=1e-2)
        cut, values = within(np.array([0.0, 1.0, 2.0]), np.array([0.0, 1.0, 2.0]), (0.5, 1.5))
        self.assertEqual([list(cut), list(values)], [[0.5, 1.0, 1.5], [0.5, 1.0, 1.5]])
        # The integral goes in straight lines between samples, which at either end is off by slope gap^2 / 8 at most.
        bound = 2.0 * 2.0 * np.diff(t).max() ** 2 / 8.0 / 0.1
        np.testing.assert_allclose(smooth(t, 2.0 * t, 0.1)[500:-500], 2.0 * t[500:-500], atol=bound)


class Marks(unittest.TestCase):
    def test_every_case_has_marks_and_a_row(self) -> None:
        table = (ROOT / "README.md").read_text(encoding="utf-8")
        for name in CASES:
            text = (ROOT / name / "README.md").read_text(encoding="utf-8")
            for block in ("result", "time"):
                self.assertEqual(text.count(f"<!-- figures: begin {block} -->"), 1, name)
            self.assertEqual(text.count("figures: begin"), text.count("<!-- figures: end -->"), name)
            self.assertEqual(table.count(f"\n| [{name}]({name}/README.md) | "), 1)

    def test_a_block_is_written_over_and_the_rest_stays(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "README.md"
            page.write_text("before\n<!-- figures: begin a -->\nold\n<!-- figures: end -->\nafter\n", encoding="utf-8")
            for _ in range(2):
                readme.put(page, {"a": readme.table(["", "found"], [["flow", "1"]])})
                self.assertEqual(page.read_text(encoding="utf-8"), "before\n<!-- figures: begin a -->\n\n| | found |\n|---|---|\n| flow | 1 |\n\n<!-- figures: end -->\nafter\n")
            self.assertRaises(ValueError, readme.put, page, {"b": ""})


if __name__ == "__main__":
    unittest.main()
