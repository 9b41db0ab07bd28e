# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the verification; write doc/verification.md, the pages in doc/verification
and the summary in README.md.

    python3 report.py BUILD [--rows] [--without-slow]
    python3 report.py --pages
    python3 report.py --check

BUILD is the build folder. The tests of ctest's label `verification` are run (with
--rows the rows of an earlier run are taken), and every gate becomes a row of
rows.csv beside this script; rows of suites that did not run stay. The pages are
written from rows.csv. Ends with 1 if a gate fails, if a test fails, or if a suite of
topics.py has no row.

--pages writes the pages from rows.csv alone. --check writes nothing and fails if a
page differs from rows.csv, or if ctest knows other suites than topics.py; Python's
standard library is enough.
"""

import csv
import datetime
import glob
import os
import re
import subprocess
import sys
import textwrap

from topics import KINDS, PAGES, kind_of, page_of

HERE = os.path.dirname(os.path.abspath(__file__))
DOC = os.path.dirname(HERE)
ROWS = os.path.join(HERE, "rows.csv")
COLUMNS = ["suite", "measured", "case", "run", "source", "quantity", "talus",
           "reference", "gate", "verdict", "cause"]
PICTURES = {
    "Bar of the paper": [
        ("verification-bar.png",
         "Velocity of the bar's centre of mass over ten periods.")],
    "Manufactured solutions": [
        ("verification-convergence.png",
         "Errors under refinement. With boxes that follow the deformation the "
         "order is two (vortex: above one), with and without splits; with "
         "fixed boxes the order is lost.")],
    "Elasticity at large strain": [
        ("verification-column.png",
         "Self-weight column: stress over the height before the load.")],
    "Layers on a slope": [
        ("verification-layers.png",
         "Viscoplastic layers on a slope of 5 degrees, and a layer that slides "
         "on a capped seabed, against their closed forms (grey).")],
    "Vertical cut": [
        ("verification-cut.png",
         "Vertical cut in clay under growing weight. Runs end where the crest "
         "has settled by 0.2 % of the height. Grey: bounds of the collapse "
         "load.")],
    "Pipes in clay": [
        ("pipe-flow.png",
         "Clay around a pipe dragged by 0.2 D, cells of D/16. The grid does "
         "not see the noise of the points beside the pipe.")],
    "Landslide to rest": [
        ("verification-deposits.png", "Shape of the deposit.")],
}
# What README shows, by what matters most to an engineer: suite and the
# quantity's beginning; the first row that begins so.
SUMMARY = [
    ("Pipe", "N of a rough pipe"),
    ("TaylorSlope", "factor of safety, cells of H/10"),
    ("VerticalCutSafety", "gamma H F/s_u, cells of H/16"),
    ("LandslideFull", "energy lost"),
]

HEAD = """# Verification

Each gate below is asserted by a test of the label `verification`. The pages are written from the results of the tests:

    cmake --build build/test --target verification

runs all tests (expect an hour or more, most of it the landslides to rest), writes the pages and pictures, and fails if a
gate fails. `python3 doc/verification/report.py --pages` writes the pages from the rows of earlier runs
(`doc/verification/rows.csv`).

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


def read_results(folder):
    """Rows of a build by test suite; within a suite, by the tests' names."""
    rows = {}
    for name in sorted(os.listdir(folder)):
        if name.endswith(".csv"):
            path = os.path.join(folder, name)
            suite = name.split(".")[0]
            day = datetime.date.fromtimestamp(os.path.getmtime(path))
            with open(path, newline="") as stream:
                for row in csv.DictReader(stream):
                    rows.setdefault(suite, []).append(
                        {"suite": suite, "measured": day.isoformat(), **row})
    return rows


def read_rows():
    """Rows of rows.csv by test suite."""
    rows = {}
    if os.path.exists(ROWS):
        with open(ROWS, newline="") as stream:
            for row in csv.DictReader(stream):
                rows.setdefault(row["suite"], []).append(row)
    return rows


def write_rows(rows):
    with open(ROWS, "w", newline="") as stream:
        out = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        out.writeheader()
        for suite in sorted(rows):
            out.writerows(rows[suite])


def cell(text):
    return text.replace("|", "\\|")


def paragraph(text):
    return textwrap.fill(text, 118, break_long_words=False,
                         break_on_hyphens=False) + "\n\n"


def number(text):
    """The number that a text is, or None."""
    try:
        return float(text)
    except ValueError:
        return None


def values(row):
    """Value, reference and relative error [%] of a row, as texts."""
    match = re.fullmatch(r"(\S+) \((\S+) % off\)", row["talus"])
    value = match.group(1) if match else row["talus"]
    reference = row["reference"]
    x, exact = number(value), number(reference)
    error = match.group(2) if match else ""
    if (not match and x is not None and exact
            and kind_of(row["suite"], row) != "order"
            and not row["gate"].endswith(exact_gate(reference))):
        error = "%.2g" % (100 * abs(x - exact) / abs(exact))
    return six_digits(value), six_digits(reference), error


def six_digits(text):
    """The text with its decimal numbers to six digits."""
    return re.sub(r"-?\d+\.\d{5,}(e[+-]?\d+)?",
                  lambda match: "%.6g" % float(match.group(0)), text)


def exact_gate(reference):
    """A gate that is the reference itself bounds, and asks for no accuracy."""
    return " " + reference


def gate(row):
    return "=" if row["gate"] == row["reference"] else row["gate"]


def verdict(row):
    return row["verdict"] if row["verdict"] == "pass" else (
        "**%s**" % row["verdict"])


def write_table(rows, compares):
    """A table; with the columns of a comparison if @p compares."""
    out = "| case | quantity | talus | " + (
        "reference | error | gate | verdict |\n|---|---|---|---|---|---|---|\n"
        if compares else "gate | verdict |\n|---|---|---|---|---|\n")
    last = None
    for row in rows:
        case = "%s <br>`%s` <br>%s" % (row["case"], row["run"], row["source"])
        value, reference, error = values(row)
        cells = [case if case != last else "", row["quantity"], value]
        if compares:
            cells += [reference, error + " %" if error else ""]
        cells += [gate(row) if compares or gate(row) != "=" else row["gate"],
                  verdict(row)]
        out += "| " + " | ".join(cell(text) for text in cells) + " |\n"
        last = case
    return out + "\n"


def write_causes(rows):
    """A sentence per cause of rows that fall short."""
    causes = {}
    for row in rows:
        if row["cause"]:
            causes.setdefault((row["case"], row["cause"]), []).append(
                row["quantity"])
    return "".join(
        paragraph("*Falls short: %s, %s.* Cause: %s." % (
            case, "; ".join(quantities), cause))
        for (case, cause), quantities in causes.items())


def count(rows):
    verdicts = [row["verdict"] for row in rows]
    return "%d gates: %d pass, %d fall short, %d fail" % (
        len(verdicts), verdicts.count("pass"), verdicts.count("falls short"),
        verdicts.count("FAIL"))


def of_suites(rows, suites, kind=None):
    return [row for suite in suites for row in rows.get(suite, [])
            if kind is None or kind_of(suite, row) == kind]


def anchor(heading):
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def text_of(name):
    path = os.path.join(HERE, "text", name + ".md")
    if not os.path.exists(path):
        return ""
    with open(path) as stream:
        return "\n" + stream.read()


def topic_page(name, title, sections, rows):
    out = "# %s\n\nPart of the [verification](../verification.md).\n\n" % title
    for heading, suites in sections:
        out += "## %s\n\n" % heading
        accuracy = [row for suite in suites for row in rows.get(suite, [])
                    if kind_of(suite, row) in ("reference", "order",
                                               "balance")]
        agreement = of_suites(rows, suites, "agreement")
        if accuracy:
            out += write_table(accuracy, True)
        if agreement:
            out += "Agreement of talus with itself:\n\n" + write_table(
                agreement, True)
        out += write_causes(accuracy + agreement)
        if of_suites(rows, suites, "baseline"):
            out += "More gates: [baselines](baselines.md#%s).\n\n" % anchor(
                heading)
        for picture, caption in PICTURES.get(heading, []):
            # The alternative text is a short one: the caption follows.
            alternative = re.split("[.:,]", caption)[0]
            out += "![%s](../figures/%s)\n\n" % (alternative, picture)
            out += paragraph("*%s*" % caption)
    return out.rstrip("\n") + "\n" + text_of(name)


def baseline_page(rows):
    out = ("# Baselines against drift\n\n"
           + paragraph("The gates below hold values of talus itself: what an "
                       "earlier version gave, or that a case does what it is "
                       "made for. A baseline notices a change and says nothing "
                       "about accuracy. Part of the "
                       "[verification](../verification.md)."))
    for _, _, sections in PAGES:
        for heading, suites in sections:
            found = of_suites(rows, suites, "baseline")
            if found:
                out += "## %s\n\n" % heading + write_table(found, False)
                out += write_causes(found)
    return out.rstrip("\n") + "\n"


def entry_of_matrix(rows, kind):
    """Number of gates; for references also the largest relative error."""
    if not rows:
        return ""
    result = "%d" % len(rows)
    if kind == "reference":
        errors = [float(values(row)[2]) for row in rows if values(row)[2]
                  and row["verdict"] == "pass"]
        if errors:
            result += ", to %.2g %%" % max(errors)
    short = sum(row["verdict"] != "pass" for row in rows)
    return result + (", **%d short**" % short if short else "")


def matrix(rows):
    out = "| capability | " + " | ".join(k[1] for k in KINDS) + " |\n"
    out += "|---|" + "---|" * len(KINDS) + "\n"
    for page, _, sections in PAGES:
        for heading, suites in sections:
            cells = ["[%s](verification/%s.md#%s)" % (heading, page,
                                                      anchor(heading))]
            cells += [entry_of_matrix(of_suites(rows, suites, kind), kind)
                      for kind, _, _ in KINDS]
            out += "| " + " | ".join(cells) + " |\n"
    return out + "\n"


def shortfalls(rows):
    out = ("| case | quantity | talus | gate |\n|---|---|---|---|\n")
    pages = page_of()
    for _, _, sections in PAGES:
        for heading, suites in sections:
            for row in of_suites(rows, suites):
                if row["verdict"] != "pass":
                    page = pages[row["suite"]]
                    if kind_of(row["suite"], row) == "baseline":
                        page = "baselines"
                    out += "| [%s](verification/%s.md#%s) | %s | %s | %s |\n" % (
                        cell(row["case"]), page, anchor(heading),
                        cell(row["quantity"]), cell(values(row)[0]),
                        cell(row["gate"]))
    return out + "\n"


def when_measured(rows):
    """Sentences on the days on which the rows were measured."""
    def names(suites):
        return ", ".join("`%s`" % suite for suite in sorted(suites))

    days = sorted({row["measured"] for of in rows.values() for row in of})
    older = {suite for suite, of in rows.items()
             if of[0]["measured"] != days[-1]}
    missing = set(page_of()) - set(rows)
    text = "The rows were measured on %s" % days[-1]
    if older:
        text += "; the suites %s earlier, from %s on" % (names(older), days[0])
    text += "."
    if missing:
        text += " No row has been measured for %s." % names(missing)
    return paragraph(text)


def index_page(rows):
    every = [row for of in rows.values() for row in of]
    out = HEAD + "## Capabilities and evidence\n\n"
    out += count(every) + ".\n\n" + matrix(rows)
    out += "Kinds of evidence, with the number of gates in the table:\n\n"
    for kind, name, explanation in KINDS:
        out += textwrap.fill("* *%s*: %s%s." % (
            name, explanation, "; \"to 2 %\" is the largest relative error "
            "among the gates that are met" if kind == "reference" else ""),
            118, subsequent_indent="  ") + "\n"
    out += "\n" + when_measured(rows)
    out += ("## Where it falls short\n\nGates that are not met, with the cause "
            "on the page of the case:\n\n" + shortfalls(rows))
    return out.rstrip("\n") + "\n" + text_of("index")


def readme_summary(rows):
    every = [row for of in rows.values() for row in of]
    table = [count(every) + ".\n", "| case | quantity | talus | reference | "
             "error | gate |", "|---|---|---|---|---|---|"]
    for suite, start in SUMMARY:
        row = next((row for row in rows.get(suite, [])
                    if row["quantity"].startswith(start)), None)
        if row:
            limit = gate(row)
            if row["verdict"] != "pass":
                limit += ", **%s**" % row["verdict"]
            value, reference, error = values(row)
            table.append("| " + " | ".join(cell(x) for x in (
                row["case"], row["quantity"], value, reference,
                error + " %" if error else "", limit)) + " |")
    return "\n".join(table) + "\n"


def readme_page(rows):
    """README.md with a new summary between the two comments."""
    with open(os.path.join(DOC, "..", "README.md")) as stream:
        text = stream.read()
    begin, end = "<!-- verification: begin -->\n", "<!-- verification: end -->"
    before, rest = text.split(begin)
    return before + begin + readme_summary(rows) + end + rest.split(end)[1]


def all_pages(rows):
    """Contents of all pages by path."""
    pages = {os.path.join(HERE, name + ".md"):
             topic_page(name, title, sections, rows)
             for name, title, sections in PAGES}
    pages[os.path.join(HERE, "baselines.md")] = baseline_page(rows)
    pages[os.path.join(DOC, "verification.md")] = index_page(rows)
    pages[os.path.join(DOC, "..", "README.md")] = readme_page(rows)
    return pages


def suites_of_ctest():
    """Suites with the label `verification`, as tests/cases/CMakeLists.txt finds
    them in the sources, and the slow ones among them, of tests/sets.csv."""
    tests = os.path.join(DOC, "..", "tests")
    suites = set()
    for path in glob.glob(os.path.join(tests, "cases", "*.cc")):
        with open(path) as stream:
            text = stream.read()
        if "Verification" in text:
            suites.update(re.findall(r"^ *TEST\((\w+),", text, re.MULTILINE))
    with open(os.path.join(tests, "sets.csv"), newline="") as stream:
        slow = {row["entry"].split("/")[-1] for row in csv.DictReader(stream)
                if row["set"] == "slow"}
    return suites, slow


def check(rows):
    """Sentences on what is not as the rows and the tests say."""
    for path, content in all_pages(rows).items():
        with open(path) as stream:
            if stream.read() != content:
                yield ("%s is not what doc/verification/report.py --pages "
                       "writes" % os.path.relpath(path, os.path.dirname(DOC)))
    suites, _ = suites_of_ctest()
    for suite in sorted(suites ^ set(page_of())):
        yield ("The suite %s is in only one of tests/cases and PAGES of "
               "doc/verification/topics.py" % suite)


def write_pages(rows):
    for path, content in all_pages(rows).items():
        with open(path, "w") as out:
            out.write(content)


def main():
    if sys.argv[1] == "--check":
        problems = list(check(read_rows()))
        print("\n".join(problems))
        sys.exit(len(problems) > 0)

    options = sys.argv[2:]
    passed = True
    rows = read_rows()
    expected = set(page_of())
    missing = set()
    if sys.argv[1] != "--pages":
        build = os.path.abspath(sys.argv[1])
        folder = os.path.join(build, "results", "verification")
        if "--rows" not in options:
            subprocess.run(["rm", "-rf", folder], check=True)
            passed = run_tests(build, "--without-slow" in options)
        results = read_results(folder)
        rows.update(results)
        if "--rows" not in options:
            missing = expected - set(results)
            if "--without-slow" in options:
                missing -= suites_of_ctest()[1]
        # Needs numpy and matplotlib.
        sys.path.insert(0, os.path.join(DOC, "figures"))
        from verification_plots import draw_all
        draw_all(os.path.join(folder, "series"), os.path.join(DOC, "figures"))
    unknown = sorted(set(rows) - expected)
    for suite in unknown:
        print("The test suite '%s' has no section in topics.py." % suite)
        del rows[suite]
    missing |= expected - set(rows)
    write_rows(rows)
    write_pages(rows)
    every = [row for of in rows.values() for row in of]
    print("doc/verification.md: " + count(every))
    for name in sorted(missing):
        print("No rows of the test suite '%s': it did not run." % name)
    if (not passed or missing or unknown
            or any(row["verdict"] == "FAIL" for row in every)):
        sys.exit(1)


if __name__ == "__main__":
    main()
