"""Generators of solid test and demo shapes."""

from ._core import _solids
from ._core._solids import *

__all__ = [name for name in vars(_solids) if not name.startswith("_")]
