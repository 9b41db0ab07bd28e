# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hold a program to the results of another one, bit by bit: for refactorings.

Usage: same_results.py BEFORE AFTER FOLDER [--case NAME ...] [--rename OLD=NEW ...]

BEFORE and AFTER are two programs talus for the same processor, FOLDER is for
their results; those of BEFORE are kept there and used again. Each case below is
run on 1 and 2 ranks. Compared are all tables (CSV), the decoded arrays of all
VTU files, and the points and numbers of the checkpoints; of times that the
clock told, only that they are there. --rename says that a column, array or
entry that was called OLD is to be called NEW. Ends with 1 and one line per
difference.
"""

import argparse
import base64
import csv
import pathlib
import shutil
import struct
import subprocess
import sys
import xml.etree.ElementTree
import zlib

import h5py
import numpy as np

PRM = pathlib.Path(__file__).resolve().parents[2] / "prm"
COARSE = ["Grid/Cell size=0.8"]
CHECKPOINT = ["Checkpoint/At the end=true"]
TRACKING = ["Mesh tracking/Enabled=true", "Mesh tracking/Margin=6",
            "Mesh tracking/Interval=100", "Grid/Coarsest level=4"]
WALL_TIMES = {"wall time [s]", "time of linear solver [s]"}

# Name: file and settings.
CASES = {
    "bar": ("bar.prm", []),
    "slide": ("landslide-quick.prm", ["End time=10"]),
    "slide-stretched": ("landslide-quick.prm",
                        ["End time=10", "Splitting/Directions=stretched",
                         "Splitting/Shear=ignored"]),
    "trigger": ("landslide-trigger.prm", COARSE + ["End time=6"]),
    "filtered": ("landslide-quick.prm",
                 COARSE + ["End time=4", "Transfer/Scheme=filtered FLIP"]),
    "3d": ("landslide-3d.prm", ["End time=1", "Grid/Cell size=1.2"]),
    "graded": ("landslide-quick.prm",
               COARSE + ["End time=4",
                         "Grid/Refinement boxes=30, 0; 60, 4; 1"]),
    "tracked": ("landslide-quick.prm", COARSE + ["End time=4"] + TRACKING),
    "herschel-bulkley": ("verification/herschel-bulkley-layer.prm",
                         ["End time=4"]),
    "convected": ("verification/cantilever.prm", ["End time=0.3"]),
    "block": ("verification/block-on-incline.prm", []),
    "slope": ("slope.prm", ["Grid/Cell size=10", "End time=20"]),
}
# Cases that are also interrupted by the end time and resumed.
RESUMED = {"slide": "End time=12", "tracked": "End time=5"}


def run(talus, folder, ranks, file, settings, options=()):
    launcher = (["mpirun", "--allow-run-as-root", "--oversubscribe",
                 "-np", str(ranks)] if ranks > 1 else [])
    sets = [o for s in settings for o in ("--set", s)]
    result = subprocess.run(
        [*launcher, talus, *sets, "--output", folder, *options, PRM / file],
        capture_output=True, text=True)
    if result.returncode:
        sys.exit(f"{folder}: talus ended with {result.returncode}: "
                 f"{result.stderr}")


def run_case(talus, folder, name, ranks):
    """Run a case, and go on with it, unless its results are there."""
    if (folder / "done").exists():
        return
    shutil.rmtree(folder, ignore_errors=True)
    file, settings = CASES[name]
    run(talus, folder, ranks, file, settings + CHECKPOINT, ["--overwrite"])
    if name in RESUMED:
        run(talus, folder, ranks, file,
            settings + CHECKPOINT + [RESUMED[name]], ["--resume"])
    (folder / "done").touch()


def table(path):
    with open(path, newline="") as lines:
        names, *rows = list(csv.reader(lines))
    return {name: [row[i] for row in rows] for i, name in enumerate(names)
            if name not in WALL_TIMES}


def inflate(text):
    """VTK's blocks: a header of its own in base64, then the blocks."""
    n_blocks, size, last = struct.unpack(
        "<3I", base64.b64decode(text[:16]))
    header = base64.b64decode(
        text[:4 * ((4 * (3 + n_blocks) + 2) // 3)])
    sizes = struct.unpack(f"<{n_blocks}I", header[12:12 + 4 * n_blocks])
    body = base64.b64decode(text[4 * ((4 * (3 + n_blocks) + 2) // 3):])
    at, result = 0, b""
    for n in sizes:
        result += zlib.decompress(body[at:at + n])
        at += n
    return result


def vtu(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    compressed = root.get("compressor") is not None
    result = {}
    for section in root.iter():
        for array in section.findall("DataArray"):
            text = (array.text or "").strip()
            is_packed = (compressed and text and
                         array.get("format") == "binary")
            # Each rank has a piece with the same arrays.
            result.setdefault(f"{section.tag}/{array.get('Name')}", []).append(
                inflate(text) if is_packed else text)
    return result


def hdf5(path):
    result = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            result[name] = np.asarray(item[()]).tobytes()
    with h5py.File(path) as file:
        file.visititems(visit)
    return result


def contents(path):
    if path.suffix == ".csv":
        return table(path)
    if path.suffix == ".vtu":
        return vtu(path)
    if path.suffix == ".h5":
        return hdf5(path)
    return {"bytes": path.read_bytes()}


def files(folder):
    return sorted(p.relative_to(folder) for p in folder.rglob("*")
                  if p.suffix in (".csv", ".vtu", ".h5", ".data"))


# What a checkpoint tells of the program and the moment, not of the soil.
UNLIKE = {"head/git revision", "head/talus version", "parameters"}


def differences(before, after, renamed):
    """Sentences on what the two folders do not have in common."""
    if files(before) != files(after):
        odd = set(files(before)) ^ set(files(after))
        yield f"files differ: {', '.join(sorted(map(str, odd)))}"
    for path in files(before):
        if not (after / path).exists():
            continue
        a, b = contents(before / path), contents(after / path)
        a = {renamed.get(name, name): value for name, value in a.items()}
        for name in a.keys() | b.keys():
            if name in UNLIKE:
                continue
            if name not in a or name not in b:
                yield (f"{path}: '{name}' is only "
                       f"{'before' if name in a else 'after'}")
            elif a[name] != b[name]:
                yield f"{path}: '{name}' differs"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--case", action="append", choices=CASES)
    parser.add_argument("--rename", action="append", default=[])
    arguments = parser.parse_args()
    renamed = dict(pair.split("=", 1) for pair in arguments.rename)
    n_differences = 0
    shutil.rmtree(arguments.folder / "after", ignore_errors=True)
    for name in arguments.case or CASES:
        for ranks in (1, 2):
            folders = [arguments.folder / when / f"{name}-{ranks}"
                       for when in ("before", "after")]
            for talus, folder in zip((arguments.before, arguments.after),
                                     folders):
                run_case(talus.resolve(), folder, name, ranks)
            found = list(differences(*folders, renamed))
            n_differences += len(found)
            print(f"{name}, {ranks} rank{'s' * (ranks > 1)}: "
                  f"{'the same' if not found else ''}", flush=True)
            for sentence in found:
                print("  " + sentence)
    return n_differences > 0


if __name__ == "__main__":
    sys.exit(main())
