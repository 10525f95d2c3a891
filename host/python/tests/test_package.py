"""The package as a user finds it: examples, types, the command."""

from __future__ import annotations

import ast
import doctest
import importlib.metadata
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest
import taxel
from conftest import program

ROOT = Path(__file__).parents[3]
DOCS = [ROOT / "docs/guides" / page for page in ("python.md", "python-boards.md")]
READMES = [ROOT / "README.md", ROOT / "host/python/README.md"]
MODULES = [taxel, taxel.fcm, sys.modules["taxel._recording"]]


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__)
def test_examples_run(module: object) -> None:
    found = doctest.testmod(module, optionflags=doctest.ELLIPSIS)  # type: ignore[arg-type]
    assert found.attempted > 0 and found.failed == 0


@pytest.mark.skipif(not DOCS[0].exists(), reason="outside of the repository")
@pytest.mark.parametrize("page", DOCS, ids=lambda page: str(page.name))
def test_the_page_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    program("record", "--source", "sim:pat", "--for", "4s", "-o", "pat.mcap")
    # What stands between the code blocks is no output.
    lines = page.read_text(encoding="utf-8").splitlines()
    text = "\n".join("" if line.startswith("```") else line for line in lines)
    examples = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    found = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(examples)
    assert found.attempted > 10 and found.failed == 0


@pytest.mark.skipif(not DOCS[0].exists(), reason="outside of the repository")
@pytest.mark.parametrize("readme", READMES, ids=lambda readme: str(readme.parent.name))
def test_the_readme_runs(readme: Path, capsys: pytest.CaptureFixture[str]) -> None:
    blocks = re.findall(r"```python\n(.*?)```", readme.read_text(encoding="utf-8"), re.DOTALL)
    assert blocks
    for block in blocks:
        exec(compile(block, str(readme), "exec"), {})
    assert "back" in capsys.readouterr().out


def test_the_command() -> None:
    assert program("--version").strip() == f"taxel {taxel.__version__}"
    assert importlib.metadata.version("taxel") == taxel.__version__
    done = subprocess.run([sys.executable, "-m", "taxel", "live", "--source", "radio"], capture_output=True)
    assert done.returncode == 2
    script = Path(sys.executable).with_name("taxel")
    assert subprocess.run([script, "config", "touches"], capture_output=True, check=True).stdout.startswith(b"pat")


def public(thing: type) -> list[tuple[str, object]]:
    """The class and its public attributes, by name."""
    own = [(f"{thing.__name__}.{name}", value) for name, value in vars(thing).items() if not name.startswith("_")]
    return [(thing.__name__, thing), *own]


def test_all_is_documented() -> None:
    named = {name: getattr(taxel, name) for name in taxel.__all__}
    things = [(name, thing) for name, thing in named.items() if callable(thing) and not isinstance(thing, type)]
    things += [pair for thing in named.values() if isinstance(thing, type) for pair in public(thing)]
    assert len(things) > 300
    assert [name for name, thing in things if not inspect.getdoc(thing)] == []
    # The stub says it to editors.
    stub = ast.parse((Path(taxel.__file__).parent / "_taxel.pyi").read_text(encoding="utf-8"))
    defined = [node for node in ast.walk(stub) if isinstance(node, (ast.ClassDef, ast.FunctionDef))]
    plain = [node.name for node in defined if not node.name.startswith("_") and not ast.get_docstring(node)]
    assert plain == []
    assert (Path(taxel.__file__).parent / "py.typed").exists()


def test_warnings_go_to_the_logging_of_python(caplog: pytest.LogCaptureFixture) -> None:
    next(iter(taxel.open("sim:press", garment="block-4x16")))
    (warning,) = [record for record in caplog.records if record.name == "taxel"]
    assert "the garment block-4x16 has no panel chest" in warning.getMessage()
