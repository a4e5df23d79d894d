"""Pictures of bars and of pieces for notebooks, as SVG text; no network, no plot library."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from . import _core

_WIDTH, _MARGIN = 480.0, 10.0
_MOST_BARS = 120
_PIECES = ("#9ecae1", "#fdd49e", "#c7e9c0", "#dadaeb", "#fcc5c0", "#d9d9a3")
_CUT = "#d81e3a"


def _svg(height: float, body: Sequence[str]) -> str:
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH:.0f} {height:.0f}" width="{_WIDTH:.0f}">'
    return head + "".join(body) + "</svg>"


def bars_svg(features: _core.ShapeFeatures) -> str:
    """Bars over the diameter, the longest first; those that never end go on to the right."""
    bars = features.bars()
    shown = [bars[index] for index in features.lasting(0)[:_MOST_BARS]]
    last = max([0.0, *(bar.death_alpha if bar.death is not None else bar.birth_alpha for bar in shown)])
    unit = (_WIDTH - 2 * _MARGIN) / (1.08 * last) if last > 0 else 0.0
    body = []
    for row, bar in enumerate(shown):
        left = _MARGIN + bar.birth_alpha * unit
        right = _WIDTH if bar.death is None else _MARGIN + bar.death_alpha * unit
        colour = _CUT if bar.born == _core.FeatureBar.Birth.corner else "#e8a33d"
        body.append(f'<rect x="{left:.1f}" y="{_MARGIN + 10 * row:.1f}" width="{max(right - left, 0.6):.1f}" ')
        body.append(f'height="6" fill="{colour}"/>')
    below = _MARGIN + 10 * len(shown) + 14
    note = "" if len(shown) == len(bars) else f"; the {len(shown)} longest of {len(bars)}"
    body.append(f'<text x="{_MARGIN:.0f}" y="{below:.0f}" font-family="sans-serif" font-size="11">')
    body.append(f"diameters 0 to {1.08 * last:.4g}{note}</text>")
    return _svg(below + _MARGIN, body)


def pieces_svg(made: _core.Decomposition) -> str:
    """The pieces, and the cuts in red. What is far from the origin is subtracted exactly."""
    corners = [point for piece in made.pieces for point in piece.outer]
    low = min((point.x for point in corners), default=Fraction(0))
    high = max((point.y for point in corners), default=Fraction(0))
    size = max((max(point.x - low, high - point.y) for point in corners), default=Fraction(1))

    def place(point: tuple[Fraction, Fraction]) -> str:
        x, y = (float(away / size) * (_WIDTH - 2 * _MARGIN) + _MARGIN for away in (point[0] - low, high - point[1]))
        return f"{x:.2f} {y:.2f}"

    body = []
    for colour, piece in zip(_core.piece_colours(made), made.pieces, strict=True):
        path = "".join("M" + "L".join(map(place, ring)) + "Z" for ring in (piece.outer, *piece.holes))
        body.append(f'<path d="{path}" fill="{_PIECES[colour]}" fill-rule="evenodd" stroke="#333" stroke-width="0.7"/>')
    for cut in made.cuts:
        path = "".join("M" + "L".join(map(place, run)) for run in cut.runs)
        body.append(f'<path d="{path}" stroke="{_CUT}" stroke-width="1.6"/>')
    lowest = min((point.y for point in corners), default=high)
    return _svg(float((high - lowest) / size) * (_WIDTH - 2 * _MARGIN) + 2 * _MARGIN, body)
