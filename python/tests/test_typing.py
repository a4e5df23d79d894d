"""The stubs: mypy --strict accepts what is right and refuses what is wrong."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent


@pytest.fixture(scope="session")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What mypy has read once, it need not read again."""
    return tmp_path_factory.mktemp("mypy")


def mypy(*what: object, cache: Path) -> str:
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--strict",
        "--no-error-summary",
        "--disable-error-code",
        "overload-overlap",
        "--cache-dir",
        str(cache),
        *map(str, what),
    ]
    return subprocess.run(command, capture_output=True, text=True, cwd=cache, check=False).stdout


def test_a_sample_is_typed(cache: Path) -> None:
    said = mypy(HERE / "typed_sample.py", cache=cache)
    expected = [
        f"typed_sample.py:{number}: error"
        for number, line in enumerate((HERE / "typed_sample.py").read_text().splitlines(), 1)
        if line.endswith("# wrong")
    ]
    errors = [line for line in said.splitlines() if ": error" in line]
    assert len(expected) == 4
    assert [error.rsplit("/", 1)[-1].split(": error")[0] + ": error" for error in errors] == expected, said


def test_the_package_is_typed(cache: Path) -> None:
    import dymsum

    assert (Path(dymsum.__file__).parent / "py.typed").exists()
    said = mypy("-p", "dymsum", cache=cache)
    assert said == ""
