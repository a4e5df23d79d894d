"""Every public name of the C++ headers has its Python name."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import dymsum

HEADERS = Path(__file__).parents[2] / "include" / "dymsum"
#: What Python has in another form: Result is an exception, Rational is fractions.Fraction, the rest is internal.
OTHER_FORM = {"Result", "Rational", "ForcedTier", "PlanarOperand", "SpatialOperand"}
RENAMED = {"in": "in_", "from": "from_"}
#: Members that have no sense in Python.
LEFT_OUT = {"Error.code", "Error.message", "Error.evidence", "NfpTable.state", "SumOptions.forced_tier", "MovingOptions.forced_tier", "EditOptions.forced_tier"}


def _plain(text: str) -> str:
    return re.sub(r"//[^\n]*|^#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.MULTILINE)


def _split(text: str) -> list[str]:
    """At commas that are in no brackets."""
    parts, depth = [""], 0
    for c in text:
        depth += (c in "<({[") - (c in ">)}]")
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts]


def _closing(text: str, at: int) -> int:
    """The index behind the brace that closes the one at `at`."""
    depth = 0
    while True:
        depth += (text[at] == "{") - (text[at] == "}")
        at += 1
        if depth == 0:
            return at


def _declared(statement: str, scope: list[str], names: set[str]) -> None:
    """A declaration of a function or of members."""
    statement = re.sub(r"\[\[\w+\]\]", "", statement).strip()
    if re.match(r"(friend|using|template|explicit|static_assert|struct|class|enum|virtual|~)\b|~", statement):
        return
    if re.search(r"\boperator\b|= delete$|= default$", statement) or not statement:
        return
    head = re.sub(r"<[^()]*?>(?=\s|&|\*|::)", "", statement)
    function = re.match(
        r"(?:[\w:]+[\s&*]+)+(\w+)\s*\(", re.sub(r"<.*?>+", "", head.split("(")[0]) + "(" if "(" in head else ""
    )
    if function and "=" not in statement.split("(")[0]:
        names.add(".".join([*scope, function[1]]))
    elif "(" not in statement.split("=")[0].split("{")[0]:
        first, *others = _split(statement)
        for name in [re.split(r"\s*[={]", first)[0].split()[-1], *(re.split(r"\s*[={]", o)[0] for o in others)]:
            names.add(".".join([*scope, name.strip("&* ")]))


def _read(text: str, scope: list[str], names: set[str], public: bool) -> None:
    """The declarations of a namespace or a type."""
    at, begin = 0, 0
    while at < len(text):
        statement = text[begin:at].strip()
        if access := re.match(r"(public|private)\s*:$", statement + text[at] if text[at] == ":" else ""):
            public, begin = access[1] == "public", at + 1
        elif text[at] == ";":
            if public:
                _declared(statement, scope, names)
            begin = at + 1
        elif text[at] == "{":
            end = _closing(text, at)
            inside = text[at + 1 : end - 1]
            if space := re.match(r"(?:inline )?namespace ([\w:]+)$", statement):
                name = space[1].split("::")[-1]
                if name in ("dymsum", "shapes", "solids"):
                    _read(inside, [] if name == "dymsum" else [name], names, True)
                begin = end
            elif kind := re.search(
                r"\b(struct|class|enum class|enum)\s+(?:\[\[\w+\]\]\s*)?(\w+)(?:\s*:[^{]*)?$", statement
            ):
                if public and "template" not in statement:
                    own = [*scope, kind[2]]
                    names.add(".".join(own))
                    if kind[1].startswith("enum"):
                        names.update(".".join([*own, item.split("=")[0].strip()]) for item in _split(inside) if item)
                    else:
                        _read(inside, own, names, kind[1] == "struct")
                begin = end
                while text[end : end + 1].isspace():
                    end += 1
                if rest := re.match(r"\s*(\w+)(?:\s*=[^;]*)?;", text[end:]):  # enum class Kind {...} kind = ...;
                    names.add(".".join([*scope, rest[1]]))
                    begin = end = end + rest.end()
                elif text[end : end + 1] == ";":
                    begin = end = end + 1
            elif re.search(r"\)[\sa-z&]*$|\)\s*:.*$", statement, re.DOTALL):  # a body
                if public:
                    _declared(statement, scope, names)
                begin = end
            at = end - 1
        at += 1


def public_names() -> list[str]:
    names: set[str] = set()
    for header in sorted(HEADERS.glob("*.h")):
        _read(_plain(header.read_text()), [], names, True)
    return sorted(names)


def _has(name: str) -> bool:
    if name.split(".")[0] in OTHER_FORM or name in LEFT_OUT:
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
    assert len(names) > 1000, "the headers were not read"
    for known in (
        "minkowski_sum",
        "ConvexSum.changed_facets",
        "CspaceObstacle.loops",
        "check_path",
        "SolidFeature.Kind.edge",
        "shapes.gear",
        "Region.create",
        "Patch.contact",
        "FrameWork.rebuilt",
        "Engine.winding",
        "version",
    ):
        assert known in names
    assert [name for name in names if not _has(name)] == []


@pytest.mark.parametrize("name", ["minkowski_sum", "Region", "ConvexSum", "plan", "fit_range"])
def test_docstrings_are_there(name: str) -> None:
    assert len(getattr(dymsum, name).__doc__) > 80
