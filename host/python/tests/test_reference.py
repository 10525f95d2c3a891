"""The page of the reference, made from stubs and sources. ``TAXEL_BLESS=1`` updates it."""

from __future__ import annotations

import ast
import inspect
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
import taxel

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs/reference/python.md"
PACKAGE = ROOT / "host/python/python/taxel"
HEAD = """# Python

[In Python](../guides/python.md) shows how it is used. Made from the package's stub and sources; `help(taxel.open)`
says the same.
"""

Function = ast.FunctionDef
Definition = ast.FunctionDef | ast.ClassDef


def defined(file: str) -> dict[str, Definition]:
    """The functions and classes at the top of a file."""
    tree = ast.parse((PACKAGE / file).read_text(encoding="utf-8"))
    return {node.name: node for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}


def signature(node: Function, name: str) -> str:
    """The signature as one writes it, without ``self``."""
    arguments = ast.unparse(node.args).removeprefix("self, ").removeprefix("self")
    arguments = arguments.removeprefix("/, ").removeprefix("/")
    returned = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{name}({arguments}){returned}"


def words(node: ast.AST) -> str:
    """The docstring without its examples."""
    text = inspect.cleandoc(ast.get_docstring(node) or "")  # type: ignore[arg-type]
    kept = [part for part in text.split("\n\n") if ">>>" not in part]
    return "\n\n".join(kept).replace("``", "`")


def is_property(node: Function) -> bool:
    return any(ast.unparse(one) == "property" for one in node.decorator_list)


def members(node: ast.ClassDef) -> Iterator[str]:
    """Rows of a table: what an event or a part has, and properties."""
    for one in node.body:
        if isinstance(one, ast.Assign) and isinstance(one.value, ast.Call):
            kind = ast.unparse(one.value.func)
            if kind.startswith("Field["):
                doc = ast.literal_eval(one.value.args[-1])
                name = ast.unparse(one.targets[0])
                yield f"| `{name}` | `{kind[6:-1]}` | {doc} |".replace("``", "`")
        if isinstance(one, ast.FunctionDef) and is_property(one) and not one.name.startswith("_"):
            kind = ast.unparse(one.returns) if one.returns else ""
            yield f"| `{one.name}` | `{kind}` | {' '.join(words(one).split())} |"


def described(name: str, files: list[dict[str, Definition]]) -> Iterator[str]:
    """A section for a function or a class, whose bases are in the package, too."""
    nodes = [file[name] for file in files if name in file]
    title = name.rpartition(".")[2]
    yield f"## {name}\n"
    if isinstance(nodes[0], ast.FunctionDef):
        yield f"```python\n{signature(nodes[0], name)}\n```\n\n{words(nodes[0])}\n"
        return
    classes = [node for node in nodes if isinstance(node, ast.ClassDef)]
    bases = {ast.unparse(base).rpartition(".")[2] for node in classes for base in node.bases}
    for base in sorted(bases - {name, "Event", "Part", "Exception", "Error"}):
        classes += [node for file in files if isinstance(node := file.get(base), ast.ClassDef)]
    yield next((f"{text}\n" for node in classes if (text := words(node))), "")
    rows = [row for node in classes for row in members(node)]
    if rows:
        yield "| attribute | type | meaning |\n|---|---|---|\n" + "\n".join(rows).replace(" | None", " or None") + "\n"
    methods: dict[str, ast.FunctionDef] = {}
    for node in classes:
        for one in (one for one in node.body if isinstance(one, ast.FunctionDef) and not is_property(one)):
            # What a base is made of is its own business.
            if not one.name.startswith("_") or (one.name == "__init__" and node is classes[0]):
                methods.setdefault(one.name, one)
    for one in sorted(methods.values(), key=lambda one: one.name != "__init__"):
        is_class = one.name == "__init__"
        shown = signature(one, title if is_class else f"{title}.{one.name}").replace(" -> None", "")
        yield f"```python\n{shown}\n```\n\n{'' if is_class else words(one)}".rstrip() + "\n"


def page() -> str:
    """The whole page."""
    files = [defined(file) for file in ("__init__.py", "_recording.py", "_requests.py", "_events.py", "_taxel.pyi")]
    parts = [HEAD]
    for name in taxel.__all__:
        if any(name in file for file in files):
            parts += described(name, files)
    for module in ("fcm", "folds"):
        names = {f"taxel.{module}.{name}": node for name, node in defined(f"{module}.py").items()}
        for name in names:
            if name.rpartition(".")[2] in getattr(taxel, module).__all__:
                parts += described(name, [names])
    return "\n".join(part for part in parts if part)


@pytest.mark.skipif(not PACKAGE.exists(), reason="outside of the repository")
def test_the_page_is_fresh() -> None:
    wanted = page()
    if "TAXEL_BLESS" in os.environ:
        PAGE.write_text(wanted, encoding="utf-8")
    assert PAGE.exists() and PAGE.read_text(encoding="utf-8") == wanted, f"{PAGE} is not what TAXEL_BLESS=1 writes"


def test_what_is_public_is_listed() -> None:
    assert dir(taxel) == sorted(taxel.__all__)
