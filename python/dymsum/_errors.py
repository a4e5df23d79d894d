"""Errors of the library as an exception with code and evidence."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

from . import _core
from ._core import ErrorCode


@dataclass(frozen=True)
class Evidence:
    """Where and what: a field is set only where it applies. Indices count from 0, lines from 1. Rings of a part: 0 is
    the outer ring, 1, 2, ... its holes."""

    file: str = ""
    line: Optional[int] = None
    part: Optional[int] = None
    ring: Optional[int] = None
    vertex: Optional[int] = None
    other_part: Optional[int] = None
    other_ring: Optional[int] = None
    other_vertex: Optional[int] = None
    face: Optional[int] = None
    other_face: Optional[int] = None
    x: Optional[float] = None
    y: Optional[float] = None
    z: Optional[float] = None


class Error(Exception):
    """What the library cannot use: code, sentence and evidence.

    >>> import dymsum
    >>> try:
    ...     dymsum.Region([(0, 0), (1, 0), (float("nan"), 1)])
    ... except dymsum.Error as error:
    ...     print(error.code.name, error.evidence.vertex, error.vertex)
    not_finite 2 2
    """

    __module__ = "dymsum"

    def __init__(self, code: ErrorCode, message: str = "", evidence: Evidence = Evidence()) -> None:
        super().__init__(code, message, evidence)
        self.code = code
        self.message = message
        self.evidence = evidence
        #: The index of what failed in the list that a batch was given.
        self.item: Optional[int] = None

    def to_string(self) -> str:
        """The sentence with its evidence: item of a batch, file, line, part, ring, vertex and position."""
        return ("" if self.item is None else f"item {self.item}: ") + _core._error_text(self)

    __str__ = to_string

    def __getattr__(self, name: str) -> object:
        """The fields of the evidence are attributes of the error as well."""
        if name.startswith("_") or name == "evidence" or name not in Evidence.__dataclass_fields__:
            raise AttributeError(name)
        return getattr(self.evidence, name)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Error) and self.args == other.args

    def __hash__(self) -> int:
        return hash(self.args)
