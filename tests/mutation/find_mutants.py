"""Finds the places in the syntax tree of a C++ source that can be changed, and the changes to try at each place.

A `Site` replaces a range of the text. `Kind.EXPRESSION` sites choose between the text and its changes at run time;
`Kind.STATEMENT` sites run the statement or not."""
import enum
import re
from dataclasses import dataclass, field

try:
    from clang import cindex
    from clang.cindex import CursorKind, TypeKind
except ModuleNotFoundError:
    raise SystemExit("Debian's Python needs clang: apt-get install python3-clang-19 libclang-19-dev") from None

ARGUMENTS = ["-x", "c++", "-std=c++23", "-fsyntax-only"]

COMPARISONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
OTHER_BOUND = {"<": "-", "<=": "+", ">": "+", ">=": "-"}  # the right side also changes by 1 this way
SWAPS = {"+": "-", "-": "+", "+=": "-=", "-=": "+=", "&&": "||", "||": "&&"}

# The compiler evaluates these, or they are only declarations.
SKIPPED = {CursorKind.STATIC_ASSERT, CursorKind.ENUM_CONSTANT_DECL, CursorKind.TYPE_ALIAS_DECL,
           CursorKind.ANNOTATE_ATTR}
CONDITIONAL = {CursorKind.IF_STMT, CursorKind.CONDITIONAL_OPERATOR, CursorKind.WHILE_STMT}
DROPPED = {CursorKind.CALL_EXPR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR, CursorKind.UNARY_OPERATOR,
           CursorKind.BINARY_OPERATOR}


class Kind(enum.Enum):
    EXPRESSION = 1
    STATEMENT = 2


@dataclass
class Site:
    start: int
    end: int
    kind: Kind
    changes: list = field(default_factory=list)  # (what, text instead)


def is_integer(cursor):
    return cursor.type.get_canonical().kind in (
        TypeKind.INT, TypeKind.UINT, TypeKind.LONG, TypeKind.ULONG, TypeKind.LONGLONG, TypeKind.ULONGLONG,
        TypeKind.SHORT, TypeKind.USHORT, TypeKind.UCHAR, TypeKind.SCHAR)


class Finder:
    def __init__(self, path, text):
        self.path, self.text = path, text
        self.sites = {}

    def find(self, arguments):
        unit = cindex.Index.create().parse(self.path, args=ARGUMENTS + arguments)
        errors = [d for d in unit.diagnostics if d.severity >= cindex.Diagnostic.Error]
        if errors:
            raise SystemExit(f"{self.path}: not understood: {errors[0].location}: {errors[0].spelling}")
        for child in unit.cursor.get_children():
            if child.location.file and child.location.file.name == self.path:
                self.walk(child, None)
        return sorted(self.sites.values(), key=lambda s: (s.start, -s.end, -s.kind.value))

    def span(self, cursor):
        return self.text[cursor.extent.start.offset:cursor.extent.end.offset]

    def add(self, cursor, kind, what, instead):
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        if start >= end or "#" in self.text[start:end] or "//" in self.text[start:end]:
            return
        site = self.sites.setdefault((start, end, kind), Site(start, end, kind))
        if all(other != instead for _, other in site.changes):
            site.changes.append((what, instead))

    def walk(self, cursor, parent):
        if cursor.kind in SKIPPED or self.is_constexpr_variable(cursor) or self.is_check(cursor):
            return
        if cursor.kind == CursorKind.FIELD_DECL and cursor.is_bitfield():
            return
        self.visit(cursor, parent)
        children = list(cursor.get_children())
        if cursor.kind == CursorKind.CASE_STMT:
            children = children[1:]
        for child in children:
            declares = cursor.kind in (CursorKind.VAR_DECL, CursorKind.FIELD_DECL, CursorKind.PARM_DECL,
                                       CursorKind.FUNCTION_DECL, CursorKind.CXX_METHOD)
            if declares and child.extent.end.offset <= cursor.location.offset:
                continue  # a part of the type
            self.walk(child, cursor)

    def is_constexpr_variable(self, cursor):
        return cursor.kind == CursorKind.VAR_DECL and "constexpr" in self.span(cursor).split("=")[0]

    def is_check(self, cursor):
        """A check(...) only verifies an assumption of the code; without it nothing else changes."""
        return cursor.kind == CursorKind.CALL_EXPR and cursor.spelling == "check"

    def visit(self, cursor, parent):
        kind = cursor.kind
        if parent is not None and parent.kind == CursorKind.COMPOUND_STMT:
            self.drop(cursor)
        if kind in CONDITIONAL:
            self.negate(cursor)
        if kind in (CursorKind.BINARY_OPERATOR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR, CursorKind.CALL_EXPR,
                    CursorKind.UNEXPOSED_EXPR):
            self.swap_operator(cursor)
        if kind == CursorKind.UNARY_OPERATOR and re.match(r"-\s*[A-Za-z_(]", self.span(cursor)):
            self.add(cursor, Kind.EXPRESSION, "sign dropped", self.span(cursor)[1:])
        if kind == CursorKind.CALL_EXPR and cursor.spelling in ("min", "max"):
            self.swap_extreme(cursor)
        self.change_literal(cursor)

    def drop(self, cursor):
        inner = cursor
        while inner.kind == CursorKind.UNEXPOSED_EXPR and len(list(inner.get_children())) == 1:
            inner = next(inner.get_children())
        text = self.span(cursor)
        if inner.kind in DROPPED and not text.startswith(("return", "static_cast<void>")) and "check(" not in text[:14]:
            self.add(cursor, Kind.STATEMENT, "dropped", "")

    def negate(self, cursor):
        children = list(cursor.get_children())
        if self.span(cursor).startswith("if constexpr"):
            return
        # if (init; condition): the condition is the last expression before the first statement
        if cursor.kind == CursorKind.IF_STMT:
            first = next((i for i, c in enumerate(children) if c.kind.is_statement() and
                          c.kind != CursorKind.DECL_STMT), len(children) - 1)
            children = [c for c in children[:first] if c.kind.is_expression()][-1:]
        if not children or not children[0].kind.is_expression():
            return
        condition = children[0]
        if any(c.kind == CursorKind.VAR_DECL and condition.extent.start.offset < c.extent.end.offset
               for c in cursor.get_children()):
            return  # if (const auto x = f())
        text = self.span(condition)
        self.add(condition, Kind.EXPRESSION, "negated", f"!({text})")

    def operator(self, cursor):
        """The operator in the text between two operands, and the operands."""
        children = list(cursor.get_children())
        if len(children) == 3:  # an overloaded one: left, operator, right
            children = [children[0], children[2]]
        if len(children) != 2:
            return None
        left, right = children
        if left.extent.end.offset > right.extent.start.offset:
            return None
        between = self.text[left.extent.end.offset:right.extent.start.offset].strip()
        return (between, left, right) if between in COMPARISONS or between in SWAPS else None

    def swap_operator(self, cursor):
        found = self.operator(cursor)
        if not found:
            return
        op, left, right = found
        a, b = self.span(left), self.span(right)
        other = COMPARISONS.get(op) or SWAPS[op]
        start, end = cursor.extent.start.offset, cursor.extent.end.offset
        if (left.extent.start.offset, right.extent.end.offset) != (start, end):
            return
        if not self.compiles(op, cursor, left, right):
            return
        negated = self.sites.get((start, end, Kind.EXPRESSION))
        if op not in ("==", "!=") or not negated:  # otherwise the negation is the same change
            self.add(cursor, Kind.EXPRESSION, f"{op} is {other}", f"{a} {other} {b}")
        same_as_constant = OTHER_BOUND.get(op) == "+" and right.kind == CursorKind.INTEGER_LITERAL
        if op in OTHER_BOUND and is_integer(left) and not same_as_constant:
            self.add(cursor, Kind.EXPRESSION, f"bound {OTHER_BOUND[op]}1", f"{a} {op} ({b}) {OTHER_BOUND[op]} 1")

    def compiles(self, op, cursor, left, right):
        """Whether the changed code compiles: instants have a difference and no sum, strings a sum and no difference."""
        of, other, result = (c.type.get_canonical() for c in (left, right, cursor))
        names = [t.spelling.replace("const ", "") for t in (of, other, result)]
        if op in SWAPS and any("basic_string" in name for name in names):
            return False
        if op == "+=" and of.kind == TypeKind.RECORD:
            return False
        return op != "-" or of.kind not in (TypeKind.RECORD, TypeKind.POINTER) or names[2] == names[0]

    def swap_extreme(self, cursor):
        other = {"min": "max", "max": "min"}[cursor.spelling]
        text = self.span(cursor)
        instead = re.sub(rf"^((?:std::)?){cursor.spelling}\b", rf"\g<1>{other}", text)
        if instead != text:
            self.add(cursor, Kind.EXPRESSION, f"{cursor.spelling} is {other}", instead)

    def change_literal(self, cursor):
        text = self.span(cursor)
        if cursor.kind == CursorKind.INTEGER_LITERAL and re.fullmatch(r"[0-9']+", text):
            self.add(cursor, Kind.EXPRESSION, "constant", str(int(text.replace("'", "")) + 1))
        if cursor.kind == CursorKind.FLOATING_LITERAL:
            self.add(cursor, Kind.EXPRESSION, "constant", "1.0" if re.fullmatch(r"0*\.?0*", text) else f"2 * {text}")
        if cursor.kind == CursorKind.CXX_BOOL_LITERAL_EXPR and text in ("true", "false"):
            self.add(cursor, Kind.EXPRESSION, "constant", {"true": "false", "false": "true"}[text])


def macro_sites(text):
    """The rules of the protocol are macros: returns sites within the value of each."""
    text = text.replace("\\\n", "  ")  # keeps the length
    sites = []
    for line in re.finditer(r"^#define RULE_\w+(\([^)]*\))? +(\(.*\)|\d+)$", text, re.M):
        start, end = line.span(2)
        body, site = text[start:end], Site(start, end, Kind.EXPRESSION)
        for at in re.finditer(r"(?<=\s)(<=|>=|==|&&|[<>+-])(?=\s)|(?<=\))(-)(?=RULE)|\b\d+\b|!(?=[(A-Z])", body):
            old = at.group()
            new = (str(int(old) + 1) if old.isdigit() else "" if old == "!" else COMPARISONS.get(old) or SWAPS[old])
            site.changes.append((f"{old} is {new}", body[:at.start()] + new + body[at.end():]))
        if site.changes:
            sites.append(site)
    return sites
