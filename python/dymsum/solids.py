"""Generators of solid test and demo shapes."""

from ._core.solids import *
