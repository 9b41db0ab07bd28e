# SPDX-License-Identifier: LGPL-2.1-or-later
"""Deflection and bending of a pipeline in a slide, by a beam on soil springs."""
