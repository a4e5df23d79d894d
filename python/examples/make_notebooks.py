"""Writes the notebook of every example: the scripts here are the source, their cells begin with `# %%`."""

from __future__ import annotations

import json
from pathlib import Path

HERE = Path(__file__).parent


def cells(script: str) -> list[tuple[str, str]]:
    """(kind, text) of the cells: "markdown" or "code"."""
    found = []
    for block in script.split("# %%")[1:]:
        head, _, body = block.partition("\n")
        if "[markdown]" in head:
            lines = [line[2:] if line.startswith("# ") else line.lstrip("#") for line in body.strip().splitlines()]
            found.append(("markdown", "\n".join(lines)))
        else:
            found.append(("code", body.strip()))
    return found


def notebook(script: str) -> str:
    """The notebook as text, without outputs."""
    blocks = []
    for number, (kind, text) in enumerate(cells(script)):
        block = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": text.splitlines(keepends=True)}
        if kind == "code":
            block |= {"execution_count": None, "outputs": []}
        blocks.append(block)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    page = {"cells": blocks, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(page, indent=1) + "\n"


def scripts() -> list[Path]:
    return [path for path in sorted(HERE.glob("*.py")) if path.name != Path(__file__).name]


if __name__ == "__main__":
    for path in scripts():
        path.with_suffix(".ipynb").write_text(notebook(path.read_text()))
