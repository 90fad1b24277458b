"""How Sphinx makes the site: the documents of the repository as they are, and the pages of this folder.

`cargo xtask site` runs it, with the root of the repository as the folder of sources: the documents link
to each other by their paths there.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
from pathlib import Path

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.writers.html5 import HTML5Translator

sys.path.insert(0, str(Path(__file__).parent))
import notebooks

project = "coated-contact"
author = "The authors of coated-contact"
html_theme = "furo"
html_title = "Adhesive contact on coated substrates"
html_copy_source = False
html_static_path = ["static"]
html_css_files = ["site.css"]
root_doc = "crates/site/index"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
include_patterns = [
    "README.md",
    "CHANGELOG.md",
    ".github/CONTRIBUTING.md",
    "tables/README.md",
    "crates/README.md",
    "crates/*/README.md",
    "crates/contact/fuzz/README.md",
    "crates/python/notebooks/*.py",
    "crates/fit/EXPERIMENTS.md",
    "crates/tabulate/COST.md",
    "crates/site/**.md",
]
source_suffix = {".md": "markdown", ".py": "markdown"}
myst_heading_anchors = 4
# `rust:interp` is the documentation of a crate, seen from the first page.
myst_url_schemes = {"http": None, "https": None, "rust": "../../rust/{{path}}/index.html"}
# A program without a lexer is shown without colours.
suppress_warnings = ["misc.highlighting_failure"]
autodoc_typehints = "none"
napoleon_google_docstring = False
html_math_renderer = "mathml"

logger = logging.getLogger(__name__)
RUST = Path(os.environ["RUST_DOCUMENTATION"])
CRATE = re.compile(r"\(rust:(\w+)\)")
ROOT = Path(__file__).resolve().parents[2]
FOLDER = re.compile(r"\[([^\]\[]+)\]\(([^)\s#:]+)\)")
LINK = re.compile(r"(?<=\])\(([^)\s#:]+)(#[^)\s]*)?\)")


def pages_of_folders(_app: Sphinx, name: str, source: list[str]) -> None:
    """Points a link to a folder at the README there; without one only the text stays."""
    here = (ROOT / name).parent

    def target(match: re.Match[str]) -> str:
        path, anchor = match.group(1), match.group(2) or ""
        if (here / path / "README.md").exists():
            return f"({path.rstrip('/')}/README.md{anchor})"
        return match.group(0)

    def text(match: re.Match[str]) -> str:
        return match.group(1) if (here / match.group(2)).is_dir() else match.group(0)

    source[0] = FOLDER.sub(text, LINK.sub(target, source[0]))


def run_notebooks(_app: Sphinx, name: str, source: list[str]) -> None:
    """Makes a notebook, which is plain Python, a page with its output and its pictures."""
    if name.startswith("crates/python/notebooks/"):
        source[0] = notebooks.page(source[0])


def inline_math(writer: HTML5Translator, node: nodes.math) -> None:
    writer.body.append(convert(node.astext()))
    raise nodes.SkipNode


def display_math(writer: HTML5Translator, node: nodes.math_block) -> None:
    writer.body.append(convert(node.astext(), display="block"))
    raise nodes.SkipNode


def first_page(app: Sphinx, error: Exception | None) -> None:
    """Leads from the root of the site to its first page."""
    if error is None:
        page = f'<meta http-equiv="refresh" content="0; url={root_doc}.html">'
        (app.outdir / "index.html").write_text(page, encoding="utf-8")


def links_to_crates(_app: Sphinx, name: str, source: list[str]) -> None:
    """Warns of a link to the documentation of a crate that has none."""
    for crate in CRATE.findall(source[0]):
        if not (RUST / crate / "index.html").exists():
            logger.warning("%s holds no crate %s: correct the link rust:%s", RUST, crate, crate, location=name)


def documentation_of_crates(app: Sphinx, error: Exception | None) -> None:
    """Adds the documentation of the crates."""
    if error is None:
        shutil.copytree(RUST, app.outdir / "rust", dirs_exist_ok=True)


def setup(app: Sphinx) -> None:
    """Adds the links, the notebooks, the formulas, which a browser draws without a script, and the first page."""
    app.connect("build-finished", first_page)
    app.connect("build-finished", documentation_of_crates)
    app.connect("source-read", links_to_crates)
    app.connect("source-read", pages_of_folders)
    app.connect("source-read", run_notebooks)
    app.add_html_math_renderer("mathml", (inline_math, None), (display_math, None))
