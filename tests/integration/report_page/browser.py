"""A page in a real browser, as a person would see it."""
import pathlib
import re
import subprocess

# Appended to a copy of the page: reports what a person would see. A canvas that was drawn on is not blank.
PROBE = """<script>
const blank = (canvas) => !canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some(Boolean);
const seen = [...document.querySelectorAll("canvas")].map((c) => `${c.clientWidth}x${c.clientHeight}${blank(c) ? " blank" : ""}`);
document.body.dataset.seen = [document.documentElement.dataset.drawn, document.body.scrollWidth <= innerWidth, ...seen].join("|");
</script>"""


def look(html, folder, width, *flags):
    """The sizes of a page's charts, after it has drawn itself without errors and fits the window."""
    page = pathlib.Path(folder) / "probed.html"
    page.write_text(html.replace("</body>", PROBE + "</body>"))
    shown = subprocess.run(
        ["chromium-headless-shell", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
         f"--window-size={width},900", "--virtual-time-budget=3000", f"--user-data-dir={folder}/profile", *flags,
         "--dump-dom", f"file://{page}"],
        capture_output=True, text=True, timeout=100, check=True)
    # Errors of the page, not of the browser's own pages.
    complaints = [line for line in shown.stderr.splitlines() if "CONSOLE" in line and "source: chrome:" not in line]
    seen = re.search(r'data-seen="([^"]*)"', shown.stdout)
    assert not complaints, complaints
    assert seen, "the page's scripts did not come to their end"
    drawn, fits, *charts = seen[1].split("|")
    assert drawn == "yes" and fits == "true", seen[1]
    return charts
