# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that several suites read: computed unless the same run is there already.

Usage: shared_run.py TALUS PRM FOLDER [SETTING...]

The results go to FOLDER, without fields. FOLDER.json says which program and input
they are of, and is written when the run has ended well.
"""

import json
import pathlib
import shutil
import subprocess
import sys

QUIET = ["Output/Write points=false", "Output/Write grid=false",
         "Output/Write obstacles=false"]


def main():
    talus, file, folder = map(pathlib.Path, sys.argv[1:4])
    settings = [*QUIET, *sys.argv[4:]]
    program = talus.stat()
    key = json.dumps({"program": [str(talus), program.st_size, program.st_mtime_ns],
                      "input": file.read_text(), "settings": settings})
    stamp = folder.with_suffix(".json")
    if stamp.exists() and stamp.read_text() == key and folder.exists():
        print("The results of the same program and input are in", folder)
        return 0
    stamp.unlink(missing_ok=True)
    shutil.rmtree(folder, ignore_errors=True)
    options = [option for s in settings for option in ("--set", s)]
    status = subprocess.run([talus, file, *options, "--output", folder]).returncode
    if status == 0:
        stamp.write_text(key)
    return status


if __name__ == "__main__":
    sys.exit(main())
