# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every entry of the parameter file without a value and with values that are none;
run by bad_input.py."""

import re

from bad_input_case import Case, GOOD

# What deal.II, Boost, HDF5 and the C++ library say to programmers.
RAW = re.compile(r"An error occurred|violated condition|Exc[A-Z]\w+|terminate|"
                 r"std::|dealii|Boost|what\(\)|PRM|Patterns|handler|muParser")

# A case with a section of every kind.
FULL = GOOD + """\
subsection Obstacles
  set Names = pipe
  subsection pipe
    set Shape  = ball
    set Centre = 3.5, 3.5
    set Radius = 0.6
  end
end

subsection Surfaces
  set Names = mudline
  subsection mudline
    set Expression = 2
  end
end
"""


def entries(parameters):
    """Path and value of each entry of a parameter file."""
    path = []
    for line in map(str.strip, parameters.splitlines()):
        if line.startswith("subsection "):
            path.append(line[len("subsection "):])
        elif line == "end":
            path.pop()
        elif line.startswith("set "):
            name, value = line[len("set "):].split("=", 1)
            yield "/".join([*path, name.strip()]), value.strip()


class BadInputValues(Case):
    def assert_refused(self, result, *words):
        super().assert_refused(result, *words)
        self.assertIsNone(RAW.search(result.stderr), result.stderr)

    def full_entries(self):
        """Path and settings of all entries that a file may have: those of the
        reference, by the names of our case."""
        for path, value in entries(self.run_talus("--document").stdout):
            first, *rest = path.split("/")
            law = []
            if first == "Bodies" and len(rest) == 2:
                rest[0] = "block"
            elif first == "Obstacles" and len(rest) == 2:
                rest[0] = "pipe"
            elif first == "Materials" and len(rest) >= 2:
                law = [f"Materials/clay/Law={rest[0]}"]
                rest[0] = "clay"
            yield "/".join([first, *rest]), value, law

    def test_reference_has_every_entry(self):
        """An entry that a run records and the reference does not list would be
        one that nobody can know."""
        reference = {path for path, value, law in self.full_entries()}
        result = self.run_file(FULL, output="full")
        self.assertEqual(result.returncode, 0, result.stderr)
        record = (self.folder / "full" / "parameters.prm").read_text()
        recorded = {path for path, value in entries(record)}
        self.assertIn("Obstacles/pipe/Friction coefficient", recorded)
        # Those of the materials by the laws, which have other names there.
        self.assertEqual(recorded - reference, set())

    def test_every_entry_without_value(self):
        n_refused = 0
        for path, value, law in self.full_entries():
            # The folder is given by --output; nothing is a value of the others.
            if not value or path == "Output/Folder":
                continue
            with self.subTest(path):
                n_refused += 1
                text = FULL
                if law and "Cam clay" in law[0]:
                    text = FULL.replace("    set Young's modulus = 1e6\n", "")
                self.assert_refused(self.run_file(text, [*law, path + "="]),
                                    path.split("/")[-1])
        self.assertGreater(n_refused, 150)
        self.assert_untouched()

    def test_entries_that_may_be_empty(self):
        paths = [path for path, value, law in self.full_entries()
                 if not value and not law and path.count("/") < 2]
        self.assertGreater(len(paths), 15)
        settings = [path + "=" for path in paths
                    if path not in ("Bodies/Names", "Materials/Names",
                                    "Obstacles/Names", "Surfaces/Names")]
        result = self.run_file(FULL, settings)
        self.assertEqual(result.returncode, 0, result.stderr)
