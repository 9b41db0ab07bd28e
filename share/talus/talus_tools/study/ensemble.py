# SPDX-License-Identifier: LGPL-2.1-or-later
"""All members: which are to run, some at once, until all have ended."""

import fcntl
import os
import shutil
import signal
import subprocess
import time

from talus_tools.errors import UserError
from talus_tools.study.design import design
from talus_tools.study.member import FAILED, FINISHED, Member


def program_version(settings):
    """What the program says of itself; results of another one are not taken for its own."""
    if shutil.which(settings.program) is None:
        raise UserError(f"The program '{settings.program}' was not found. Give its path as "
                        "'Program' in the study file, or with --program.")
    result = subprocess.run([settings.program, "--version"], capture_output=True, text=True,
                            errors="replace", check=False)
    # MPI and its libraries may have something to say, too.
    lines = [line for line in result.stdout.splitlines() if line.startswith("talus ")]
    if result.returncode != 0 or not lines:
        raise UserError(f"'{settings.program} --version' did not tell the version of talus: "
                        f"{(result.stderr or result.stdout).strip()[:200]}.")
    return lines[0]


def make_members(settings, version):
    """All members of the design."""
    return [Member(settings, i + 1, values, version)
            for i, values in enumerate(design(settings))]


def lock(folder):
    """A file locked as long as it is open, so that one study runs in a folder."""
    try:
        os.makedirs(folder, exist_ok=True)
        stream = open(os.path.join(folder, "lock"), "a", encoding="utf-8")
    except OSError as error:
        raise UserError(f"The folder '{folder}' cannot be made or written ({error.strerror}). "
                        "Choose another one with 'Output folder' or --output.") from None
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise UserError(f"Another talus-study is running in '{folder}'. Wait for it, or stop it "
                        "with SIGTERM.") from None
    return stream


class Stop:
    """SIGTERM, SIGINT and SIGUSR1 let the runs write checkpoints and end."""

    def __init__(self):
        self.asked = False
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1):
            signal.signal(number, self.ask)

    def ask(self, *_):
        """Remember; the loop does the rest."""
        self.asked = True


class ColumnCheck:
    """Checks the names in the quantities as soon as any member has written its tables, and takes
    the numbers of the first finished member: an error then ends the study before further members
    run."""

    def __init__(self, quantities):
        self.pending, self.untried = list(quantities), list(quantities)

    def __call__(self, member, has_finished=False):
        """Throw a UserError if this member has no column or map of a name, or has finished without
        a number."""
        self.pending = [quantity for quantity in self.pending
                        if not quantity.is_found(member, has_finished)]
        if has_finished:
            for quantity in self.untried:
                quantity.value(member)
            self.untried = []


def run_members(members, at_once, quantities):
    """Run those that have not finished. A run that is stopped can be resumed."""
    waiting = [m for m in members if m.state()[0] != FINISHED]
    n_done, running, stop, told = len(members) - len(waiting), [], Stop(), False
    check, error = ColumnCheck(quantities), None
    if n_done:
        print(f"{n_done} of {len(members)} members have finished before.", flush=True)
        check(next(m for m in members if m not in waiting), has_finished=True)
    while running or (waiting and not stop.asked):
        while waiting and len(running) < at_once and not stop.asked:
            running.append(waiting.pop(0))
            running[-1].start()
        if stop.asked and not told:
            for member in running:
                member.process.terminate()
            told = True
        for member in list(running):
            has_ended = member.process.poll() is not None
            status = member.finish(stop.asked) if has_ended else ""
            try:
                check(member, status == FINISHED)
            except UserError as found:
                stop.asked, error = True, found
            if not has_ended:
                continue
            running.remove(member)
            n_done += status == FINISHED
            why = f": {member.state()[1]}" if status == FAILED else ""
            print(f"{member.name} {status}{why} ({n_done} of {len(members)} finished)", flush=True)
        time.sleep(0.02)
    if error:
        raise error
