"""Generators of planar test and demo shapes."""

from ._core import _shapes
from ._core._shapes import *

__all__ = [name for name in vars(_shapes) if not name.startswith("_")]
