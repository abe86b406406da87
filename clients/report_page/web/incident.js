// Builds an incident's page: a lane for each process, the axes' speeds and positions below, then all events.
"use strict";

const report = JSON.parse(document.getElementById("report").textContent);
const log = JSON.parse(document.getElementById("charts").textContent);  // of the run, or null
const main = document.getElementById("main");
const laneHeight = 34;

function section(title, ...content) {
  const part = make("section", {}, make("h2", {}, title), ...content);
  main.append(part);
  return part;
}

const moments = report.events.filter((event) => event.what === "vetoed" || event.what === "fault" || event.what === "frame-refused");
const lanes = report.processes.map((process) => process.name);
const bar = (event) => ["stalled", "peer-silent", "peer-heard"].includes(event.what) && event.lasts_s ? -event.lasts_s
  : event.what === "tail-run" ? event.lasts_s : 0;

// The initial range: from before the cause until all axes are at rest.
function aroundIt() {
  const from = Math.min(report.cause_at_s ?? 0, 0);
  const to = Math.max(report.rest_s ?? 0, 0.3);
  const room = 0.4 * (to - from) + 0.1;
  return [from - room, to + room];
}

function lanesPlugin(shown, show) {
  const radius = { telling: 4.5, notable: 3, routine: 1.5 };
  const place = (u, event) => [u.valToPos(event.at_s, "x", true), u.valToPos(lanes.length - 1 - lanes.indexOf(event.process), "y", true)];
  const colour = (event) => (event.weight === "telling" ? css("--alarm") : event.weight === "notable" ? css("--ink") : css("--soft"));
  const drawBar = (u, event) => {
    const [x, y] = place(u, event);
    const other = u.valToPos(event.at_s + bar(event), "x", true);
    const silence = event.what.startsWith("peer");
    u.ctx.fillStyle = event.what === "tail-run" ? "rgba(31,111,180,.45)" : silence ? css("--missing") : css("--alarm");
    const height = (silence ? 14 : 8) * devicePixelRatio;
    u.ctx.fillRect(Math.min(x, other), y - height / 2, Math.abs(other - x), height);
  };
  const drawDot = (u, event) => {
    const [x, y] = place(u, event);
    u.ctx.fillStyle = colour(event);
    u.ctx.beginPath();
    u.ctx.arc(x, y, radius[event.weight] * devicePixelRatio, 0, 2 * Math.PI);
    u.ctx.fill();
  };
  const drawLife = (u, process, lane) => {
    const y = u.valToPos(lanes.length - 1 - lane, "y", true);
    const [from, to] = [process.first_s, process.last_s].map((x) => u.valToPos(x, "x", true));
    u.ctx.strokeStyle = css("--grid");
    u.ctx.lineWidth = 3 * devicePixelRatio;
    u.ctx.beginPath();
    u.ctx.moveTo(from, y);
    u.ctx.lineTo(to, y);
    u.ctx.stroke();
    if (!process.ended) { return; }
    u.ctx.strokeStyle = css("--alarm");
    const size = 6 * devicePixelRatio;
    u.ctx.beginPath();
    u.ctx.moveTo(to - size, y - size);
    u.ctx.lineTo(to + size, y + size);
    u.ctx.moveTo(to - size, y + size);
    u.ctx.lineTo(to + size, y - size);
    u.ctx.stroke();
  };
  const draw = (u) => {
    u.ctx.save();
    u.ctx.beginPath();
    u.ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    u.ctx.clip();
    report.processes.forEach((process, lane) => drawLife(u, process, lane));
    const events = shown();
    events.filter(bar).forEach((event) => drawBar(u, event));
    ["routine", "notable", "telling"].forEach((weight) => events.filter((event) => event.weight === weight).forEach((event) => drawDot(u, event)));
    u.ctx.restore();
  };
  const nearest = (u) => {
    let best;
    let least = 14;
    for (const event of shown()) {
      const [x, y] = place(u, event).map((at, i) => at / devicePixelRatio - (i ? u.bbox.top : u.bbox.left) / devicePixelRatio);
      const far = Math.hypot(x - u.cursor.left, y - u.cursor.top);
      if (far < least) { [best, least] = [event, far]; }
    }
    if (best) { show(best); }
  };
  return { hooks: { draw, setCursor: nearest } };
}

function lanesChart() {
  const words = make("p", { className: "soft" }, "Point at a mark to read it. Red: events of a fault. Bars: stalls, silences and motion to rest. A cross: the process ended.");
  const host = make("figure");
  let all = false;
  const shown = () => report.events.filter((event) => all || event.weight !== "routine");
  const part = section("Events by process", host, words);
  part.id = "time";
  const width = () => Math.max(240, host.clientWidth);
  const chart = new uPlot({
    width: width(), height: lanes.length * laneHeight + 60, padding: [8, 12, 0, 0], legend: { show: false },
    cursor: { sync: { key: joined.key, setSeries: false }, drag: { x: true, y: false }, points: { show: false } },
    scales: { x: { time: false, min: whole[0], max: whole[1] }, y: { range: [-0.6, lanes.length - 0.4] } },
    axes: [{ ...axisStyle("s after it was noticed"), size: 46 },
      { ...axisStyle(), size: 150, splits: () => lanes.map((_, i) => i), values: () => [...lanes].reverse(), grid: { show: false } }],
    series: [{}, { show: true, stroke: "transparent", points: { show: false } }],
    plugins: [lanesPlugin(shown, (event) => words.replaceChildren(`${event.at_s.toFixed(3)} s  `, make("b", {}, event.process), ` ${event.text}`))],
    hooks: { setScale: [follow] },
  }, [[whole[0], whole[1]], [null, null]], host);
  timeCharts.push(chart);
  joined.sub(chart);
  addEventListener("resize", () => chart.setSize({ width: width(), height: chart.height }));
  const zoom = (range) => make("button", { type: "button", onclick: () => zoomTo(...range) }, range === whole ? "everything" : "the incident");
  const routine = make("button", { type: "button", onclick: () => {
    all = !all;
    routine.setAttribute("aria-pressed", all);
    chart.redraw();
  } }, "show routine events");
  host.before(make("p", {}, zoom(aroundIt()), zoom(whole), routine));
}

const axisOf = (process) => process.replace(/^(axis|motor)[ -]/, "");
// The states that a process noted, ten times a second.
const statesOf = (process) => report.events.filter((event) => event.process === process && event.position_mm !== undefined);
const kinds = { speed: "velocity_mm_s", position: "position_mm" };

// The part of a curve up to a time.
function pointsUntil(points, end) {
  const behind = points.findIndex(([x]) => x > end);
  if (behind < 0) { return points; }
  const kept = points.slice(0, behind);
  const [[x0, y0], [x1, y1]] = [kept.at(-1) ?? [end, null], points[behind]];
  return y0 === null || y1 === null ? kept : [...kept, [end, y0 + ((y1 - y0) * (end - x0)) / (x1 - x0)]];
}

// A row of the log, by the time of the page. The log's curves end at its last step: noted states continue them. After
// the end of its process an axis's motion is not known.
function rowOfLog(row) {
  const process = report.processes.find((each) => axisOf(each.name) === axisOf(row.name));
  const end = process?.ended ? process.last_s : Infinity;
  const points = pointsUntil(row.x.map((x, i) => [x + log.offset_s, row.y[i]]), end);
  const last = points.at(-1)?.[0] ?? -Infinity;
  const gaps = row.missing.map((span) => span.map((x) => x + log.offset_s));
  const isOpen = (span) => span[1] > end || span[0] >= last - 1e-3;  // the curve does not go on behind it
  const missing = gaps.filter((span) => !isOpen(span));
  const from = Math.min(end, ...gaps.filter(isOpen).map((span) => span[0]));
  if (process?.ended) {
    missing.push([from, report.processes.find((each) => axisOf(each.name).startsWith(`${axisOf(row.name)},`))?.first_s ?? whole[1]]);
  } else if (from < Infinity) {
    missing.push([from, whole[1]]);
  } else {
    points.push(...statesOf(process?.name).filter((event) => event.at_s > last).map((event) => [event.at_s, event[kinds[row.kind]]]));
  }
  return { ...row, x: points.map((point) => point[0]), y: points.map((point) => point[1]), missing };
}

function rowsOfNotes() {
  const axes = lanes.filter((name) => statesOf(name).length >= 2);
  return axes.flatMap((name, colour) => {
    const states = statesOf(name);
    const unit = unitOf(axisOf(name).replace(/,.*/, ""));
    return Object.entries(kinds).map(([kind, key]) => ({ kind, name, what: `${kind}, as it noted it`, unit: kind === "speed" ? `${unit}/s` : unit,
      colour, x: states.map((event) => event.at_s), y: states.map((event) => event[key]), limits: [], missing: [] }));
  });
}

// Takes the rows from the log if there is one, else from the states that axes noted.
const rows = () => (log ? log.rows.filter((row) => row.kind in kinds).map(rowOfLog) : rowsOfNotes());

function curves() {
  const all = rows();
  if (all.length === 0) { return; }
  const part = section("Motion of the axes", make("p", { className: "soft" }, "Drag to zoom, double-click to see all again. Red lines: vetoes and faults. Shaded: not known."));
  const moved = all.filter((row) => row.kind === "speed" ? row.y.some((y) => y) : true);
  ["speed", "position"].forEach((kind) => moved.filter((row) => row.kind === kind).forEach((row, i, same) => {
    const figure = make("figure", {}, make("figcaption", {}, make("b", {}, row.name), ` ${row.what}`));
    part.append(figure);
    timeChart(figure, row, i + 1 === same.length, moments);
  }));
}

function noted() {
  const weights = { telling: "telling", notable: "", routine: "soft" };
  const columns = [
    { head: "s", of: (event) => event.at_s, show: fixed(4) },
    { head: "process", of: (event) => event.process, text: true },
    { head: "event", of: (event) => event.text, text: true, long: true, grade: (event) => weights[event.weight] },
    { head: "weight", of: (event) => event.weight, text: true },
  ];
  const onRow = (event) => {
    zoomTo(event.at_s - 0.3, event.at_s + 0.3);
    document.getElementById("time").scrollIntoView({ behavior: "smooth" });
  };
  section("Notable events", table(columns, report.events.filter((event) => event.weight !== "routine"), { first: 60, onRow }));
  section("All events", table(columns, [...report.events], { first: 0, onRow }));
}

function processes() {
  section("Processes", table([
    { head: "process", of: (process) => process.name, text: true },
    { head: "notes from, s", of: (process) => process.first_s, show: fixed(3) },
    { head: "to, s", of: (process) => process.last_s, show: fixed(3) },
    { head: "ended unexpectedly", of: (process) => (process.ended ? "yes" : "no"), text: true, grade: (process) => (process.ended ? "bad" : "") },
    { head: "clock error at most, \u00b5s", of: (process) => process.clock_error_us, show: fixed(1) },
    { head: "files", of: (process) => process.files.map((file) => file.split("/").pop()).join(" "), text: true, long: true },
  ], report.processes));
  if (report.notes.length > 0) { section("Notes", make("ul", {}, ...report.notes.map((note) => make("li", {}, note)))); }
}

const times = report.events.map((event) => event.at_s);
whole = [Math.min(...times, -1), Math.max(...times, 1)];
lanesChart();
curves();
noted();
processes();
zoomTo(...aroundIt());
document.documentElement.dataset.drawn = "yes";
