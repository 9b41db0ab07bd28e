# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors that a user can do something about."""

import sys


class UserError(Exception):
    """A whole sentence: what was found, where, and what to do about it."""


def run_tool(name, main):
    """Run main() and return the exit status; a UserError becomes its sentence."""
    try:
        return main()
    except UserError as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 1
