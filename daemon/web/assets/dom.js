// Small tools: the page is touched only where something has changed.

import { formats, DASH } from "./format.js";

export const byId = (id) => document.getElementById(id);

export function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

export function setClass(node, name) {
  if (node.getAttribute("class") !== name) node.setAttribute("class", name);
}

export function setAttr(node, name, value) {
  const text = String(value);
  if (node.getAttribute(name) !== text) node.setAttribute(name, text);
}

export function show(node, visible) {
  if (node.hidden === visible) node.hidden = !visible;
}

export function make(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

export function svg(parent, tag, attributes = {}, text) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  if (text !== undefined) node.textContent = text;
  parent.append(node);
  return node;
}

// Fills the rows of a table. A cell is a text, or { text, cls, title, sub } with a second line.
export function fill(table, rows) {
  const body = table.tBodies[0];
  while (body.rows.length > rows.length) body.deleteRow(-1);
  rows.forEach((cells, index) => {
    const row = body.rows[index] ?? body.insertRow();
    cells.forEach((cell, column) => fillCell(row, column, cell));
  });
}

function fillCell(row, column, cell) {
  const { text = DASH, cls = "", sub, title } = typeof cell === "object" && cell ? cell : { text: cell };
  let node = row.cells[column];
  if (!node) {
    node = column === 0 ? make("th", { scope: "row" }) : make("td");
    node.append(make("span"));
    row.append(node);
  }
  // on a phone each cell stands in a line of its own, with the heading of its column
  if (column > 0) setAttr(node, "data-head", row.closest("table").tHead.rows[0].cells[column]?.textContent ?? "");
  setText(node.firstChild, String(text));
  setClass(node, cls);
  if (sub !== undefined) {
    if (node.childNodes.length < 2) node.append(make("small"));
    setText(node.lastChild, String(sub));
  }
  if (title !== undefined) setAttr(node, "title", title);
}

export const right = (text, cls = "") => ({ text, cls: `r num ${cls}`.trim() });

// Counts that should stay at zero.
export const bad = (value, text) => right(text ?? formats.count(value), value > 0 ? "is-some" : "is-zero");

const at = (data, path) => path.split(".").reduce((part, key) => part?.[key], data);

// All elements with data-bind show the value at their path.
export function binder(root) {
  const bound = [...root.querySelectorAll("[data-bind]")].map((node) => ({
    node,
    path: node.dataset.bind,
    format: formats[node.dataset.as ?? "plain"],
    other: node.dataset.or,
    // without a number there is no unit
    holder: node.closest("dd"),
  }));
  return (data) => {
    for (const { node, path, format, other, holder } of bound) {
      const text = format(at(data, path));
      holder?.classList.toggle("without", text === DASH);
      setText(node, text === DASH && other !== undefined ? other : text);
    }
  };
}

// Size of a canvas in CSS pixels; its own are as fine as the screen's.
export function fitted(canvas) {
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

// What the browser keeps for us, if it keeps anything.
export function recall(store, name) {
  try { return window[store].getItem(name); } catch { return null; }
}

export function keep(store, name, value) {
  try { window[store].setItem(name, value); } catch { /* then it is forgotten with the page */ }
}

// The letters of the page, for a canvas.
export const lettering = (pixels) => `${pixels}px ${getComputedStyle(document.body).fontFamily}`;

// A colour of the theme.
export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
