# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameters of a study that fit an observed deposit."""
