"""Bars of pockets, and decompositions that follow them."""

from ._core import (
    AlphaBridge as AlphaBridge,
    BridgeContact as BridgeContact,
    Concavity as Concavity,
    Cut as Cut,
    DecomposeOptions as DecomposeOptions,
    Decomposition as Decomposition,
    FeatureBar as FeatureBar,
    FeatureOptions as FeatureOptions,
    Piece as Piece,
    ShapeFeatures as ShapeFeatures,
    decompose as decompose,
    piece_colours as piece_colours,
    rounded as rounded,
    rounded_with_repair as rounded_with_repair,
    twice_area as twice_area,
)

__all__ = [
    "AlphaBridge",
    "BridgeContact",
    "Concavity",
    "Cut",
    "DecomposeOptions",
    "Decomposition",
    "FeatureBar",
    "FeatureOptions",
    "Piece",
    "ShapeFeatures",
    "decompose",
    "piece_colours",
    "rounded",
    "rounded_with_repair",
    "twice_area",
]
