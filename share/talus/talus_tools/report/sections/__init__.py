# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of the page. Each is a function of the run that returns a Section, or None where the
run has no files for it; contents.py has their order."""
