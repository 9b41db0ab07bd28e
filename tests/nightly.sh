#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Runs the checks that neither `cmake --workflow --preset test` nor
# `ctest --preset full` has, and prints a table of results and seconds. A step that
# fails does not stop the steps behind it.
#
# Usage: tests/nightly.sh [STEP...]
#        tests/nightly.sh --list
#
# The output of a step is in build/nightly/STEP.log; the end of the log is printed if
# the step fails. Without a STEP all steps run, and a step whose packages are missing
# is skipped; a STEP on the command line then fails. The exit status is 1 if a step
# failed. The environment variable TALUS_CHROOTS is the folder for the chroots of
# Debian (default /tmp/talus-nightly, 10 GB), which need root.
set -u
cd "$(dirname "$0")/.." || exit 1

steps=(lint debug sanitize clang levels slow documentation tidy
  bookworm trixie package)
declare -A purpose=(
  [lint]="layout of the sources, language, links, arrows between rooms"
  [debug]="Debug with the assertions of deal.II: unit tests on 1 to 3 ranks"
  [sanitize]="address and undefined behaviour sanitizers: tests of the readers"
  [clang]="clang 16: unit tests"
  [levels]="three levels of processors: unit tests, installation, a law of a user"
  [slow]="cases of minutes to an hour each: ctest --preset slow"
  [documentation]="HTML of the pages and of the headers, without warnings"
  [tidy]="clang-tidy"
  [bookworm]="first command of README in an empty Debian 12"
  [trixie]="first command of README in an empty Debian 13"
  [package]="the Debian package, built and installed in an empty Debian 12")

logs=build/nightly
chroots=${TALUS_CHROOTS:-/tmp/talus-nightly}
jobs=$(nproc)
# Not 77, with which tests of a step say that something has not been built.
skipped=99
gcc_options=()
launcher=()
if command -v ccache > /dev/null; then
  # GCC tells ccache of precompiled headers only with -fpch-preprocess.
  export CCACHE_SLOPPINESS=pch_defines,time_macros
  launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  gcc_options=("${launcher[@]}" -DCMAKE_CXX_FLAGS=-fpch-preprocess)
fi

# skip REASON: end the step with the status of skipped steps.
skip() {
  echo "$1"
  exit "$skipped"
}

# need COMMAND PACKAGE: skip the step if the command is missing.
need() {
  command -v "$1" > /dev/null ||
    skip "The program $1 was not found; Debian's package $2 has it."
}

# unit_tests BUILD: all entries with the label unit.
unit_tests() {
  ctest --test-dir "$1" -L unit --no-tests=error --output-on-failure -j "$jobs"
}

# own_tree NAME OPTIONS...: configure build/NAME without a preset.
own_tree() {
  local name=$1
  shift
  cmake -S . -B "build/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    "${gcc_options[@]}" "$@"
}

# suites FOLDER...: the suites of unit tests in the folders, as a filter of gtest.
suites() {
  local names
  names=$(cd tests/unit && find "$@" -name '*.cc' -exec \
    sed -nE 's/^ *TEST(_F|_P)?\((\w+),.*/\2/p' {} + | sort -u)
  if [ -z "$names" ]; then
    echo "No unit tests were found in $*." >&2
    return 1
  fi
  # shellcheck disable=SC2086
  printf '%s.*:' $names
}

# bare SUITE WHAT: a new chroot, and tests/bare-debian.sh in it.
bare() {
  local folder=$chroots/$1-$2
  need mmdebstrap mmdebstrap
  [ "$(id -u)" = 0 ] || skip "A chroot needs root."
  if grep -q " $folder" /proc/mounts; then
    echo "'$folder' has mounted file systems; unmount them first."
    exit 1
  fi
  mkdir -p "$chroots"
  rm -rf --one-file-system "$folder" "$folder.package"
  tests/bare-debian.sh "$1" "$folder" "$2"
}

step_lint() {
  need clang-format clang-format
  tests/lint.sh
}

step_debug() {
  cmake --preset debug "${gcc_options[@]}"
  cmake --build --preset debug
  ctest --preset debug --no-tests=error -j "$jobs"
}

# The preset has flags of its own.
step_sanitize() {
  local filter
  filter=$(suites base io checkpoint geometry)
  cmake --preset sanitize "${launcher[@]}"
  cmake --build --preset sanitize
  ASAN_OPTIONS=detect_leaks=0 build/sanitize/tests/talus-unit \
    --gtest_filter="$filter"
}

step_clang() {
  need clang++-16 clang-16
  cmake --preset clang "${launcher[@]}"
  cmake --build --preset clang
  unit_tests build/clang
}

# The unit tests run on the first level, x86-64-v2.
step_levels() {
  own_tree levels -DTALUS_NATIVE=OFF -DTALUS_PYTHON=OFF
  cmake --build build/levels --target talus talus-unit talus-width
  unit_tests build/levels
  python3 tests/cases/installed_set.py build/levels . $logs/installed-set
  python3 tests/cases/own_law.py build/levels $logs/own-law ${launcher[0]:+ccache}
  python3 tests/width/whole_runs.py levels build/levels --program build/levels/talus
}

# The options of this tree stay as they are: it is the tree of the quick tests.
step_slow() {
  cmake --preset test
  cmake --build --preset test
  ctest --preset slow --no-tests=error
}

step_documentation() {
  need doxygen doxygen
  need bibtex texlive-binaries
  [ -e /usr/share/javascript/mathjax/MathJax.js ] ||
    skip "MathJax was not found; Debian's package libjs-mathjax has it."
  cmake --preset release
  cmake --build build/release --target documentation
}

step_tidy() {
  need clang-tidy-16 clang-tidy-16
  cmake --preset release
  cmake --build build/release --target tidy
}

step_bookworm() {
  bare bookworm first
}

step_trixie() {
  bare trixie first
}

step_package() {
  bare bookworm package
}

# run_step STEP: set `result`, and print the end of the log of a failure.
run_step() {
  local log=$logs/$1.log status
  echo "$1: ${purpose[$1]} ..."
  (set -e; "step_${1//-/_}") > "$log" 2>&1 < /dev/null
  status=$?
  result=passed
  if [ "$status" = "$skipped" ] && [ "$named" = no ]; then
    result="skipped: $(tail -n 1 "$log")"
  elif [ "$status" != 0 ]; then
    result=failed
    tail -n 40 "$log"
    echo "$1 failed with status $status; all of the output is in $log"
  fi
}

list_steps() {
  local step
  for step in "${steps[@]}"; do
    printf '%-14s %s\n' "$step" "${purpose[$step]}"
  done
}

named=no
case ${1:-} in
  --list)
    list_steps
    exit 0 ;;
  "") ;;
  *)
    for step in "$@"; do
      if [ -z "${purpose[$step]:-}" ]; then
        echo "tests/nightly.sh has no step '$step'; the steps are ${steps[*]}." >&2
        exit 2
      fi
    done
    named=yes
    steps=("$@") ;;
esac

mkdir -p $logs
failures=0
table=
for step in "${steps[@]}"; do
  begin=$SECONDS
  run_step "$step"
  [ "$result" = failed ] && failures=$((failures + 1))
  table+=$(printf '%-14s %7d  %s' "$step" $((SECONDS - begin)) "$result")$'\n'
done
printf '\n%-14s %7s  %s\n%s' step seconds result "$table"
[ "$failures" = 0 ]
