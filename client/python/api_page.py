"""api_page.py OUT: the page of the package's interface, as Markdown, made of its docstrings.

Read from the source text, for the texts below fields as well, which a running program does not have.
"""

from __future__ import annotations

import ast
import sys
from pathlib import Path
from typing import Iterator, Union

PACKAGE = Path(__file__).resolve().parent / "src" / "trc"
Function = Union[ast.FunctionDef, ast.AsyncFunctionDef]


def definitions(module: str) -> dict[str, ast.stmt]:
    """Classes and functions of a module by name."""
    tree = ast.parse((PACKAGE / f"{module}.py").read_text())
    return {node.name: node for node in tree.body
            if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef))}


def exported() -> Iterator[tuple[str, ast.stmt]]:
    """What `import trc` gives, by name, from where it is imported from."""
    for node in ast.parse((PACKAGE / "__init__.py").read_text()).body:
        if isinstance(node, ast.ImportFrom) and node.module:
            found = definitions(node.module)
            yield from ((name.name, found[name.name]) for name in node.names if name.name in found)


def paragraphs(node: ast.AST) -> str:
    text = ast.get_docstring(node) or ""
    return f"\n{text}\n" if text else ""


def signature(function: Function, owner: str) -> str:
    arguments = ast.unparse(function.args).replace("self, ", "").replace("self", "", 1)
    name = owner + ("" if function.name == "__init__" else f".{function.name}" if owner
                    else function.name)
    returns = f" -> {ast.unparse(function.returns)}" if function.returns else ""
    is_awaited = isinstance(function, ast.AsyncFunctionDef)
    return ("await " if is_awaited else "") + f"{name}({arguments})" + (
        "" if function.name == "__init__" else returns)


def is_public(function: Function) -> bool:
    return not function.name.startswith("_") or function.name == "__init__"


def fields(body: list[ast.stmt]) -> Iterator[str]:
    """Fields and members of an enum, with the text below each."""
    for at, node in enumerate(body):
        if isinstance(node, ast.AnnAssign):
            head = f"{ast.unparse(node.target)}: {ast.unparse(node.annotation)}"
        elif isinstance(node, ast.Assign):
            head = ast.unparse(node)
        else:
            continue
        below = body[at + 1] if at + 1 < len(body) else None
        text = ""
        if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant):
            text = ": " + " ".join(str(below.value.value).split())
        yield f"* `{head}`{text}\n"


def page_of(name: str, node: ast.stmt) -> str:
    if not isinstance(node, ast.ClassDef):
        assert isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
        return f"\n### {name}\n\n```text\n{signature(node, '')}\n```\n{paragraphs(node)}"
    text = f"\n### {name}\n{paragraphs(node)}"
    listed = "".join(fields(node.body))
    text += f"\n{listed}" if listed else ""
    for member in node.body:
        if not isinstance(member, (ast.FunctionDef, ast.AsyncFunctionDef)) or not is_public(member):
            continue
        decorators = [ast.unparse(each) for each in member.decorator_list]
        if "staticmethod" in decorators:  # made of messages of the protocol: the package's own
            continue
        shown = (f"{name}.{member.name}" if "property" in decorators
                 else signature(member, name).replace("cls, ", ""))
        text += f"\n```text\n{shown}\n```\n{paragraphs(member)}"
    return text


def page() -> str:
    """The whole page."""
    text = f"# trc\n\n{ast.get_docstring(ast.parse((PACKAGE / '__init__.py').read_text()))}\n"
    text += "".join(page_of(name, node) for name, node in exported())
    text += f"\n## trc.aio\n\n{ast.get_docstring(ast.parse((PACKAGE / 'aio.py').read_text()))}\n"
    return text + "".join(page_of(name, node) for name, node in definitions("aio").items())


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(page())
