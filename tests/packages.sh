#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Installs the packages that README names, and those given as arguments.
set -euo pipefail
cd "$(dirname "$0")/.."
export DEBIAN_FRONTEND=noninteractive

packages=$(sed -n '/^sudo apt-get update/,/[^\\]$/p' README.md | tr -d '\\\n' |
  sed -n 's/.*--no-install-recommends \([^&]*\)&&.*/\1/p')
if [ -z "$packages" ]; then
  echo "$0: the line of README.md that installs packages was not found" >&2
  exit 1
fi

apt-get update
# shellcheck disable=SC2086
apt-get install -y --no-install-recommends $packages "$@"
