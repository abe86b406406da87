"""Draws the samples as a picture: the memory of each process during the clients, then during the jobs."""
WIDTH, HEIGHT = 900, 420
LEFT, RIGHT, TOP, BOTTOM = 70, 120, 30, 50
COLOURS = ("#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2", "#7f7f7f", "#bcbd22", "#17becf")
PHASES = ("clients", "jobs")


def draw(samples):
    rows = [row for row in samples.rows if row.phase in PHASES]
    ends = {phase: max((row.done for row in rows if row.phase == phase), default=0) for phase in PHASES}
    top_kb = 1024 * (max(row.rss_anon_kb for row in rows) // 1024 + 1)
    half = (WIDTH - LEFT - RIGHT) / 2
    x = lambda row: LEFT + half * (PHASES.index(row.phase) + row.done / max(1, ends[row.phase]))
    y = lambda kb: HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * kb / top_kb
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" '
             'font-size="12">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
             f'<text x="{LEFT}" y="18">Anonymous memory of each process, MB</text>']
    for mb in range(top_kb // 1024 + 1):
        parts += [f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y(mb * 1024):.1f}" y2="{y(mb * 1024):.1f}" stroke="#ddd"/>',
                  f'<text x="{LEFT - 8}" y="{y(mb * 1024) + 4:.1f}" text-anchor="end">{mb}</text>']
    for number, phase in enumerate(PHASES):
        middle, end = LEFT + half * (number + 0.5), LEFT + half * (number + 1)
        parts += [f'<text x="{middle}" y="{HEIGHT - 15}" text-anchor="middle">{ends[phase]} {phase}</text>',
                  f'<line x1="{end}" x2="{end}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" stroke="#999" stroke-dasharray="4"/>']
    for number, process in enumerate(samples.processes):
        colour = COLOURS[number % len(COLOURS)]
        points = " ".join(f"{x(row):.1f},{y(row.rss_anon_kb):.1f}" for row in rows if row.process == process)
        parts += [f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.5"/>',
                  f'<text x="{WIDTH - RIGHT + 10}" y="{TOP + 10 + 18 * number}" fill="{colour}">{process}</text>']
    return "\n".join(parts + ["</svg>"]) + "\n"
