// Tables of the report: plain rows, sorted by a click on a head.
"use strict";

const make = (tag, attributes = {}, ...children) => {
  const element = Object.assign(document.createElement(tag), attributes);
  element.append(...children.filter((child) => child !== undefined && child !== null));
  return element;
};

// The unit of an axis's positions, by its name: A, B and C rotate (core/axis_unit.hpp). The report's keys have mm for both.
const unitOf = (axis) => (/^[ABC]$/i.test(axis) ? "deg" : "mm");
const smallUnitOf = { mm: "\u00b5m", deg: "mdeg" };

// A grade has a symbol, a word and a colour, so that none of them is needed to read it.
const grades = { good: "\u2713", doubtful: "!", unknown: "?", bad: "\u2717" };
const markOf = (grade) => (grade in grades ? make("span", { className: "mark", title: grade, role: "img", ariaLabel: grade }, grades[grade]) : undefined);

const count = (value) => Number(value ?? 0).toLocaleString("en").replaceAll(",", "\u202f");
const fixed = (digits) => (value) => (value === undefined ? "–" : Number(value).toFixed(digits));
// unit: row -> text
const fixedIn = (digits, unit) => (value, row) => (Number.isFinite(value) ? `${value.toFixed(digits)} ${unit(row)}` : "–");

// A table that is wider than the page scrolls within this box, by keys too.
const inBox = (content) => make("div", { className: "wide", tabIndex: 0 }, content);

// Columns of one group, which are neighbours, have a common head above theirs.
function groupHeads(columns) {
  if (!columns.some((column) => column.group)) { return []; }
  const cells = [];
  columns.forEach((column, i) => {
    if (column.group && column.group === columns[i - 1]?.group) {
      cells.at(-1).colSpan += 1;
    } else {
      cells.push(make("th", { className: column.group ? "group" : "", colSpan: 1 }, column.group ?? ""));
    }
  });
  return [make("tr", {}, ...cells)];
}

// columns: {head, group, of: row -> value, show: (value, row) -> text, grade: row -> grade or class, text: left-aligned,
// long: text that wraps, wraps: numbers that wrap}
function table(columns, rows, { first = rows.length, onRow } = {}) {
  const body = make("tbody");
  let shown = first;
  let sorted = { by: undefined, down: false };
  const cell = (column, row) => {
    const value = column.of(row);
    const kind = [column.text ? "text" : "", column.long ? "long" : "", column.wraps ? "wraps" : "", column.grade?.(row) ?? ""].join(" ");
    return make("td", { className: kind.trim() }, markOf(column.grade?.(row)), column.show ? column.show(value, row) : String(value));
  };
  const line = (row) => {
    const tr = make("tr", {}, ...columns.map((column) => cell(column, row)));
    if (onRow) {
      tr.className = "goes";
      tr.title = "show in the charts";
      tr.onclick = () => onRow(row);
    }
    return tr;
  };
  const more = make("button", { type: "button" }, `show all ${count(rows.length)}`);
  const draw = () => {
    body.replaceChildren(...rows.slice(0, shown).map(line));
    more.hidden = shown >= rows.length;
  };
  more.onclick = () => { shown = rows.length; draw(); };
  const sortBy = (column) => {
    sorted = { by: column, down: sorted.by === column ? !sorted.down : !column.text };
    const compare = (a, b) => (a < b ? -1 : a > b ? 1 : 0);
    const key = (row) => column.of(row) ?? -Infinity;
    rows.sort((a, b) => compare(key(a), key(b)) * (sorted.down ? -1 : 1));
    draw();
  };
  const head = columns.map((column) => make("th", {
    className: `${column.text ? "text" : ""} ${column.head.length > 16 ? "long" : ""}`.trim(), title: "sort", onclick: () => sortBy(column) }, column.head));
  draw();
  return make("div", {}, inBox(make("table", {}, make("thead", {}, ...groupHeads(columns), make("tr", {}, ...head)), body)), more);
}
