"""Examples run, show their last value as a picture, and their notebooks are up to date."""

from __future__ import annotations

import ast
import importlib.util
import sys
from pathlib import Path
from typing import Any

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"
SPEC = importlib.util.spec_from_file_location("make_notebooks", EXAMPLES / "make_notebooks.py")
assert SPEC is not None and SPEC.loader is not None
notebooks = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(notebooks)

SAYS = {
    "fitting_scales": "it fits inside from scale 0 to 7/3",
    "nest_parts": "9 parts, length 12, density 0.9444: proved",
    "nesting_table": "2 items, 16 no-fit polygons",
    "obstacle_and_path": "the path is free",
    "turning_solid": "depths from",
}


def run(script: str) -> Any:
    """Runs the cells of a notebook one after the other; the value of the last one's last line."""
    names: dict[str, Any] = {"__name__": "__main__"}
    value = None
    for kind, text in notebooks.cells(script):
        if kind == "code":
            tree = ast.parse(text)
            last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
            exec(compile(tree, "cell", "exec"), names)
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names) if last else None  # type: ignore[attr-defined]
    return value


@pytest.mark.parametrize("path", notebooks.scripts(), ids=lambda path: path.stem)
def test_example(path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", [str(path)])
    value = run(path.read_text())
    assert SAYS[path.stem] in capsys.readouterr().out
    assert value._repr_svg_().startswith(("<svg", "<?xml"))
    assert path.with_suffix(".ipynb").read_text() == notebooks.notebook(path.read_text())
    assert len(path.read_text().splitlines()) <= 70
