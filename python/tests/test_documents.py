"""Examples in docstrings and in the guide print what they say; the README's program too."""

from __future__ import annotations

import doctest
import inspect
import re
from pathlib import Path
from typing import Any, Iterator

import pytest

import dymsum

ROOT = Path(__file__).parents[2]


def documented() -> Iterator[tuple[str, str]]:
    """Every docstring with an example."""
    seen: set[int] = set()
    for scope_name, scope in [("dymsum", dymsum), ("dymsum.shapes", dymsum.shapes), ("dymsum.solids", dymsum.solids)]:
        for name, value in vars(scope).items():
            if name.startswith("_") or id(value) in seen or not getattr(value, "__module__", "").startswith("dymsum"):
                continue
            seen.add(id(value))
            members: list[tuple[str, Any]] = [("", value)]
            if inspect.isclass(value):
                members += [("." + n, m) for n, m in vars(value).items() if not n.startswith("_")]
            for member_name, member in members:
                text = inspect.cleandoc(getattr(member, "__doc__", None) or "")
                if ">>>" in text:
                    yield f"{scope_name}.{name}{member_name}", text


EXAMPLES = list(documented())
PAGES = [page for page in (ROOT / "docs/guide/python.md", ROOT / "docs/guide/nesting.md", ROOT / "docs/guide/depth.md", ROOT / "README.md") if page.exists()]


def run(text: str, name: str) -> None:
    test = doctest.DocTestParser().get_doctest(text, {}, name, name, 0)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    said: list[str] = []
    runner.run(test, out=said.append)
    assert runner.failures == 0, "".join(said)


#: What is called most.
COMMON = """minkowski_sum nfp nfp_each erode union_of rotated_sum contains contains_each SumLocator PlanarSum PlanarSum.exact
PlanarSum.rounded Region area bounds negated translated scaled repair grown parse_shapes format_region ScalingSum RotatingSum
ScalingFamily RotationFamily Scale Orientation Orientation.of_degrees Rotation Rotation.about_degrees AxisTurn scale_range CspaceObstacle
cspace_slice ObstacleQueries ObstacleQueries.free_angles check_translation plan Mesh volume convex_hull ConvexSum
SpatialSum opening slice_of_sum MovingSolidSum posed_sums SolidScaleEvents SolidRotationEvents SolidScalingFamily SolidRotationFamily SolidDepth PlanarDepth
penetration_depth depth_batch ContinuousDepth NfpTable parse_nesting_instance GrowingDisc ShapeFeatures decompose""".split()


def test_there_are_examples() -> None:
    names = {name.removeprefix("dymsum.") for name, _ in EXAMPLES}
    assert len(COMMON) >= 50
    assert [name for name in COMMON if name not in names] == []


@pytest.mark.parametrize(("name", "text"), EXAMPLES, ids=[name for name, _ in EXAMPLES])
def test_docstring(name: str, text: str) -> None:
    run(text, name)


@pytest.mark.parametrize("page", PAGES, ids=[page.name for page in PAGES])
def test_page(page: Path) -> None:
    blocks = re.findall(r"```pycon\n(.*?)```", page.read_text(), re.DOTALL)
    assert blocks
    run("\n".join(blocks), page.name)
