#!/usr/bin/env python3
"""Checks that the commands accept every command line in a document: its verb and its options are in --help.

Usage: check_commands.py ROOT BIN    BIN has the programs. Programs that are missing there are not checked.

A command line begins an indented line or a word in backticks, perhaps behind `docker compose run --rm client`. A script
of the tree must exist and be executable, and a CMakeLists.txt must build each program named below build/bin.
"""
import functools
import pathlib
import re
import subprocess
import sys

GIT_FILES = ["git", "-c", "safe.directory=*", "ls-files", "-co", "--exclude-standard"]  # accepts a clone of any owner
PROGRAMS = "lockstep|lockstep-axis|lockstep-board|lockstep-coordinator|lockstep-fpga|lockstep-grbl|lockstep-simtest|lockstep-web"
COMMAND = re.compile(rf"(?:^|[;&|] *|client |CYCLONEDDS_URI=\S+ )({PROGRAMS}) +(?=[a-z-])(.*)")
SCRIPT = re.compile(r"(?m)(?:^    |`)((?:tests|deploy|core|docs|idl|sim_fpga)/[\w./-]+)(?= [\w<-])")
BUILT = re.compile(r"build/bin/([\w-]+)")
SEPARATOR = re.compile(r"\s#|[|;>]|&&|\\$|\.\.\.")


def documents(root):
    listed = subprocess.run(GIT_FILES + ["*.md"], cwd=root, capture_output=True, text=True, check=True)
    return listed.stdout.splitlines()


def command_lines(text):
    """The command lines, each with its line number."""
    for number, line in enumerate(text.splitlines(), 1):
        pieces = [line.strip()] if line.startswith("    ") else re.findall(r"`([^`]+)`", line)
        for piece in pieces:
            found = COMMAND.search(piece)
            if found:
                yield number, found.group(1), SEPARATOR.split(found.group(2))[0].split()


@functools.cache
def help_of(*words):
    run = subprocess.run([*words, "--help"], capture_output=True, text=True, check=False)
    return run.stdout if run.returncode == 0 else None


def verbs_in(text):
    listed = re.findall(r"(?ms)^Verbs[^\n]*:\n(.*?)(?=^\S|\Z)", text)
    return re.findall(r"(?m)^  ([a-z]\S*)", "".join(listed))


def breach(program, words):
    """The error in a command line; None if there is none."""
    path = [str(program)]
    text = help_of(*path)
    while words and re.match("[^-=]+$", words[0]) and verbs_in(text):  # X=10 is a value
        if words[0] not in verbs_in(text):
            return f"{program.name} has no command {words[0]}"
        path.append(words.pop(0))
        text = help_of(*path)
    options = [re.split("[=,]", word)[0] for word in words if re.match("--[a-z]|-[a-z]$", word)]
    for option in options:
        if not re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", text):
            return f"{' '.join([program.name, *path[1:]])} has no option {option}"
    return None


def missing_programs(root, text):
    """The commands in the text that do not exist."""
    for script in SCRIPT.findall(text):
        if not (root / script).is_file() or not (root / script).stat().st_mode & 0o100:
            yield f"{script} is not an executable file"
    made = "".join(file.read_text() for folder in ("clients", "services", "tests") for file in (root / folder).rglob("CMakeLists.txt"))
    for program in BUILT.findall(text):
        if not re.search(rf"\b{program}\b", made):
            yield f"no CMakeLists.txt builds {program}"


def main():
    root, programs = map(pathlib.Path, sys.argv[1:])
    found, count = [], 0
    for document in documents(root):
        text = (root / document).read_text()
        found += [f"{document}: {what}" for what in missing_programs(root, text)]
        for number, name, words in command_lines(text):
            if not (programs / name).exists():
                continue
            count += 1
            wrong = breach(programs / name, words)
            if wrong:
                found.append(f"{document}:{number}: {wrong}")
    if count == 0:
        sys.exit(f"no command line found: are {root} a clone and {programs} a folder with the programs?")
    print("\n".join(found) if found else f"{count} command lines are accepted")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
