# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run a part of the unit tests in one process, or in one start of MPI.

Usage: run_tests.py PROGRAM [--part I/N] [--ranks N LAUNCHER...]

A process loads 200 libraries before the first test, so that one process for each
suite costs more than most suites. Part I of N has every N-th test. With --ranks the
tests that TALUS_ALSO_ON_RANKS names for N ranks run, started by LAUNCHER N. A test
that crashes, or prints nothing for TALUS_TEST_SECONDS (300), is named as a failure,
and the tests behind it run in a new process. Ends with 1 if a test fails.
"""

import os
import re
import selectors
import signal
import subprocess
import sys

TEST_NAME = re.compile(r"\[ RUN +\] (\S+)")
FAILED_NAME = re.compile(r"\[  FAILED  \] (\w+\.\w+)")
# Lines of each test that passes.
ROUTINE = re.compile(
    r"\[ RUN  |\[       OK |\[-{10}\]|\[={10}\]|\[  PASSED  \]|Note: |\s*$")


def names_of_tests(program, ranks):
    """Names of the tests that run on this number of ranks."""
    lines = subprocess.run([program, "--list-tests"], check=True, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    table = [line.split() for line in lines]
    return [name for name, *numbers in table if str(ranks) in numbers]


class Process:
    """One start of the program, with tests by name."""

    def __init__(self, command, tests):
        self.running = None
        self.failed = set()
        self.limit = float(os.environ.get("TALUS_TEST_SECONDS", 300))
        self.process = subprocess.Popen(
            [*command, "--gtest_color=no", "--gtest_filter=" + ":".join(tests)],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            start_new_session=True)

    def follow(self):
        """Read the output to its end; True unless it stopped for too long."""
        selector = selectors.DefaultSelector()
        selector.register(self.process.stdout, selectors.EVENT_READ)
        descriptor, rest = self.process.stdout.fileno(), b""
        while selector.select(self.limit):
            data = os.read(descriptor, 1 << 16)
            *lines, rest = (rest + data).split(b"\n")
            for line in lines + ([rest] if not data else []):
                self.read(line.decode(errors="replace"))
            if not data:
                return True
        return False

    def read(self, line):
        if match := TEST_NAME.search(line):
            self.running = match.group(1)
        if match := FAILED_NAME.search(line):
            self.failed.add(match.group(1))
        if not ROUTINE.match(line):
            print(line, flush=True)

    def end(self):
        """Stop the processes of all ranks, which mpirun ends when told to."""
        self.process.terminate()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()


def run(command, tests):
    """Names of the tests that fail; starts again behind a crash."""
    failed = []
    while tests:
        process = Process(command, tests)
        finished = process.follow()
        if not finished:
            process.end()
        status = process.process.wait()
        failed += [name for name in tests if name in process.failed]
        if status in (0, 1) and finished:
            if status == 1 and not process.failed:
                failed.append("%s (status 1 without a named test)" % tests[0])
            return failed
        guilty = process.running or tests[0]
        failed.append("%s (%s)" % (
            guilty, "ended with status %d" % status if finished
            else "no output for %.0f s" % process.limit))
        tests = tests[tests.index(guilty) + 1:]
    return failed


def main():
    program, *options = sys.argv[1:]
    part, n_parts, ranks, launcher = 1, 1, 1, []
    if options and options[0] == "--part":
        part, n_parts = map(int, options[1].split("/"))
    elif options:
        ranks, launcher = int(options[1]), [*options[2:], options[1]]
    tests = names_of_tests(program, ranks)[part - 1::n_parts]
    if not tests:
        print("run_tests.py: no test of %s runs on %d ranks; expected at least "
              "one. Correct the number of ranks." % (program, ranks))
        return 1
    failed = run([*launcher, program], tests)
    print("%d tests on %d rank(s), %d failed%s" % (
        len(tests), ranks, len(failed),
        "".join("\n  FAILED: " + name for name in failed)))
    return len(failed) > 0


if __name__ == "__main__":
    sys.exit(main())
