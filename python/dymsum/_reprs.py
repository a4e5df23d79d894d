"""How objects show themselves that are no plain values: by what they were made of."""

from __future__ import annotations

from typing import Any

from . import _core

_OPERANDS = (_core.Region, _core.Mesh, _core.PlanarSum, _core.SpatialSum, _core.CspaceObstacle)


def _short(value: Any) -> str:
    """<ScalingSum of <Region: ...> and <Region: ...>>."""
    name = type(value).__name__
    try:
        made_of = [repr(part) for part in value.__reduce__()[1] if isinstance(part, _OPERANDS)]
    except (TypeError, RuntimeError, AttributeError):  # it cannot be pickled, or another thread moves it
        return f"<{name}>"
    return f"<{name} of {' and '.join(made_of)}>" if made_of else f"<{name}>"


def _obstacle(value: Any) -> str:
    return f"<CspaceObstacle: {len(value.patches())} patches>"


def _family(value: Any) -> str:
    return f"<ScalingFamily: {value.low().exact()} to {value.high().exact()}, {value.work().cells} cells>"


def _turn(value: Any) -> str:
    return f"<RotationFamily: {value.work().cells} cells>"


def _solid_family(value: Any) -> str:
    return f"<SolidScalingFamily: {value.low().exact()} to {value.high().exact()}, {value.work().cells} cells>"


def _solid_turn(value: Any) -> str:
    return f"<SolidRotationFamily: {value.work().cells} cells>"


def _region_data(value: Any) -> str:
    return f"<RegionData: {len(value.parts)} parts, {len(value.polylines)} polylines, {len(value.points)} points>"


for _kind in list(vars(_core).values()):
    if isinstance(_kind, type) and getattr(_kind, "__repr__") is getattr(object, "__repr__"):
        setattr(_kind, "__repr__", _short)
setattr(_core.CspaceObstacle, "__repr__", _obstacle)
setattr(_core.ScalingFamily, "__repr__", _family)
setattr(_core.RotationFamily, "__repr__", _turn)
setattr(_core.SolidScalingFamily, "__repr__", _solid_family)
setattr(_core.SolidRotationFamily, "__repr__", _solid_turn)
setattr(_core.RegionData, "__repr__", _region_data)
