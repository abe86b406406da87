// Charts over time with common cursor and zoom. And the path in a plane, with equal scales in both directions.
"use strict";

const colours = ["#1f6fb4", "#e07b00", "#1a9367", "#b5559b", "#3aa6d8", "#a8710f", "#6b5fc7"];
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const joined = uPlot.sync("time");
const timeCharts = [];
let whole;  // [from, to] in seconds

function axisStyle(label) {
  return { stroke: css("--soft"), grid: { stroke: css("--grid"), width: 1 }, ticks: { stroke: css("--grid"), width: 1 },
    label, labelSize: label ? 18 : 0, labelFont: "12px sans-serif", font: "12px sans-serif", size: label ? 62 : 50 };
}

function zoomTo(from, to) {
  for (const chart of timeCharts) { chart.setScale("x", { min: from, max: to }); }
}

// Zooms all other charts over time to the range of this one.
function follow(u, key) {
  if (key !== "x" || u.following) { return; }
  const { min, max } = u.scales.x;
  for (const other of timeCharts) {
    if (other === u || (other.scales.x.min === min && other.scales.x.max === max)) { continue; }
    other.following = true;
    other.setScale("x", { min, max });
    other.following = false;
  }
}

// Shades stretches without data and draws limits and events.
function marksPlugin(row, events, programEvents) {
  const vertical = (u, x, colour) => {
    const at = u.valToPos(x, "x", true);
    if (at < u.bbox.left || at > u.bbox.left + u.bbox.width) { return; }
    u.ctx.fillStyle = colour;
    u.ctx.fillRect(at - 0.5, u.bbox.top, Math.max(1, devicePixelRatio), u.bbox.height);
  };
  const shade = (u, [from, to]) => {
    const left = Math.max(u.valToPos(from, "x", true), u.bbox.left);
    const right = Math.min(u.valToPos(to, "x", true), u.bbox.left + u.bbox.width);
    u.ctx.fillStyle = css("--missing");
    if (right > left) { u.ctx.fillRect(left, u.bbox.top, Math.max(2, right - left), u.bbox.height); }
  };
  const limit = (u, y) => {
    const at = u.valToPos(y, "y", true);
    if (at < u.bbox.top || at > u.bbox.top + u.bbox.height) { return; }
    u.ctx.strokeStyle = css("--alarm");
    u.ctx.setLineDash([6, 5]);
    u.ctx.beginPath();
    u.ctx.moveTo(u.bbox.left, at);
    u.ctx.lineTo(u.bbox.left + u.bbox.width, at);
    u.ctx.stroke();
    u.ctx.setLineDash([]);
  };
  // Words at lines, where they end before the next one begins.
  const label = (u, labels) => {
    let free = u.bbox.left;
    u.ctx.textAlign = "left";
    u.ctx.textBaseline = "alphabetic";
    u.ctx.font = `${10 * devicePixelRatio}px sans-serif`;
    u.ctx.fillStyle = css("--ink");
    for (const { at_s, what } of labels) {
      const left = u.valToPos(at_s, "x", true) + 3 * devicePixelRatio;
      const right = left + u.ctx.measureText(what).width;
      if (left < free || right > u.bbox.left + u.bbox.width) { continue; }
      u.ctx.fillText(what, left, u.bbox.top + 10 * devicePixelRatio);
      free = right + 4 * devicePixelRatio;
    }
  };
  return { hooks: { draw: (u) => {
    u.ctx.save();
    (row.missing ?? []).forEach((stretch) => shade(u, stretch));
    (row.limits ?? []).forEach((y) => limit(u, y));
    programEvents.forEach((event) => vertical(u, event.at_s, css("--soft")));
    events.forEach((event) => vertical(u, event.at_s, css("--alarm")));
    label(u, row.words ?? []);
    u.ctx.restore();
  } } };
}

// The extent of a curve from one time to another: of the points between, and of the curve where it enters and leaves.
function shownExtent([xs, ys], [from, to]) {
  const at = (x, i) => ys[i - 1] + ((ys[i] - ys[i - 1]) * (x - xs[i - 1])) / (xs[i] - xs[i - 1]);
  let low = 0;
  let high = 0;
  const add = (y) => { low = Math.min(low, y); high = Math.max(high, y); };
  for (let i = 0; i < xs.length; i++) {
    if (ys[i] === null) { continue; }
    if (xs[i] >= from && xs[i] <= to) { add(ys[i]); }
    if (i === 0 || ys[i - 1] === null || xs[i] <= xs[i - 1]) { continue; }
    [from, to].filter((edge) => xs[i - 1] < edge && edge < xs[i]).forEach((edge) => add(at(edge, i)));
  }
  return [low, high];
}

function timeChart(host, row, last, events, programEvents = []) {
  const width = () => Math.max(240, host.clientWidth);
  const pad = ([min, max]) => {
    const room = 0.06 * (max - min) || 1;
    return [min - room, max + room];
  };
  const named = row.levels ? { splits: () => [0, 1], values: () => row.levels } : {};
  const yRange = row.levels ? () => [-0.2, 1.3] : () => pad(shownExtent([row.x, row.y], shown));
  let shown = whole;  // uPlot asks for the range of x first
  const chart = new uPlot({
    width: width(), padding: [10, 12, 0, 0], height: last ? 200 : 170, cursor: { sync: { key: joined.key, setSeries: false }, drag: { x: true, y: false } },
    scales: { x: { time: false, min: whole[0], max: whole[1], range: (u, min, max) => (shown = [min ?? whole[0], max ?? whole[1]]) },
      y: { range: yRange } },
    axes: [{ ...axisStyle(last ? "time, s" : undefined), size: last ? 46 : 26 }, { ...axisStyle(row.unit), ...named }],
    series: [{ label: "s", value: (u, value) => value?.toFixed(4) },
      { label: row.name, stroke: colours[row.colour % colours.length], width: 1.3, points: { show: false }, spanGaps: false,
        ...(row.filled && { fill: `${colours[row.colour % colours.length]}40`, fillTo: 0 }),
        ...(row.levels && { value: (u, value) => row.levels[value] ?? "" }) }],
    plugins: [marksPlugin(row, events, programEvents)],
    hooks: { setScale: [follow] },
  }, [row.x, row.y], host);
  timeCharts.push(chart);
  joined.sub(chart);
  addEventListener("resize", () => chart.setSize({ width: width(), height: chart.height }));
}

// Draws lines from point to point in any order of x.
function wayPainter(u, index) {
  const [xs, ys] = u.data[index];
  const stroke = new Path2D();
  let broken = true;
  for (let i = 0; i < xs.length; i++) {
    if (xs[i] === null) { broken = true; continue; }
    const x = u.valToPos(xs[i], "x", true);
    const y = u.valToPos(ys[i], "y", true);
    broken ? stroke.moveTo(x, y) : stroke.lineTo(x, y);
    broken = false;
  }
  return { stroke, fill: null, clip: null, band: null, gaps: null, flags: 0 };
}

function extent(values) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value === null) { continue; }
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return [low, high];
}

function pathChart(host, path) {
  const ways = [path.stepped, path.asked].filter((way) => way.x.length > 0);
  const [x, y] = ["x", "y"].map((key) => extent(ways.flatMap((way) => extent(way[key]))));
  const inner = () => Math.max(200, Math.min(host.clientWidth, 800) - 80);
  const size = () => {
    const width = inner() + 80;
    const ratio = (y[1] - y[0] || 1) / (x[1] - x[0] || 1);
    return { width, height: Math.round(Math.min(700, Math.max(220, inner() * ratio))) + 120 };
  };
  // Shows at least the requested range, with equal scales in both directions.
  const even = (u, low, high, key) => {
    const other = key === "x" ? "y" : "x";
    const box = { x: u.bbox.width, y: u.bbox.height };
    const want = key === "x" ? u.want?.x ?? x : u.want?.y ?? y;
    const wantOther = other === "x" ? u.want?.x ?? x : u.want?.y ?? y;
    const perPixel = Math.max((want[1] - want[0]) / box[key], (wantOther[1] - wantOther[0]) / box[other]) * 1.06 || 1e-3;
    const middle = (want[0] + want[1]) / 2;
    return [middle - perPixel * box[key] / 2, middle + perPixel * box[key] / 2];
  };
  const series = [null];
  const data = [null];
  const add = (way, label, stroke, width) => {
    if (way.x.length === 0) { return; }
    series.push({ label, stroke, width, paths: wayPainter, points: { show: false }, facets: [{ scale: "x", auto: true }, { scale: "y", auto: true }] });
    data.push([way.x, way.y]);
  };
  add(path.stepped, "stepped path", colours[0] + "88", 5);
  add(path.asked, "commanded path", css("--asked"), 1);
  const chart = new uPlot({
    mode: 2, ...size(), legend: { live: false }, cursor: { drag: { x: true, y: true, uni: 20, setScale: false } },
    scales: { x: { time: false, range: even }, y: { range: even } },
    axes: [{ ...axisStyle("X, mm"), size: 46 }, axisStyle("Y, mm")], series,
    hooks: { setSelect: [(u) => {
      const { left, top, width, height } = u.select;
      if (width < 4 && height < 4) { return; }
      u.want = { x: [u.posToVal(left, "x"), u.posToVal(left + width, "x")], y: [u.posToVal(top + height, "y"), u.posToVal(top, "y")] };
      u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      u.setData(u.data, true);
    }], ready: [(u) => u.over.addEventListener("dblclick", () => { u.want = undefined; u.setData(u.data, true); })] },
  }, data, host);
  addEventListener("resize", () => chart.setSize(size()));
}

// A picture of a power map's cells, from the top: [number, how often, number, how often, ...]. -2: not known, -1: no
// path, 0: path without power, 1 to 100: percent. What is not known is hatched.
function powerPicture(host, map, lengths, label) {
  const zoom = Math.max(1, Math.floor(Math.min(host.clientWidth || 800, 1200) / 2.1 / map.width));
  const canvas = make("canvas");
  canvas.width = map.width * zoom;
  canvas.height = map.height * zoom;
  canvas.style.cssText = "max-width:100%;image-rendering:pixelated;background:#fff;border:1px solid var(--grid)";
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", label);
  const context = canvas.getContext("2d");
  const paint = (number, column, row, count) => {
    context.fillStyle = number === -2 ? "#c8323c44" : number === 0 ? "#dfe6ec" : `rgba(27,39,51,${number / 100})`;
    context.fillRect(column * zoom, row * zoom, count * zoom, zoom);
    if (number !== -2) { return; }
    context.fillStyle = "#c8323c";
    for (let x = 0; x < count * zoom; x++) { context.fillRect(column * zoom + x, row * zoom + (zoom - 1 - (x % zoom)), 1, 1); }
  };
  let at = 0;
  for (let i = 0; i < lengths.length; i += 2) {
    for (let left = lengths[i + 1]; left > 0;) {
      const column = at % map.width;
      const count = Math.min(left, map.width - column);
      if (lengths[i] !== -1) { paint(lengths[i], column, Math.floor(at / map.width), count); }
      at += count;
      left -= count;
    }
  }
  host.append(make("figure", {}, make("figcaption", {}, make("b", {}, label)), canvas));
}

// A distribution for each axis: a bar for each class of values, its length the logarithm of what it counts.
// `shown`: the values (of), their unit, and what is counted (counts).
function barChart(host, axes, shown) {
  const most = Math.log10(1 + Math.max(1, ...axes.flatMap((axis) => axis.counts)));
  const rows = [];
  for (const axis of axes) {
    axis.counts.forEach((number, i) => {
      if (number === 0) { return; }
      const bar = make("div");
      bar.style.cssText = `height:.7rem;min-width:2px;width:${(14 * Math.log10(1 + number)) / most}rem;background:${colours[axis.colour % colours.length]}`;
      rows.push(make("tr", {}, make("td", {}, axis.name), make("td", {}, axis.classes[i]), make("td", {}, count(number)), make("td", { className: "text" }, bar)));
    });
  }
  const heads = ["axis", `${shown.of}, ${shown.unit}`, shown.counts, ""].map((head) => make("th", {}, head));
  host.append(inBox(make("table", {}, make("thead", {}, make("tr", {}, ...heads)), make("tbody", {}, ...rows))));
}
