# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The API reference of Python, from the module's sources and its stub: nothing is imported, so nothing need be built."""

import ast
import inspect
import re

SOURCES = ("__init__.py", "errors.py", "_terracut.pyi")  # the first that defines a name describes it
CALLED = ("__init__", "__call__")  # methods without a name of their own that a user calls
WIDTH = 100


def documentation(node):
    return inspect.cleandoc(ast.get_docstring(node) or "")


def signature(name, node):
    """Returns how a function is called: in one line, or with a line for each argument if that is too long."""
    # Commas outside of brackets separate arguments.
    given = [part for part in re.split(r", (?![^\[(]*[\])])", ast.unparse(node.args)) if part != "self"]
    returned = f" -> {ast.unparse(node.returns)}" if node.returns and node.name != "__init__" else ""
    line = f"{name}({', '.join(given)}){returned}"
    return line if len(line) <= WIDTH else f"{name}(\n" + "".join(f"    {part},\n" for part in given) + f"){returned}"


def function(name, node):
    return f"```python\n{signature(name, node)}\n```\n\n{documentation(node)}"


def class_of(node, returned):
    """Yields a class's parts: how it is made unless a function returns it, its methods, and a table of its properties."""
    yield documentation(node)
    values, properties = [], []
    for member in node.body:
        if isinstance(member, ast.FunctionDef) and member.decorator_list:
            text = " ".join(documentation(member).split()).replace("|", r"\|")
            properties.append(f"| `{member.name}` | `{ast.unparse(member.returns)}` | {text} |")
        elif isinstance(member, ast.FunctionDef) and (member.name in CALLED or not member.name.startswith("_")):
            name = {"__init__": node.name, "__call__": node.name.lower()}.get(member.name, member.name)
            if name not in returned:
                yield function(name, member)
        elif isinstance(member, ast.AnnAssign):
            values.append(f"`{member.target.id}`")
    if values:
        yield f"Constants: {', '.join(values)}."
    if properties:
        yield "| property | type | |\n|---|---|---|\n" + "\n".join(properties)


def python_page(module):
    """Yields the blocks of the page, in Markdown, of all public names of the module in a folder."""
    trees = [ast.parse((module / source).read_text(encoding="utf-8")) for source in SOURCES]
    defined, constants = {}, {}
    for node in [node for tree in trees for node in tree.body]:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            defined.setdefault(node.name, node)
        elif isinstance(node, ast.Assign):
            target, value = node.targets[0], node.value
            pairs = zip(target.elts, value.elts) if isinstance(target, ast.Tuple) else [(target, value)]
            constants |= {name.id: ast.unparse(of) for name, of in pairs}
    public = ast.literal_eval(constants["__all__"])
    about = ast.get_docstring(trees[0], clean=False)  # whose indented lines are code
    yield "# Python reference\n\n" + re.sub(r"docs/(\S+\.md)", r"[\1](../\1)", about)
    yield "| constant | value |\n|---|---|\n" + "\n".join(f"| `{name}` | `{constants[name]}` |" for name in public if name in constants)
    returned = {ast.unparse(node.returns) for node in defined.values() if isinstance(node, ast.FunctionDef) and node.returns}
    for kind, title in ((ast.FunctionDef, "Functions"), (ast.ClassDef, "Classes")):
        yield f"## {title}"
        for name in sorted((name for name in public if isinstance(defined.get(name), kind)), key=str.lower):
            yield f"### {name}"
            yield from [function(name, defined[name])] if kind is ast.FunctionDef else class_of(defined[name], returned)
