// Builds the page: commanded and made motion, its charts, then the errors.
"use strict";

const report = JSON.parse(document.getElementById("report").textContent);
const charts = JSON.parse(document.getElementById("charts").textContent);
const main = document.getElementById("main");

// A machine whose motors are not its axes: what makes steps is then called a motor.
const hasMotors = report.axes.some((axis) => axis.axis !== undefined);
const part = hasMotors ? "motor" : "axis";
const parts = hasMotors ? "motors" : "axes";
const unitOfPart = (name) => report.axes.find((axis) => axis.name === name)?.unit || unitOf(name);

function section(title, ...content) {
  const part = make("section", {}, make("h2", {}, title), ...content);
  main.append(part);
  return part;
}

function showTime(from, to) {
  zoomTo(from, to);
  document.getElementById("time")?.scrollIntoView({ behavior: "smooth" });
}

// Units of report.proto: "mm", "deg", or "mm and deg" if axes slide and rotate together.
const shownLength = (value, move) => (move.dwell ? "–" : `${value.toFixed(3)} ${move.unit.replace(" and", ",")}`);
const thousandths = (value, unit) => {
  const units = unit.split(" and ").map((each) => smallUnitOf[each]);
  return `${units.length > 1 ? "\u2264 " : ""}${(value * 1000).toFixed(1)} ${units.join(", ")}`;
};
const shownDeviations = (value, job) => job.deviations.map((each) => thousandths(each.largest, each.unit)).join("\n") || "–";
const peakAxis = (key, move) => move.axes.reduce((top, axis) => ((axis[key] ?? 0) > (top?.[key] ?? 0) ? axis : top), undefined);
const peak = (key) => (move) => peakAxis(key, move)?.[key];
const shownPeak = (digits, key, per) => fixedIn(digits, (move) => unitOfPart(peakAxis(key, move).name) + per);
const sum = (key) => (move) => move.axes.reduce((all, axis) => all + Number(axis[key]), 0);
const shownLine = (line, row) => line || (row.kind === "own-move" ? "own move" : "–");
// Undefined if no step was compared.
const timeError = (key) => (row) => (Number(row.step_time_error.steps) ? row.step_time_error[key] : undefined);
const timeErrorColumns = ["p50", "p99", "max"].map((key) => (
  { head: key, group: "step time error, \u00b5s", of: timeError(`${key}_us`), show: fixed(1) }));

// Steps that the log lacks are not known to be wrong. A job that was not done need not have made all its steps.
function gradeOfAxis(axis, job) {
  const difference = Number(axis.made_steps) - Number(axis.asked_steps);
  if (difference === 0) { return ""; }
  if (axis.made_unknown || job.axes_not_known.includes(axis.name)) { return "unknown"; }
  return difference < 0 && job.outcome !== "done" ? "doubtful" : "bad";
}
const worst = (found) => ["bad", "unknown", "doubtful"].find((grade) => found.includes(grade)) ?? "";
const gradeOfMove = (move, job) => worst(move.axes.map((axis) => gradeOfAxis(axis, job)));
function gradeOfJob(job) {
  const listed = job.moves.map((move) => gradeOfMove(move, job));
  const others = Number(job.moves_not_whole) - listed.filter(Boolean).length;  // of moves that are not listed
  const unclear = job.axes_not_known.length > 0 ? "unknown" : job.outcome === "done" ? "bad" : "doubtful";
  return worst([...listed, others > 0 ? unclear : "", Number(job.unasked_steps) > 0 && job.outcome === "done" ? unclear : ""]);
}
const shownMade = (grade) => (value, row) => (grade(row) === "unknown" ? `\u2265 ${count(value)}` : count(value));

const stepColumns = (asked, made, grade) => [
  { head: "steps commanded", of: asked, show: count },
  { head: "steps made", of: made, show: shownMade(grade), grade },
];

function jobs() {
  const rows = report.jobs;
  if (rows.length === 0) { return; }
  const outcome = { done: "good", failed: "bad" };
  const columns = [
    { head: "job", of: (job) => Number(job.job) },
    { head: "kind", of: (job) => job.kind, text: true },
    { head: "program", of: (job) => job.name, text: true },
    { head: "outcome", of: (job) => job.outcome || "not ended", text: true, grade: (job) => outcome[job.outcome] ?? "doubtful" },
    { head: "moves", of: (job) => Number(job.move_count) - Number(job.dwells), show: count },
    { head: "dwells", of: (job) => Number(job.dwells), show: count },
    ...stepColumns((job) => Number(job.asked_steps), (job) => Number(job.made_steps), gradeOfJob),
    { head: "planned,\u00a0s", of: (job) => job.planned_s, show: fixed(3) },
    { head: "overridden", of: (job) => (job.overridden ? "yes" : "no"), text: true },
    { head: "took,\u00a0s", of: (job) => job.real_s, show: fixed(3) },
    { head: "interrupted", of: (job) => Number(job.interruptions), grade: (job) => (Number(job.interruptions) ? "doubtful" : "") },
    { head: "path deviation", of: (job) => job.largest_distance_mm, wraps: true, show: shownDeviations },
    { head: "step time error, \u00b5s", of: timeError("max_us"), show: fixed(1) },
  ];
  const onRow = (job) => showTime(job.begun_s ?? whole[0], (job.begun_s ?? 0) + (job.real_s ?? whole[1]));
  section("Jobs", table(columns, rows, { first: 50, onRow }));
}

function moves() {
  const all = report.jobs.flatMap((job) => job.moves.map((move) => ({ ...move, job: Number(job.job), kind: job.kind, grade: gradeOfMove(move, job) })));
  if (all.length === 0) { return; }
  const columns = [
    { head: "job", of: (move) => move.job },
    { head: "line", of: (move) => move.line, show: shownLine },
    { head: parts, of: (move) => (move.dwell ? "dwell" : move.axes.map((axis) => axis.name).join(" ") || "–"), text: true },
    { head: "length", of: (move) => move.length_mm, show: shownLength },
    ...stepColumns(sum("asked_steps"), sum("made_steps"), (move) => move.grade),
    { head: "planned,\u00a0s", of: (move) => move.planned_s, show: fixed(4) },
    { head: "took,\u00a0s", of: (move) => move.real_s, show: fixed(4) },
    { head: "difference,\u00a0ms", of: (move) => (move.real_s === undefined ? undefined : (move.real_s - move.planned_s) * 1000), show: fixed(3) },
    { head: "peak speed", of: peak("peak_velocity_mm_s"), show: shownPeak(2, "peak_velocity_mm_s", "/s") },
    { head: "peak acceleration", of: peak("peak_acceleration_mm_s2"), show: shownPeak(0, "peak_acceleration_mm_s2", "/s\u00b2") },
    { head: "path deviation", of: (move) => move.largest_distance_mm, wraps: true,
      show: (value, move) => (value === undefined ? "–" : thousandths(value, move.unit)) },
    ...timeErrorColumns,
    { head: "step skew, \u00b5s", of: (move) => (Number(move.step_time_error.steps) ? move.skew_max_us : undefined), show: fixed(1) },
  ];
  const listed = report.jobs.reduce((sumOf, job) => sumOf + Number(job.move_count), 0);
  const notes = [`Peaks are those of the fastest ${part}, computed from its steps.`];
  if (all.some((move) => move.unit === "mm and deg")) {
    notes.push("If axes slide and rotate in one move, its length and deviation are the root of the sum of the squares in mm and degrees; the deviation limits each of them.");
  }
  notes.push("Click a heading to sort the table, or a move to show it in the charts.");
  if (all.length < listed) { notes.push(`The first ${count(all.length)} of ${count(listed)}; all are in the jobs' figures.`); }
  const onRow = (move) => {
    if (move.begun_s === undefined) { return; }
    const lasts = move.real_s ?? move.planned_s;
    showTime(move.begun_s - 0.1 * lasts, move.begun_s + 1.1 * lasts);
  };
  section("Moves", make("p", { className: "soft" }, notes.join(" ")),
    table(columns, all, { first: 25, onRow }));
}

const motionColumns = (unit) => [
  { head: "from", of: (row) => row.position_start_mm, show: fixedIn(3, unit) },
  { head: "to", of: (row) => row.position_end_mm, show: fixedIn(3, unit) },
  { head: "peak speed", of: (row) => row.peak_velocity_mm_s, show: fixedIn(2, (row) => `${unit(row)}/s`) },
  { head: "peak acceleration", of: (row) => row.peak_acceleration_mm_s2, show: fixedIn(0, (row) => `${unit(row)}/s\u00b2`) },
];

function axisMotion() {
  if (report.axis_motion.length === 0) { return; }
  const unit = (axis) => axis.unit;
  section("Axes", make("p", { className: "soft" }, "By the frames that all motors ran."), table([
    { head: "axis", of: (axis) => axis.name, text: true },
    ...motionColumns(unit),
    { head: "limit of speed", of: (axis) => axis.max_velocity_mm_s, show: fixedIn(2, (axis) => `${unit(axis)}/s`) },
    { head: "limit of acceleration", of: (axis) => axis.max_acceleration_mm_s2, show: fixedIn(0, (axis) => `${unit(axis)}/s\u00b2`) },
  ], report.axis_motion));
}

function motorSkew() {
  if (report.motor_skew.length === 0) { return; }
  const most = (skew) => Math.max(skew.in_homing_mm ?? 0, skew.in_motion_mm ?? 0, skew.at_rest_mm ?? 0);
  const grade = (skew) => (most(skew) > (skew.max_skew_mm ?? Infinity) ? "bad" : "");
  const motorsOf = (skew) => report.axes.filter((motor) => motor.axis === skew.axis).map((motor) => motor.name).join(", ");
  const shown = fixedIn(4, (skew) => skew.unit);
  section("Motors of one axis", make("p", { className: "soft" }, "How far they were apart at most."), table([
    { head: "axis", of: (skew) => skew.axis, text: true },
    { head: "motors", of: motorsOf, text: true },
    { head: "in homing", of: (skew) => skew.in_homing_mm, show: shown, grade },
    { head: "in motion", of: (skew) => skew.in_motion_mm, show: shown },
    { head: "at rest", of: (skew) => skew.at_rest_mm, show: shown },
    { head: "max_skew_mm", of: (skew) => skew.max_skew_mm, show: shown },
  ], report.motor_skew));
}

function axes() {
  const columns = [
    { head: part, of: (axis) => axis.name, text: true },
    ...(hasMotors ? [{ head: "of axis", of: (axis) => axis.axis ?? "–", text: true }] : []),
    { head: "steps", of: (axis) => Number(axis.steps), show: count },
    ...motionColumns((axis) => unitOfPart(axis.name)),
    { head: "steps missing in the log", of: (axis) => Number(axis.missing_steps), show: count, grade: (axis) => (Number(axis.missing_steps) ? "unknown" : "") },
    ...timeErrorColumns,
  ];
  section(hasMotors ? "Motors" : "Axes", table(columns, report.axes.filter((axis) => !axis.board)));
  axisMotion();
  motorSkew();
  if (report.step_skew_between_axes.length === 0) { return; }
  section(`Step skew between ${parts}`, table([
    { head: parts, of: (skew) => `${skew.first} – ${skew.second}`, text: true },
    { head: "steps", of: (skew) => Number(skew.steps), show: count },
    ...["p50", "p99", "max"].map((key) => ({ head: key, group: "skew, \u00b5s", of: (skew) => skew[`${key}_us`], show: fixed(1) })),
  ], report.step_skew_between_axes));
}

function events() {
  if (report.events.length === 0) { return; }
  const place = (event) => event.positions.map((at) => `${at.name}\u00a0${at.position_mm === undefined ? at.position_steps : `${at.position_mm.toFixed(3)}\u00a0${unitOfPart(at.name)}`}`).join("  ");
  section("Faults, stops and interruptions", table([
    { head: "at, s", of: (event) => event.at_s, show: fixed(3) },
    { head: part, of: (event) => event.axis ?? "all", text: true },
    { head: "what", of: (event) => event.what, text: true, long: true },
    { head: "job", of: (event) => event.job ?? "–" },
    { head: "line", of: (event) => event.line || "–" },
    { head: `${parts} were at`, of: place, text: true, long: true },
    { head: "remedy", of: (event) => event.remedy ?? "", text: true, long: true },
  ], report.events, { first: 50, onRow: (event) => showTime(event.at_s - 1, event.at_s + 1) }));
}

function programEvents() {
  const rows = report.program_events;
  if (rows.length === 0) { return; }
  const place = (event) => (event.of_program ? event.place.map((at) => `${at.name}\u00a0${at.position_mm.toFixed(3)}\u00a0${unitOf(at.name)}`).join("  ") : "switched off at the job's end");
  const more = Number(report.program_events_not_listed);
  const note = more ? `The first ${count(rows.length)} of ${count(rows.length + more)}.` : "";
  section("Events of programs", make("p", { className: "soft" }, `What programs switch; the place is the program's, in machine coordinates. ${note}`), table([
    { head: "at, s", of: (event) => event.at_s, show: fixed(3) },
    { head: "job", of: (event) => Number(event.job) },
    { head: "line", of: (event) => event.line, show: (line) => line || "–" },
    { head: "event", of: (event) => event.what, text: true },
    { head: "place", of: place, text: true, long: true },
    { head: "at rest", of: (event) => (event.at_rest ? "yes" : "no"), text: true },
  ], rows, { first: 50, onRow: (event) => showTime(event.at_s - 1, event.at_s + 1) }));
}

function record() {
  const gaps = report.axes.flatMap((axis) => axis.gaps.map((gap) => ({ ...gap, axis: axis.name })));
  if (gaps.length > 0) {
    section("Gaps in the record", table([
      { head: part, of: (gap) => gap.axis, text: true },
      { head: "after tick", of: (gap) => Number(gap.after_tick), show: count },
      { head: "before tick", of: (gap) => Number(gap.before_tick), show: count },
      { head: "steps missing", of: (gap) => Number(gap.missing_steps), show: count },
    ], gaps, { first: 50 }));
  }
  if (report.unread.length > 0) {
    section("Unreadable parts", table([
      { head: "reason", of: (part) => part.reason, text: true, long: true },
      { head: "first byte", of: (part) => Number(part.first_byte), show: count },
      { head: "last byte", of: (part) => Number(part.last_byte), show: count },
      { head: "places", of: (part) => Number(part.places), show: count },
      { head: "bytes skipped", of: (part) => Number(part.bytes), show: count },
    ], report.unread));
  }
  if (report.notes.length > 0) { section("Notes", make("ul", {}, ...report.notes.map((note) => make("li", {}, note)))); }
}

function overTime() {
  if (charts.rows.length === 0) { return; }
  whole = charts.whole;
  const buttons = make("p");
  const holder = make("div");
  const part = section("Over time", make("p", { className: "soft" },
    "Drag to zoom, double-click to see all again. Dashed lines: limits. Shaded: steps or changes missing in the log. Red: faults and stops. Grey: events of programs. A curve of an input or output begins with the first change on record."), buttons, holder);
  part.id = "time";
  const kinds = [...new Set(charts.rows.map((row) => row.kind))];
  const draw = (kind) => {
    const range = timeCharts.length > 0 ? timeCharts[0].scales.x : undefined;
    const zoom = range ? [range.min, range.max] : whole;
    timeCharts.splice(0).forEach((chart) => { joined.unsub(chart); chart.destroy(); });
    holder.replaceChildren();
    const rows = charts.rows.filter((row) => row.kind === kind);
    rows.forEach((row, i) => {
      const figure = make("figure", {}, make("figcaption", {}, make("b", {}, row.name), ` ${row.what}`));
      holder.append(figure);
      timeChart(figure, row, i + 1 === rows.length, report.events, row.words ?? report.program_events);
    });
    zoomTo(...zoom);
    [...buttons.children].forEach((button) => button.setAttribute("aria-pressed", button.textContent === kind));
  };
  kinds.forEach((kind) => buttons.append(make("button", { type: "button", onclick: () => draw(kind) }, kind)));
  buttons.append(make("button", { type: "button", onclick: () => zoomTo(...whole) }, "everything"));
  draw(kinds[0]);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => location.reload());
}

function path() {
  if (charts.path === null) { return; }
  const figure = make("figure");
  section("Path", make("p", { className: "soft" }, "X–Y. Drag a rectangle to zoom, double-click to see all again."), figure);
  pathChart(figure, charts.path);
}

function power(map) {
  const range = (first, count) => `${(first * map.cell_mm).toFixed(2)} to ${((first + count) * map.cell_mm).toFixed(2)} mm`;
  const words = `At each place: what the program's words ask for, and what the recorded steps and changes of the output made. The darker, the more; pale: path without power${map.unknown ? "; hatched: not known, because changes are missing in the log" : ""}. X ${range(map.left, map.width)}, Y ${range(map.bottom, map.height)}.`;
  const buttons = make("p");
  const pictures = make("div", { className: "pictures" });
  const unit = make("p", { className: "soft" });
  section(`Power of ${map.output}`, make("p", { className: "soft" }, words), make("p", {}, map.summary), buttons, unit, pictures);
  const draw = (of) => {
    pictures.replaceChildren();
    unit.textContent = of.unit;
    powerPicture(pictures, map, of.asked, `asked for: ${of.name}`);
    powerPicture(pictures, map, of.made, `made: ${of.name}`);
    [...buttons.children].forEach((button) => button.setAttribute("aria-pressed", button.textContent === of.name));
  };
  map.maps.forEach((of) => buttons.append(make("button", { type: "button", onclick: () => draw(of) }, of.name)));
  draw(map.maps[0]);
}

function stepTimes() {
  if (charts.step_times.length === 0) { return; }
  const isExact = charts.step_times.every((axis) => axis.counts.every((number, i) => i === 0 || number === 0));
  const words = isExact ? "Every step that was compared is at its commanded tick." : "A bar's length is the logarithm of the number of steps.";
  const host = section("Differences between step times and commanded times", make("p", { className: "soft" }, words));
  barChart(host, charts.step_times, { of: "step time error", unit: "\u00b5s", counts: "steps" });
}

jobs();
events();
programEvents();
moves();
axes();
overTime();
path();
charts.powers.forEach(power);
stepTimes();
record();
document.documentElement.dataset.drawn = "yes";
