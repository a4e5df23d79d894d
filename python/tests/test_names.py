"""Every public name of the C++ headers has its Python name."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import dymsum

HEADERS = Path(__file__).parents[2] / "include" / "dymsum"
#: What Python has in another form: Result is an exception, Rational is fractions.Fraction, the rest is internal.
OTHER_FORM = {"Result", "Rational", "ForcedTier"}
RENAMED = {"in": "in_", "from": "from_"}
#: Members that have no sense in Python.
LEFT_OUT = {"Error.code", "Error.message", "Error.evidence", "SumOptions.forced_tier", "MovingOptions.forced_tier"}


def _without_comments(text: str) -> str:
    return re.sub(r"//[^\n]*", "", text)


class Reader:
    """Reads declarations by their indentation, which clang-format keeps."""

    def __init__(self) -> None:
        self.names: set[str] = set()

    def read(self, text: str) -> None:
        scope: list[str] = []
        public = True
        for line in re.sub(r",\n\s+", ", ", _without_comments(text)).splitlines():
            if match := re.match(r"namespace dymsum(?:::(\w+))? \{", line):
                scope = [match[1]] if match[1] in ("shapes", "solids") else []
                inner = match[1] not in (None, "shapes", "solids")
                if inner:
                    scope = ["#"]
                continue
            if re.match(r"namespace \w+ \{", line):
                scope = ["#"]
                continue
            if line.startswith("}  // namespace") or (line == "}" and scope == ["#"]):
                scope = []
                continue
            indent = len(line) - len(line.lstrip())
            types = [s for s in scope if s[:1].isupper()]
            while types and indent < 2 * len(types) and not line.strip().startswith(("public", "private")):
                types.pop()
                scope.pop()
                public = True
            if not line.strip() or scope == ["#"]:
                continue
            stripped = line.strip()
            if stripped in ("public:", "private:"):
                public = stripped == "public:"
                continue
            if not public or indent != 2 * len(types):
                continue
            self._declaration(stripped, scope)
            if match := re.match(r"(?:struct|class|enum class|enum) (?:\[\[nodiscard\]\] )?(\w+)(?: : [\w:]+)? \{", stripped):
                if stripped.endswith("{") and not stripped.endswith("};"):
                    scope.append(match[1])
                    public = not stripped.startswith("class")

    def _declaration(self, line: str, scope: list[str]) -> None:
        if line.startswith(("friend", "template", "#", "using", "explicit", "~", "return", "}", "static_assert")):
            return
        if re.search(r"\boperator\b|= delete|= default", line):
            return
        if match := re.match(r"(?:struct|class|enum class|enum) (?:\[\[nodiscard\]\] )?(\w+)(?: : [\w:]+)? \{", line):
            self.names.add(".".join([*scope, match[1]]))
        elif match := re.match(r"(?:inline |static |constexpr |const )*[\w:]+(?:<.*?>+)?[\w:<>]*[&*]? (\w+)\(", line):
            self.names.add(".".join([*scope, match[1]]))
        elif scope and scope[-1][:1].isupper() and not line.endswith("{"):
            self._members(line, scope)

    def _members(self, line: str, scope: list[str]) -> None:
        if match := re.match(r"(?:static constexpr )?[\w:]+(?:<.*>)? ([\w ,={}.+-]+?)(?:\{.*\}| = .*)?;", line):
            for name in re.sub(r"=[^,]*|\{[^}]*\}", "", match[1]).split(","):
                if re.fullmatch(r"\w+", name.strip()):
                    self.names.add(".".join([*scope, name.strip()]))
        elif match := re.match(r"(\w+)(?: = \w+)?,$", line):
            self.names.add(".".join([*scope, match[1]]))


def public_names() -> list[str]:
    reader = Reader()
    for header in sorted(HEADERS.glob("*.h")):
        reader.read(header.read_text())
    return sorted(reader.names)


def _has(name: str) -> bool:
    if name.split(".")[0] in OTHER_FORM or name in LEFT_OUT or name.endswith(("_", "Bits_")):
        return True
    place: object = dymsum
    for part in name.split("."):
        part = RENAMED.get(part, part)
        if not hasattr(place, part):
            fields = getattr(place, "__dataclass_fields__", {})
            return part in fields
        place = getattr(place, part)
    return True


def test_every_public_name_is_there() -> None:
    names = public_names()
    assert len(names) > 540, "the headers were not read"
    for known in ("minkowski_sum", "shapes.gear", "Region.create", "Patch.contact", "FrameWork.rebuilt", "Engine.winding"):
        assert known in names
    assert [name for name in names if not _has(name)] == []


@pytest.mark.parametrize("name", ["minkowski_sum", "Region", "ConvexSum", "plan", "fit_range"])
def test_docstrings_are_there(name: str) -> None:
    assert len(getattr(dymsum, name).__doc__) > 80
