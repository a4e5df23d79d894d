"""What the library raises."""

from ._core import ErrorCode as ErrorCode, name as name
from ._errors import Error as Error, Evidence as Evidence

__all__ = [
    "Error",
    "ErrorCode",
    "Evidence",
    "name",
]
