#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# What README promises a newcomer, on a Debian with nothing installed: a chroot made
# by mmdebstrap. As root; the folder is kept, so that a second time takes minutes.
#
# Usage: tests/bare-debian.sh SUITE FOLDER WHAT [PATTERN]
#   SUITE    bookworm (Debian 12) or trixie (Debian 13)
#   WHAT     first    README's first command, with the seconds at each of its steps
#            second   README's second command: the tests
#            unit     the unit tests, or those that ctest's PATTERN fits
#            package  builds the .deb, installs it in another such chroot,
#                     FOLDER.package, runs the slide with it, starts each tool
#                     and writes a report
set -eu
usage="Usage: tests/bare-debian.sh bookworm|trixie FOLDER first|second|unit|package [PATTERN]"
suite=${1:?"$usage"}
folder=${2:?"$usage"}
what=${3:?"$usage"}
selection="-L unit"
if [ $# -ge 4 ]; then
  selection="-R '$4'"
fi
root=$(cd "$(dirname "$0")/.." && pwd)
first=$(sed -n '/^```sh/,/^```/{/^```$/q; /^```/d; s/sudo //g; p}' "$root/README.md")
second=$(sed -n '/^cmake --workflow --preset test/p' "$root/README.md")
install=$(echo "$first" | sed '/&&$/q' | sed 's/&&$//')
if [ -z "$install" ] || [ -z "$second" ]; then
  echo "$0: README.md has no line that installs packages, or no line that tests" >&2
  exit 1
fi

# Without /proc deal.II 9.6 loops for ever when it asks for its memory; without /sys
# MPI complains.
mounted=
trap 'for folder in $mounted; do
  umount -l "$folder/proc" "$folder/dev" "$folder/sys"; done' EXIT
make_bare() {
  test -e "$1/etc" || mmdebstrap --variant=minbase "$suite" "$1"
  mounted="$mounted $1"
  mount -t proc proc "$1/proc"
  mount -t sysfs sysfs "$1/sys"
  mount --rbind /dev "$1/dev"
  mount --make-rslave "$1/dev"
}

# Each command is printed with the seconds since the start of the first. bash goes on
# behind a failure within a list of &&, unless the list is in parentheses.
run_in() {
  chroot "$1" env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    DEBIAN_FRONTEND=noninteractive \
    bash -ec "PS4='+ \$SECONDS s: '; cd /talus; set -x; $2"
}

make_bare "$folder"
mkdir -p "$folder/talus"
# Sources of an earlier time may be gone here.
find "$folder/talus" -mindepth 1 -maxdepth 1 ! -name build ! -name output \
  -exec rm -rf {} +
tar -C "$root" --exclude=./build --exclude=./output --exclude=./.git -cf - . |
  tar -C "$folder/talus" -xf -
case $what in
  first)
    run_in "$folder" "($first)
      : the end" ;;
  second)
    run_in "$folder" "($install)
      $second" ;;
  unit)
    run_in "$folder" "($install)
      cmake --preset test
      cmake --build --preset test --target talus talus-unit talus-width
      ctest --test-dir build/test $selection --no-tests=error --output-on-failure" ;;
  package)
    run_in "$folder" "($install)
      apt-get install -y --no-install-recommends file dpkg-dev
      cmake --preset dist
      cmake --build --preset dist
      cd build/dist
      rm -f talus_*.deb
      cpack"
    make_bare "$folder.package"
    mkdir -p "$folder.package/talus"
    rm -f "$folder.package"/talus/talus_*.deb
    cp "$folder"/talus/build/dist/talus_*.deb "$folder.package/talus"
    run_in "$folder.package" "apt-get update
      apt-get install -y --no-install-recommends ./talus_*.deb
      talus --version
      talus /usr/share/talus/prm/landslide-quick.prm --set Splitting/Directions=stretched --set Splitting/Shear=ignored
      tail -n 1 output/landslide-quick/statistics.csv
      apt-get install -y --no-install-recommends \
        \$(dpkg-query -W -f='\${Recommends}' talus | tr -d ,)
      for tool in /usr/bin/talus-*; do \$tool --help > /dev/null; done
      talus-report output/landslide-quick
      ls -l output/landslide-quick/report.html" ;;
  *)
    echo "$usage" >&2
    exit 2 ;;
esac
