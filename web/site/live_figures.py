"""Commands of the documents, live: below a command whose result the viewer shows, the viewer with its inputs."""

import base64
import html
import json
import re
import shlex
import subprocess
import tempfile
import zlib
from functools import cache
from pathlib import Path

BLOCK = re.compile(r"^```console\n(.*?)^```\n", re.MULTILINE | re.DOTALL)
DATA = re.compile(r'<script id="dymsum-data" type="application/json">(.+?)</script>', re.DOTALL)
WRONG_USAGE, ANSWER_IS_NO = 1, 4
VERBS = {"sum", "nfp", "scale", "rotate", "cspace", "slice", "features", "decompose"}


@cache
def workplace(program):
    """A folder with the shapes that the documents' commands work on."""
    folder = tempfile.TemporaryDirectory(prefix="dymsum-site-")
    examples = program.parent / "examples"
    for command in ([examples / "demo_shapes", "."], [examples / "demo_solids", "."], [examples / "first_solid"]):
        subprocess.run(command, cwd=folder.name, check=True, capture_output=True)
    return folder


def viewer_data(command, program):
    """The data of the page that a command writes; nothing where it takes no -o FILE.html, which is wrong usage."""
    words = shlex.split(command)
    written = [i for i, word in enumerate(words) if word == "-o"]
    for i in reversed(written):
        del words[i : i + 2]
    folder = workplace(program).name
    done = subprocess.run([program, *words[1:], "-o", "live.html"], cwd=folder, capture_output=True, text=True)
    if done.returncode == WRONG_USAGE:
        return None
    if done.returncode not in (0, ANSWER_IS_NO):
        raise RuntimeError(f"{command}: exit code {done.returncode}: {done.stderr}")
    return json.loads(DATA.search((Path(folder) / "live.html").read_text(encoding="utf-8"))[1])


def permalink(data):
    """The fragment of a page's address that holds this data."""
    text = json.dumps(data, separators=(",", ":")).encode()
    deflated = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = deflated.compress(text) + deflated.flush()
    return "#data=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def figure(command, program, viewer):
    data = viewer_data(command, program)
    if data is None:
        return ""
    del data["live"], data["revision"]
    address = html.escape(viewer + permalink(data))
    return (
        f'<details class="live"><summary>Live: <code>{html.escape(command)}</code></summary>\n'
        f'<iframe src="{address}" loading="lazy" title="{html.escape(command)}"></iframe>\n'
        f'<a href="{address}" target="_blank">In a window of its own</a></details>\n'
    )


def add(markdown, program, viewer):
    """Figures behind every block of commands that the viewer shows."""

    def with_figures(block):
        lines = [line[2:] for line in block[1].splitlines() if line.startswith("$ ")]
        for line in lines:
            if line.startswith("printf "):  # a shape that the commands below work on
                subprocess.run(line, cwd=workplace(program).name, check=True, shell=True)
        commands = [line for line in lines if line.startswith("dymsum ")]
        shown = [command for command in commands if command.split()[1] in VERBS and not re.search(r"[|<>]", command)]
        return block[0] + "".join("\n" + figure(command, program, viewer) for command in shown)

    return BLOCK.sub(with_figures, markdown)
