#!/usr/bin/env python3
"""Counts the functions of each class. A class with more than MOST_FUNCTIONS is in large_classes.toml, with the number of
its functions, which must not grow, and the reason why it is not divided.

Constructors, destructors and functions that the compiler writes (= default, = delete) do not count.

Usage: check_classes.py ROOT         Prints each breach as file: what; exits 1 where there is one.
       check_classes.py --self-test
"""
import collections
import pathlib
import re
import sys
import tomllib

SOURCES = ("core", "sim_fpga", "services", "clients")
MOST_FUNCTIONS = 20
LIST = "tests/style/large_classes.toml"
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\''
                      r"|^[ \t]*#(?:\\\n|[^\n])*", re.S | re.M)
TOKEN = re.compile(r"[A-Za-z_]\w*|\d[\w.']*|::|->|&&|\S")
CLOSING = {"(": ")", "[": "]", "{": "}", "<": ">"}

ClassCount = collections.namedtuple("ClassCount", "file name functions")


def tokens_of(text):
    return TOKEN.findall(NOT_CODE.sub(" ", text))


def behind(tokens, begin):
    """The index behind the bracket that closes the one at `begin`."""
    opening, depth = tokens[begin], 0
    for i in range(begin, len(tokens)):
        depth += (tokens[i] == opening) - (tokens[i] == CLOSING[opening])
        if depth == 0:
            return i + 1
    return len(tokens)


def class_head(tokens, begin):
    """The name and the index of the brace of the class that is defined at `begin`; None if none is."""
    if tokens[begin] not in ("class", "struct") or (begin > 0 and tokens[begin - 1] in ("enum", "<", ",")):
        return None
    name = None
    for i in range(begin + 1, len(tokens)):
        if tokens[i] == "{":
            return (name, i) if name else None
        if tokens[i] in (";", "(", ")", "=", ">") and name is None or tokens[i] in (";", "(", "="):
            return None
        if name is None and tokens[i].isidentifier():
            name = tokens[i]
    return None


def classes_in(tokens):
    """The name and the tokens of the body of each class, also of those within others."""
    for i in range(len(tokens)):
        if head := class_head(tokens, i):
            name, brace = head
            yield name, tokens[brace + 1:behind(tokens, brace) - 1]


def end_of_member(body, i):
    """The index behind the member whose parameters or value end before `i`: behind its semicolon or its body."""
    in_list = False  # of what a constructor initializes
    while i < len(body):
        if body[i] == ";":
            return i + 1
        if body[i] == ":":
            in_list = True
        if body[i] == "{" and in_list and body[i - 1] not in (")", "}"):
            i = behind(body, i)
            continue
        if body[i] == "{":
            i = behind(body, i)
            return i + 1 if i < len(body) and body[i] == ";" else i
        i = behind(body, i) if body[i] == "(" else i + 1
    return i


def parameters_of(body, i):
    """The index of the parenthesis before the parameters of the member at `i`; None if it is not a function."""
    while i < len(body):
        token = body[i]
        if token == "operator":
            i += 3 if body[i + 1] == "(" else 1
            while body[i] != "(":
                i += 1
            return i
        if token == "(":
            is_name = body[i - 1].isidentifier() and body[i + 1] != "*"
            return i if is_name else None
        if token in (";", "=", "{", ":"):
            return None
        i = behind(body, i) if token in ("<", "[") else i + 1
    return None


def functions_of(name, body):
    """The names of the functions that a class declares."""
    i = 0
    while i < len(body):
        if body[i] in ("public", "private", "protected"):
            i += 2
        elif body[i] == "template":
            i = behind(body, i + 1)
        elif body[i] in ("explicit", "virtual", "static", "constexpr", "inline"):
            i += 1
            if body[i] == "(":
                i = behind(body, i)
        elif body[i] in ("using", "friend", "static_assert", "typedef", "enum", "union"):
            i = body.index(";", i) + 1
        elif head := class_head(body, i):
            i = body.index(";", behind(body, head[1])) + 1
        else:
            at = parameters_of(body, i)
            end = end_of_member(body, behind(body, at) if at is not None else i)
            is_written = at is not None and not {"default", "delete"} & set(body[end - 2:end])
            if is_written and body[at - 1] != name:
                yield body[at - 1]
            i = end


def counts(root):
    for path in sorted(p for layer in SOURCES for p in (root / layer).rglob("*.[hc]pp")):
        for name, body in classes_in(tokens_of(path.read_text())):
            yield ClassCount(path.relative_to(root).as_posix(), name, len(list(functions_of(name, body))))


def breaches(found, listed):
    """listed: the entries of large_classes.toml."""
    allowed = {(entry["file"], entry["name"]): entry["functions"] for entry in listed if entry["reason"]}
    large = {(one.file, one.name): one.functions for one in found if one.functions > MOST_FUNCTIONS}
    for (file, name), functions in large.items():
        most = allowed.get((file, name))
        if most is None:
            yield (f"{file}: {name} has {functions} functions, above {MOST_FUNCTIONS}: divide its duties, or give the "
                   f"reason in {LIST}")
        elif functions > most:
            yield f"{file}: {name} has {functions} functions and may have {most}: move new duties to a class of their own"
        elif functions < most:
            yield f"{file}: {name} has {functions} functions now: write this number instead of {most} into {LIST}"
    for file, name in allowed:
        if (file, name) not in large:
            yield f"{LIST}: {name} of {file} is not above {MOST_FUNCTIONS} functions any more: remove it"


EXAMPLE = """
enum class Kind { A, B };  // class Comment { void no(); };
template <class T>
class One final : public Base<T> {
public:
    explicit One(int a) : a_(a), b_{a}, c_(f({a})) {}
    One(const One&) = delete;
    ~One() override = default;
    virtual std::function<void(int)> made(std::vector<int> of = {}) const noexcept { return [](int) {}; }
    bool operator==(const One&) const = default;
    bool operator()(int) const;
    template <typename F> void each(F f) { f(); }
    static std::expected<One, std::string> make(const char* text = "void no();");
    struct Inner { int inside() const; int value = 0; };
    virtual void pure() = 0;
    std::function<int(int)> member_;
    using Feed = std::function<void(int)>;
    int array_[4]{};
    int (*pointer_)(int);
    friend bool friendly(int);
private:
    Inner inner_{.value = int(3)};
    int count_ = start();
};
"""


def self_test():
    found = [(name, list(functions_of(name, body))) for name, body in classes_in(tokens_of(EXAMPLE))]
    assert found == [("One", ["made", ")", "each", "make", "pure"]), ("Inner", ["inside"])], found
    large = [ClassCount("a.hpp", "A", 22)]
    assert len(list(breaches(large, []))) == 1
    for functions in (21, 22, 23):
        entry = {"file": "a.hpp", "name": "A", "functions": functions, "reason": "one for each command"}
        assert len(list(breaches(large, [entry]))) == (functions != 22)
        assert len(list(breaches([], [entry]))) == 1
    assert list(breaches(large, [{"file": "a.hpp", "name": "A", "functions": 22, "reason": ""}]))
    print("each breach is found")


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1])
    found = list(breaches(list(counts(root)), tomllib.loads((root / LIST).read_text())["class"]))
    print("\n".join(found) if found else f"every class above {MOST_FUNCTIONS} functions has its reason")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
