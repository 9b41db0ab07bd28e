# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tools around runs of talus: what talus-report and talus-study share."""
