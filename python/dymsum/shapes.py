"""Generators of planar test and demo shapes."""

from ._core._shapes import *
