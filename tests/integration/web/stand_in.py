#!/usr/bin/env python3
"""The machine that stands in for a real one in the page's tests is as clients/web/openapi.yaml says, at rest and while it
runs, with all that it can have.

Usage: stand_in.py ROOT PROGRAMS
"""
import json
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
from contract import Contract  # noqa: E402

TELL = """
import { StandInMachine } from "./stand_in_machine.mjs";
const machine = new StandInMachine();
const told = [];
const tell = () => told.push(JSON.parse(JSON.stringify({ Machine: machine.description, State: machine.state })));
tell();
machine.haveTwoMotorsOnY();
machine.haveInputs();
machine.haveOutputs();
machine.load("rose.gcode", 100);
tell();
for (const verb of ["run", "hold", "resume", "stop", "estop"]) {
  machine.command(verb, {});
  machine.tick(5);
  tell();
}
console.log(JSON.stringify(told));
"""


def main():
    root = pathlib.Path(sys.argv[1])
    node = subprocess.run(["node", "--input-type=module", "--eval", TELL], cwd=root / "tests/integration/web_page", check=True,
                          stdout=subprocess.PIPE, text=True)
    contract, told = Contract(root), json.loads(node.stdout)
    assert len(told) == 7, f"{len(told)} moments"
    errors = {f"{schema}: {error}" for moment in told for schema, value in moment.items()
              for error in contract.errors({"$ref": f"#/components/schemas/{schema}"}, value)}
    assert not errors, "\n".join(sorted(errors))


if __name__ == "__main__":
    main()
