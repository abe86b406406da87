#!/usr/bin/env python3
"""Checks that deploy/make-compose serves any machine, and that deploy/compose.yaml and compose.peers.yaml are its
output for the example.

Usage: check_compose.py ROOT
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1])
EXAMPLE = ROOT / "deploy/examples/three-containers.textproto"


def make(machine, *options):
    return subprocess.run([ROOT / "deploy/make-compose", *options, machine], capture_output=True, text=True)


def machine_of(axes, coordinator="planner", peers=()):
    """A machine's file; the axis in its comment does not count."""
    text = f'name: "mill"\ncoordinator_host: "{coordinator}"  # axis {{ host: "no" }}\n'
    text += "network { " + " ".join(f'peers: "{peer}"' for peer in peers) + " }\n"
    return text + "".join(f'axis {{ name: "{name}" plant {{ start_position_mm: 1 }} host: "{host}" }}\n'
                          for name, host in axes)


def made_of(axes, *options, **more):
    with tempfile.NamedTemporaryFile("w", suffix=".textproto") as file:
        file.write(machine_of(axes, **more))
        file.flush()
        return make(file.name, *options)


def expect(holds, what):
    if not holds:
        sys.exit("check_compose: " + what)


expect(make(EXAMPLE).stdout == (ROOT / "deploy/compose.yaml").read_text(), "compose.yaml differs from the output of make-compose")
expect(make(EXAMPLE, "--peers").stdout == (ROOT / "deploy/compose.peers.yaml").read_text(),
       "compose.peers.yaml differs from the output of make-compose --peers")


def peers_of(axes, **more):
    """Each service's address, the subnet, and the range of addresses for all other containers."""
    made = made_of(axes, "--peers", **more)
    services = re.findall(r"(?m)^  (\w+):\n    command: .*\n    networks: .*ipv4_address: ([\d.]+)", made.stdout)
    return services, re.findall(r"subnet: (\S+), ip_range: ([\d./]+)", made.stdout)


for count in (1, 2, 6):
    hosts = [f"board{i}" for i in range(count)]
    axes = [(f"A{i}", host) for i, host in enumerate(hosts)]
    services, network = peers_of(axes)
    expect([name for name, _ in services] == ["coordinator", *hosts], f"{count} axes: the peers' services")
    expect([address for _, address in services] == [f"10.213.76.{10 + i}" for i in range(count + 1)],
           f"{count} axes: the addresses that are chosen")
    given = [f"192.168.7.{200 + i}" for i in range(count + 1)]
    services, network = peers_of(axes, peers=given)
    expect([address for _, address in services] == given, f"{count} axes: the addresses of network.peers")
    expect(network == [("192.168.7.0/24", "192.168.7.0/25")], f"{count} axes: {network}")
    text = made_of([(f"A{i}", host) for i, host in enumerate(hosts)]).stdout
    expect(re.findall(r"(?m)^  (\w+):\n    <<: \*axis\n    hostname: \1$", text) == hosts, f"{count} axes: the services")
    expect(re.findall(r"- (\w+):/records/\1:ro", text) == ["coordinator"] + hosts, f"{count} axes: the client's records")
    volumes = re.findall(r"(\w+): \{\}", re.search(r"(?m)^volumes: .*", text).group(0))
    expect(volumes == ["coordinator", *hosts, "log", "web"], f"{count} axes: the volumes")
    expect("hostname: planner\n" in text and "axis-x" not in text.split("services:")[1], f"{count} axes: the rest")
for wrong, message in ((made_of([("X", "a"), ("Y", "a")]), "host of its own"), (made_of([("X", "")]), "name the host"),
                    (made_of([("X", "a")], coordinator=""), "coordinator_host"), (make("/nothing"), "no such file"),
                    (made_of([("X", "a")], "--peers", peers=["10.0.0.1"]), "each of the 2 containers"),
                    (made_of([("X", "a")], "--peers", peers=["here", "there"]), "IPv4 address"),
                    (made_of([("X", "a")], "--peers", peers=["10.0.0.1", "10.0.1.2"]), "must all be in 10.0.0.0/24"),
                    (made_of([("X", "a")], "--peers", peers=["10.0.0.1", "10.0.0.200"]), "one half")):
    expect(wrong.returncode != 0 and message in wrong.stderr and not wrong.stdout, f"refusal: {message}: {wrong.stderr}")
