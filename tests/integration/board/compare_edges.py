"""Compares the edges of a board's step pins with the recorded steps: compare_edges.py LOG EDGES. Exits 1 if one differs."""
import pathlib
import sys
from collections import defaultdict

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "deploy/examples"))
import read_log  # noqa: E402

made = defaultdict(list)
for line in open(sys.argv[2], encoding="ascii"):
    motor, tick, direction = line.split()
    made[motor].append((int(tick), int(direction)))

batches = defaultdict(dict)
for message in read_log.messages(sys.argv[1]):
    if isinstance(message, read_log.step_batch_t):
        batches[message.axis][message.incarnation, message.sequence] = message

is_equal = bool(made)
for motor, edges in sorted(made.items()):
    recorded = [step for _, batch in sorted(batches[motor].items())
                for step in zip(read_log.step_ticks(batch), batch.direction)]
    different = sum(one != other for one, other in zip(edges, recorded)) + abs(len(edges) - len(recorded))
    print(f"{motor}: {len(edges)} edges at the pins, {len(recorded)} steps recorded, {different} different")
    is_equal = is_equal and different == 0
sys.exit(not is_equal)
