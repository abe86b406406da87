"""The tests of the machine in containers: each story starts it, and reports what did not hold."""
import os
import signal
import subprocess
import time

import image
from composed import PARTS

FAR = ("move", "X=190", "Y=150", "Z=20", "--feed", "900")
BACK = ("move", "X=50", "Y=20", "Z=50", "--feed", "1800")


def run_story(story, composed):
    """The failures of a story, with the parts' logs if there are any."""
    try:
        story(composed)
        if composed.failures:
            composed.failures.append(composed.compose("logs", "--tail", "40")[1])
    finally:
        composed.down()
    return composed.failures


def the_image_holds_no_more_than_is_needed(composed):
    """The image: no compiler in it, and it runs as a user without rights"""
    run = lambda script: composed.podman.ask("run", "--rm", "--network", "none", image.NAME, "sh", "-c", script)
    tools = "cc c++ gcc g++ as ld cmake ninja make git npm"
    code, output = run(f"for tool in {tools}; do command -v $tool; done; ls /src /build 2>/dev/null; true")
    composed.expect((code, output) == (0, ""), f"the image contains build tools: {output}")
    code, output = run("id -un")
    composed.expect((code, output) == (0, "lockstep"), f"the image runs as {output}")


def a_machine_comes_up_and_moves(composed):
    """Up, home and a move of three axes by multicast, every step on record; then everything ends on request"""
    if not composed.up() or not composed.home():
        return
    if composed.move(*BACK, by=lambda *words: composed.client("lockstep", *words)):
        composed.expect(composed.verify() > 10_000, "too few steps are on record")
    expect_little_rights(composed)
    expect_well(composed)
    expect_to_end_as_asked(composed)


def expect_little_rights(composed):
    for part in (*PARTS, "logger"):
        output = composed.inside(part, "sh", "-c", "id -u; grep -E 'CapEff|CapBnd|NoNewPrivs' /proc/self/status; "
                                                 "touch /usr/x && echo written; true")[1]
        composed.expect(not output.startswith("0\n"), f"{part} runs as root")
        composed.expect(output.count("0000000000000000") == 2, f"{part} has capabilities: {output}")
        composed.expect("NoNewPrivs:\t1" in output, f"{part} could gain rights: {output}")
        composed.expect("Read-only file system" in output and "written" not in output, f"{part} can write to /usr: {output}")
        composed.expect(not composed.inspect(part)["HostConfig"]["PortBindings"], f"{part} publishes ports")


def expect_well(composed):
    for part in PARTS:
        code, output = composed.podman.ask("healthcheck", "run", composed.container(part))
        composed.expect(code == 0, f"{part} is not healthy: {output}")


def expect_to_end_as_asked(composed):
    """A process that has not ended after the grace period is killed: its exit code would be 137."""
    composed.compose("stop")
    for part in (*PARTS, "logger"):
        state = composed.inspect(part)["State"]
        composed.expect(state["Status"] == "exited" and state["ExitCode"] == 0,
                        f"{part} has not ended as asked: {state['Status']}, exit code {state['ExitCode']}")


def an_axis_that_dies_is_restarted(composed):
    """An axis killed in motion: the others stop on the path, the engine restarts it, nothing moves without a command"""
    if not composed.up() or not (move := begin_move(composed)):
        return
    process = composed.inspect("axis-z")["State"]["Pid"]
    os.kill(process, signal.SIGKILL)  # not by the engine, which would treat it as requested
    expect_spoilt(composed, move)
    expect_still(composed)
    state = composed.inspect("axis-z")["State"]
    composed.expect(state["Running"] and state["Pid"] != process, f"it was not restarted: {state}")
    if composed.move(*BACK):
        composed.verify(killed=True)


def an_axis_is_paused_in_motion(composed):
    """An axis paused in motion for two seconds: the others stop on the path, and the machine recovers"""
    if not composed.up() or not (move := begin_move(composed)):
        return
    composed.podman.ask("pause", composed.container("axis-y"))
    time.sleep(2)
    composed.podman.ask("unpause", composed.container("axis-y"))
    move.communicate()  # it may continue by itself, if every axis is at exactly the same place
    composed.wait_for("nothing moves", lambda s: s["phase"] in ("Idle", "Fault") and stands(s))
    composed.verify()
    if composed.move(*BACK):
        composed.verify()


def begin_move(composed):
    """Begins a long move. Returns it in motion, or None."""
    for _ in range(3):
        if not composed.home():
            return None
        move = composed.begin(*FAR)
        composed.wait_for("the move begins", lambda s: s["phase"] == "Running" or move.poll() is not None)
        time.sleep(1.5)
        if move.poll() is None:
            return move
        move.communicate()
    composed.expect(False, "a move does not last")
    return None


def stands(status):
    return all(axis.get("at_rest") for axis in status["axes"] if axis.get("present"))


def expect_spoilt(composed, move):
    output, _ = move.communicate()
    composed.expect(move.returncode == 1, f"a move whose axis was killed: exit code {move.returncode}: {output}")
    composed.wait_for("the others stand", lambda s: stands(s) and s["phase"] != "Running")


def expect_still(composed):
    """A restarted axis is present, and nothing moves without a command."""
    places = lambda status: [axis.get("position_steps") for axis in status.get("axes", [])]
    before = composed.wait_for("all axes are there", lambda s: all(axis.get("present") for axis in s["axes"]))
    time.sleep(2)
    after = composed.status()
    composed.expect(places(before) == places(after) and stands(after), f"moved unasked: {before} {after}")


def a_machine_moves_without_multicast(composed):
    """Without multicast: home and a move by named peers, some of them absent; the parts' own logs, merged, are the record"""
    machine = composed.work / "peers.textproto"
    text = (composed.folder / "examples" / "three-containers.textproto").read_text()
    away = " ".join(f'peers: "10.213.76.{number}"' for number in (98, 99))
    machine.write_text(text.replace("#peers:", f"{away} peers:"))
    composed.use(["compose.yaml", "compose.peers.yaml"], machine)
    if not composed.up():
        return
    for part in PARTS:
        on_network_of(composed, part, "-A", "OUTPUT", "-p", "udp", "-d", "224.0.0.0/4", "-j", "DROP")
    client = composed.client_by_podman
    if composed.move(*BACK, by=lambda *words: client("lockstep", *words)):
        code, output = client("sh", "-c", "lockstep log merge whole.lcm /records/*/*/record")
        composed.expect(code == 0 and "complete as far as is known" in output, f"lockstep log merge: exit code {code}: {output}")
        composed.expect(composed.verify("lockstep verify whole.lcm", client) > 10_000, "too few steps are on record")
    for part in PARTS:
        counted = on_network_of(composed, part, "-L", "OUTPUT", "-v", "-x", "-n")
        packets = int(counted.splitlines()[2].split()[0])
        composed.expect(packets == 0, f"{part} sends to multicast addresses: {packets} packets")


def scenarios_are_played_in_containers(composed):
    """Scenarios that ship, in containers: a part killed, one stopped, a link cut; evaluated as elsewhere"""
    files = [composed.folder / "scenarios" / f"{name}.textproto" for name in ("axis-killed", "long-pause", "deaf-axis")]
    ran = subprocess.run([composed.programs / "lockstep", "scenario", "run", *files, "--place", "CONTAINER"],
                         env=composed.podman.as_the_hosts(), capture_output=True, text=True)
    composed.expect(ran.returncode == 0, f"lockstep scenario run: exit code {ran.returncode}: {ran.stdout}{ran.stderr}")


def on_network_of(composed, part, *words):
    pid = composed.inspect(part)["State"]["Pid"]
    return subprocess.run(["nsenter", f"--net=/proc/{pid}/ns/net", "iptables", *words], check=True,
                          capture_output=True, text=True).stdout


ALL = (the_image_holds_no_more_than_is_needed, a_machine_comes_up_and_moves, an_axis_that_dies_is_restarted,
       an_axis_is_paused_in_motion, a_machine_moves_without_multicast, scenarios_are_played_in_containers)
