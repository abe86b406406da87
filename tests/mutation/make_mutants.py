"""Writes a copy of the sources in which every change is there at the same time, chosen by a number at run time
("mutant schemata": Untch, Offutt, Harrold, 1993). Lines keep their numbers."""
import json

from find_mutants import Finder, Kind, macro_sites

BYTES = "latin-1"  # a character for each byte, because the compiler counts bytes


def sources(root, folders):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".cpp", ".hpp") or path.name == "rules.inc":
                yield path


def nest(sites):
    """Nests the sites into a tree; leaves out a site that overlaps another without lying inside it."""
    roots, stack = [], []
    for site in sites:
        site.inner = []
        while stack and stack[-1].end <= site.start:
            stack.pop()
        if stack and site.end > stack[-1].end:
            continue
        (stack[-1].inner if stack else roots).append(site)
        stack.append(site)
    return roots


class Rewriter:
    def __init__(self, path, text, dropped, first):
        self.path, self.text, self.dropped, self.next = path, text, dropped, first
        self.mutants = []

    def number(self, site, what, instead):
        n, self.next = self.next, self.next + 1
        line = self.text.count("\n", 0, site.start) + 1
        was = " ".join(self.text[site.start:site.end].split())
        self.mutants.append({"file": self.path, "line": line, "what": what, "was": was,
                             "is": " ".join(instead.split()), "used": (self.path, line) not in self.dropped})
        return n

    def render(self, sites, start, end):
        out, at = [], start
        for site in sites:
            out += [self.text[at:site.start], self.render_site(site)]
            at = site.end
        return "".join(out) + self.text[at:end]

    def render_site(self, site):
        inside = self.render(site.inner, site.start, site.end)
        for what, instead in site.changes:
            n = self.number(site, what, instead)
            if not self.mutants[-1]["used"]:
                continue
            if site.kind == Kind.STATEMENT:
                inside = f"if (!::lockstep::mutant({n})) {inside}"
            elif what == "negated":
                inside = f"(::lockstep::mutant({n}) != static_cast<bool>({inside}))"
            else:
                inside = f"(::lockstep::mutant({n}) ? ({' '.join(instead.split())}) : ({inside}))"
        return inside


def put(path, text):
    """Leaves a file with the right text untouched, so that the build does not compile it again."""
    if not path.exists() or path.read_text(encoding=BYTES) != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding=BYTES)


def find(root, folders):
    """The text of each source and the places in it to change."""
    for path in sources(root, folders):
        text = path.read_text(encoding=BYTES)
        if path.suffix == ".inc":
            text = text.replace("\\\n", "  ")
            yield path.relative_to(root), text, macro_sites(text)
        else:
            yield path.relative_to(root), text, Finder(str(path), text).find([f"-I{root}"])


def rewrite(found, copy, dropped):
    """Writes the changed sources into the copy; returns the mutants, by number from 0."""
    mutants = []
    for name, text, sites in found:
        rewriter = Rewriter(str(name), text, dropped, len(mutants))
        put(copy / name, rewriter.render(nest(sites), 0, len(text)))
        mutants += rewriter.mutants
    (copy / "mutants.json").write_text(json.dumps(mutants, indent=0))
    return mutants
