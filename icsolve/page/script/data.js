/* The data of the page, and what is where in every position. */
const { atan2, cos, floor, hypot, max, min, PI, sin } = Math;
const abs = (v) => (v < 0 ? -v : v);
const { entries } = Object;
const data = JSON.parse(document.getElementById("data").textContent);
const NS = "http://www.w3.org/2000/svg";
const byId = (id) => document.getElementById(id);
const all = (selector, root = document) => [...root.querySelectorAll(selector)];
const figure = byId("figure");
const motion = data.motion;
const INFINITE = 1e9;

/* Columns: differences of differences in steps of 1/s, or plain values. */
const column = (c) => {
  if (!c) return null;
  if (c.v) return c.v;
  let sum = 0;
  let rate = 0;
  const values = c.d.map((d) => (sum += rate += d) / c.s);
  for (const r of c.n || []) values[r] = null;
  return values;
};
const places = (o) => ({ x: column(o.x), y: column(o.y) });
const links = {};
const points = {};
if (motion) {
  for (const [name, o] of entries(motion.links)) links[name] = { from: o.from, a: column(o.a), ...places(o) };
  for (const [name, o] of entries(motion.points)) points[name] = places(o);
}
const own = (o, name) => (Object.prototype.hasOwnProperty.call(o, name) ? o[name] : undefined);
const loads = {};
for (const [name, o] of entries(data.loads)) loads[name] = { ...o, way: column(o.way), values: column(o.values) };
const answers = data.answers.map((o) => ({ ...o, values: column(o.values), sense: column(o.sense) }));
const centres = data.centres.map((o) => ({ ...o, ...places(o) }));
const zero = motion ? motion.zero : 0;
const rows = motion ? motion.rows : 1;
let row = zero;
let step = data.steps;
let complete = true;

/* Numbers as a figure writes them. */
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";
/* What is as near to one as to the other is rounded to the even one. */
function rounded(value, digits) {
  const [m, power] = abs(value).toExponential(60).split("e");
  const figures = m.replace(".", "");
  const halfway = figures[digits] === "5" && !/[1-9]/.test(figures.slice(digits + 1)) && figures[digits - 1] % 2 === 0;
  if (!halfway) return Number(value.toPrecision(digits));
  return Math.sign(value) * Number(`${figures[0]}.${figures.slice(1, digits)}e${power}`);
}
function number(value, digits) {
  const x = rounded(value, digits);
  if (x === 0) return "0";
  const size = abs(x);
  if (size >= 1e-4 && size < 10 ** max(digits, 7)) return String(x).replace("-", "−");
  const [m, e] = x.toExponential(digits - 1).split("e");
  const mantissa = m.includes(".") ? m.replace(/\.?0+$/, "") : m;
  const power = e.replace("+", "").replace("-", "⁻").replace(/\d/g, (d) => RAISED[d]);
  return (mantissa + "×10" + power).replace("-", "−");
}

/* Where a place of a link is. */
function carried(place, r) {
  if (r === LIVE && place.now) return place.now;
  const [link, x, y] = place;
  const pose = own(links, link);
  if (!pose) return [x, y];
  const a = (pose.a[r] * PI) / 180;
  const dx = x - pose.from[0];
  const dy = y - pose.from[1];
  return [pose.x[r] + cos(a) * dx + sin(a) * dy, pose.y[r] - sin(a) * dx + cos(a) * dy];
}
/* A hidden point (a contact that a profile placed) that is none of the points is known as written only. */
const placed = (name, r) => !name.startsWith("@") || r === zero;
const at = (name, r) => {
  const p = own(points, name);
  return p ? [p.x[r], p.y[r]] : placed(name, r) ? own(data.anchors, name) : null;
};
const set = (element, name, value) => element.setAttribute(name, value);
const show = (element, yes) => element.classList.toggle("hidden", !yes);
const minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
const f = (v) => v.toFixed(2);
