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

const count = (value) => Number(value ?? 0).toLocaleString("en").replaceAll(",", "\u202f");
const fixed = (digits) => (value) => (value === undefined ? "–" : Number(value).toFixed(digits));
// unit: row -> text
const fixedIn = (digits, unit) => (value, row) => (Number.isFinite(value) ? `${value.toFixed(digits)} ${unit(row)}` : "–");

// columns: {head, of: row -> value, show: (value, row) -> text, grade: row -> class, text: left-aligned}
function table(columns, rows, { first = rows.length, onRow } = {}) {
  const body = make("tbody");
  let shown = first;
  let sorted = { by: undefined, down: false };
  const cell = (column, row) => {
    const value = column.of(row);
    const kind = [column.text ? "text" : "", column.long ? "long" : "", column.grade?.(row) ?? ""].join(" ");
    return make("td", { className: kind.trim() }, column.show ? column.show(value, row) : String(value));
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
    className: column.text ? "text" : "", title: "sort", onclick: () => sortBy(column) }, column.head));
  draw();
  return make("div", { className: "wide" },
    make("table", {}, make("thead", {}, make("tr", {}, ...head)), body), more);
}
