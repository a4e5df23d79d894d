"""Every parameter that is a number, of every function, method and option: taken exactly or refused."""

from __future__ import annotations

import inspect
import re
from decimal import Decimal
from fractions import Fraction as F
from typing import Any, Iterator

import numpy
import pytest

import dymsum
from dymsum import _core, shapes, solids

REGION, MESH = shapes.rectangle(0, 0, 1, 1), solids.box(0, 0, 0, 1, 1, 1)
THIRD = numpy.longdouble(1) / 3
NO_DOUBLES = [F(1, 3), Decimal("0.1"), 2**53 + 1, 10**400, *([THIRD] if float(THIRD) != THIRD else [])]
HALVES = [0.5, F(1, 2), Decimal("0.5"), numpy.float32(0.5), numpy.float16(0.5), numpy.longdouble(0.5), numpy.array(0.5)]
NO_INTEGERS = [2.5, 2.0, F(5, 2), Decimal("2.5"), numpy.float32(2.5), numpy.array([2])]

#: One value for each annotation; those of classes are made by what their names say.
VALUES: dict[str, Any] = {
    "dymsum.RegionLike": REGION,
    "dymsum.MeshLike": MESH,
    "float": 0.5,
    "float | None": 0.5,
    "int": 4,
    "str": "1",
    "str | os.PathLike[str]": "a.wkt",
    "bool": True,
    "collections.abc.Sequence[numpy.typing.ArrayLike]": [(0, 0), (1, 0), (0, 1)],
    "collections.abc.Sequence[tuple[dymsum.RegionLike, dymsum.RegionLike]]": [(REGION, REGION)],
    "fractions.Fraction | float": F(1, 2),
    "Scale | fractions.Fraction | float": 1,
    "DiscRadius | fractions.Fraction | float": 1,
    "collections.abc.Sequence[fractions.Fraction | float]": (0, 0),
    "collections.abc.Callable[[str, float], bool | None] | None": None,
    "collections.abc.Sequence[int]": (0, 0, 1),
    "collections.abc.Sequence[float]": [0.5],
    "collections.abc.Sequence[dymsum.MeshLike]": [MESH, MESH],
    "collections.abc.Sequence[dymsum.RegionLike]": [REGION, REGION],
}


def made() -> dict[str, Any]:
    """Objects whose methods are called, by their classes."""
    obstacle = dymsum.CspaceObstacle(REGION, REGION)
    disc, features = dymsum.GrowingDisc(REGION), dymsum.ShapeFeatures(shapes.letter_u(4, 4, 1))
    sum, solid = dymsum.nfp(REGION, REGION), dymsum.minkowski_sum(MESH, MESH)
    local, space = dymsum.PlanarLocalSum(REGION, REGION), dymsum.LocalSum(MESH, MESH)
    continuous = dymsum.ContinuousDepth(MESH, MESH)
    objects = [
        REGION,
        MESH,
        obstacle,
        dymsum.ObstacleQueries(obstacle),
        disc,
        disc.sum_at(1),
        features,
        sum,
        solid,
        dymsum.SumLocator(sum),
        local,
        space,
        continuous,
        dymsum.ScalingSum(REGION, REGION),
        dymsum.RotatingSum(REGION, REGION),
        dymsum.ScalingFamily(REGION, REGION, 1, 2),
        dymsum.RotationFamily(REGION, REGION),
        dymsum.Placement(REGION),
        dymsum.ConvexSum(MESH, MESH),
        dymsum.MovingSolidSum(MESH, MESH),
        dymsum.SolidScaleEvents(MESH, MESH),
        dymsum.SolidRotationEvents(MESH, MESH, (0, 0, 1)),
        dymsum.SolidScalingFamily(MESH, MESH, 1, 2),
        dymsum.SolidRotationFamily(MESH, MESH, (0, 0, 1)),
        dymsum.SolidDepth(MESH, MESH),
        dymsum.PlanarDepth(REGION, REGION),
        dymsum.DiscRadius(1),
    ]
    return {type(one).__name__: one for one in objects}


OBJECTS = made()


class Parameter:
    """One of a signature: text is "name: annotation = default"."""

    def __init__(self, text: str) -> None:
        head, _, default = text.partition(" = ")
        self.name, _, self.annotation = head.partition(": ")
        self.needed = not default


def split(text: str) -> list[str]:
    """At commas that are in no brackets."""
    parts, depth = [""], 0
    for c in text:
        depth += (c in "([") - (c in ")]")
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts if part.strip()]


def parameters(signature: str) -> list[Parameter]:
    begin = signature.index("(") + 1
    end, depth = begin, 1
    while depth:
        depth += (signature[end] in "([") - (signature[end] in ")]")
        end += 1
    return [Parameter(part) for part in split(signature[begin : end - 1]) if part not in ("/", "*")]


#: Positions of which nothing but the name says how many numbers they have.
POSITIONS = {"poses": [(0, 0, 0)], "positions": [(0, 0)], "moves": [(0, 0, 0)], "points": [(0, 0, 0)]}


def value_of(annotation: str, name: str, function: str) -> Any:
    if annotation == "numpy.typing.ArrayLike":
        return (0, 0) if function.startswith("PlanarDisc") else POSITIONS.get(name, (0, 0, 1))
    if annotation in VALUES:
        return VALUES[annotation]
    name = annotation.split(".")[-1]
    if name in OBJECTS:
        return OBJECTS[name]
    return DEFAULTS[name]()


def any_of(kind: Any) -> Any:
    return next(iter(kind.__members__.values()))


class Defaults(dict[str, Any]):
    def __missing__(self, name: str) -> Any:
        kind = getattr(dymsum, name)
        return (lambda: any_of(kind)) if hasattr(kind, "__members__") else kind


DEFAULTS = Defaults(
    Part=lambda: dymsum.Part([(0, 0), (1, 0), (0, 1)]),
    TableItem=lambda: dymsum.TableItem("a", REGION, [0]),
    ArrayLike=lambda: (0, 0, 1),
    Patch=lambda: OBJECTS["CspaceObstacle"].patches()[0],
    ClipBox=lambda: dymsum.ClipBox((0, 0, 0), (1, 1, 1)),
    ClipBall=lambda: dymsum.ClipBall((0, 0, 0), 1),
)


def scopes() -> Iterator[tuple[str, Any]]:
    for scope in (_core, _core._shapes, _core._solids):
        for name, value in vars(scope).items():
            yield name, value
            if inspect.isclass(value):
                for member, of in vars(value).items():
                    yield f"{name}.{member}", getattr(value, member) if callable(getattr(of, "__func__", None)) else of


def signatures() -> Iterator[tuple[str, Any, str]]:
    """Of all functions and methods: name, function, signature."""
    for name, function in scopes():
        for signature in getattr(function, "__nb_signature__", ()):
            yield name, function, signature[0]


def cases(annotations: set[str]) -> Iterator[Any]:
    for name, function, signature in signatures():
        if name.split(".")[-1] in ("__setstate__", "__getstate__") or "**kwargs" in signature:
            continue
        for parameter in parameters(signature):
            if parameter.annotation in annotations:
                yield pytest.param(name, function, signature, parameter.name, id=f"{name}-{parameter.name}-{len(signature)}")


def call(name: str, function: Any, signature: str, number: str, value: Any) -> Any:
    """With values of the right kinds for all that is needed, and this one."""
    given: dict[str, Any] = {}
    first: list[Any] = []
    for parameter in parameters(signature):
        if parameter.name == "self":
            kind = getattr(dymsum, name.split(".")[0])
            if name.endswith("__init__"):
                function = kind
                continue
            first.append(OBJECTS[kind.__name__] if kind.__name__ in OBJECTS else DEFAULTS[kind.__name__]())
        elif parameter.name == number:
            given[number] = value
        elif parameter.name == "arg":
            first.append(value)
        elif parameter.needed:
            given[parameter.name] = value_of(parameter.annotation, parameter.name, name)
    return function(*first, **given)


FLOATS = list(cases({"float", "float | None"}))
INTEGERS = list(cases({"int", "int | None"}))


def test_signatures_are_read() -> None:
    assert len(FLOATS) > 120 and len(INTEGERS) > 60


@pytest.mark.parametrize(("name", "function", "signature", "number"), FLOATS)
def test_no_double_is_refused(name: str, function: Any, signature: str, number: str) -> None:
    for value in NO_DOUBLES:
        with pytest.raises(dymsum.Error) as caught:
            call(name, function, signature, number, value)
        assert caught.value.code == dymsum.ErrorCode.unsupported_operand
        assert "no double holds the number" in caught.value.message
    for value in ("0.5", None if "None" not in signature else "1", 1j, numpy.array([0.5, 1])):
        with pytest.raises(TypeError):
            call(name, function, signature, number, value)


@pytest.mark.parametrize(("name", "function", "signature", "number"), FLOATS)
def test_doubles_of_all_kinds_are_taken(name: str, function: Any, signature: str, number: str) -> None:
    """As the float is: the same answer, or the same error."""

    def said(value: Any) -> str:
        try:
            answer = call(name, function, signature, number, value)
            return re.sub(r"(seconds|ms)=[^,)]*| at 0x\w+", "", repr(answer))
        except (dymsum.Error, ValueError) as error:
            return repr(error)

    expected = said(0.5)
    for value in HALVES:
        assert said(value) == expected


@pytest.mark.parametrize(("name", "function", "signature", "number"), INTEGERS)
def test_no_integer_is_refused(name: str, function: Any, signature: str, number: str) -> None:
    for value in NO_INTEGERS:
        with pytest.raises(TypeError):
            call(name, function, signature, number, value)


def options() -> Iterator[Any]:
    """Fields that are set: class, name, annotation."""
    for name, kind in scopes():
        if not inspect.isclass(kind) or hasattr(kind, "__members__"):
            continue
        for field, descriptor in vars(kind).items():
            if isinstance(descriptor, property) and descriptor.fset is not None:
                told = descriptor.fget.__nb_signature__[0][0].split(" -> ")[-1]  # type: ignore[union-attr]
                if told in ("float", "int"):
                    yield pytest.param(name, field, told, id=f"{name}.{field}")


OPTIONS = list(options())


@pytest.mark.parametrize(("name", "field", "annotation"), OPTIONS)
def test_options_are_taken_exactly_or_refused(name: str, field: str, annotation: str) -> None:
    made = getattr(dymsum, name)()
    before = getattr(made, field)
    for value in NO_DOUBLES if annotation == "float" else NO_INTEGERS:
        with pytest.raises((dymsum.Error, TypeError)):
            setattr(made, field, value)
        assert getattr(made, field) == before
    setattr(made, field, F(1, 2) if annotation == "float" else numpy.int64(3))
    assert getattr(made, field) == (0.5 if annotation == "float" else 3)


def test_there_are_options() -> None:
    assert len(OPTIONS) > 20


@pytest.mark.parametrize("x", NO_DOUBLES)
def test_fields_positions_and_arrays(x: Any) -> None:
    """What no signature tells: positions, fields of records, poses, the numbers of lists."""
    queries = OBJECTS["ObstacleQueries"]
    for ask in (
        lambda: dymsum.ScaledCopy(1, (x, 0)),
        lambda: queries.contains((x, 0, 0)),
        lambda: queries.free_each([(0, 0, x)]),
        lambda: dymsum.pose_batch_arrays(MESH, MESH, [(1, 0, 0, x)]),
        lambda: dymsum.Rotation.about((0, 0, x), 1),
        lambda: dymsum.plan(OBJECTS["CspaceObstacle"], (0, 9, x), (9, 9, 0)),
        lambda: solids.prism([(0, 0), (x, 0), (0, 1)], 1),
        lambda: dymsum.TableInput(strip_height=x),
        lambda: dymsum.TableOptions(pair_seconds=x),
        lambda: dymsum.convex_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, x)]),
    ):
        with pytest.raises(dymsum.Error) as caught:
            ask()
        assert caught.value.code == dymsum.ErrorCode.unsupported_operand


class Only:
    """Nothing but a float."""

    def __init__(self, number: float, same: bool) -> None:
        self._number, self._same = number, same

    def __float__(self) -> float:
        return self._number

    def __eq__(self, other: object) -> bool:
        return self._same


def test_what_has_a_float_has_to_be_equal_to_it() -> None:
    assert shapes.rectangle(0, 0, Only(0.5, True), 1).bounds() == [0, 0, 0.5, 1]  # type: ignore[arg-type, unused-ignore]
    with pytest.raises(dymsum.Error, match="no double holds the number"):
        shapes.rectangle(0, 0, Only(0.5, False), 1)  # type: ignore[arg-type, unused-ignore]
