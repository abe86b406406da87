"""Whether samples show growth.

Memory is judged by its peaks: receive buffers fill and are given back, so that two instants differ by some hundred KB
whatever happened between. The first quarter of each phase is the warm-up; the last quarter's peak is compared with the
second's.
"""
import dataclasses

PHASES = ("clients", "jobs")
EXACT = ("descriptors", "threads", "shm_files")


@dataclasses.dataclass
class Judged:
    growth_kb: dict   # by (process, phase)
    growth_each: dict  # bytes for each client or job, by (process, phase)
    wrong: list


def peak_kb(rows, part):
    """Of one quarter of the phase, 0 to 3."""
    return max(row.rss_anon_kb for row in rows[len(rows) * part // 4:max(len(rows) * (part + 1) // 4, 1)])


def growth(rows):
    """In KB, and in how many clients or jobs."""
    return peak_kb(rows, 3) - peak_kb(rows, 1), rows[-1].done / 2


def judge(samples, options):
    judged = Judged({}, {}, [])
    for process in samples.processes:
        for phase in PHASES:
            rows = samples.of(process, phase)
            if len(rows) < 8:
                continue
            grown_kb, over = growth(rows)
            judged.growth_kb[process, phase] = grown_kb
            judged.growth_each[process, phase] = 1024 * grown_kb / over
            limit_kb = options.limit_kb + options.limit_bytes_each * over / 1024
            if grown_kb > limit_kb:
                judged.wrong.append(f"{process} by {grown_kb} KB over {over:.0f} {phase}; the limit is {limit_kb:.0f} KB")
        judged.wrong += differences(samples, process)
    return judged


def differences(samples, process):
    """What a process or the machine has more or less of at rest than before."""
    before = samples.of(process, "before")[0]
    for row in samples.of(process, "between") + samples.of(process, "after"):
        for what in EXACT:
            if getattr(row, what) != getattr(before, what):
                yield f"{process}: {getattr(before, what)} {what} before, {getattr(row, what)} {row.phase} the phases"


def table(judged, samples, options, seconds):
    """Markdown."""
    last = samples.rows[-1]
    lines = [f"{options.clients} clients and {options.jobs} jobs in {seconds / 60:.0f} minutes; "
             f"{samples.failed_jobs} jobs were cut short by the host and begun again.", "",
             "| process | before, KB | after, KB | growth over the last half of the clients, bytes each "
             "| of the jobs, bytes each | descriptors | threads |", "|---|---|---|---|---|---|---|"]
    for process in samples.processes:
        before, after = samples.of(process, "before")[0], samples.of(process, last.phase)[-1]
        each = [f"{judged.growth_each.get((process, phase), 0):.0f}" for phase in PHASES]
        lines.append(f"| {process} | {before.rss_anon_kb} | {after.rss_anon_kb} | {each[0]} | {each[1]} | "
                     f"{before.descriptors} → {after.descriptors} | {before.threads} → {after.threads} |")
    return "\n".join(lines + ["", f"Files in /dev/shm: {samples.rows[0].shm_files} → {last.shm_files}."])
