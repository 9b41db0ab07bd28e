# SPDX-License-Identifier: LGPL-2.1-or-later
"""Emulators of studies, sensitivities, exceedance curves, and calibration on a deposit.

Usage: emulator.py TALUS ROOT FOLDER [SUITE]
"""

import math
import subprocess
import types
import unittest

import numpy

from tools_case import ROOT, TALUS, Case, main, read_csv

from talus_tools.errors import UserError
from talus_tools.study.emulation import Emulation
from talus_tools.study.emulator import Emulator, sobol_indices
from talus_tools.study.design import design, shares_of
from talus_tools.study.pile import PiledEmulator, pile_of
from talus_tools.study.quantities import MapQuantity
from talus_tools.study.settings import Settings
from talus_tools.tables import read_table

try:
    import sklearn
except ImportError:
    sklearn = None

# In place of talus: front = strength/100 + 3 seabed/100, without a run.
PRETENDER = """#!/bin/sh
if [ "$1" = --version ]; then echo "talus pretended 1"; exit 0; fi
s=$(sed -n 's/^ *set Undrained shear strength = //p' "$1" | tail -1)
b=$(sed -n 's/^ *set Maximum shear stress = //p' "$1" | tail -1)
f=$(awk "BEGIN { printf \\"%.15g\\", $s/100 + 3*$b/100 }")
printf 'time [s],runout [m]\\n0,9\\n1,%s\\n' "$f" > "$3/runout.csv"
echo "A report of this run: talus-report $3" > "$3/log.txt"
"""
# The first slope on cells of 2 m: half a second.
COARSE = {"Grid/Cell size": "2", "Grid/Upper corner": "200, 6", "End time": "15",
          "Output/Write points": "false", "Output/Write grid": "false",
          "Checkpoint/At the end": "false", "Maps/Write": "true"}
STRENGTH, SEABED = "Materials/mud/Undrained shear strength", "Boundaries/Seabed/Maximum shear stress"
VARIED = f"""
  set Names = strength, seabed
  subsection strength
    set Parameter = {STRENGTH}
    set Lower = 1200
    set Upper = 2800
  end
  subsection seabed
    set Parameter = {SEABED}
    set Lower = 500
    set Upper = 1500
  end
"""


def ishigami(shares):
    """Function of three numbers uniform between -pi and pi, with known indices."""
    x = math.pi * (2 * shares - 1)
    return numpy.sin(x[:, 0]) + 7 * numpy.sin(x[:, 1])**2 + 0.1 * x[:, 2]**4 * numpy.sin(x[:, 0])


@unittest.skipIf(sklearn is None, "scikit-learn is not installed")
class EmulatorCase(Case):
    def write(self, name, program, members, *sections, parameters=()):
        """A study file; its folder is NAME-output."""
        path = self.folder / f"{name}.prm"
        lines = [f"set Case = {ROOT / 'prm' / 'first-slope.prm'}", f"set Program = {program}",
                 f"set Output folder = {self.folder / (name + '-output')}",
                 "set Number at once = 2",
                 f"subsection Design\nset Members = {members}\nend",
                 f"subsection Varied\n{VARIED}\nend", *sections]
        for key, value in dict(parameters).items():
            *parts, entry = key.split("/")
            lines += [f"subsection {s}" for s in ["Parameters", *parts]]
            lines += [f"set {entry} = {value}"] + ["end"] * (1 + len(parts))
        path.write_text("\n".join(lines) + "\n")
        return path

    def pretender(self):
        path = self.folder / "pretender"
        path.write_text(PRETENDER)
        path.chmod(0o755)
        return path

    def run_tool(self, name, *arguments):
        result = self.tool(name, *arguments, cwd=ROOT)
        self.assertEqual((result.returncode, result.stderr), (0, ""), result)
        return result.stdout


class Emulators(EmulatorCase):
    def test_sobol_indices(self):
        """Closed form of Ishigami and Homma (1990)."""
        first, total = sobol_indices(ishigami, 3, 2**14, 1)
        numpy.testing.assert_allclose(first, [0.3139, 0.4424, 0], atol=0.02)
        numpy.testing.assert_allclose(total, [0.5576, 0.4424, 0.2437], atol=0.02)

    def test_leave_one_out(self):
        """The closed form is the prediction by a process of the same kernel without the
        member."""
        shares = numpy.random.default_rng(3).random((12, 2))
        values = 5 + numpy.sin(4 * shares[:, 0]) + shares[:, 1]**2
        emulator = Emulator(shares, values)
        mean, deviation = emulator.leave_one_out()
        kernel = emulator.process.kernel_
        for i in range(12):
            others = numpy.arange(12) != i
            between = kernel(shares[others], shares[[i]])[:, 0]
            weights = numpy.linalg.solve(kernel(shares[others]), between)
            alone = kernel(shares[[i]])[0, 0]
            self.assertAlmostEqual(
                mean[i], values.mean() + weights @ (values - values.mean())[others], 6)
            self.assertAlmostEqual(
                deviation[i], values.std() * math.sqrt(alone - weights @ between), 6)
        grid = numpy.random.default_rng(4).random((200, 2))
        exact = 5 + numpy.sin(4 * grid[:, 0]) + grid[:, 1]**2
        self.assertLess(abs(emulator(grid)[0] - exact).max(), 0.3)
        self.assertGreater(emulator.explained_variance(), 0.9)

    def test_study(self):
        """A linear quantity of two uniform numbers: shares of the variance 1600^2 to
        (3 * 1000)^2, and the exceedance curve of their sum."""
        study = self.write("linear", self.pretender(), 16,
                           "subsection Emulator\nset Write = true\nend")
        said = self.run_tool("talus-study", study)
        self.assertRegex(said, r"Emulator of runout \[m\]: the other members explain "
                         r"(100.0|99.\d) % of the variance")
        folder = study.with_name("linear-output")
        indices = {row["parameter"]: row for row in read_csv(folder / "sobol.csv")}
        alone = 1.6**2 / (1.6**2 + 3.0**2)
        for name, exact in (("strength", alone), ("seabed", 1 - alone)):
            for kind in ("first-order", "total"):
                self.assertAlmostEqual(float(indices[name][f"{kind} index [-]"]), exact,
                                       delta=0.02)
        curve = read_csv(folder / "emulator-exceedance.csv")
        values = [float(row["value"]) for row in curve]
        above = [float(row["probability of exceedance [-]"]) for row in curve]
        self.assertAlmostEqual(numpy.interp(0.5, above[::-1], values[::-1]), 20 + 30, delta=0.3)
        # Nearest the largest sum: a triangle of the square of both numbers.
        top, step = 28 + 45, 4.0
        self.assertAlmostEqual(numpy.interp(top - step, values, above),
                               step**2 / 2 / (16 * 30), delta=0.004)
        self.assertTrue((folder / "emulator.png").stat().st_size > 10000)
        self.assertEqual(len(read_csv(folder / "emulator.csv")), 16)

    def test_shares_are_the_design(self):
        """shares_of() inverts the distributions."""
        for distribution in ("Lower = 1\nset Upper = 4", "Lower = 1\nset Mode = 2\nset Upper = 4\n"
                             "set Distribution = triangular", "Mean = 5\nset Standard deviation = "
                             "2\nset Distribution = normal", "Mean = 5\nset Standard deviation = "
                             "2\nset Distribution = lognormal"):
            path = self.folder / "shares.prm"
            path.write_text("set Case = x\nsubsection Varied\nset Names = a\nsubsection a\n"
                            f"set Parameter = a/b\nset {distribution}\nend\nend\n")
            settings = Settings(path)
            shares = numpy.sort(shares_of(settings, design(settings))[:, 0])
            # One member in each of 16 strata.
            self.assertEqual(list((16 * shares).astype(int)), list(range(16)))

    def test_refused(self):
        study = self.write("few", self.pretender(), 5,
                           "subsection Emulator\nset Write = true\nend")
        self.assert_sentence(self.tool("talus-study", study, cwd=ROOT), "at least 8")
        self.assert_sentence(self.tool("talus-calibrate", study, cwd=ROOT), "observes nothing")


class Piles(EmulatorCase):
    """Quantities with the same value in many members: q = max(0, 3 x + y - c) of two uniform
    numbers. P(q > a) = P(3 x + y > c + a) is 1 - (c + a - 1/2)/3 where 1 < c + a < 3."""

    @staticmethod
    def emulate(function, n, seed):
        """Emulation of one quantity, function(x, y), without a study."""
        import scipy.stats
        emulation = Emulation.__new__(Emulation)
        emulation.settings = types.SimpleNamespace(seed=seed, emulator_samples=20000)
        emulation.shares = scipy.stats.qmc.LatinHypercube(2, seed=seed).random(n)
        emulation.emulators = [emulation.fit(function(*emulation.shares.T))]
        return emulation

    def count_within(self, sign, n, c):
        """Share of ten designs with P(q > a) within the stated interval, and the largest
        error, at the pile and beyond it."""
        within, errors = [], []
        for seed in range(10):
            emulation = self.emulate(lambda x, y: sign * numpy.maximum(0, 3 * x + y - c), n, seed)
            self.assertIsInstance(emulation.emulators[0], PiledEmulator)
            values, probability = emulation.exceedance(0, emulation.samples())
            # Nothing lies beyond the pile, and the curve falls.
            self.assertGreaterEqual((sign * values).min(), 0)
            self.assertTrue((numpy.diff(values) >= 0).all())
            self.assertTrue((numpy.diff(probability) <= 0).all())
            low, high = emulation.interval(0, values, probability)
            for distance in (0.0, 0.3):
                exact = 1 - (c + distance - 0.5) / 3
                if sign > 0:
                    at = max(0, numpy.searchsorted(values, distance, "right") - 1)
                else:
                    exact = 1 - exact
                    at = min(len(values) - 1, numpy.searchsorted(values, -distance))
                within.append(low[at] <= exact <= high[at])
                errors.append(abs(probability[at] - exact))
        return numpy.mean(within), max(errors)

    def test_probability(self):
        """Closed form within the 90 % interval, with a pile at the smallest and at the largest
        value, of many and of few hits (of which the values themselves are the distribution)."""
        for sign, n, c, largest in ((1, 32, 2.6, 0.1), (-1, 16, 2.6, 0.15), (1, 10, 2.6, 0.2),
                                    (1, 24, 1.4, 0.15)):
            share, error = self.count_within(sign, n, c)
            self.assertGreaterEqual(share, 0.9, (sign, n, c, error))
            self.assertLess(error, largest, (sign, n, c))

    def test_pile(self):
        """Three equal values at an end are a pile; values in between and constants are not."""
        for values, pile in (([0, 0, 0, 1, 2], 0), ([1, 5, 5, 5, 2], 5), ([0, 0, 1, 2, 3], None),
                             ([0, 1, 1, 1, 2], None), ([4, 4, 4, 4], None)):
            self.assertEqual(pile_of(numpy.array(values, dtype=float)), pile)

    def test_study(self):
        """The terminal and the tables of a study with a pile, and a curve without negative
        values; without a pile the columns of the emulator alone."""
        pretender = self.pretender()
        pretender.write_text(PRETENDER + (
            "printf 'time [s],front x [m],at rest\n0,9,1\n1,%s,%d\n' \"$f\" "
            "$(( ${f%.*} > 60 ? 0 : 1 )) > \"$3/statistics.csv\"\n"))
        study = self.write("moving", pretender, 16,
                           "subsection Emulator\nset Write = true\nend",
                           "subsection Quantities\nset Names = front\nsubsection front\n"
                           "set Column = front x [m]\nend\nend")
        said = self.run_tool("talus-study", study)
        folder = study.with_name("moving-output")
        moving = [row["member"] for row in read_csv(folder / "study.csv")
                  if float(row["front [m]"]) >= 61]
        self.assertGreater(len(moving), 1)
        self.assertIn(f"(members {', '.join(moving)})", said)
        self.assertIn("lower bounds", said)
        for name in ("exceedance", "emulator"):
            rows = read_csv(folder / f"{name}.csv")
            self.assertEqual(sorted(row["member"] for row in rows
                                    if row["moving at the end"] == "1"), sorted(moving))
            for row in rows:
                self.assertEqual(row["moving at the end"] == "1", float(row["value"]) >= 61)


class Calibration(EmulatorCase):
    QUANTITIES = """subsection Quantities
      set Names = front, deposit, thickness
      subsection front
        set Column = front x [m]
      end
      subsection deposit
        set Map = final-thickness
        set Outline = OUTLINE
        set Threshold = 0.2
      end
      subsection thickness
        set Map = final-thickness
        set Place = PLACE
      end
    end"""
    OBSERVED = """subsection Observed
      set Names = front, deposit, thickness
      subsection front
        set Quantity = front
        set Value = FRONT
        set Standard deviation = 0.5
      end
      subsection deposit
        set Quantity = deposit
        set Value = 1
        set Standard deviation = 0.1
      end
      subsection thickness
        set Quantity = thickness
        set Value = THICKNESS
        set Standard deviation = 0.03
      end
    end"""

    def deposit(self, strength, seabed):
        """Front, ends of the soil above 0.2 m, and a place with its thickness, of a run."""
        folder = self.folder / "truth"
        entries = COARSE | {STRENGTH: strength, SEABED: seabed}
        subprocess.run([TALUS, ROOT / "prm" / "first-slope.prm", "--output", folder, *[
            word for item in entries.items() for word in ("--set", "=".join(item))]],
            check=True, capture_output=True, timeout=300)
        maps = read_table(folder / "maps.csv")
        x, thickness = maps["x [m]"], maps["final thickness [m]"]
        soil = x[thickness > 0.2]
        middle = (soil[0] + soil[-1]) // 4 * 2 + 1
        return {"FRONT": read_table(folder / "statistics.csv")["front x [m]"][-1],
                "OUTLINE": f"{soil[0] - 1}, {soil[-1] + 1}", "PLACE": middle,
                "THICKNESS": thickness[abs(x - middle).argmin()]}

    def test_synthetic_deposit(self):
        """Parameters of a deposit that talus made are found within their 90 % range, which is
        narrower than before."""
        truth = {"strength": 1900, "seabed": 900}
        found = self.deposit(*map(str, truth.values()))
        texts = []
        for text in (self.QUANTITIES, self.OBSERVED):
            for key, value in found.items():
                text = text.replace(key, str(value))
            texts.append(text)
        study = self.write("deposit", TALUS, 24, *texts, parameters=COARSE)
        self.run_tool("talus-study", study)
        said = self.run_tool("talus-calibrate", study)
        self.assertIn("effective samples", said)
        rows = {row["name"]: {k: float(v) for k, v in row.items() if k != "name"}
                for row in read_csv(study.with_name("deposit-output") / "calibration.csv")}
        for name, value in truth.items():
            row = rows[name]
            self.assertLess(row["posterior 5 %"], value, rows)
            self.assertGreater(row["posterior 95 %"], value, rows)
        self.assertLess(rows["seabed"]["posterior 95 %"] - rows["seabed"]["posterior 5 %"],
                        0.5 * (rows["seabed"]["prior 95 %"] - rows["seabed"]["prior 5 %"]))
        self.assertTrue((study.with_name("deposit-output") / "calibration.png").exists())
        far = study.with_name("far.prm")
        far.write_text(study.read_text().replace(f"Value = {found['FRONT']}", "Value = 500"))
        self.assert_sentence(self.tool("talus-calibrate", far, cwd=ROOT), "The observation 'front'",
                             "standard deviations from the nearest")

    def test_overlap(self):
        """Intersection over union of intervals and of cells."""
        folder = self.folder / "member"
        (folder / "maps").mkdir(parents=True)

        class Member:
            name = "member"

            @staticmethod
            def path(name):
                return str(folder / name)

        (folder / "maps.csv").write_text("x [m],final thickness [m]\n" + "".join(
            f"{x},{h}\n" for x, h in ((1, 0), (3, 1), (5, 1), (7, 0.05), (9, 0))))
        for outline, exact in (([2, 6], 1), ([4, 8], 2 / 6), ([3, 7], 3 / 5), ([8, 9], 0)):
            quantity = MapQuantity("q", "final-thickness", None, outline, 0.1)
            self.assertAlmostEqual(quantity.value(Member), exact, 12)
        self.assertEqual(MapQuantity("q", "final-thickness", [5.4], None, 0).value(Member), 1)
        head = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n"
        (folder / "maps" / "final-thickness.asc").write_text(head + "1 1 0\n1 -9999 0\n")
        (folder / "seen.asc").write_text(head + "0 1 1\n1 0 0\n")
        quantity = MapQuantity("q", "final-thickness", None, str(folder / "seen.asc"), 0.1)
        self.assertAlmostEqual(quantity.value(Member), 2 / 4, 12)
        self.assertEqual(MapQuantity("q", "final-thickness", [5, 5], None, 0).value(Member), 1)
        with self.assertRaises(UserError):
            MapQuantity("q", "final-thickness", [50, 5], None, 0).value(Member)


main()
