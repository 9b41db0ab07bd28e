#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Builds talus and passes the unit tests on Debian 13, in a chroot made by
# mmdebstrap: deal.II 9.6, HDF5 1.14, GCC 14. As root; the folder is kept, so that a
# second time takes minutes.
#
# Usage: tests/debian-13.sh FOLDER [PATTERN of ctest, unit/ by default]
set -eu
folder=${1:?"Usage: tests/debian-13.sh FOLDER [PATTERN]"}
pattern=${2:-^unit/}
root=$(cd "$(dirname "$0")/.." && pwd)
packages=$(sed -n '/^sudo apt-get update/,/[^\\]$/p' "$root/README.md" | tr -d '\\\n' |
  sed -n 's/.*--no-install-recommends \([^&]*\)&&.*/\1/p' | tr -s ' ' ',')

test -e "$folder/etc" ||
  mmdebstrap --variant=minbase --include="$packages" trixie "$folder"
mkdir -p "$folder/talus"
tar -C "$root" --exclude=./build --exclude=./output --exclude=./.git -cf - . |
  tar -C "$folder/talus" -xf -

# Without /proc deal.II 9.6 loops for ever when it asks for its memory; without /sys
# MPI complains.
trap 'umount -l "$folder/proc" "$folder/dev" "$folder/sys"' EXIT
mount -t proc proc "$folder/proc"
mount -t sysfs sysfs "$folder/sys"
mount --rbind /dev "$folder/dev"
mount --make-rslave "$folder/dev"
chroot "$folder" env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 sh -c "
  cd /talus && cmake --preset release &&
  cmake --build --preset release --target talus talus-unit &&
  ctest --test-dir build/release -R '$pattern' --output-on-failure"
