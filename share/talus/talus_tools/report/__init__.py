# SPDX-License-Identifier: LGPL-2.1-or-later
"""One page about one run: report.html."""
