#!/usr/bin/env python3
"""Checks that links, files, folders and functions in documents exist, and that README and ARCHITECTURE are short.

Usage: check_documents.py ROOT [--fix]

Every document is a .md file. In backticks, a word with a slash that begins with one of the tree's folders is a path; a word
that ends with a source file's suffix is a file's name; `file`: `Name::function` is a function in that file; `CamelCase` is a
name in the code; `Name::member` is declared in the class, structure or enumeration Name, or in a base of it; `5 (`kName`)` is
a constant and its value. Types in docs/words.md are declared once in core. --fix renames a path whose file was moved, where
only one file has its name.
"""
import argparse
import collections
import pathlib
import re
import subprocess
import sys

GIT_FILES = ["git", "-c", "safe.directory=*", "ls-files", "-co", "--exclude-standard"]  # accepts a clone of any owner
MOST_LINES = {"README.md": 150, "ARCHITECTURE.md": 250}
MOST_PICTURE_BYTES = 150_000
MOST_BLOCK = 60_000  # characters of a class
UNITS = {None: 1, " KiB": 1 << 10, " MiB": 1 << 20}
FOLDERS = "core|sim_fpga|idl|services|clients|deploy|tests|docs"
PATH = re.compile(rf"`((?:{FOLDERS})/[\w./@-]*)`")
NAME = re.compile(r"`([\w-]+\.(?:hpp|cpp|inc|py|proto|idl|lcm|pml|js))`")
FUNCTION = re.compile(rf"`((?:{FOLDERS})/[\w./-]+)`:\s+`([A-Za-z_][\w:]*)`")
TYPE = re.compile(r"`([A-Z][a-z]+[A-Z]\w*)(?:::\w+)*`")
MEMBER = re.compile(r"`(?:\w+::)*([A-Z]\w*)::(~?\w+)`")
BLOCK = re.compile(r"\b(?:class|struct|enum class|enum) (\w+)\b([^;{}()]*)\{")
CONSTANT = re.compile(r"(\d[\d,]*)( [KM]iB)?[^|`()\d]* \(`(k[A-Z]\w*)`\)")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")


class Tree:
    """The files of the repository, and all words in its code."""

    def __init__(self, root):
        self.root = root
        listed = subprocess.run(GIT_FILES, cwd=root, capture_output=True, text=True, check=False)
        self.files = [f for f in listed.stdout.splitlines() if (root / f).exists()]
        self.by_name = collections.defaultdict(list)
        for file in self.files:
            self.by_name[file.rsplit("/", 1)[-1]].append(file)
        self.code = "\n".join((root / f).read_text() for f in self.files if f.endswith((".hpp", ".cpp", ".inc", ".lcm", ".idl")))
        self.words = set(re.findall(r"\w+", self.code))
        self.blocks = collections.defaultdict(list)  # of classes, structures and enumerations
        for block in BLOCK.finditer(self.code):
            self.blocks[block.group(1)].append(block)

    def declares(self, name, member):
        """Whether a class, structure or enumeration of this name, or a base of it, declares the member."""
        for found in self.blocks[name]:
            body = self.outer_text(found.end())
            if re.search(rf"\b{member}\b", body):
                return True
            rows = re.findall(r"^\s*(LOCKSTEP_\w+)\(X\)", body, re.MULTILINE)  # its values are the rows of a table
            tables = [re.search(rf"#define {table}\(X\)((?:.*\\\n)*.*)", self.code).group(1) for table in rows]
            if any(re.search(rf"X\({member}\b", table) for table in tables):
                return True
            if any(self.declares(base, member) for base in re.findall(r"\b[A-Z]\w+", found.group(2))):
                return True
        return False

    def outer_text(self, at):
        """The text of a block that begins there, without the blocks inside it and without comments."""
        depth, text = 1, []
        for part in re.finditer(r"//[^\n]*|[{}]|[^{}/]+|/", self.code[at : at + MOST_BLOCK]):
            depth += {"{": 1, "}": -1}.get(part.group(), 0)
            if depth == 0:
                break
            if depth == 1 and not part.group().startswith("//"):
                text.append(part.group())
        return "".join(text)

    def documents(self):
        return [f for f in self.files if f.endswith(".md")]

    def values(self, constant):
        """The values of the constants with this name that are a number or a shifted number."""
        found = re.findall(rf"\b{constant} = ([\d']+)(?: << (\d+))?[;,]", self.code)
        return {int(number.replace("'", "")) << int(shift or 0) for number, shift in found}

    def has(self, path):
        return (self.root / path).exists()

    def moved_to(self, path):
        found = self.by_name[path.rstrip("/").rsplit("/", 1)[-1]]
        return found[0] if len(found) == 1 else None

    def defines(self, path, name):
        """A file defines a name, or its header or source beside it does."""
        file = self.root / path
        files = [file.with_suffix(suffix) for suffix in (".hpp", ".cpp", ".inc")] if file.suffix in (".hpp", ".cpp") else [file]
        text = "".join(f.read_text() for f in files if f.exists())
        return all(re.search(rf"\b{part}\b", text) for part in name.split("::"))


def prose(text):
    """The text without examples: indented lines and fenced blocks are left empty."""
    inside, lines = False, []
    for line in text.splitlines():
        inside ^= line.startswith("```")
        lines.append("" if inside or line.startswith("    ") else line)
    return "\n".join(lines)


def breaches(tree, document):
    whole = (tree.root / document).read_text()
    count = len(whole.splitlines())
    if count > MOST_LINES.get(document, count):
        yield 1, f"{count} lines; at most {MOST_LINES[document]}: move something to docs/"
    text = prose(whole)

    def line_of(match):
        return text.count("\n", 0, match.start()) + 1

    folder = pathlib.Path(document).parent
    for link in LINK.finditer(text):
        target = link.group(1)
        if not re.match(r"[a-z]+:", target) and not (tree.root / folder / target).exists():
            yield line_of(link), f"the link {target} leads nowhere"
    for path in PATH.finditer(text):
        if not tree.has(path.group(1)):
            now = tree.moved_to(path.group(1))
            yield line_of(path), f"{path.group(1)} does not exist" + (f"; it is now {now} (--fix)" if now else "")
    for name in NAME.finditer(text):
        if name.group(1) not in tree.by_name:
            yield line_of(name), f"no file is called {name.group(1)}"
    for function in FUNCTION.finditer(text):
        if tree.has(function.group(1)) and not tree.defines(*function.groups()):
            yield line_of(function), f"{function.group(1)} has no {function.group(2)}"
    for name in TYPE.finditer(text):
        if name.group(1) not in tree.words:
            yield line_of(name), f"the code has no {name.group(1)}"
    for member in MEMBER.finditer(text):
        if not tree.declares(*member.groups()):
            yield line_of(member), f"{member.group(1)} declares no {member.group(2)}"
    for constant in CONSTANT.finditer(text):
        number, unit, name = constant.groups()
        if int(number.replace(",", "")) * UNITS[unit] not in tree.values(name):
            yield line_of(constant), f"{name} is {sorted(tree.values(name))}, not {number}{unit or ''}"


def words(tree):
    """Types in the last column of docs/words.md that core and services/setup do not declare once: their name alone would not
    tell what they are."""
    declaring = [f for f in tree.files if f.startswith(("core/", "services/setup/")) and f.endswith((".hpp", ".cpp"))]
    core = "\n".join((tree.root / f).read_text() for f in declaring)
    cells = re.findall(r"\|([^|\n]*)\|$", (tree.root / "docs/words.md").read_text(), re.MULTILINE)
    types = dict.fromkeys(name for cell in cells for name in re.findall(r"`([A-Z]\w*)`", cell))
    for name in types:
        declared = re.findall(rf"^\s*(?:struct|class|enum class|using) {name}\b(?!::)[^;]*?[{{=:]", core, re.MULTILINE)
        if len(declared) != 1:
            yield f"docs/words.md:1: core declares {name} {len(declared)} times; it must be once, so that a word has one meaning"


def unlinked(tree):
    """Documents below docs/ that no other document links to."""
    linked = set()
    for document in tree.documents():
        folder = (tree.root / document).parent
        linked |= {(folder / link).resolve() for link in LINK.findall((tree.root / document).read_text())}
    for document in tree.documents():
        if document.startswith("docs/") and (tree.root / document).resolve() not in linked:
            yield f"{document}:1: no document links to it"


def pictures(tree):
    for file in tree.files:
        size = (tree.root / file).stat().st_size
        if file.startswith("docs/pictures/") and size > MOST_PICTURE_BYTES:
            yield f"{file}:1: {size} bytes; at most {MOST_PICTURE_BYTES}"
    drawn = subprocess.run([tree.root / "docs/draw_parts.py"], capture_output=True, text=True, check=True).stdout
    if drawn != (tree.root / "docs/pictures/parts.svg").read_text():
        yield "docs/pictures/parts.svg:1: is not what docs/draw_parts.py draws; run: docs/make-pictures"


def fix(tree, document):
    file = tree.root / document
    text = file.read_text()
    for path in sorted(set(PATH.findall(text)), key=len, reverse=True):
        now = None if tree.has(path) else tree.moved_to(path)
        if now:
            text = text.replace(f"`{path}`", f"`{now}`")
    file.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--fix", action="store_true")
    options = parser.parse_args()
    tree = Tree(options.root.resolve())
    if options.fix:
        for document in tree.documents():
            fix(tree, document)
    found = [f"{document}:{line}: {what}" for document in tree.documents() for line, what in breaches(tree, document)]
    found += [*words(tree), *unlinked(tree), *pictures(tree)]
    if not tree.documents():
        sys.exit("no documents found: is git there, and ROOT a clone?")
    print("\n".join(found) if found else f"{len(tree.documents())} documents are in order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
