# SPDX-License-Identifier: LGPL-2.1-or-later
"""A case of talus from a raster of heights and the outline of a release area."""
