"""Checks samples for growth.

Memory is evaluated by its peaks: receive buffers fill and are freed, so that two instants differ by several hundred KB
without any growth. The first quarter of each phase is the warm-up; the peak of the last quarter is compared with that of the
second quarter.
"""
import dataclasses

PHASES = ("clients", "jobs")
EXACT = ("descriptors", "threads", "shm_files")


@dataclasses.dataclass
class Evaluation:
    growth_kb: dict   # by (process, phase)
    growth_each: dict  # bytes for each client or job, by (process, phase)
    wrong: list


def peak_kb(rows, part):
    """The peak of one quarter of the phase, 0 to 3."""
    return max(row.rss_anon_kb for row in rows[len(rows) * part // 4:max(len(rows) * (part + 1) // 4, 1)])


def growth(rows):
    """The growth in KB, and the number of clients or jobs during it."""
    return peak_kb(rows, 3) - peak_kb(rows, 1), rows[-1].done / 2


def evaluate(samples, options):
    result = Evaluation({}, {}, [])
    for process in samples.processes:
        for phase in PHASES:
            rows = samples.of(process, phase)
            if len(rows) < 8:
                continue
            grown_kb, over = growth(rows)
            result.growth_kb[process, phase] = grown_kb
            result.growth_each[process, phase] = 1024 * grown_kb / over
            limit_kb = options.limit_kb + options.limit_bytes_each * over / 1024
            if grown_kb > limit_kb:
                result.wrong.append(f"{process} by {grown_kb} KB over {over:.0f} {phase}; the limit is {limit_kb:.0f} KB")
        result.wrong += differences(samples, process)
    return result


def differences(samples, process):
    """The resources at rest of which a process or the machine has more or fewer than before."""
    before = samples.of(process, "before")[0]
    for row in samples.of(process, "between") + samples.of(process, "after"):
        for what in EXACT:
            if getattr(row, what) != getattr(before, what):
                yield f"{process}: {getattr(before, what)} {what} before, {getattr(row, what)} {row.phase} the phases"


def table(result, samples, options, seconds):
    """The table as Markdown."""
    last = samples.rows[-1]
    lines = [f"{options.clients} clients and {options.jobs} jobs in {seconds / 60:.0f} minutes; "
             f"{samples.failed_jobs} jobs were interrupted by the host and repeated.", "",
             "| process | before, KB | after, KB | growth over the last half of the clients, bytes each "
             "| of the jobs, bytes each | descriptors | threads |", "|---|---|---|---|---|---|---|"]
    for process in samples.processes:
        own = [row for row in samples.rows if row.process == process]
        before, after = own[0], own[-1]
        each = [f"{result.growth_each.get((process, phase), 0):.0f}" for phase in PHASES]
        lines.append(f"| {process} | {before.rss_anon_kb} | {after.rss_anon_kb} | {each[0]} | {each[1]} | "
                     f"{before.descriptors} → {after.descriptors} | {before.threads} → {after.threads} |")
    return "\n".join(lines + ["", f"Files in /dev/shm: {samples.rows[0].shm_files} → {last.shm_files}."])
