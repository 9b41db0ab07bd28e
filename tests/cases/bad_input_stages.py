# SPDX-License-Identifier: LGPL-2.1-or-later
"""What talus says to bad input for the stages before the dynamics; run by
bad_input.py.
"""

import pathlib

from bad_input_case import Case, GOOD

PRM = pathlib.Path(__file__).resolve().parents[2] / "prm"


class BadInputStages(Case):
    CLAY = GOOD.replace("linear elastic", "von Mises")

    def refuse_settings(self, settings, *words, content=CLAY):
        self.assert_refused(self.run_file(content, settings), *words)
        self.assert_untouched()

    def test_good_stages_run(self):
        result = self.run_file(
            self.CLAY, ["Stages=equilibrium, strength reduction, dynamics",
                        "Materials/clay/Undrained shear strength=1e5"])
        self.assertEqual(result.returncode, 0, result)
        self.assertEqual(result.stderr, "")
        self.assertIn("The factor of safety is ", result.stdout)

    def test_list_of_stages(self):
        for stages, *words in (
                ("equilibrum", "'equilibrum'", "'equilibrium'", "'dynamics'"),
                ("dynamics, equilibrium", "'equilibrium' after 'dynamics'",
                 "in the order"),
                ("strength reduction, equilibrium, dynamics",
                 "'equilibrium' after 'strength reduction'", "in the order"),
                ("equilibrium, equilibrium", "'equilibrium' after "
                 "'equilibrium'", "once at most"),
                ("", "Stages is empty", "'dynamics'")):
            with self.subTest(stages):
                self.refuse_settings(["Stages=" + stages], "Stages", *words)

    def test_hyperelastic_law(self):
        for stage in "equilibrium", "strength reduction":
            self.refuse_settings(["Stages=" + stage,
                                  "Materials/clay/Law=Hencky"],
                                 "'block' follows from its deformation",
                                 "rate form", "'Gravity/Ramp time'",
                                 content=GOOD)

    def test_former_strain_measure(self):
        self.refuse_settings(["Equilibrium/Strain=large"],
                             "no parameter 'Strain'", "always use small strain",
                             "'Gravity/Ramp time'", content=GOOD)

    def test_no_gravity_at_the_start(self):
        for stages in ("equilibrium", "strength reduction",
                       "equilibrium, dynamics"):
            with self.subTest(stages):
                self.refuse_settings(["Stages=" + stages,
                                      "Gravity/Ramp time=1"],
                                     "no gravity at t = 0",
                                     "'Gravity/Ramp time' to 0")

    def test_equilibrium_without_load(self):
        for settings, told in ((["Gravity/Magnitude=0"], True), ([], False),
                               (["Gravity/Magnitude=0",
                                 "Body force/Expression=0; -1"], False)):
            with self.subTest(settings):
                result = self.run_file(GOOD, ["Stages=equilibrium", *settings])
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual("'equilibrium' had nothing to balance"
                                 in result.stdout, told, result.stdout)

    def test_nothing_has_a_strength(self):
        for settings in ([], ["Boundaries/Bottom=seabed",
                              "Strength reduction/Seabed=false"]):
            with self.subTest(settings):
                self.refuse_settings(["Stages=strength reduction", *settings],
                                     "'strength reduction'",
                                     "/Materials/clay", "'von Mises'",
                                     "'Strength reduction/Seabed'",
                                     content=GOOD)

    def test_seabed_alone_has_a_strength(self):
        result = self.run_file(
            GOOD, ["Stages=equilibrium, strength reduction",
                   "Gravity/Slope angle=5", "Boundaries/Bottom=seabed",
                   "Boundaries/Seabed/Friction coefficient=0.35",
                   "Boundaries/Seabed/Maximum shear stress=1e9"])
        self.assertEqual(result.returncode, 0, result)
        # 0.35/tan(5 degrees)
        self.assertIn("The factor of safety is 4.0", result.stdout)

    # Soil that cannot stand

    WEAK_CLAY = "Materials/clay/Undrained shear strength=2500"
    WEAK_SEABED = "Boundaries/Seabed/Maximum shear stress=1e3"

    def run_slope(self, *settings):
        return self.run_slope_as("--overwrite", *settings)

    def run_slope_as(self, how, *settings):
        options = [o for s in settings for o in ("--set", s)]
        return self.run_talus(how, "--output", "falls", "--set",
                              "Grid/Cell size=0.8", *options,
                              PRM / "landslide-trigger.prm")

    def falls(self, *settings):
        self.assert_refused(
            self.run_slope("Stages=equilibrium, dynamics", *settings),
            "'equilibrium' found no balance", " of the load", ", at (",
            "'no-equilibrium'", "more strength or support",
            "'strength reduction'")
        written = self.folder / "falls" / "no-equilibrium.pvd"
        self.assertIn(".vtu", written.read_text())

    def test_soil_that_cannot_stand(self):
        self.falls(self.WEAK_CLAY)

    def test_seabed_that_cannot_hold(self):
        self.falls(self.WEAK_SEABED)

    def test_load_steps_smaller_than_the_smallest(self):
        self.falls(self.WEAK_CLAY, "Equilibrium/Load steps=2000",
                   "Equilibrium/Smallest load step=0.01")

    def test_load_steps_without_end(self):
        """A step that fails would be halved for ever."""
        result = self.run_slope("Equilibrium/Smallest load step=0")
        self.assert_refused(result, "'Smallest load step' is '0'",
                            "from 1e-06 to 1")

    def test_former_load_steps_of_strength_reduction(self):
        result = self.run_slope("Strength reduction/Smallest load step=0.1")
        self.assert_refused(result, "no parameter 'Smallest load step'",
                            "without load steps: remove the line")

    def test_factor_of_safety_less_than_one(self):
        result = self.run_slope("Stages=equilibrium, strength reduction",
                                self.WEAK_CLAY, self.WEAK_SEABED)
        self.assertEqual(result.returncode, 0, result)
        for words in ("'equilibrium' found no balance beyond 0.",
                      "looked for with more strength", "strength / 0.",
                      "The factor of safety is 0.37", "It is less than 1: the "
                      "soil cannot stand with its strength."):
            self.assertIn(words, result.stdout)

    def test_no_dynamics_of_soil_that_cannot_stand(self):
        result = self.run_slope(self.WEAK_CLAY, self.WEAK_SEABED)
        self.assert_refused(result, "'equilibrium'", "only with 3.375 times",
                            "no state of rest", "'dynamics'",
                            "more strength or support")
        self.assertIn("The factor of safety is 0.37", result.stdout)
        self.assert_refused(
            self.run_slope_as("--resume", self.WEAK_CLAY, self.WEAK_SEABED),
            "only with 3.375 times")

    def test_reduction_from_soil_out_of_balance(self):
        self.assert_refused(
            self.run_slope("Equilibrium/Allowed imbalance=1e-3",
                           "Strength reduction/Allowed imbalance=1e-12"),
            "'strength reduction' starts from soil that is out of balance",
            "but at most 1e-12 is allowed", "'Equilibrium/Allowed imbalance'",
            "'Strength reduction/Allowed imbalance'")

    def test_soil_that_softens_is_not_strengthened_too_much(self):
        # 3 G/|H| = 2.01, but it takes 2.6 times the strength.
        result = self.run_slope(
            "Stages=equilibrium, strength reduction", self.WEAK_CLAY,
            self.WEAK_SEABED, "Materials/clay/Hardening modulus=-125e3",
            "Materials/clay/Residual undrained shear strength=2400")
        self.assert_refused(result, "'equilibrium' found no balance",
                            "No balance was found with more strength",
                            "soften faster")
