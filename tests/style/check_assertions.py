#!/usr/bin/env python3
"""Finds tests that assert nothing: neither their body nor a helper that it calls contains an assertion.

Usage: check_assertions.py ROOT    exit codes: 0 every test asserts something, 1 some do not
       check_assertions.py --self-test    checks that it finds such a test, and no other

A helper counts if it is defined in the test's folder or in any header; helpers of helpers count, too. The check knows
functions only by their names."""
import pathlib
import re
import sys

ASSERTION = re.compile(r"\b((EXPECT|ASSERT|RC_ASSERT|RC_FAIL|ADD_FAILURE|GTEST_SKIP)(_\w+)?|FAIL|SUCCEED)\b")
TEST = re.compile(r"^\s*(TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\((\w+),\s*(\w+)[^{;]*\)", re.M)
FUNCTION = re.compile(r"\b(\w+)\s*(?:<[^;{}()]*>)?\([^;{}]*\)\s*(?:const\s*)?(?:override\s*)?(?:->[^;{}()]+)?\{")
LAMBDA = re.compile(r"\bauto\s+(\w+)\s*=\s*\[")
CALL = re.compile(r"\b(\w+)\s*(?:<[^;()]*>)?[({]")
NO_FUNCTIONS = {"if", "for", "while", "switch", "catch", "return"}
# Names that many classes have, so a header's function of this name proves nothing.
COMMON = set("begin end value at move string run open job data push_back test read write line home wait process "
             "ready send start stop reset".split())


def without_text(source):
    """The source without comments and without the content of strings. Lines keep their numbers."""
    source = re.sub(r'R"(\w*)\((.*?)\)\1"', lambda found: '""' + "\n" * found[0].count("\n"), source, flags=re.S)
    source = re.sub(r"//[^\n]*", "", source)
    return re.sub(r'"(\\.|[^"\\\n])*"', '""', source)


def body(source, begin):
    """The block in braces behind a place."""
    opened = source.find("{", begin)
    depth = 0
    for at in range(opened, len(source)):
        depth += {"{": 1, "}": -1}.get(source[at], 0)
        if depth == 0:
            return source[opened:at + 1]
    return source[opened:]


def functions(sources):
    """Yields the name of each function, the folder in which it counts (None: everywhere), and its body."""
    for path, source in sources.items():
        folder = path.parent if path.suffix == ".cpp" else None
        for found in [*FUNCTION.finditer(source), *LAMBDA.finditer(source)]:
            if found[1] not in NO_FUNCTIONS and not TEST.match(found[0]):
                begin = found.end() - 1 if found[0].endswith("{") else found.end()
                yield found[1], folder, body(source, begin)


def asserting(sources):
    """The names of functions that assert something, with the folders in which they count."""
    known = list(functions(sources))
    found = {(name, folder) for name, folder, text in known if ASSERTION.search(text)}
    while True:
        names = {name for name, _ in found}
        more = {(name, folder) for name, folder, text in known if set(CALL.findall(text)) & names} - found
        if not more:
            return found
        found |= more


def silent_tests(sources):
    helpers = asserting(sources)
    for path, source in sorted(sources.items()):
        for found in TEST.finditer(source):
            text = body(source, found.end())
            calls = set(CALL.findall(text))
            helped = any((name, path.parent) in helpers or (name not in COMMON and (name, None) in helpers)
                         for name in calls)
            if not helped and not ASSERTION.search(text):
                yield f"{path}:{source.count(chr(10), 0, found.start(2)) + 1}: {found[2]}.{found[3]} asserts nothing"


def self_test():
    source = """
    void expect_two(int n) { EXPECT_EQ(n, 2); }
    void expect_it() { expect_two(2); }
    TEST(Some, AssertsItself) { EXPECT_TRUE(true); }
    TEST(Some, AssertsByAHelper) { expect_it(); }
    TEST(Some, AssertsNothing) { run("EXPECT_EQ(1, 1)"); }  // EXPECT
    """
    found = list(silent_tests({pathlib.Path("tests/some_test.cpp"): without_text(source)}))
    assert len(found) == 1 and "Some.AssertsNothing" in found[0], found
    print("finds a test that asserts nothing, and no other")


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1])
    paths = [path for path in (root / "tests").rglob("*") if path.suffix in (".cpp", ".hpp")]
    found = list(silent_tests({path.relative_to(root): without_text(path.read_text()) for path in paths}))
    print("\n".join(found) or "every test asserts something")
    return sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
