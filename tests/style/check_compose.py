#!/usr/bin/env python3
"""deploy/make-compose serves any machine, and deploy/compose.yaml is what it makes of the example.

Usage: check_compose.py ROOT
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1])
EXAMPLE = ROOT / "deploy/examples/three-containers.textproto"


def make(machine):
    return subprocess.run([ROOT / "deploy/make-compose", machine], capture_output=True, text=True)


def machine_of(axes, coordinator="planner"):
    """axis { host: "no" } in a comment is none."""
    text = f'name: "mill"\ncoordinator_host: "{coordinator}"  # axis {{ host: "no" }}\n'
    return text + "".join(f'axis {{ name: "{name}" plant {{ start_position_mm: 1 }} host: "{host}" }}\n'
                          for name, host in axes)


def made_of(axes, **more):
    with tempfile.NamedTemporaryFile("w", suffix=".textproto") as file:
        file.write(machine_of(axes, **more))
        file.flush()
        return make(file.name)


def expect(holds, what):
    if not holds:
        sys.exit("check_compose: " + what)


expect(make(EXAMPLE).stdout == (ROOT / "deploy/compose.yaml").read_text(), "compose.yaml is not make-compose's any more")
for count in (1, 2, 6):
    hosts = [f"board{i}" for i in range(count)]
    text = made_of([(f"A{i}", host) for i, host in enumerate(hosts)]).stdout
    expect(re.findall(r"(?m)^  (\w+):\n    <<: \*axis\n    hostname: \1$", text) == hosts, f"{count} axes: the services")
    expect(re.findall(r"- (\w+):/records/\1:ro", text) == ["coordinator"] + hosts, f"{count} axes: the client's records")
    volumes = re.findall(r"(\w+): \{\}", re.search(r"(?m)^volumes: .*", text).group(0))
    expect(volumes == ["coordinator", *hosts, "log"], f"{count} axes: the volumes")
    expect("hostname: planner\n" in text and "axis-x" not in text.split("services:")[1], f"{count} axes: the rest")
for wrong, says in ((made_of([("X", "a"), ("Y", "a")]), "host of its own"), (made_of([("X", "")]), "name the host"),
                    (made_of([("X", "a")], coordinator=""), "coordinator_host"), (make("/nothing"), "no such file")):
    expect(wrong.returncode != 0 and says in wrong.stderr and not wrong.stdout, f"refusal: {says}: {wrong.stderr}")
