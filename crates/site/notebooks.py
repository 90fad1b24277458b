"""The notebooks as pages: each cell with what it prints, its last value, and its pictures."""

from __future__ import annotations

import ast
import base64
import contextlib
import io
import re

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

CELL = re.compile(r"^# %%(.*)$", re.MULTILINE)


def page(source: str) -> str:
    """Runs a notebook in the percent format, and returns it in Markdown."""
    names: dict[str, object] = {"__name__": "__main__"}
    parts = CELL.split(source)
    parts = [
        text(cell) if "[markdown]" in head else run(cell.strip(), names)
        for head, cell in zip(parts[1::2], parts[2::2], strict=True)
    ]
    return "\n\n".join(parts)


def text(cell: str) -> str:
    """Returns the text of a cell of comments."""
    return "\n".join(line.removeprefix("#").removeprefix(" ") for line in cell.strip().split("\n"))


def run(cell: str, names: dict[str, object]) -> str:
    """Runs a cell of code, and returns it with its output."""
    shown = [f"```python\n{cell}\n```"]
    tree = ast.parse(cell)
    value = None
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, "<notebook>", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), "<notebook>", "eval"), names)
    said = printed.getvalue()
    pictures = [pyplot.figure(number) for number in pyplot.get_fignums()]
    # A cell that draws ends with a part of the picture.
    if value is not None and not pictures:
        said += f"{value!r}\n"
    if said:
        shown.append(f"```text\n{said.rstrip()}\n```")
    for picture in pictures:
        drawn = io.BytesIO()
        picture.savefig(drawn, format="png", dpi=110)
        shown.append(f"![](data:image/png;base64,{base64.b64encode(drawn.getvalue()).decode()})")
    pyplot.close("all")
    return "\n\n".join(shown)
