# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies that run through, are killed, stopped, changed, and asked for nonsense.

Usage: study.py TALUS ROOT FOLDER [SUITE]
"""

import math
import os
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import numpy

from tools_case import ROOT, SHARE, TALUS, Case, main, read_csv

from talus_tools.errors import UserError
from talus_tools.study.design import design, quantile
from talus_tools.study.ensemble import lock, make_members, program_version
from talus_tools.study.member import written
from talus_tools.study.quantities import Quantity
from talus_tools.study.settings import ENTRIES, Settings

# The first slope on cells of 2 m: half a second.
COARSE = {"Grid/Cell size": "2", "Grid/Upper corner": "200, 6", "End time": "8",
          "Output/Write points": "false", "Output/Write grid": "false",
          "Checkpoint/Step interval": "400", "Checkpoint/At the end": "false"}
STRENGTH = """
  subsection strength
    set Parameter          = Materials/mud/Undrained shear strength
    set Distribution       = lognormal
    set Mean               = 2000
    set Standard deviation = 500
  end
"""
# The default, a runout, changes by whole columns of the mesh.
FRONT = """subsection Quantities
  set Names = front
  subsection front
    set Column = front x [m]
  end
end"""
# In place of talus where only what is around the runs is tested: it writes the tables and
# maps that a run with this strength might have. Strength 3 is an error.
PRETENDER = """#!/bin/sh
if [ "$1" = --version ]; then echo "talus pretended VERSION"; exit 0; fi
s=$(sed -n 's/^ *set Undrained shear strength = \\([0-9]*\\).*/\\1/p' "$1" | tail -1)
if [ "$s" = 3 ]; then echo "talus: Point 7, that of body 0, left the mesh." >&2; exit 1; fi
echo run >> "$3/runs"
printf 'time [s],front x [m]\\n0,9\\n1,%s\\n2,0\\n' "$s" > "$3/statistics.csv"
printf 'time [s],runout [m]\\n0,9\\n1,%s\\n2,0\\n' "$s" > "$3/runout.csv"
echo "A report of this run: talus-report $3" > "$3/log.txt"
MAPS
"""
RASTERS = """mkdir -p "$3/maps"
h='ncols 2\\nnrows 1\\nxllcorner 100\\nyllcorner 200\\ncellsize 10\\nNODATA_value -9999\\n'
printf "$h-50 -51\\n" > "$3/maps/ground.asc"
printf "$h$s -9999\\n" > "$3/maps/maximum-thickness.asc"
"""
LINES = """printf 'x [m],maximum thickness [m]\\n0,%s\\n1,nan\\n' "$s" > "$3/maps.csv"
"""


def as_sections(entries):
    """As --set has them, in the section Parameters."""
    lines = []
    for name, value in entries.items():
        *sections, entry = name.split("/")
        lines += [f"subsection {s}" for s in ["Parameters", *sections]]
        lines += [f"set {entry} = {value}"] + ["end"] * (1 + len(sections))
    return "\n".join(lines)


class StudyCase(Case):
    def write(self, name, *lines, varied=STRENGTH, parameters=COARSE, names="strength"):
        """A study file; its folder is NAME-output."""
        path = self.folder / f"{name}.prm"
        path.write_text("\n".join([
            f"set Case = {ROOT / 'prm' / 'first-slope.prm'}", f"set Program = {TALUS}",
            f"set Output folder = {self.folder / (name + '-output')}", *lines,
            f"subsection Varied\nset Names = {names}\n{varied}\nend", as_sections(parameters)]))
        return path

    def grid(self, name, values, *lines, program=None):
        """A study with these strengths, by the pretender."""
        return self.write(name, "subsection Design\nset Kind = grid\nend",
                          f"set Program = {program or self.pretender()}", *lines,
                          varied="subsection strength\n"
                          "set Parameter = Materials/mud/Undrained shear strength\n"
                          f"set Template = {{}} + 0*depth\nset Values = {values}\nend",
                          parameters={})

    def pretender(self, name="pretender", version="1", maps=""):
        path = self.folder / name
        path.write_text(PRETENDER.replace("VERSION", version).replace("MAPS", maps))
        path.chmod(0o755)
        return path

    def output(self, study):
        return study.with_name(study.stem + "-output")

    def study(self, *arguments, status=0):
        result = self.tool("talus-study", *arguments, cwd=ROOT)
        self.assertEqual(result.returncode, status, result)
        self.assertEqual(result.stderr, "")
        return result.stdout

    def start(self, study):
        """In a process group of its own."""
        # pylint: disable-next=consider-using-with
        return subprocess.Popen([sys.executable, SHARE / "talus-study", study, "--at-once", "2"],
                                cwd=ROOT, stdout=subprocess.DEVNULL, start_new_session=True)

    def wait_for(self, what):
        end = time.time() + 100
        while not what() and time.time() < end:
            time.sleep(0.005)
        self.assertTrue(what())

    def running_with_checkpoint(self, folder):
        """Members that have begun, are not near their end, and can go on."""
        def steps(member):
            return [int(p.name) for p in (member / "checkpoints").glob("*[0-9]")]
        return [p.parent for p in folder.glob("*/member.json")
                if '"started"' in p.read_text() and 0 < max(steps(p.parent), default=0) <= 800]


class Interrupted(StudyCase):
    """The gate: killed in the middle and resumed, bit for bit the same."""

    def test_killed_and_resumed(self):
        reference, killed = (self.write(name, FRONT) for name in ("reference", "killed"))
        self.study(reference, "--at-once", 2)
        process, folder = self.start(killed), self.output(killed)
        self.wait_for(lambda: len([p for p in folder.glob("*/member.json")
                                   if '"finished"' in p.read_text()]) >= 5
                      and self.running_with_checkpoint(folder))
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        self.assertFalse((folder / "study.csv").exists())
        before = {p: p.stat().st_mtime_ns for p in folder.glob("*/member.json")
                  if '"finished"' in p.read_text()}
        self.assertLess(len(before), 16)
        self.study(killed, "--at-once", 2)
        for path, written in before.items():
            self.assertEqual(path.stat().st_mtime_ns, written)
        resumed = [p for p in folder.glob("*/log.txt") if "Resumed at t =" in p.read_text()]
        self.assertGreaterEqual(len(resumed), 1)
        for name in ("study.csv", "exceedance.csv"):
            self.assertEqual((folder / name).read_bytes(),
                             (self.output(reference) / name).read_bytes())
        rows = read_csv(folder / "study.csv")
        self.assertEqual([row["status"] for row in rows], ["finished"] * 16)
        self.assertGreater(len({row["front [m]"] for row in rows}), 10)

    def test_stopped_by_sigterm(self):
        study = self.write("stopped", "subsection Design\nset Members = 4\nend")
        process, folder = self.start(study), self.output(study)
        self.wait_for(lambda: self.running_with_checkpoint(folder))
        process.terminate()
        self.assertEqual(process.wait(timeout=60), 75)
        status = [row["status"] for row in read_csv(folder / "study.csv")]
        self.assertIn("stopped", status)
        self.study(study)
        self.assertEqual({row["status"] for row in read_csv(folder / "study.csv")}, {"finished"})

    def test_study_alone_is_killed(self):
        """Its runs stop by themselves, with a checkpoint."""
        study = self.write("orphans", "subsection Design\nset Members = 2\nend")
        process, folder = self.start(study), self.output(study)
        self.wait_for(lambda: self.running_with_checkpoint(folder))
        process.kill()
        process.wait()
        self.study(study)
        self.assertEqual({row["status"] for row in read_csv(folder / "study.csv")}, {"finished"})


class Members(StudyCase):
    def test_failed_are_listed_with_the_reason(self):
        study = self.grid("failed", "2, 3, 4")
        said = self.study(study, status=1)
        self.assertIn("member-0002 failed: Point 7, that of body 0, left the mesh.", said)
        rows = read_csv(self.output(study) / "study.csv")
        self.assertEqual([row["status"] for row in rows], ["finished", "failed", "finished"])
        self.assertEqual(rows[1]["reason"], "Point 7, that of body 0, left the mesh.")
        self.assertEqual(rows[1]["runout [m]"], "")
        self.assertEqual([row["value"] for row in
                          read_csv(self.output(study) / "exceedance.csv")], ["0.0", "0.0"])

    def test_real_error_of_talus(self):
        study = self.write("real", "subsection Design\nset Members = 1\nend",
                           parameters={**COARSE, "Grid/Upper corner": "52, 6"})
        self.assertIn("left the mesh through the face 'Right'", self.study(study, status=1))

    def test_moving_at_the_end(self):
        """Two seconds are too short for the slope, two hundred are not."""
        study = self.write("moving", "subsection Design\nset Kind = grid\nend",
                           varied="subsection time\nset Parameter = End time\n"
                           "set Values = 2, 200\nend", names="time",
                           parameters={**COARSE, "Grid/Cell size": "1"})
        said = self.study(study)
        self.assertEqual([row["moving at the end"] for row in
                          read_csv(self.output(study) / "study.csv")], ["1", "0"])
        self.assertIn("1 of the finished members still moved at the end", said)

    def test_quantities(self):
        study = self.grid("quantities", "5, 20, 7", """subsection Quantities
          set Names = most, least
          subsection most
            set Take = maximum
          end
          subsection least
            set Take = minimum
          end
        end""")
        self.study(study)
        rows = read_csv(self.output(study) / "study.csv")
        self.assertEqual([row["most [m]"] for row in rows], ["9.0", "20.0", "9.0"])
        self.assertEqual([row["least [m]"] for row in rows], ["0.0"] * 3)
        shares = [(row["value"], row["share of members at or above [-]"])
                  for row in read_csv(self.output(study) / "exceedance.csv")
                  if row["quantity"] == "most [m]"]
        self.assertEqual(shares, [("9.0", "1.0"), ("9.0", "1.0"), ("20.0", repr(1 - 2 / 3))])
        self.assertTrue((self.output(study) / "study.png").exists())

    def test_settling_time(self):
        """A front that approaches its place as 1 - exp(-t) is within 2 % from t = ln 50 on."""
        times = [0.01 * i for i in range(3001)]
        (self.folder / "statistics.csv").write_text("time [s],front x [m]\n" + "".join(
            f"{t!r},{5 - 3 * math.exp(-t)!r}\n" for t in times))
        quantity = Quantity("time", "statistics.csv", "front x [m]", "settling time")
        value = quantity.value(SimpleNamespace(path=lambda name: self.folder / name))
        self.assertEqual(quantity.label(), "time [s]")
        self.assertLess(abs(value - math.log(50)), 0.01)

    def test_list_member_collect(self):
        study = self.grid("array", "5, 20")
        self.assertEqual(self.study(study, "--list"),
                         "member,strength,status\n1,5,waiting\n2,20,waiting\n")
        self.study(study, "--member", 2)
        self.assertIn("2,20,finished", self.study(study, "--list"))
        self.assertFalse((self.output(study) / "study.csv").exists())
        self.study(study, "--collect", status=75)
        self.assertEqual([row["status"] for row in read_csv(self.output(study) / "study.csv")],
                         ["waiting", "finished"])
        self.assert_sentence(self.tool("talus-study", study, "--member", 3), "from 1 to 2")

    def runs(self, study):
        return [len((self.output(study) / f"member-000{i}" / "runs").read_text().split())
                for i in (1, 2)]

    def test_only_what_changed_runs_again(self):
        study = self.grid("changed", "5, 20")
        self.study(study)
        self.study(self.grid("changed", "5, 21"))
        self.assertEqual(self.runs(study), [1, 2])
        self.study(self.grid("changed", "5, 21", program=self.pretender("other", version="2")))
        self.assertEqual(self.runs(study), [2, 3])

    def test_parameters_of_a_member(self):
        study = self.write("written", "subsection Design\nset Members = 1\nend",
                           parameters={**COARSE, "End time": "0.1"})
        self.study(study)
        row = read_csv(self.output(study) / "study.csv")[0]
        record = (self.output(study) / "member-0001" / "parameters.prm").read_text()
        self.assertRegex(record, rf"set Undrained shear strength +=.* {row['strength']}\n")
        self.assertRegex(record, r"set Cell size +=.* 2\n")


    def test_files_beside_the_case(self):
        """Are found from the folder of each member, and count when they change."""
        (self.folder / "strength.csv").write_text(
            "depth [m],undrained shear strength [Pa]\n0,1000\n10,2000\n")
        case = self.folder / "case.prm"
        case.write_text(f"include {ROOT / 'prm' / 'first-slope.prm'}\nsubsection Materials\n"
                        "subsection mud\nset Undrained shear strength = table strength.csv\n"
                        "end\nend\n")
        study = self.write("files", "subsection Design\nset Members = 1\nend",
                           f"set Case = {case}", parameters={**COARSE, "End time": "0.1"},
                           varied="subsection strength\nset Parameter = Materials/mud/Density\n"
                           "set Lower = 1500\nset Upper = 1700\nend")
        self.study(study)
        self.assertIn("finished", self.study(study, "--list"))
        (self.folder / "strength.csv").write_text(
            "depth [m],undrained shear strength [Pa]\n0,1000\n10,2001\n")
        self.assertIn("waiting", self.study(study, "--list"))


class Launchers(StudyCase):
    """The exit status is that of the launcher, whatever talus did."""

    def states(self, study):
        return [line.split(",")[2] for line in self.study(study, "--list").splitlines()[1:]]

    def test_launcher_that_runs_nothing(self):
        study = self.grid("nothing", "5, 20", "set Launcher = true")
        said = self.study(study, status=1)
        self.assertIn("member-0001 failed: exit status 0, but log.txt", said)
        self.assertEqual(self.states(study), ["failed", "failed"])
        self.study(self.grid("nothing", "5, 20"))
        self.assertEqual(self.states(study), ["finished", "finished"])

    def test_results_of_another_member_do_not_count(self):
        self.study(self.grid("stale", "5, 20"))
        study = self.grid("stale", "6, 20", "set Launcher = true")
        self.study(study, status=1)
        self.assertEqual([row["status"] for row in read_csv(self.output(study) / "study.csv")],
                         ["failed", "finished"])

    def test_lost_exit_status(self):
        launcher = self.folder / "careless"
        launcher.write_text('#!/bin/sh\n"$@"\nexit 0\n')
        launcher.chmod(0o755)
        study = self.grid("lost", "2, 3", f"set Launcher = {launcher}")
        self.assertIn("member-0002 failed: Point 7", self.study(study, status=1))


class Exceedance(StudyCase):
    def test_rasters(self):
        study = self.grid("rasters", "5, 20, 7, 1", "subsection Exceedance\n"
                          "set Thresholds = 4, 6\nend",
                          program=self.pretender("rasters", maps=RASTERS))
        self.study(study)
        folder = self.output(study) / "maps"
        for threshold, share in ((4, "0.75"), (6, "0.5")):
            text = (folder / f"exceedance-maximum-thickness-{threshold}.asc").read_text()
            self.assertIn("xllcorner 100.0\nyllcorner 200.0\ncellsize 10.0\n", text)
            self.assertTrue(text.endswith(f"\n{share} 0\n"), text)
        self.assertTrue((self.output(study) / "exceedance-maps.png").exists())

    def test_lines(self):
        study = self.grid("lines", "5, 20, 7, 1", "subsection Exceedance\n"
                          "set Thresholds = 6\nend",
                          program=self.pretender("lines", maps=LINES))
        self.study(study)
        self.assertEqual((self.output(study) / "exceedance-maps.csv").read_text(),
                         "x [m],share of members with maximum thickness above 6 [-]\n"
                         "0.0,0.5\n1.0,0.0\n")


class Seeds(StudyCase):
    def test_random_strength(self):
        """Realizations of the strength, by whole numbers: each seed has a runout of its own, and
        a seed that is given twice has the same."""
        start = "Materials/mud/Strength field/"
        study = self.write(
            "seeds", FRONT, "subsection Design\nset Kind = grid\nend", names="seed",
            varied=f"subsection seed\nset Parameter = {start}Seed\nset Values = 1, 2, 1\nend",
            parameters=COARSE | {start + "Coefficient of variation": "0.3",
                                 start + "Correlation lengths": "20, 2"})
        self.study(study)
        fronts = [float(row["front [m]"]) for row in read_csv(self.output(study) / "study.csv")]
        self.assertEqual(fronts[0], fronts[2])
        self.assertGreater(abs(fronts[0] - fronts[1]), 1e-3)

    def test_whole_numbers_have_no_point(self):
        for value, text in ((3.0, "3"), (-2.0, "-2"), (0.1, "0.1"), (1e22, "1e+22")):
            self.assertEqual(written(value), text)


class Design(StudyCase):
    def drawn(self, varied, members=2000):
        study = self.write("design", f"subsection Design\nset Members = {members}\nend",
                           varied=f"subsection strength\nset Parameter = a/b\n{varied}\nend")
        settings = Settings(study)
        return settings, design(settings)[:, 0]

    def test_one_member_in_each_stratum(self):
        _, values = self.drawn("set Lower = 10\nset Upper = 26", 16)
        self.assertEqual(sorted(int(v) for v in values), list(range(10, 26)))

    def test_distributions(self):
        for varied, mean, deviation in (
                ("set Distribution = normal\nset Mean = 5\nset Standard deviation = 2", 5, 2),
                ("set Distribution = lognormal\nset Mean = 5\nset Standard deviation = 2", 5, 2),
                ("set Lower = 1\nset Upper = 4", 2.5, 3 / math.sqrt(12)),
                ("set Distribution = triangular\nset Lower = 1\nset Mode = 2\nset Upper = 4",
                 7 / 3, math.sqrt(7 / 18))):
            _, values = self.drawn(varied)
            self.assertAlmostEqual(values.mean() / mean, 1, delta=1e-3)
            self.assertAlmostEqual(values.std() / deviation, 1, delta=1e-2)

    def test_median_of_lognormal(self):
        settings, _ = self.drawn(
            "set Distribution = lognormal\nset Mean = 5\nset Standard deviation = 2")
        self.assertAlmostEqual(quantile(settings.varied[0], numpy.array([0.5]))[0],
                               5 / math.sqrt(1 + 0.16))

    def test_example_and_page(self):
        settings = Settings(SHARE / "study-example.prm")
        self.assertEqual(design(settings).shape, (16, 2))
        self.assertTrue((ROOT / settings.case).exists())
        page = (ROOT / "doc" / "study.md").read_text()
        for entry in ENTRIES:
            self.assertIn(f"`{entry.split('NAME/')[-1]}`", page)

    def test_seed(self):
        text = "set Lower = 0\nset Upper = 1"
        numpy.testing.assert_array_equal(self.drawn(text)[1], self.drawn(text)[1])
        settings, values = self.drawn(text)
        settings.seed = 2
        self.assertFalse((design(settings)[:, 0] == values).any())


class Refused(StudyCase):
    def refuse(self, path, *parts):
        with self.assertRaises(UserError) as caught:
            settings = Settings(path)
            make_members(settings, program_version(settings))
        self.assertTrue(str(caught.exception).endswith("."))
        for part in parts:
            self.assertIn(part, str(caught.exception))

    def test_sentence_of_the_program(self):
        path = self.write("sentence", "set Titel = x")
        self.assert_sentence(self.tool("talus-study", path), "Titel", "no entry of a study")

    def test_study_files(self):
        self.refuse(self.folder / "none.prm", "none.prm", "cannot be read")
        for line, parts in (
                ("set Titel = x", ("Titel", "no entry of a study")),
                ("set Number at once = 0", ("Number at once", "at least 1")),
                ("set Program = no-such-program", ("no-such-program", "not found")),
                ("set Program = /bin/true", ("/bin/true", "version")),
                ("set Case = no.prm", ("no.prm", "cannot be read")),
                ("subsection Design\nset Kind = dice\nend", ("Design/Kind", "dice", "grid")),
                ("subsection Design\nset Kind = grid\nend", ("Varied/strength/Values",)),
                ("subsection Design\nset Members = 1000000000000\nend", ("Members", "at most")),
                ("subsection Design", ("end",))):
            self.refuse(self.write("bad", line), *parts)
        for varied, parts in (
                ("", ("Varied/strength/Lower", "needed")),
                ("subsection strength\nset Lower = 1\nset Upper = 2\nend", ("Parameter", "needed")),
                (STRENGTH.replace("500", "-5"), ("Standard deviation", "positive")),
                (STRENGTH.replace("500", "a"), ("Standard deviation", "numbers")),
                (STRENGTH.replace("500", "1e300"), ("Standard deviation", "beyond 1e100")),
                (STRENGTH.replace("500", "1e50"), ("Standard deviation", "million")),
                (STRENGTH.replace("2000", "nan"), ("Mean", "nan")),
                (STRENGTH.replace("500", "inf"), ("Standard deviation", "numbers")),
                (STRENGTH.replace("Materials/mud/Undrained shear strength", "Output/Folder"),
                 ("Parameter", "folder of its own")),
                (STRENGTH.replace("lognormal", "uniform\nset Lower = 2\nset Upper = 1"),
                 ("Upper", "above 'Lower'")),
                (STRENGTH.replace("set Mean ", "set Template = x\nset Mean "), ("Template", "{}")),
                (STRENGTH.replace("set Mean ", "set Template = {{}}\nset Mean "),
                 ("Template = {{}}", "other braces")),
                (STRENGTH.replace("set Mean ", "set Template = {} + ${c}*depth\nset Mean "),
                 ("Template", "other braces"))):
            self.refuse(self.write("bad", varied=varied), *parts)
        self.refuse(self.write("bad", parameters={"End time": "${T}"}),
                    "'Parameters/End time = ${T}'", "without '{'")

    def test_options_and_folders(self):
        study = self.write("options")
        for options, parts in ((("--member", "a"), ("--member", "--help")),
                               (("--at-once", "x"), ("--at-once",)),
                               (("--output", "/dev/null"), ("/dev/null", "cannot be made")),
                               (("--output", study), ("cannot be made",))):
            self.assert_sentence(self.tool("talus-study", study, *options), *parts)
        self.assert_sentence(self.tool("talus-report", "--fast", "x"), "--fast", "--help")

    def test_lock_of_the_user(self):
        file = self.folder / "lock"
        file.write_text("mine")
        lock(self.folder).close()
        self.assertEqual(file.read_text(), "mine")

    def quantity(self, name, *lines, **options):
        """A study of four members with one quantity."""
        return self.grid(name, "5, 6, 7, 8", "subsection Quantities\nset Names = a\nsubsection a",
                         *lines, "end\nend", **options)

    def test_column_that_is_not_there(self):
        """The first member tells; the others do not run."""
        study = self.quantity("column", "set Column = speed")
        self.assert_sentence(self.tool("talus-study", study), "statistics.csv", "'speed'",
                             "it has time [s], front x [m]")
        self.assertFalse((self.output(study) / "member-0003").exists())

    def test_column_is_checked_while_the_first_member_runs(self):
        study = self.write("early", "subsection Design\nset Members = 1\nend",
                           "subsection Quantities\nset Names = a\nsubsection a\n"
                           "set Column = speed\nend\nend",
                           parameters={**COARSE, "End time": "1000"})
        self.assert_sentence(self.tool("talus-study", study), "'speed'", "front x [m]")
        self.assertIn("1,", self.study(study, "--list"))
        self.assertNotIn("finished", self.study(study, "--list"))

    def test_maps_that_are_not_there(self):
        """One member tells of maps.csv while it runs, of rasters when it has finished, and of the
        name in the section Exceedance, too."""
        for name, maps, text in (("section", LINES, "maximum-thickness"),
                                 ("plan", RASTERS, "ground, maximum-thickness")):
            program = self.pretender(name, maps=maps)
            study = self.quantity(name, "set Map = max-thickness", "set Place = 0",
                                  program=program)
            self.assert_sentence(self.tool("talus-study", study), "member-0001 has no map "
                                 "'max-thickness'", "quantity 'a'", f"it has {text}. Correct")
            self.assertFalse((self.output(study) / "member-0002").exists())
            study = self.grid(f"{name}-exceedance", "5, 6, 7", "subsection Exceedance\n"
                              "set Map = thickness\nend", program=program)
            self.assert_sentence(self.tool("talus-study", study), "no map 'thickness'",
                                 "'Exceedance/Map'", f"it has {text}.")
            self.assertFalse((self.output(study) / "member-0002").exists())

    def test_place_that_is_not_on_the_map(self):
        study = self.quantity("place", "set Map = maximum-thickness", "set Place = 9, 9",
                              program=self.pretender("place", maps=RASTERS))
        self.assert_sentence(self.tool("talus-study", study), "the place [9.0, 9.0]")
        self.assertFalse((self.output(study) / "member-0002").exists())

    def test_table_that_is_not_written(self):
        study = self.quantity("unwritten", "set File = obstacles.csv")
        self.assert_sentence(self.tool("talus-study", study), "finished without",
                             "obstacles.csv", "Quantities/a/File")
        self.assertFalse((self.output(study) / "member-0003").exists())
        for file in ("statistic.csv", "lines.csv", "../statistics.csv"):
            self.refuse(self.quantity("file", f"set File = {file}"), file, "stations.csv")

    def test_names(self):
        for name in ("member", "status", "hash", "reason"):
            self.refuse(self.write("named", varied=STRENGTH.replace("subsection strength",
                                                                    f"subsection {name}"),
                                   names=name), f"'{name}'", "study.csv")
        self.refuse(self.write("named", varied=STRENGTH, names="a/b"), "'a/b'", "slash")
        self.refuse(self.quantity("slash", "end\nend\nsubsection Quantities\n"
                                  "set Names = a/b\nsubsection x"), "'a/b'", "slash")
        self.refuse(self.write("twice", "subsection Quantities\nset Names = a, a\nend"),
                    "'a [m]'", "study.csv")


if __name__ == "__main__":
    main()
