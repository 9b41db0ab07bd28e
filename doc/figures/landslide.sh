#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Pictures of one landslide: landslide.png and runout.png, in the folder that
# holds its output.
#
#   doc/figures/landslide.sh FOLDER
#
# Needs Debian's package python3-matplotlib.
set -eu

if [ $# -ne 1 ] || [ ! -f "$1/points.pvd" ]; then
  echo "Usage: $0 FOLDER, where FOLDER holds the output of talus (points.pvd," \
       "statistics.csv)." >&2
  exit 1
fi
here=$(dirname "$0")

/usr/bin/python3 "$here/runout.py" "$1/runout.png" "$1"
/usr/bin/python3 "$here/landslide.py" "$1" "$1/landslide.png"
