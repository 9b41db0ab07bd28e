# SPDX-License-Identifier: LGPL-2.1-or-later
"""Source of a tsunami model from the plan series of a run."""
