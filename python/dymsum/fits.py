"""Scales at which a part fits or passes."""

from ._core import (
    ScaleContact as ScaleContact,
    ScaleInterval as ScaleInterval,
    ScaleRange as ScaleRange,
    ScaledSolidCopy as ScaledSolidCopy,
    SolidCopySum as SolidCopySum,
    SolidScaleContact as SolidScaleContact,
    SolidScaleInterval as SolidScaleInterval,
    SolidScaleRange as SolidScaleRange,
    fit_range as fit_range,
    scale_range as scale_range,
    scaled_solid_copies as scaled_solid_copies,
    solid_fit_range as solid_fit_range,
    solid_scale_range as solid_scale_range,
)

__all__ = [
    "ScaleContact",
    "ScaleInterval",
    "ScaleRange",
    "ScaledSolidCopy",
    "SolidCopySum",
    "SolidScaleContact",
    "SolidScaleInterval",
    "SolidScaleRange",
    "fit_range",
    "scale_range",
    "scaled_solid_copies",
    "solid_fit_range",
    "solid_scale_range",
]
