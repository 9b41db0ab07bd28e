# SPDX-License-Identifier: LGPL-2.1-or-later
"""talus-compare: two runs side by side."""
