# SPDX-License-Identifier: LGPL-2.1-or-later
"""Entries of a parameter file of a tool, with defaults and checks."""

import math

from talus_tools.errors import UserError


class Entries:
    """Base of the settings of a tool: `entries` as read from the file `path`, by the names of
    `defaults`. An entry without a default is empty."""

    def __init__(self, path, entries, defaults):
        self.path, self.entries, self.defaults = path, entries, defaults

    def default(self, name):
        """Default of an entry."""
        return self.defaults[name]

    def get(self, name):
        """Value of an entry or its default."""
        return self.entries.get(name, self.default(name)).strip()

    def error(self, name, expected):
        """Error about the value of an entry."""
        return UserError(f"'{self.path}': '{name} = {self.get(name)}' was found, where {expected} "
                         "was expected.")

    def needed(self, name):
        """Value of an entry that must be set."""
        if not self.get(name):
            raise UserError(f"'{self.path}' does not set '{name}', which is needed.")
        return self.get(name)

    def one_of(self, name, words):
        """One of several words."""
        if self.get(name) not in words:
            raise self.error(name, " or ".join(f"'{word}'" for word in words))
        return self.get(name)

    def numbers(self, name):
        """A list of numbers, separated by commas."""
        try:
            numbers = [float(part) for part in self.get(name).split(",") if part.strip()]
        except ValueError:
            numbers = [math.nan]
        # Squares of larger ones overflow.
        if not all(abs(number) <= 1e100 for number in numbers):
            raise self.error(name, "numbers separated by commas, none of them nan or beyond 1e100,")
        return numbers

    def number(self, name, smallest=-1e100, largest=1e100):
        """One number between limits; it must be set."""
        self.needed(name)
        found = self.numbers(name)
        if len(found) != 1:
            raise self.error(name, "one number")
        if not smallest <= found[0] <= largest:
            raise self.error(name, f"a number from {smallest:g} to {largest:g}")
        return found[0]
