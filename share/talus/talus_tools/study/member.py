# SPDX-License-Identifier: LGPL-2.1-or-later
"""One member: its files, its state, and how it is run."""

import ctypes
import fcntl
import hashlib
import json
import os
import re
import signal
import subprocess
import time

from talus_tools.parameters import as_text, expand
from talus_tools.report.log import Log
from talus_tools.texts import LENIENT

FINISHED, FAILED, STARTED, STOPPED, WAITING = ("finished", "failed", "started", "stopped",
                                               "waiting")
CHECKPOINT_STATUS = 75  # of talus, when it stopped with a checkpoint
VALUE = re.compile(r"^(\s*set\s[^=\n]*=\s*(?:table\s+)?)([^#\n]*[^#\s])", re.MULTILINE)
PATIENCE = 60  # with a run that is about to end [s]
SET_PARENT_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of prctl(2)


def stop_with_parent():
    """In the child: when the study is killed, the run gets SIGTERM, and writes a checkpoint."""
    ctypes.CDLL(None).prctl(SET_PARENT_DEATH_SIGNAL, signal.SIGTERM)


def with_absolute_paths(text, folder):
    """A parameter file with the files that it names, such as rasters and tables, which talus
    looks for in the file's own folder, by their whole paths; and these paths."""
    paths = []

    def replace(found):
        """The line with the whole path."""
        path = os.path.abspath(os.path.join(folder, found[2]))
        if not os.path.isfile(path):
            return found[0]
        paths.append(path)
        return found[1] + path

    return VALUE.sub(replace, text), paths


def digest(version, text, paths):
    """SHA-256 of all that a result depends on: program, parameters, content of other files."""
    result = hashlib.sha256(version.encode() + text.encode())
    for path in paths:
        with open(path, "rb") as stream:
            result.update(hashlib.sha256(stream.read()).digest())
    return result.hexdigest()


def written(value):
    """A number as text for a parameter file, with all digits. A whole number has no point, since
    it may be the value of an entry that counts, such as a seed."""
    return repr(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)


class Member:
    """Number, varied values and folder of a member; `hash` is that of all that its results
    depend on."""

    def __init__(self, settings, number, values, version):
        self.settings, self.number, self.values = settings, number, [float(v) for v in values]
        self.name = f"member-{number:04d}"
        self.folder = os.path.join(settings.folder, self.name)
        varied = {one.parameter: one.template.replace("{}", written(value))
                  for one, value in zip(settings.varied, self.values)}
        text = (f"# {self.name} of a study: the case with its includes, then what differs "
                f"from it.\n{expand(settings.case)}\n\n# For all members:\n"
                f"{as_text(settings.fixed)}\n# Varied:\n{as_text(varied)}")
        self.text, paths = with_absolute_paths(text, os.path.dirname(settings.case))
        self.hash = digest(version, text, paths)
        self.process = None

    def path(self, name):
        """Path of one of its files."""
        return os.path.join(self.folder, name)

    def state(self):
        """(status, reason) of this very member; of another one in its folder nothing counts."""
        try:
            with open(self.path("member.json"), encoding="utf-8") as stream:
                state = json.load(stream)
        except (OSError, ValueError):
            return WAITING, ""
        return (state["status"], state["reason"]) if state.get("hash") == self.hash else (
            WAITING, "")

    def write_state(self, status, reason=""):
        """At once or not at all."""
        with open(self.path("member.json.part"), "w", encoding="utf-8") as stream:
            json.dump({"hash": self.hash, "status": status, "reason": reason}, stream, indent=1)
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(self.path("member.json.part"), self.path("member.json"))

    def has_checkpoint(self):
        """Whether talus can go on."""
        folder = self.path("checkpoints")
        return os.path.isdir(folder) and any(name.isdigit() for name in os.listdir(folder))

    def wait_for_lock(self):
        """A run whose study was killed may still be writing its checkpoint."""
        end = time.monotonic() + PATIENCE
        while os.path.exists(self.path("lock")) and time.monotonic() < end:
            with open(self.path("lock"), "rb") as stream:
                try:
                    fcntl.flock(stream, fcntl.LOCK_SH | fcntl.LOCK_NB)
                    return
                except BlockingIOError:
                    time.sleep(0.05)

    def remove_results(self):
        """Remove the log, by which has_ended() knows that this run came to its end, and the
        tables and maps of the quantities, which may be those of another member."""
        for name in {"log.txt"}.union(*(one.files() for one in self.settings.quantities)):
            if os.path.exists(self.path(name)):
                os.remove(self.path(name))

    def start(self):
        """Start it; one that was interrupted goes on from its checkpoint."""
        status, _ = self.state()
        os.makedirs(self.folder, exist_ok=True)
        self.wait_for_lock()
        resume = status in (STARTED, STOPPED) and self.has_checkpoint()
        with open(self.path("member.prm"), "w", encoding="utf-8") as stream:
            stream.write(self.text)
        if not resume:
            self.remove_results()
        self.write_state(STARTED)
        command = [*self.settings.launcher, self.settings.program, self.path("member.prm"),
                   "--output", self.folder, "--resume" if resume else "--overwrite"]
        with open(self.path("errors.txt"), "wb") as errors:
            # pylint: disable-next=subprocess-popen-preexec-fn,consider-using-with
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=errors,
                                            stdout=subprocess.DEVNULL, preexec_fn=stop_with_parent)

    def reason(self, code):
        """Why it failed: what talus said last, or the signal that killed it."""
        with open(self.path("errors.txt"), **LENIENT) as stream:
            lines = [line.strip() for line in stream if line.strip()]
        said = [line for line in lines if line.startswith("talus: ")] or lines
        if said:
            return said[-1].removeprefix("talus: ")
        if code == 0:
            return ("exit status 0, but log.txt does not say that the run came to its end: the "
                    "launcher did not run talus, or lost its exit status")
        return f"killed by signal {-code}" if code < 0 else f"exit status {code} without a message"

    def has_ended(self):
        """Whether the log says that the run came to its end. The exit status is that of the
        launcher, which may have run nothing."""
        try:
            with open(self.path("log.txt"), **LENIENT) as stream:
                return Log(stream.read()).has_ended()
        except OSError:
            return False

    def finish(self, was_asked_to_stop):
        """Record how the process ended, and return the status."""
        code = self.process.returncode
        status = {0: FINISHED, CHECKPOINT_STATUS: STOPPED}.get(code, FAILED)
        if status == FINISHED and not self.has_ended():
            status = FAILED
        # In its first moments a run does not yet listen to signals, which then end it.
        if was_asked_to_stop and code < 0:
            status = STOPPED
        self.write_state(status, self.reason(code) if status == FAILED else "")
        return status
