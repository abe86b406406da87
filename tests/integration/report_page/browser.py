"""A page in a real browser, as a person would see it."""
import html as escapes
import json
import pathlib
import re
import subprocess

# Appended to a copy of the page: waits until it has drawn itself, and reports the value of an expression.
PROBE = """<script>setTimeout(async () => {
  const seen = await (async () => (%s))().catch((error) => ({ failure: String(error) }));
  document.body.dataset.seen = JSON.stringify({ drawn: document.documentElement.dataset.drawn, seen });
}, 500);</script>"""

# A canvas that was drawn on is not blank. A table that is wider than the page scrolls within its box. A curve that enters
# or leaves the shown time does so within its chart.
CHARTS = """(() => {
  const leaves = (chart) => [chart.scales.x.min, chart.scales.x.max].some((x) => {
    const [xs, ys] = chart.data;
    const i = xs.findIndex((each) => each > x);
    if (i <= 0 || ys[i] === null || ys[i - 1] === null) { return false; }
    const y = ys[i - 1] + ((ys[i] - ys[i - 1]) * (x - xs[i - 1])) / (xs[i] - xs[i - 1]);
    return y < chart.scales.y.min || y > chart.scales.y.max;
  });
  const blank = (canvas) => !canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some(Boolean);
  const charts = [...document.querySelectorAll("canvas")].map((c) => `${c.clientWidth}x${c.clientHeight}${blank(c) ? " blank" : ""}`);
  const boxed = [...document.querySelectorAll("table:not(.u-legend)")].every((table) => {
    const box = table.parentElement.getBoundingClientRect();
    return getComputedStyle(table.parentElement).overflowX === "auto" && box.left >= 0 && box.right <= innerWidth;
  });
  return { fits: document.body.scrollWidth <= innerWidth, boxed, charts, clipped: timeCharts.filter(leaves).length };
})()"""

TABLES = """Object.fromEntries([...document.querySelectorAll("section")].map((section) => {
  const rowsOf = (table) => [...table.rows].map((row) => [...row.cells].map((cell) => cell.innerText));
  const tables = [...section.querySelectorAll("table:not(.u-legend)")];
  return [section.querySelector("h2").textContent, {
    rows: tables.flatMap(rowsOf), wide: tables.some((table) => table.scrollWidth > table.parentElement.clientWidth) }];
}))"""


def evaluate(html, folder, width, expression, *flags):
    """The value of a JavaScript expression in the page, after it has drawn itself without errors."""
    page = pathlib.Path(folder) / "probed.html"
    page.write_text(html.replace("</body>", PROBE % expression + "</body>"))
    shown = subprocess.run(
        ["chromium-headless-shell", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
         f"--window-size={width},900", "--virtual-time-budget=5000", f"--user-data-dir={folder}/profile", *flags,
         "--dump-dom", f"file://{page}"],
        capture_output=True, text=True, timeout=100, check=True)
    # Errors of the page, not of the browser's own pages.
    complaints = [line for line in shown.stderr.splitlines() if "CONSOLE" in line and "source: chrome:" not in line]
    found = re.search(r'data-seen="([^"]*)"', shown.stdout)
    assert not complaints, complaints
    assert found, "the page's scripts did not come to their end"
    result = json.loads(escapes.unescape(found[1]))
    assert result["drawn"] == "yes", result
    assert "failure" not in (result["seen"] or {}), result
    return result["seen"]


def look(html, folder, width, *flags):
    """The sizes of a page's charts, after it has drawn itself without errors and fits the window."""
    seen = evaluate(html, folder, width, CHARTS, *flags)
    assert seen["fits"] and seen["boxed"] and seen["clipped"] == 0, seen
    return seen["charts"]


def tables(html, folder, width):
    """For each section of the page: the texts of its tables' cells, row by row, and whether a table has to scroll."""
    return evaluate(html, folder, width, TABLES)
