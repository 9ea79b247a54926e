# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Where mistakes can be planted: places in the syntax tree, each with the wrong text that takes its place."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from clang.cindex import CursorKind as Kind
from clang.cindex import Index, TypeKind

ROOMS = ("calib", "firmware_io", "pipeline", "rt")

SYMMETRIC = {"max", "min", "minmax", "hypot"}  # swapped arguments change nothing
COMPARISONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
LOGIC = {"&&": "||", "||": "&&"}
ARITHMETIC = {"+": "-", "-": "+", "*": "+", "/": "*", "%": "+"}

SCALARS = {TypeKind.BOOL, TypeKind.CHAR_U, TypeKind.UCHAR, TypeKind.USHORT, TypeKind.UINT, TypeKind.ULONG, TypeKind.ULONGLONG,
           TypeKind.CHAR_S, TypeKind.SCHAR, TypeKind.SHORT, TypeKind.INT, TypeKind.LONG, TypeKind.LONGLONG, TypeKind.FLOAT,
           TypeKind.DOUBLE, TypeKind.ENUM}  # fmt: skip
FUNCTIONS = {Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.FUNCTION_TEMPLATE}
ASSIGNMENTS = {Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR}
# What the compiler works out, no test can notice while running.
CONSTANT = {Kind.STATIC_ASSERT, Kind.ENUM_CONSTANT_DECL, Kind.TYPE_ALIAS_DECL, Kind.CONCEPT_DECL}


@dataclass(frozen=True)
class Site:
    """`shape` is what stands in place of the bytes [begin, end), with {id} for the mistake's number."""

    file: str  # from the repository's root
    line: int
    begin: int
    end: int
    rule: str
    before: str
    after: str
    shape: str

    def key(self):
        return f"{self.file}:{self.begin}:{self.end}:{self.rule}"


def is_scalar(cursor):
    return cursor.type.get_canonical().kind in SCALARS


class _Source:
    def __init__(self, root, path):
        self.name = str(path.relative_to(root))
        self.bytes = path.read_bytes()

    def text(self, begin, end):
        return self.bytes[begin:end].decode(errors="replace")

    def site(self, cursor, rule, before, after, shape, at=None):
        begin, end = at or (cursor.extent.start.offset, cursor.extent.end.offset)
        line = self.bytes.count(b"\n", 0, begin) + 1
        return Site(self.name, line, begin, end, rule, before, after, shape)


def _expression(source, cursor, rule, before, after, wrong):
    right = source.text(cursor.extent.start.offset, cursor.extent.end.offset)
    # Text is put into a format string later, so its braces are doubled.
    shape = "(::terracut::mutants::planted({id}) ? (" + _escaped(wrong) + ") : (" + _escaped(right) + "))"
    return source.site(cursor, rule, before, after, shape)


def _escaped(text):
    return text.replace("{", "{{").replace("}", "}}")


def _binary(source, cursor):
    children = list(cursor.get_children())
    if len(children) != 2:
        return
    left, right = (source.text(child.extent.start.offset, child.extent.end.offset) for child in children)
    between = source.text(children[0].extent.end.offset, children[1].extent.start.offset)
    operator = between.strip()
    if not left or not right or not all(map(is_scalar, children)):
        return
    for rule, table in (("comparison", COMPARISONS), ("logic", LOGIC), ("arithmetic", ARITHMETIC)):
        if operator in table:
            wrong = left + between.replace(operator, table[operator]) + right
            yield _expression(source, cursor, rule, operator, table[operator], wrong)


def _literal(source, cursor):
    text = source.text(cursor.extent.start.offset, cursor.extent.end.offset)
    if text and text[0].isdigit():
        yield _expression(source, cursor, "constant", text, f"{text} + 1", f"{text} + 1")


def _negation(source, cursor):
    text = source.text(cursor.extent.start.offset, cursor.extent.end.offset)
    operand = next(iter(cursor.get_children()), None)
    if operand is not None and text.startswith(("!", "-")) and is_scalar(operand) and is_scalar(cursor):
        if operand.kind != Kind.INTEGER_LITERAL:
            # What is asked only whether it holds may be of any type: the mistake is a bool, as the right one is.
            yield _expression(source, cursor, "sign", text[0], "", "!" + text if text[0] == "!" else text[1:])


def _statement(source, cursor):
    begin, end = cursor.extent.start.offset, cursor.extent.end.offset
    text = source.text(begin, end)
    if text and source.text(end, end + 1) == ";":
        shape = "if (!::terracut::mutants::planted({id})) " + _escaped(text)
        yield source.site(cursor, "dropped", text, "", shape)


def _swapped(source, cursor):
    if cursor.spelling in SYMMETRIC:
        return
    arguments = list(cursor.get_arguments())
    for one, other in zip(arguments, arguments[1:]):
        if one is None or other is None:
            continue
        a, b = one.extent, other.extent
        first, second = source.text(a.start.offset, a.end.offset), source.text(b.start.offset, b.end.offset)
        same_type = one.type.get_canonical().spelling == other.type.get_canonical().spelling
        if not first or not second or first == second or not same_type or not is_scalar(one):
            continue
        begin, end = cursor.extent.start.offset, cursor.extent.end.offset
        if not begin <= a.start.offset < b.end.offset <= end:
            continue
        wrong = (source.text(begin, a.start.offset) + second + source.text(a.end.offset, b.start.offset) + first
                 + source.text(b.end.offset, end))  # fmt: skip
        yield _expression(source, cursor, "swapped", f"{first}, {second}", f"{second}, {first}", wrong)
        return


def _early_return(source, function, body):
    result = function.result_type.get_canonical().kind
    value = {TypeKind.VOID: "", TypeKind.BOOL: " false"}.get(result, " {{}}" if result in SCALARS else None)
    is_whole = function.kind in (Kind.FUNCTION_DECL, Kind.CXX_METHOD)
    if value is None or not is_whole or len(list(body.get_children())) < 2:
        return
    begin = body.extent.start.offset + 1
    shape = " if (::terracut::mutants::planted({id})) return" + value + ";"
    yield source.site(body, "early return", function.spelling, "return" + value.replace("{{}}", " {}"), shape, (begin, begin))


def _is_constant(source, cursor):
    if cursor.kind in CONSTANT:
        return True
    begin = cursor.extent.start.offset
    if cursor.kind == Kind.VAR_DECL:
        head = source.text(begin, begin + 60).split("=")[0].split("{")[0]
        return "constexpr" in head or "constinit" in head
    if cursor.kind == Kind.IF_STMT:
        return source.text(begin, begin + 12) == "if constexpr"
    return cursor.kind == Kind.FIELD_DECL and cursor.is_bitfield()


def _sites(source, cursor, parent, in_body):
    if _is_constant(source, cursor):
        if cursor.kind != Kind.IF_STMT:
            return
        children = list(cursor.get_children())[1:]  # the branches of an `if constexpr`
    else:
        children = list(cursor.get_children())
    if in_body:
        is_statement = parent is not None and parent.kind == Kind.COMPOUND_STMT
        if cursor.kind == Kind.BINARY_OPERATOR:
            yield from _binary(source, cursor)
        if cursor.kind == Kind.INTEGER_LITERAL:
            yield from _literal(source, cursor)
        if cursor.kind == Kind.UNARY_OPERATOR:
            yield from _negation(source, cursor)
        if cursor.kind == Kind.CALL_EXPR:
            yield from _swapped(source, cursor)
        is_assignment = cursor.kind in ASSIGNMENTS and cursor.type.kind != TypeKind.DEPENDENT
        if is_statement and (cursor.kind == Kind.CALL_EXPR or is_assignment):
            yield from _statement(source, cursor)
    for child in children:
        if cursor.kind == Kind.CASE_STMT and child == children[0]:
            continue
        body = cursor.kind in FUNCTIONS and child.kind == Kind.COMPOUND_STMT
        if body:
            yield from _early_return(source, cursor, child)
        yield from _sites(source, child, cursor, in_body or body or cursor.kind == Kind.LAMBDA_EXPR)


def _arguments_of(command):
    words = command.split()
    wanted, take = [], False
    for word in words:
        if take:
            wanted.append(word)
            take = False
        elif word == "-isystem":
            wanted.append(word)
            take = True
        elif word.startswith(("-I", "-D", "-std=")):
            wanted.append(word.replace('\\"', '"'))
    return wanted


_HEADERS_SEEN = set()  # by this process: a header has the same sites in every source that includes it


def sites_of(root, source, command):
    """The sites in a source file, and in the headers of the four rooms that it includes and that were not looked at before."""
    unit = Index.create().parse(str(source), args=_arguments_of(command))
    sources, found = {}, []
    for cursor in unit.cursor.get_children():
        file = cursor.location.file
        if file is None:
            continue
        path = Path(file.name).resolve()
        if path not in sources:
            inside = path.is_relative_to(root) and path.relative_to(root).parts[0] in ROOMS and path not in _HEADERS_SEEN
            sources[path] = _Source(root, path) if inside else None
        if sources[path] is not None:
            found.extend(_sites(sources[path], cursor, None, False))
    _HEADERS_SEEN.update(sources)
    return found


def to_json(sites):
    return json.dumps([asdict(site) for site in sites], indent=0)


def from_json(text):
    return [Site(**site) for site in json.loads(text)]
