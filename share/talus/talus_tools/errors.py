# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors that a user can do something about."""

import argparse
import math
import sys


class UserError(Exception):
    """A whole sentence: what was found, where, and what to do about it."""


class Parser(argparse.ArgumentParser):
    """Of options; what is wrong with them is a sentence like all others."""

    def error(self, message):
        """Exit status 1 by run_tool() instead of argparse's 2, which is no sentence."""
        raise UserError(f"The options cannot be understood: {message}. See {self.prog} --help.")


def positive(text):
    """A finite number above zero."""
    value = float(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is no number above 0")
    return value


def number_of(text):
    """A finite number, not below zero."""
    value = float(text)
    if not 0 <= value < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' is no number of 0 or above")
    return value


def run_tool(name, main):
    """Run main() and return the exit status; a UserError becomes its sentence."""
    for stream in (sys.stdout, sys.stderr):
        # Names of files may have bytes, and numbers signs, that a terminal has not.
        is_unicode = stream.encoding.lower().startswith("utf")
        stream.reconfigure(errors="surrogateescape" if is_unicode else "replace")
    try:
        return main()
    except UserError as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 1
