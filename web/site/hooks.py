"""What the site adds to the documents: an order of the pages, files that lie elsewhere, and live figures."""

import os
import re
from pathlib import Path

from mkdocs.structure.files import File

import live_figures

ROOT = Path(__file__).resolve().parents[2]
VIEWER = ROOT / "web/viewer/dist/index.html"
SHIM = Path(__file__).parent / "node_modules/iframe-worker/shim/index.js"
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)#\s]+)\)")


def listed(folder):
    """Pages of a folder of docs/: in the order in which docs/README.md names them, others behind them by name."""
    named = re.findall(rf"\]\(({folder}/[\w.-]+\.md)\)", (ROOT / "docs/README.md").read_text(encoding="utf-8"))
    there = sorted(f"{folder}/{page.name}" for page in (ROOT / "docs" / folder).glob("*.md"))
    first = [page for page in dict.fromkeys(named) if page in there]
    pages = first + [page for page in there if page not in first]
    pages.sort(key=lambda page: not page.endswith("/README.md"))
    return [f"docs/{page}" for page in pages]


def on_config(config):
    config.nav = [
        {"Start": "README.md"},
        {"All documents": "docs/README.md"},
        {"Guides": listed("guide")},
        {"Design": ["docs/map.md", *listed("design")]},
        {"Results": listed("results")},
        {"Glossary": "docs/glossary.md"},
        {"Contributing": "CONTRIBUTING.md"},
        {"Changes": "CHANGELOG.md"},
    ]
    return config


def on_files(files, config):
    files.append(File.generated(config, "javascripts/iframe-worker.js", abs_src_path=str(SHIM)))
    if VIEWER.exists():
        files.append(File.generated(config, "viewer.html", abs_src_path=str(VIEWER)))
    return files


def without_folder_links(markdown, page):
    """Folders of sources are not part of the site: their names stay, without a link."""
    here = (ROOT / page.file.src_uri).parent

    def plain(link):
        return link[1] if (here / link[2]).is_dir() else link[0]

    return LINK.sub(plain, markdown)


def on_page_markdown(markdown, page, config, files):
    markdown = without_folder_links(markdown, page)
    program = os.environ.get("DYMSUM")
    if not program or not VIEWER.exists():
        return markdown
    depth = page.file.dest_uri.count("/")
    return live_figures.add(markdown, Path(program).resolve(), "../" * depth + "viewer.html")
