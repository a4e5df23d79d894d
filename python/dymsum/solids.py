"""Generators of solid test and demo shapes."""

from ._core._solids import *
