# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the verification; write doc/verification.md with its pictures, and the
summary in README.md.

    python3 report.py BUILD [--rows] [--without-slow]

BUILD is the build folder. The tests of ctest's label `verification` are run (with
--rows they are not: the rows of an earlier run are taken), and every gate that
they hold becomes a row of the table. Ends with 1 if a gate fails, if a test
fails, or if a row is missing.
"""

import csv
import os
import re
import subprocess
import sys
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "figures"))
from verification_plots import draw_all

# Headings, and below each the test suites in the order of the page.
SECTIONS = [
    ("The bar of the paper", ["Bar", "BarConvergence"]),
    ("Manufactured solutions",
     ["ManufacturedBar", "Manufactured2d", "Manufactured3d", "Vortex",
      "ExpandingRing"]),
    ("Elasticity", ["Discs", "SelfWeightColumn", "ElasticaLoads", "Elastica"]),
    ("Bending and hanging: convected domains", ["Cantilever", "HangingCube"]),
    ("Strength: one point", ["OnePoint"]),
    ("Seabed and layers",
     ["Block", "ShearLayer", "ViscoplasticLayer", "VerticalCut",
      "VerticalCutBracket"]),
    ("Obstacles",
     ["BlockOnPlane", "Arc", "Container", "Bowl", "Pipe", "PipeRefined",
      "LandslideInclined", "LandslideInclined3d", "LandslideInclinedFull",
      "LandslideInclinedFine"]),
    ("Water", ["BlockInWater"]),
    ("Equilibrium without dynamics",
     ["ImplicitColumn", "ImplicitElasticaLoads", "ImplicitElastica",
      "Multigrid"]),
    ("Factors of safety",
     ["InfiniteSlope", "TaylorSlope", "PaperSlopeSafety", "ClaySlope",
      "ClaySlopeFine", "SlopeStability", "StripFooting", "StripFootingFine",
      "VerticalCutSafety", "VerticalCutSafetyFine"]),
    ("From rest into motion",
     ["Geostatic", "Trigger", "GroundMotion", "LandslideFromEquilibrium",
      "LandslideFromEquilibriumFine"]),
    ("Numerical fracture", ["HangingBlock"]),
    ("The landslide of the paper",
     ["LandslideFull", "LandslideFullUnsplit", "LandslideFourWay",
      "LandslideStretched", "LandslideUnsplit", "LandslideSimilarity",
      "LandslideOfLayers", "LandslideMerged", "Landslide3d", "QuietPoints",
      "Boxes"]),
]
# What README shows, by what matters most to an engineer: suite and the
# quantity's beginning; the first row that begins so.
SUMMARY = [
    ("Bar", "error of v_cm / v0, split, left stretch"),
    ("Block", "acceleration"),
    ("Pipe", "N of a rough pipe"),
    ("StripFootingFine", "q F/s_u at failure"),
    ("TaylorSlope", "factor of safety, cells of H/10"),
    ("VerticalCutSafety", "gamma H F/s_u, cells of H/16"),
    ("LandslideFull", "energy lost"),
    ("LandslideFull", "h = 0.4 against 0.2 m: front"),
]
SLOW = {"LandslideFull", "LandslideFullUnsplit", "LandslideFourWay",
        "VerticalCutBracket", "ElasticaLoads", "ImplicitElasticaLoads",
        "StripFootingFine", "VerticalCutSafetyFine", "ClaySlopeFine",
        "SlopeStability",
        "LandslideFromEquilibriumFine", "PipeRefined",
        "LandslideInclinedFull", "LandslideInclinedFine"}

HEAD = """# Verification

What talus is held against, and how it fares: every row is asserted by a test of the label
`verification`, and this page is written from what those tests measure:

    cmake --build build/release --target verification

runs all (expect an hour or more, most of it the landslides to rest), writes this page and its
pictures, and fails if a gate fails. Names of files are those to run by hand; sources are keys or
titles in [references.bib](references.bib). A gate that is not met stays here as *falls short*
with what is known of the cause.

"""


def run_tests(build, without_slow):
    """True if all pass."""
    command = ["ctest", "--test-dir", build, "-L", "verification",
               "--output-on-failure"]
    if without_slow:
        command += ["-LE", "slow"]
    else:
        command += ["-j2"]
    return subprocess.run(command).returncode == 0


def read_rows(folder):
    """Rows by test suite; within a suite, in the order of the tests' names."""
    rows = {}
    for name in sorted(os.listdir(folder)):
        if name.endswith(".csv"):
            with open(os.path.join(folder, name), newline="") as stream:
                rows.setdefault(name.split(".")[0], []).extend(
                    csv.DictReader(stream))
    return rows


def cell(text):
    return text.replace("|", "\\|")


def paragraph(text):
    return textwrap.fill(text, 118, break_long_words=False,
                         break_on_hyphens=False) + "\n\n"


def write_table(out, rows):
    out.write("| case | quantity | talus | reference | gate | verdict |\n"
              "|---|---|---|---|---|---|\n")
    last = None
    for row in rows:
        case = "%s<br>`%s`<br>%s" % (row["case"], row["run"], row["source"])
        gate = "=" if row["gate"] == row["reference"] else row["gate"]
        out.write("| %s | %s | %s | %s | %s | %s |\n"
                  % (cell(case) if case != last else "",
                     cell(row["quantity"]), cell(row["talus"]),
                     cell(row["reference"]), cell(gate),
                     "**%s**" % row["verdict"] if row["verdict"] != "pass"
                     else "pass"))
        last = case
    out.write("\n")
    for row in rows:
        if row["cause"]:
            out.write(paragraph("*%s, %s falls short*: %s."
                                % (row["case"], row["quantity"],
                                   row["cause"])))


def write_page(path, rows, pictures, known):
    with open(path, "w") as out:
        out.write(HEAD)
        verdicts = [row["verdict"] for suite in rows.values() for row in suite]
        out.write(count(verdicts) + ".\n\n")
        for heading, suites in SECTIONS:
            found = [row for suite in suites for row in rows.get(suite, [])]
            if found:
                out.write("## %s\n\n" % heading)
                write_table(out, found)
            for picture, caption in pictures.get(heading, []):
                # The alternative text is a short one: the caption follows.
                name = re.split("[.:,]", caption)[0]
                out.write("![%s](figures/%s)\n\n" % (name, picture)
                          + paragraph("*%s*" % caption))
        out.write(known)
    return verdicts


def count(verdicts):
    return ("%d gates: %d pass, %d fall short, %d fail"
            % (len(verdicts), verdicts.count("pass"),
               verdicts.count("falls short"), verdicts.count("FAIL")))


def update_readme(path, rows, verdicts):
    """Replace what stands between the two comments."""
    with open(path) as stream:
        text = stream.read()
    begin, end = "<!-- verification: begin -->\n", "<!-- verification: end -->"
    table = [count(verdicts) + ".\n", "| case | quantity | talus | reference | "
             "gate |", "|---|---|---|---|---|"]
    for suite, start in SUMMARY:
        row = next((row for row in rows.get(suite, [])
                    if row["quantity"].startswith(start)), None)
        if row:
            gate = row["gate"] if row["gate"] != row["reference"] else "="
            if row["verdict"] != "pass":
                gate += ", **%s**" % row["verdict"]
            table.append("| " + " | ".join(cell(x) for x in (
                row["case"], row["quantity"], row["talus"],
                row["reference"], gate)) + " |")
    before, rest = text.split(begin)
    after = rest.split(end)[1]
    with open(path, "w") as out:
        out.write(before + begin + "\n".join(table) + "\n" + end + after)


def main():
    options = sys.argv[2:]
    build = os.path.abspath(sys.argv[1])
    folder = os.path.join(build, "results", "verification")
    passed = True
    if "--rows" not in options:
        subprocess.run(["rm", "-rf", folder], check=True)
        passed = run_tests(build, "--without-slow" in options)

    rows = read_rows(folder)
    expected = {suite for _, suites in SECTIONS for suite in suites}
    if "--without-slow" in options:
        expected -= SLOW
    missing = sorted(expected - set(rows))
    unknown = sorted(set(rows) - expected)
    with open(os.path.join(HERE, "known.md")) as stream:
        known = stream.read()
    pictures = draw_all(os.path.join(folder, "series"),
                        os.path.join(HERE, "..", "figures"))
    verdicts = write_page(os.path.join(HERE, "..", "verification.md"),
                          rows, pictures, known)
    update_readme(os.path.join(HERE, "..", "..", "README.md"), rows, verdicts)
    print("doc/verification.md: " + count(verdicts))
    for name in missing:
        print("No rows of the test suite '%s': it did not run." % name)
    for name in unknown:
        print("The test suite '%s' has no section in report.py." % name)
    if not passed or missing or unknown or "FAIL" in verdicts:
        sys.exit(1)


main()
