#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Checks what needs no build: layout of the C++ files, language of comments and
# pages, links, the arrows between rooms, syntax of scripts. With --fix the C++
# files are laid out first.
set -euo pipefail
cd "$(dirname "$0")/.."

mapfile -t sources < <(git ls-files '*.h' '*.cc')
if [ "${1:-}" = --fix ]; then
  clang-format -i "${sources[@]}"
fi
clang-format --dry-run -Werror "${sources[@]}"
if grep -nE '^.{81,}' "${sources[@]}"; then
  echo "tests/lint.sh: the lines above have more than 80 columns" >&2
  exit 1
fi
python3 tests/language.py .
python3 tests/links.py .
cmake -D ROOT="$PWD" -P tests/include_arrows.cmake
git ls-files '*.py' | xargs python3 -m py_compile
git ls-files '*.sh' .ci/run | xargs -n 1 bash -n
