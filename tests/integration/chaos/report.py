"""A run as text and as JSON."""
import statistics


def median(values):
    known = [value for value in values if value is not None]
    return statistics.median(known) if known else None


def figures(found):
    """For each kind of fault: the count, and medians of the times to the first reaction and to rest."""
    kinds = sorted({timed.chapter.injected.kind for timed in found.timed})
    for kind in kinds:
        of_kind = [timed for timed in found.timed if timed.chapter.injected.kind == kind]
        yield {"kind": kind, "times": len(of_kind), "reacted": sum(t.reaction_ms is not None for t in of_kind),
               "reaction_ms": median([t.reaction_ms for t in of_kind]), "rest_ms": median([t.rest_ms for t in of_kind])}


def to_json(found):
    return {"exact": not found.failures, "failures": found.failures, "verify": found.verify,
            "figures": list(figures(found)),
            "timeline": [{"at_us": t.chapter.injected.at_us, "what": t.chapter.injected.text, "phase": t.chapter.phase,
                          "fault": t.chapter.fault, "job": t.chapter.job, "remedies": t.chapter.remedies,
                          "reaction_ms": t.reaction_ms, "rest_ms": t.rest_ms} for t in found.timed]}


def to_text(found):
    cell = lambda value: "-" if value is None else f"{value:.0f}"
    lines = ["", f"{'fault':<26} {'times':>5} {'reacted':>7} {'reaction ms':>11} {'rest ms':>7}   (medians)"]
    lines += [f"{f['kind']:<26} {f['times']:>5} {f['reacted']:>7} {cell(f['reaction_ms']):>11} {cell(f['rest_ms']):>7}"
              for f in figures(found)]
    lines += ["", found.verify, ""]
    lines += [f"FAILED: {failure}" for failure in found.failures] or [f"all held, through {len(found.timed)} faults"]
    return "\n".join(lines)
