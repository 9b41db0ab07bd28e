# SPDX-License-Identifier: LGPL-2.1-or-later
"""talus-study: an ensemble of runs with varied parameters."""
