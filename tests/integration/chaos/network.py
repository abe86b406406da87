"""A network in namespaces: one for each of the machine's processes, all joined by a bridge called eth0.

A process is put into its namespace by a program of the same name beside the lockstep command; so
`lockstep up` starts, supervises and restarts processes on separate hosts unmodified. Links are cut and
packets lost by the firewall of their namespace. The record (LCM) is not affected: it is needed for the
evaluation.
"""
import pathlib
import shutil
import subprocess
import time

LCM_PORT = 7667
BRIDGE = "eth0"  # the same name everywhere, since the machine's file names one interface
MTU = 65535      # no fragmented datagrams: the firewall sees the port only in the first fragment


def run(*words):
    subprocess.run(words, check=True, capture_output=True)


class Network:
    def __init__(self, hosts):
        self.holders = {}
        run("ip", "link", "set", "lo", "up")
        run("ip", "link", "add", BRIDGE, "type", "bridge", "mcast_snooping", "0")
        run("ip", "link", "set", BRIDGE, "mtu", str(MTU), "up")
        run("ip", "addr", "add", "10.9.0.1/24", "dev", BRIDGE)
        run("ip", "route", "add", "224.0.0.0/4", "dev", BRIDGE)
        for number, host in enumerate(hosts, 2):
            self._add_host(host, number)

    def _add_host(self, host, number):
        holder = subprocess.Popen(["unshare", "--net", "sleep", "infinity"])
        self.holders[host] = holder
        while pathlib.Path(f"/proc/{holder.pid}/comm").read_text() != "sleep\n":
            time.sleep(0.01)
        run("ip", "link", "add", f"to-{number}", "type", "veth", "peer", "name", BRIDGE, "netns", str(holder.pid))
        run("ip", "link", "set", f"to-{number}", "mtu", str(MTU), "master", BRIDGE, "up")
        self._on(host, "ip", "link", "set", "lo", "up")
        self._on(host, "ip", "link", "set", BRIDGE, "mtu", str(MTU), "up")
        self._on(host, "ip", "addr", "add", f"10.9.0.{number}/24", "dev", BRIDGE)
        self._on(host, "ip", "route", "add", "224.0.0.0/4", "dev", BRIDGE)

    def _enter(self, host):
        return ["nsenter", f"--net=/proc/{self.holders[host].pid}/ns/net"]

    def _on(self, host, *words):
        run(*self._enter(host), *words)

    def install(self, programs, directory):
        """Installs the lockstep command with its programs, each in its own namespace. Returns the command's path."""
        directory.mkdir()
        shutil.copy2(programs / "lockstep", directory)
        self._write_program(directory / "lockstep-coordinator", programs, [("*", "coordinator")])
        axes = [(f'*" --axis {host[5:]} "*', host) for host in self.holders if host.startswith("axis-")]
        self._write_program(directory / "lockstep-axis", programs, axes)
        return directory / "lockstep"

    def _write_program(self, path, programs, cases):
        lines = ["#!/bin/sh", 'case " $* " in']
        for pattern, host in cases:
            lines.append(f'{pattern}) exec {" ".join(self._enter(host))} {programs / path.name} "$@";;')
        path.write_text("\n".join(lines + ["esac"]) + "\n")
        path.chmod(0o755)

    def drop(self, host, directions, probability=1.0):
        """Drops packets that a process sends (OUTPUT) or receives (INPUT), with a probability, until `heal`."""
        chance = ["-m", "statistic", "--mode", "random", "--probability", str(probability)] if probability < 1 else []
        for chain in directions:
            self._on(host, "iptables", "-A", chain, "-o" if chain == "OUTPUT" else "-i", BRIDGE, "-p", "udp",
                     "!", "--dport", str(LCM_PORT), *chance, "-j", "DROP")

    def heal(self, host):
        self._on(host, "iptables", "-F")

    def close(self):
        for holder in self.holders.values():
            holder.kill()
            holder.wait()
