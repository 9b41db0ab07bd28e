# SPDX-License-Identifier: LGPL-2.1-or-later
"""What talus says to bad input: exit status 1 and one helpful line on stderr,
with earlier results untouched.

Usage: bad_input.py TALUS FOLDER [TestClass], with TALUS_FORK_SERVER in the environment.
Exits with 77 if every test was skipped, which ctest shows.
"""

import pathlib
import re
import shlex
import subprocess
import sys
import unittest

from bad_input_case import Case, DUST, GOOD, TALUS
from bad_input_folder import BadInputFolder
from bad_input_motion import BadInputMotion
from bad_input_stages import BadInputStages
from bad_input_terrain import BadInputTerrain
from bad_input_values import FULL, BadInputValues


ROOT = pathlib.Path(__file__).resolve().parents[2]


class BadInput(Case):
    def test_good_input_runs(self):
        result = self.run_file()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        self.assertIn("time [s]", (self.results / "statistics.csv").read_text())

    # The parameter file

    def test_unknown_parameter(self):
        self.refuse("set Cell size    = 1", "set Cel size = 1",
                    "case.prm", "line 6", "'Cel size'", "--document")

    def test_unknown_section(self):
        self.refuse("subsection Grid", "subsection Gird",
                    "case.prm", "line 3", "Gird", "--document")

    def test_wrong_type(self):
        self.refuse("set Cell size    = 1", "set Cell size = one",
                    "case.prm", "line 6", "'one'", "'Cell size'", "number")

    def test_wrong_number_of_coordinates(self):
        self.refuse("set Lower corner = 0, 0\n", "set Lower corner = 0\n",
                    "case.prm", "line 4", "'0'", "list of 2 values", "a number")

    def test_out_of_range(self):
        self.refuse("set Poisson's ratio = 0.3", "set Poisson's ratio = 0.5",
                    "0.5", "Poisson's ratio")

    def test_nearly_incompressible(self):
        for nu in ("0.49999999999999994", "0.499991", "0.5", "-1"):
            self.refuse_set([f"Materials/clay/Poisson's ratio={nu}"],
                            nu, "Poisson's ratio", "up to 0.49999")

    def test_first_factor_above_the_largest(self):
        self.refuse(
            "linear elastic", "von Mises\nend\nend\n"
            "set Stages = equilibrium, strength reduction\n"
            "subsection Strength reduction\n set First factor = 5\n"
            " set Largest factor = 2\nend\n"
            "subsection Materials\n subsection clay",
            "'Strength reduction/First factor' is 5", "= 2")

    def test_extent_in_z_of_two_dimensions(self):
        for shape in ("polygon", "cylinder"):
            self.refuse_set([f"Bodies/block/Shape={shape}", "Bodies/block/Centre=2,2",
                             "Bodies/block/Vertices=1,1; 2,1; 2,2",
                             "Bodies/block/Extent in z=0,1"],
                            "'Bodies/block/Extent in z' = '0,1'", "two-dimensional")

    def test_too_small_a_number(self):
        self.refuse_set(["Mesh tracking/Margin=1"],
                        "'Margin'", "'1'", "a whole number of at least 4")

    def test_unknown_law(self):
        self.refuse("linear elastic", "jelly",
                    "case.prm", "line 22", "'jelly'", "linear elastic", "von Mises", "neo-Hookean")

    def test_unknown_face_condition(self):
        self.refuse("set Bottom = roller", "set Bottom = glue",
                    "case.prm", "line 30", "'glue'", "roller", "seabed")

    def test_velocity_without_expression(self):
        self.refuse_set(["Boundaries/Top=velocity"],
                        "'Boundaries/Top velocity' is empty",
                        "expected one expression for each",
                        "Give the expressions")

    def test_expression_without_condition(self):
        self.refuse_set(["Boundaries/Top traction=0; -1"],
                        "'Boundaries/Top traction = 0; -1'", "'free'",
                        "expected 'traction'")

    def test_free_traction(self):
        self.refuse_set(["Boundaries/Top=traction",
                         "Boundaries/Top traction=free; -1"],
                        "'Boundaries/Top traction = free; -1'", "Give 0")

    def test_runout_of_a_damped_slide(self):
        self.refuse_set(["Damping/Local damping=0.5"],
                        "'Damping/Local damping' is 0.5", "falsifies",
                        "Output/Runout = false")

    def test_unknown_face(self):
        self.refuse("set Bottom = roller", "set Botom = roller",
                    "case.prm", "line 30", "'Botom'", "--document")

    def test_subsection_not_closed(self):
        self.refuse("set Bottom = roller\nend\n", "set Bottom = roller\n",
                    "case.prm, line 29: 'subsection Boundaries'", "'end'")
        self.refuse("  set Cell size    = 1\nend", "  set Cell size    = 1",
                    "case.prm, line 3: 'subsection Grid'", "'end'")
        self.refuse("set Bottom = roller\nend\n", "set Bottom = roller\nend\nend\n",
                    "case.prm, line 32: 'end'", "no 'subsection' is open")

    def test_entry_without_equals(self):
        self.refuse("set Bottom = roller", "set Bottom roller",
                    "case.prm, line 30: 'set Bottom roller'", "the '='")

    def test_words_behind_end(self):
        self.refuse("  set Cell size    = 1\nend", "  set Cell size    = 1\nend Grid",
                    "case.prm, line 7: 'end Grid'", "alone")

    def test_backslash_at_the_end_of_a_setting(self):
        for value in ("clay\\", "clay\\ "):
            self.refuse_set([f"Bodies/block/Material={value}"],
                            "--set 'Bodies/block/Material'", "backslash", "one line")

    def test_texts_are_utf8(self):
        """With or without a byte order mark; the tools read nothing else."""
        file = self.folder / "case.prm"
        file.write_bytes(b"\xef\xbb\xbf" + GOOD.encode())
        result = self.run_talus("--output", "marked", file)
        self.assertEqual(result.returncode, 0, result.stderr)
        for encoding in "cp1252", "utf-16":
            file.write_bytes((GOOD + "set Title = S\u00e3o Miguel\n").encode(encoding))
            self.assert_refused(self.run_talus("--output", "results", file), "case.prm', line ",
                                "32" if encoding == "cp1252" else "1",
                                "is not UTF-8. Save the text as UTF-8")
            self.assert_untouched()

    def test_comment_in_a_setting(self):
        """The value would end at the #."""
        self.refuse_set(["Output/Folder=o #3"], "--set 'Output/Folder'", "'#'", "comment")

    def test_commands_can_be_pasted(self):
        result = self.run_file(output="ut & a")
        self.assertEqual(result.returncode, 0, result.stderr)
        log = (self.folder / "ut & a/log.txt").read_text()
        self.assertEqual(shlex.split(re.search("talus-report .*", log)[0])[1], "ut & a")

    def test_path_that_is_too_long(self):
        self.assert_refused(self.run_file(output="a" * 4100),
                            "The output folder 'aaa", "...' could not be made (File name too long)")

    def test_braces(self):
        """deal.II takes them for a list of variants, and ignores the value."""
        for path, value in (("Gravity/Slope angle", "{8}"), ("End time", "${T}"),
                            ("Title", "{title}"), ("Dimension", "{3}"),
                            ("Bodies/Names", "{block}"),
                            ("Materials/clay/Law", "{linear elastic}")):
            entry = path.split("/")[-1]
            self.refuse_set([f"{path}={value}"], f"--set {path}={value}: '{entry}'",
                            "without '{'", "template")
        self.refuse("set Cell size    = 1", "set Cell size = {1}",
                    "case.prm, line 6: 'Cell size' is '{1}'")
        self.refuse("set Cell size    = 1", "set Cell \\\n size = \\\n {1}",
                    "case.prm, line 8: 'Cell size' is '{1}'")
        (self.folder / "part.prm").write_text("# {x}\nset End time = {0.1}")
        self.refuse("set End time = 0.01", "include part.prm",
                    "part.prm, line 2: 'End time' is '{0.1}'")
        # In a comment they mean nothing.
        result = self.run_file(GOOD.replace("roller", "roller # or {seabed}"))
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_control_characters(self):
        self.refuse("set End time = 0.01", "set End time = 0.01\nset Title = \x1b[31m",
                    "case.prm, line 2: a control character (number 27)")
        self.refuse_set(["Grid/\x1b[31m=1"], "--set Grid/\\x1b[31m=1: a control")

    def test_section_of_the_names_is_misspelt(self):
        self.refuse("subsection Materials", "subsection Material",
                    "case.prm, line 19", "no section 'Material'")
        self.refuse("subsection Bodies", "subsection Body",
                    "case.prm, line 9", "no section 'Body'")

    def test_body_of_the_name_of_the_list(self):
        self.refuse("set Names = block\n  subsection block",
                    "set Names = Names\n  subsection Names",
                    "'Bodies/Names = Names'", "Choose a different name")

    def test_line_that_is_no_parameter(self):
        self.refuse("set Bottom = roller", "Bottom: roller",
                    "case.prm", "line 30", "Bottom: roller", "set")

    def test_unknown_material(self):
        self.refuse("= clay\n  end", "= sand\n  end",
                    "block", "sand", "clay")

    def test_empty_names(self):
        self.refuse("set Names = block", "set Names =", "line 11", "Bodies/Names")
        without = GOOD[:GOOD.index("subsection Materials")]
        self.assert_refused(self.run_file(without), "'Materials/Names' is empty",
                            "at least one name")

    def test_names_twice(self):
        self.refuse("set Names = clay", "set Names = clay, clay",
                    "Materials/Names", "twice")

    def test_dimension(self):
        self.refuse_set(["Dimension=4"], "--set Dimension=4", "'4'", "3")

    def test_missing_file(self):
        self.assert_refused(self.run_talus("missing.prm"),
                            "missing.prm", "cannot be read", "existing file")

    def test_folder_for_file(self):
        self.assert_refused(self.run_talus("."), "'.'", "cannot be read")

    def test_malformed_set(self):
        self.refuse_set(["Grid/Cell size"], "Grid/Cell size",
                        "Section/Subsection/Entry=value")

    def test_unknown_set(self):
        self.refuse_set(["Grid/Cel size=1"], "--set Grid/Cel size=1",
                        "'Cel size'", "--document")

    def test_wrong_type_set(self):
        self.refuse_set(["Grid/Cell size=one"], "--set Grid/Cell size=one",
                        "'one'", "number")

    def test_empty_value(self):
        for name, expected in (("Grid/Cell size", "a number of at least"),
                               ("Grid/Lower corner", "list of 2 values"),
                               ("Materials/clay/Law", "linear elastic"),
                               ("Splitting/Enabled", "true or false")):
            self.refuse_set([name + "="], "'" + name.split("/")[-1] + "' is ''",
                            expected, "was expected")

    def test_numbers_that_contradict_each_other(self):
        self.refuse_set(["Materials/clay/Submerged density=2000"],
                        "/Materials/clay", "2000", "1000", "at most")
        self.refuse_set(["Materials/clay/Submerged density=1000.001"],
                        "1000.001", "at most")
        self.refuse(
            "linear elastic", "von Mises\nend\nend\n"
            "set Stages = equilibrium, strength reduction\n"
            "subsection Strength reduction\n set Smallest factor = 5\n"
            " set Largest factor = 2\nend\n"
            "subsection Materials\n subsection clay",
            "'Strength reduction/Smallest factor' is 5", "2", "Exchange")

    def test_friction(self):
        law = "Materials/clay/Law=Mohr-Coulomb"
        for settings, words in (
                (["Dilatancy angle=35"], ["`Dilatancy angle` is 35",
                                          "friction angle, 30"]),
                (["Friction angle=20", "Dilatancy angle=-30"], ["is -30"]),
                (["Friction angle=0"], ["`Cohesion` and `Friction angle`"]),
                (["Undrained shear strength=1e3"], ["'von Mises'"])):
            self.assert_refused(
                self.run_file(settings=[law] + ["Materials/clay/" + s
                                                for s in settings]), *words)
        self.assert_refused(
            self.run_file(settings=["Materials/clay/Law=von Mises",
                                    "Materials/clay/Friction angle=30"]),
            "'Mohr-Coulomb'")

    def test_critical_state(self):
        good = GOOD.replace("linear elastic", "modified Cam clay").replace(
            "    set Young's modulus = 1e6\n", "")
        at_rest = ["Bodies/block/K0=0.6", "Gravity/Magnitude=9.81"]
        for settings, words in (
                ([], ["'block'", "no effective stress", "'Bodies/block/K0'"]),
                (at_rest + ["Materials/clay/Overconsolidation ratio=2 - depth"],
                 ["'Materials/clay/Overconsolidation ratio' is 0.", "1 or more"]),
                (at_rest + ["Materials/clay/Slope of swelling line=0.3"],
                 ["`Slope of compression line` is 0.2", "0.3"]),
                (at_rest + ["Materials/clay/Attraction=0"],
                 ["`Attraction` is 0"]),
                (["Materials/clay/Young's modulus=1e6"],
                 ["'Young's modulus'", "'modified Cam clay'"])):
            self.assert_refused(self.run_file(good, settings), *words)

    def test_residual_strength_above_the_strength(self):
        """Whichever way the strength is given; the law would raise it."""
        (self.folder / "strength.csv").write_text(
            "depth [m],undrained shear strength [Pa]\n0,600\n2,800\n")
        for strength in ("600", "600 + 0*depth", "if(x > 2, 600, 800)",
                         "table strength.csv"):
            self.assert_refused(self.run_file(
                GOOD.replace("linear elastic", "von Mises"),
                [f"Materials/clay/Undrained shear strength={strength}",
                 "Materials/clay/Residual undrained shear strength=700"]),
                "/Materials/clay", "Residual undrained shear strength` is 700 Pa",
                "must not exceed", " 6")
        self.assert_untouched()

    def test_cells_too_large_for_the_softening(self):
        """G d/(s_u - s_res) = 1000 m/600, less 1 %."""
        for strength in "600", "600 + 0*depth":
            self.assert_refused(self.run_file(
                GOOD.replace("linear elastic", "von Mises"),
                [f"Materials/clay/Undrained shear strength={strength}",
                 "Materials/clay/Young's modulus=2e5",
                 "Materials/clay/Poisson's ratio=0",
                 "Materials/clay/Softening displacement=1e-5"]),
                "`Grid/Cell size` of at most 0.00165 m",
                "`Softening displacement` of at least 0.006060606")
        self.assert_untouched()

    def test_numbers_beyond_all_units(self):
        ball = "Bodies/block/Shape=ball"
        for path, *settings in (
                ("Materials/clay/Density",),
                ("Gravity/Magnitude",),
                ("Bodies/block/K0",),
                ("Bodies/block/Radius", ball),
                ("Boundaries/Seabed/Friction coefficient",),
                ("Ground motion/Factor",),
                ("Splitting/Threshold",),
                ("Output/Field interval",)):
            with self.subTest(path):
                self.assert_refused(
                    self.run_file(FULL, [*settings, f"{path}=1e300"]),
                    path, "'1e300'", "1e+30")
        self.assert_refused(
            self.run_file(FULL, ["Obstacles/pipe/Centre=3.5,-1.1e30"]),
            "'Obstacles/pipe/Centre'", "-1.1e30", "1e+30")
        for number in ("1e-320", "-1e-400"):
            self.assert_refused(
                self.run_file(FULL, [f"Obstacles/pipe/Centre=3.5,{number}"]),
                "'Obstacles/pipe/Centre'", f"'{number}'", "closer to zero")
        self.assert_refused(
            self.run_file(FULL, ["Materials/clay/Law=von Mises", "Materials/clay/"
                                 "Undrained shear strength=1e300*x"]),
            "'Materials/clay/Undrained shear strength' = '1e300*x'", "1e+30")
        self.assert_untouched()
        result = self.run_file(FULL, ["Output/Field interval=1e30",
                                      "Title=at 1e300 m"])
        self.assertEqual(result.returncode, 0, result.stderr)
        # What looks like a number and is none, and what is long.
        result = self.run_file(
            GOOD.replace("clay", "2e35") + f"set Title = {'long ' * 200000}\n"
            "subsection Output\n  set Folder = 57e1234\nend\n")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_run_without_end(self):
        for settings in (["Materials/clay/Young's modulus=1e29", "End time=10"],
                         ["Time step/Maximum=1e-100"], ["End time=1e30"]):
            self.refuse_set(settings, "time steps", "cannot end", "units")

    # Bodies and mesh

    def polygon(self, vertices):
        return ["Bodies/block/Shape=polygon",
                "Bodies/block/Vertices=" + vertices]

    def test_polygon_intersects_itself(self):
        self.refuse_set(self.polygon("0,0; 2,2; 2,0; 0,2"),
                        "Bodies/block/Vertices", "polygon", "crossing")

    def test_polygon_without_area(self):
        self.refuse_set(self.polygon("0,0; 2,2"),
                        "Bodies/block/Vertices", "polygon")

    def test_polygon_without_vertices(self):
        self.refuse_set(["Bodies/block/Shape=polygon"],
                        "Bodies/block/Vertices")

    def test_polygon_vertex_malformed(self):
        self.refuse_set(self.polygon("0,0; 2; 2,2"),
                        "Bodies/block/Vertices", "'2'", "two numbers")

    def test_body_without_shape(self):
        self.refuse_set(["Bodies/block/Shape="], "'Bodies/block/Shape'",
                        "not given", "'polygon'", "'Bodies/Names'")

    def test_obstacle_without_section(self):
        self.refuse_set(["Obstacles/Names=pipe"], "'Obstacles/pipe/Shape'",
                        "not given", "'half-plane'", "'Obstacles/Names'")

    def test_polygon_outside_the_mesh(self):
        self.refuse_set(self.polygon("0,0; 9,0; 2,2"),
                        "block", "9 m", "4 m", "Grid/Upper corner")

    def test_box_outside_the_mesh(self):
        self.refuse_set(["Grid/Upper corner=2,4"],
                        "block", "3 m", "2 m", "Grid/Upper corner")

    def test_body_a_little_too_large(self):
        self.refuse_set(["Bodies/block/Upper corner=3,4.000001"],
                        "to 4.000001 m", "to 4 m")

    def test_box_upside_down(self):
        self.refuse_set(["Bodies/block/Upper corner=0.5,2"],
                        "Bodies/block/Upper corner", "0.5 2", "lower corner")

    def test_no_points(self):
        self.refuse_set(["Bodies/block/Lower corner=1.4,0.4",
                         "Bodies/block/Upper corner=1.6,0.6",
                         "Bodies/block/Filling=centres"],
                        "block", "no points", "Points per cell and axis")

    def test_mesh_upside_down(self):
        self.refuse_set(["Grid/Upper corner=-1,4"],
                        "Grid/Upper corner", "Grid/Lower corner")

    def test_wall_that_would_move(self):
        self.refuse_set(["Boundaries/Top=roller", "Grid/Upper corner=4,4.5"],
                        "Grid/Cell size", "Top", "cell size")

    def test_cells_a_little_too_large(self):
        self.refuse_set(["Grid/Cell size=4.000001"], "only 4 m",
                        "Cell size = 4.000001 m")
        self.refuse_set(["Boundaries/Top=roller", "Grid/Upper corner=4,4.000001"],
                        "is 4.000001 m long", "Cell size = 1 m")

    def test_initial_velocity_is_not_a_number(self):
        self.refuse_set(["Bodies/block/Initial velocity=sqrt(1.5-x); 0"],
                        "Bodies/block/Initial velocity", "nan", "(1.75 ",
                        "finite number")

    def test_initial_velocity_is_no_expression(self):
        self.refuse_set(["Bodies/block/Initial velocity=2*; 0"],
                        "Bodies/block/Initial velocity", "2*")

    def test_constants(self):
        for constants, *words in (
                ("x=1", "'x=1'", "new name", "pi, x, y, z, t"),
                ("a=1; a=2", "'a=2'", "new name"),
                ("2a=1", "'2a=1'", "new name"),
                ("a", "'a'", "name = value"),
                ("a=2*", "'a=2*'", "cannot be understood"),
                ("a=b", "'a=b'", "cannot be understood"),
                ("a=", "'a='", "one value"),
                ("a=b=1", "'a=b=1'", "one value"),
                ("a=1,5", "'a=1,5'", "decimals with a point"),
                ("a=2*x", "'a=2*x'", "cannot be understood", '"x"'),
                ("a=1/0", "'a=1/0'", "inf", "finite")):
            self.refuse_set(["Constants=" + constants], "'Constants'", *words)

    def test_mesh_that_does_not_fit(self):
        words = ("The mesh would have", "cells, which take some",
                 "GB are available", "Grid/Cell size", "more machines")
        self.refuse_set(["Grid/Cell size=1e-4"], *words)
        # 2.5e7 cells, of which a shell allows a quarter.
        self.assert_refused(self.run_limited(4000000, "8e-4"), *words)

    def test_small_cells_that_do_not_fit(self):
        """10^6 times as many as of the others."""
        (self.folder / "case.prm").write_text(GOOD)
        for kilobytes, size, settings, advice in (
                (1200000, "1", ["Grid/Refinement boxes=0,0;4,4;10"],
                 "Grid/Refinement boxes"),
                (1200000, "1",
                 ["Grid/Refinement boxes=0,0;1,1;1|0,0;4,4;10"],
                 "Grid/Refinement boxes"),
                (900000, "0.002",
                 ["Mesh tracking/Enabled=true", "Grid/Coarsest level=6"],
                 "Grid/Coarsest level"),
                (1200000, "1",
                 ["Mesh tracking/Enabled=true", "Grid/Initial refinement=10"],
                 "less Grid/Initial refinement than 10")):
            self.assert_refused(self.run_limited(kilobytes, size, *settings),
                                "The mesh would have", "GB are available",
                                advice)

    def test_points_that_do_not_fit(self):
        """Of 2.5e6 points, for which there are 0.5 GB."""
        (self.folder / "case.prm").write_text(GOOD)
        self.assert_refused(
            self.run_limited(1100000, "0.02",
                             "Bodies/block/Points per cell and axis=16"),
            "With the body 'block' there would be 2560000 points",
            "some 0.6656 GB", "GB are available", "'Points per cell and axis'")
        # Their places alone are too much.
        for filling in ("centres", "clipped"):
            self.assert_refused(
                self.run_limited(1100000, "0.01", "Bodies/block/Points per cell "
                                 "and axis=16", f"Bodies/block/Filling={filling}"),
                "There would be more than", "GB of available memory",
                "'Points per cell and axis'")

    def test_points_of_two_bodies_that_fit(self):
        """10^6 points, 0.26 GB: what the first body has taken of 0.4 GB is not
        missing for the second."""
        (self.folder / "case.prm").write_text(
            GOOD.replace("Names = block", "Names = block, b2").replace(
                "  subsection block", """\
  subsection b2
    set Shape        = box
    set Lower corner = 1, 2
    set Upper corner = 3, 3
    set Material     = clay
    set Points per cell and axis = 2
  end
  subsection block"""))
        result = self.run_limited(1200000, "0.02",
                                  "Bodies/block/Points per cell and axis=10")
        self.assertEqual(result.returncode, 0, result.stderr)

    def run_limited(self, kilobytes, cell_size, *settings):
        """With an address space of that size, and what GDAL's libraries take."""
        kilobytes += 116000
        options = [o for s in settings for o in ("--set", s)]
        return subprocess.run(
            ["bash", "-c", f'ulimit -v {kilobytes}; exec "$@"', "bash", TALUS,
             "--set", "Grid/Cell size=" + cell_size, *options, "--validate",
             self.folder / "case.prm"],
            capture_output=True, text=True, timeout=120)

    def test_large_mesh_is_announced(self):
        """Before it is made, which takes a while."""
        for n_halvings, told in (("8", True), ("7", False)):
            result = self.run_file(settings=[
                "Grid/Initial refinement=" + n_halvings, "End time=0",
                "Bodies/block/Points per cell and axis=1",
                "Bodies/block/Upper corner=1.1,0.1", "Output/Write grid=false"])
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual("A mesh of at least 1.05e+06 cells is being made."
                             in result.stdout, told, result.stdout)

    def test_limits_that_leave_little(self):
        """0.1 GB of mesh, from no room for the libraries to enough for all."""
        (self.folder / "case.prm").write_text(GOOD)
        outcomes = set()
        for kilobytes in range(400000, 1000000, 50000):
            result = self.run_limited(kilobytes, "0.01")
            with self.subTest(kilobytes=kilobytes):
                self.assertIn(result.returncode, (0, 1, 127), result)
            outcomes.add(result.returncode)
        self.assertIn(0, outcomes)

    def test_initial_displacement(self):
        self.refuse_set(["Bodies/block/Initial displacement=-0.995*x; 0"],
                        "Bodies/block/Initial displacement",
                        "to 0.005 times its volume", "smaller")
        self.refuse_set(["Bodies/block/Initial displacement=-2*x; 0"],
                        "Bodies/block/Initial displacement", "inside out",
                        "-1", "smaller")
        self.refuse_set(["Bodies/block/Initial displacement="
                         "0.01*sqrt(1.6-x); 0"],
                        "Bodies/block/Initial displacement", "nan",
                        "finite number")

    def test_ring_without_material(self):
        self.refuse_set(["Bodies/block/Shape=ball",
                         "Bodies/block/Centre=2,2",
                         "Bodies/block/Inner radius=1"],
                        "Bodies/block/Inner radius", "leaves nothing", "1 m")

    def test_initial_velocity_components(self):
        self.refuse_set(["Bodies/block/Initial velocity=1"],
                        "Bodies/block/Initial velocity", "2 are needed")

    def test_assignment_is_no_expression(self):
        for expression in ("x=5; 0", "0; if(y>=1, t=1, 0)"):
            self.refuse_set(["Body force/Expression=" + expression],
                            "Body force/Expression", "by =", "==")
        self.assertEqual(self.run_file(settings=[
            "Body force/Expression=if(x==2 || y>=1 || t!=0, 1, 0); x<=1"])
            .returncode, 0)

    def test_body_force_is_no_expression(self):
        self.refuse_set(["Body force/Expression=q; 0"],
                        "Body force/Expression", "q")

    def test_refinement_boxes(self):
        for boxes, *words in (
                ("0,0; 1,1", "'0,0; 1,1'", "n from 1 to 10"),
                ("0,0; 1,1; 1; 1", "lower corner; upper corner; n"),
                ("0,0; 1,1; 1 | 0,0; 1,1; 11", "'0,0; 1,1; 11'"),
                ("0,0; 1,1; 1.5", "'0,0; 1,1; 1.5'"),
                ("0,0,0; 1,1,1; 1", "'0,0,0'", "2 numbers"),
                ("0,0; 1,one; 1", "'one'", "number"),
                ("nan,0; 1,1; 1", "'nan'", "number"),
                ("0,1; 1,0; 1", "'0,1; 1,0; 1'", "above"),
                ("0,0; 1,1; 1 | 9,0; 10,1; 1", "'9,0; 10,1; 1'", "outside",
                 "(0 0) to (4 4) m"),
                ("|", "''", "lower corner; upper corner; n")):
            with self.subTest(boxes):
                self.refuse_set(["Grid/Refinement boxes=" + boxes],
                                "Grid/Refinement boxes = " + boxes, *words)

    # Output

    def test_output_below_a_file(self):
        (self.folder / "file").write_text("")
        self.assert_refused(self.run_file(output="file/results"),
                            "file/results", "Output/Folder", "--output")
        self.assert_untouched()

    def test_output_folder_is_a_file(self):
        (self.folder / "file").write_text("precious")
        self.assert_refused(self.run_file(output="file"), "'file'", "--output")
        self.assertEqual((self.folder / "file").read_text(), "precious")

    def test_output_without_name(self):
        self.assert_refused(self.run_file(settings=["Output/Folder="],
                                          output=""), "Output/Folder", "empty")

    def test_no_space_for_the_statistics(self):
        (self.results / "statistics.csv").unlink()
        (self.results / "statistics.csv").symlink_to("/dev/full")
        self.assert_refused(self.run_file(), "statistics.csv",
                            "No space left on device", "--output")

    # The run

    def test_point_leaves_through_a_free_face(self):
        self.stops(["Bodies/block/Initial velocity=10; 0", "End time=1"],
                   "Point ", "'Right'", "left the mesh", "(4.", "Grid/Upper")

    def test_not_a_number(self):
        self.stops(["Body force/Expression=sqrt(0.05-t); 0", "End time=1"],
                   "Body force/Expression", "nan", ") m, t = 0.05", "finite")

    def test_not_a_number_from_the_start(self):
        self.refuse_set(["Body force/Expression=sqrt(x-1.5); 0"],
                        "Body force/Expression", "nan", ") m, t = 0 s",
                        "finite")

    def test_velocity_at_a_face_is_not_a_number_from_the_start(self):
        self.refuse_set(["Boundaries/Bottom=velocity",
                         "Boundaries/Bottom velocity=log(-1); 0"],
                        "'Boundaries/Bottom velocity'", "nan")

    def test_traction_on_a_face_without_soil_is_not_a_number(self):
        self.refuse_set(["Boundaries/Top=traction",
                         "Boundaries/Top traction=1/0; 0"],
                        "'Boundaries/Top traction'", "inf", "finite number")

    def test_velocity_at_a_face_is_not_a_number(self):
        self.assert_refused(
            self.run_file(settings=[
                "Boundaries/Bottom=velocity",
                "Boundaries/Bottom velocity=sqrt(0.001-t); 0"]),
            "'Boundaries/Bottom velocity'", "nan", "finite number")

    def test_collapsed_point(self):
        # In the cell of the jump the velocity falls by 1.5 V over h.
        self.stops(DUST + ["Bodies/block/Upper corner=4,2",
                           "Bodies/block/Initial velocity="
                           "if(x<2.5, 1000, -1000); 0"],
                   "Point ", "deformation gradient is -", ") m", "CFL number")

    def test_budget_of_points(self):
        self.stops(["Splitting/Maximum number of points=20",
                    "Splitting/Threshold=1.01", "Splitting/Minimum length=0",
                    "Bodies/block/Initial velocity=10*(x-2); 0",
                    "End time=0.1"],
                   "point ", "Splitting/Maximum number of points", "20",
                   "stretched")


class CommandLine(Case):
    def assert_succeeds(self, result, *words):
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        for word in words:
            self.assertIn(word, result.stdout)
        self.assert_untouched()

    def test_help(self):
        self.assert_succeeds(self.run_talus("--help"), "Usage", "--set",
                             "--output", "--validate", "--document",
                             "--version")

    def options(self):
        return set(re.findall(r"^  (--[a-z]+)", self.run_talus("--help").stdout,
                              re.MULTILINE))

    def test_manual_has_all_options(self):
        manual = (ROOT / "doc/man/talus.1").read_text().replace("\\-", "-")
        self.assertIn("--resume", self.options())
        self.assertEqual(set(re.findall(r"^\\fB(--[a-z]+)\\fR", manual,
                                        re.MULTILINE)), self.options())

    def complete(self, *words):
        """What bash offers for the last word."""
        line = " ".join(map(shlex.quote, words))
        return set(subprocess.run(
            ["bash", "-c", f"source '{ROOT}/share/talus/talus.bash';"
             f"COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; _talus;"
             'printf "%s\\n" "${COMPREPLY[@]}"'],
            cwd=self.folder, capture_output=True, text=True,
            check=True).stdout.split())

    def test_completion(self):
        (self.folder / "slope.prm").write_text(GOOD)
        (self.folder / "notes.txt").write_text("")
        self.assertEqual(self.complete("talus", "--"), self.options())
        self.assertEqual(self.complete("talus", "--res"), {"--resume"})
        self.assertEqual(self.complete("talus", ""), {"slope.prm", "results"})
        self.assertEqual(self.complete("talus", "--output", "r"), {"results"})

    def test_version(self):
        self.assert_succeeds(self.run_talus("--version"), "talus 0.", "deal.II")

    def test_document(self):
        self.assert_succeeds(self.run_talus("--document"), "subsection Grid",
                             "Cell size", "Undrained shear strength",
                             "subsection Splitting")

    def test_validate(self):
        (self.folder / "good.prm").write_text(GOOD)
        self.assert_succeeds(self.run_talus("--validate", "--output", "results",
                                            "good.prm"), "good.prm is valid")

    def remarks_in(self, text):
        return [line for line in text.splitlines() if line.startswith("Remark ")]

    def test_validate_tells_what_the_run_will_do(self):
        """With the remarks of the log, on a thin body, soil that softens and
        is too soft for its weight, and an entry that is set twice."""
        (self.folder / "thin.prm").write_text(
            GOOD.replace("3, 2", "3, 1.5").replace("linear elastic", "Bingham")
            .replace("set End time = 0.01", "set End time = 5\nset End time = 1"))
        arguments = ["--output", "results", "--set",
                     "Materials/clay/Remoulded strength ratio=0.5", "--set",
                     "Materials/clay/Young's modulus=3e4", "thin.prm"]
        result = self.run_talus("--validate", *arguments)
        self.assert_succeeds(
            result, "with 16 cells of 1 m, and with 12 points",
            "'block', lies in soil 1.5 cells of 1 m thick", "the time step is 0.0",
            "about 16 time steps", "million point-steps per second",
            "MB of memory on each rank")
        remarks = self.remarks_in(result.stdout)
        self.assertEqual(len(remarks), 4, result.stdout)
        for number, words in enumerate(
                ("thin.prm, line 2: 'End time' is set again, after line 1",
                 "Body 'block': the soil is 1.5 cells",
                 "Body 'block': the soil is too soft: rho' g H/G = 1.28 ",
                 "Section /Materials/clay: the material softens"), 1):
            self.assertIn(f"Remark {number}: ", remarks[number - 1])
            self.assertIn(words, remarks[number - 1])
        self.assertTrue(result.stdout.endswith(
            "thin.prm is valid, with 4 remarks.\n"), result.stdout)
        run = self.run_talus(*arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        log = (self.results / "log.txt").read_text()
        self.assertEqual(self.remarks_in(log)[:4], remarks)
        self.assertEqual(self.remarks_in(run.stdout), self.remarks_in(log))
        self.assertTrue(log.endswith(
            f"talus-report results ({len(self.remarks_in(log))} remarks)\n"), log)

    def test_remarks_are_numbered_on_when_a_run_is_resumed(self):
        """Soil of which a half leaves the ground is a remark of the run."""
        (self.folder / "thin.prm").write_text(
            GOOD.replace("3, 2", "3, 0.5").replace("Bottom = roller", "Bottom = seabed"))
        arguments = ["--output", "results", "thin.prm", "--set",
                     "Output/Statistics interval=0.01", "--set",
                     "Body force/Expression=0; if(t > 0.05 && x > 2, 60, 0)"]
        for settings, n in (["End time=0.01"], 1), (["End time=0.3", "--resume"], 2):
            result = self.run_talus("--set", *settings, *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            log = (self.results / "log.txt").read_text()
            self.assertEqual([line.split(":")[0] for line in self.remarks_in(log)],
                             [f"Remark {i + 1}" for i in range(n)], log)
        self.assertTrue(log.endswith("(2 remarks)\n"), log)

    def test_validate_finds_faults(self):
        (self.folder / "bad.prm").write_text(GOOD.replace("4, 4", "2, 4"))
        self.assert_refused(self.run_talus("--validate", "bad.prm"), "block")

    def test_validate_computes_what_the_first_step_needs(self):
        for setting in ("Body force/Expression=1/0; 0",
                        "Splitting/Maximum number of points=15",
                        "Output/Folder=/dev/null/results",
                        "Output/Folder=/proc/results"):
            (self.folder / "bad.prm").write_text(GOOD)
            self.assert_refused(
                self.run_talus("--validate", "--set", setting, "bad.prm"),
                setting.split("=")[0])

    def test_softening_is_in_the_log(self):
        result = self.run_file(GOOD.replace("linear elastic", "Bingham"),
                               ["Materials/clay/Remoulded strength ratio=0.5"])
        self.assertEqual(result.returncode, 0, result.stderr)
        log = (self.results / "log.txt").read_text()
        for words in ("Section /Materials/clay: the material softens", "on cells of 1 m",
                      "5 m and 2083.33 J/m^2 on cells of 0.5 m"):
            self.assertIn(words, log)

    def test_no_file(self):
        self.assert_refused(self.run_talus(), "parameter file", "--help")

    def test_two_files(self):
        self.assert_refused(self.run_talus("a.prm", "b.prm"), "--help")

    def test_unknown_option(self):
        self.assert_refused(self.run_talus("--fast"), "--fast", "--help")

    def test_option_without_value(self):
        self.assert_refused(self.run_talus("--set"), "--set", "--help")


class DiskFull(Case):
    """A file system of 256 kB, which only root may mount."""

    def setUp(self):
        super().setUp()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k",
                                "tmpfs", self.results],
                               capture_output=True, text=True)
        if mount.returncode != 0:
            self.skipTest("no file system to fill: " + mount.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", self.results])
        for name, content in self.earlier.items():
            (self.results / name).write_text(content)

    def fill(self):
        with open(self.results / "filling", "wb", buffering=0) as file:
            try:
                while file.write(bytes(1024)):
                    pass
            except OSError:
                return

    def test_full_at_the_start(self):
        self.fill()
        self.assert_refused(self.run_file(), "results/parameters.prm",
                            "No space left on device", "--output")
        (self.results / "filling").unlink()
        self.assert_untouched()

    def test_full_during_the_run(self):
        self.assert_refused(self.run_file(settings=["Output/Field interval=1e-4",
                                                    "End time=1"]),
                            "results/", "No space left on device", "--output")
        self.assertEqual(list(self.results.glob("*.part")), [])

    def test_full_at_a_checkpoint(self):
        """Files of the run fit, a checkpoint does not."""
        for n_bytes in range(150000, 220000, 10000):
            (self.results / "filling").write_bytes(bytes(n_bytes))
            result = self.run_file(settings=["Checkpoint/Step interval=1",
                                             "Output/Write points=false",
                                             "Output/Write grid=false"])
            self.assert_refused(result, "A checkpoint could not be written",
                                "No space left on device", "There is no earlier",
                                "--output")
            self.assertEqual(list(self.results.glob("checkpoints/*")), [])


if __name__ == "__main__":
    print()
    tests = [BadInput, BadInputFolder, BadInputMotion, BadInputStages,
             BadInputTerrain, BadInputValues, CommandLine, DiskFull]
    names = sys.argv[3:] or [test.__name__ for test in tests]
    suite = unittest.TestSuite(
        unittest.defaultTestLoader.loadTestsFromTestCase(globals()[name])
        for name in names)
    outcome = unittest.TextTestRunner().run(suite)
    if not outcome.wasSuccessful():
        sys.exit(1)
    sys.exit(77 if len(outcome.skipped) == outcome.testsRun else 0)
