"use strict";
(() => {
const data = JSON.parse(document.getElementById("data").textContent);
const NS = "http://www.w3.org/2000/svg";
const byId = (id) => document.getElementById(id);
const all = (selector, root = document) => [...root.querySelectorAll(selector)];
const figure = byId("figure");
const motion = data.motion;
const INFINITE = 1e9;

/* Columns: differences in steps of 1/s, or plain values. */
const column = (c) => {
  if (!c) return null;
  if (c.v) return c.v;
  let sum = 0;
  return c.d.map((d) => (sum += d) / c.s);
};
const places = (o) => ({ x: column(o.x), y: column(o.y) });
const links = {};
const points = {};
if (motion) {
  for (const [name, o] of Object.entries(motion.links)) links[name] = { from: o.from, a: column(o.a), ...places(o) };
  for (const [name, o] of Object.entries(motion.points)) points[name] = places(o);
}
const own = (o, name) => (Object.prototype.hasOwnProperty.call(o, name) ? o[name] : undefined);
const loads = {};
for (const [name, o] of Object.entries(data.loads)) loads[name] = { ...o, way: column(o.way) };
const answers = data.answers.map((o) => ({ ...o, values: column(o.values), sense: column(o.sense) }));
const centres = data.centres.map((o) => ({ ...o, ...places(o) }));
const zero = motion ? motion.zero : 0;
const rows = motion ? motion.rows : 1;
let row = zero;
let step = data.steps;
let complete = true;

/* Numbers as a figure writes them. */
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";
function number(value, digits) {
  const x = Number(value.toPrecision(digits));
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e-4 && size < 10 ** Math.max(digits, 7)) return String(x).replace("-", "−");
  const [m, e] = x.toExponential(digits - 1).split("e");
  const mantissa = m.includes(".") ? m.replace(/\.?0+$/, "") : m;
  const power = e.replace("+", "").replace("-", "⁻").replace(/\d/g, (d) => RAISED[d]);
  return (mantissa + "×10" + power).replace("-", "−");
}

/* Where a place of a link is. */
function carried([link, x, y], r) {
  const pose = own(links, link);
  if (!pose) return [x, y];
  const a = (pose.a[r] * Math.PI) / 180;
  const dx = x - pose.from[0];
  const dy = y - pose.from[1];
  return [pose.x[r] + Math.cos(a) * dx + Math.sin(a) * dy, pose.y[r] - Math.sin(a) * dx + Math.cos(a) * dy];
}
/* A hidden point (a contact that a profile placed) is known in the position as written only. */
const placed = (name, r) => !name.startsWith("@") || r === zero;
const at = (name, r) => {
  const p = own(points, name);
  return p ? [p.x[r], p.y[r]] : placed(name, r) ? own(data.anchors, name) : null;
};
const set = (element, name, value) => element.setAttribute(name, value);
const show = (element, yes) => element.classList.toggle("hidden", !yes);
const f = (v) => v.toFixed(2);

/* Links, joints, loads. */
const turning = all("[data-turn]", figure).map((e) => [e, own(links, e.dataset.turn)]).filter(([, l]) => l);
const following = all("#mechanism [data-at], #loads [data-at]", figure)
  .map((e) => [e, own(points, e.dataset.at)])
  .filter(([, p]) => p);
const contacts = all('#mechanism [data-at^="@"]', figure);
const pushes = all("[data-load]", figure).map((e) => [e, loads[e.dataset.load], e.dataset.load]);
const springs = all("[data-span]", figure).map((e) => [e, loads[e.dataset.span]]);
const unknown = (name) => answers.find((a) => a.name === name);

function turnOf(name, r) {
  const load = loads[name];
  const answer = unknown(name);
  const value = answer ? answer.values[r] : 1;
  const written = answer ? answer.values[zero] : 1;
  return { way: load.way ? load.way[r] : 0, flip: value !== null && value < 0 !== written < 0, gone: value === null };
}
function moveParts(r) {
  for (const [e, l] of turning)
    set(e, "transform", `translate(${f(l.x[r])} ${f(l.y[r])}) rotate(${f(-l.a[r])}) translate(${-l.from[0]} ${-l.from[1]})`);
  for (const e of contacts) show(e, r === zero);
  for (const [e, p] of following) set(e, "transform", `translate(${f(p.x[r] - p.x[zero])} ${f(p.y[r] - p.y[zero])})`);
  for (const [e, load, name] of pushes) {
    const { way, flip, gone } = turnOf(name, r);
    e.classList.toggle("ghost", gone);
    const end = e.dataset.end !== undefined && own(points, e.dataset.end);
    const from = end ? [end.x[zero], end.y[zero]] : load.on.slice(1);
    const to = end ? [end.x[r], end.y[r]] : carried(load.on, r);
    const turned = load.torque ? (flip ? "scale(-1 1)" : "") : `rotate(${f(-way - (flip ? 180 : 0))})`;
    set(e, "transform", `translate(${f(to[0])} ${f(to[1])}) ${turned} translate(${-from[0]} ${-from[1]})`);
  }
  for (const [e, load] of springs) {
    const [a0, b0] = load.span.map((s) => s.slice(1));
    const [a, b] = load.span.map((s) => carried(s, r));
    const [u, v] = [[b0[0] - a0[0], b0[1] - a0[1]], [b[0] - a[0], b[1] - a[1]]];
    const angle = (w) => (Math.atan2(w[1], w[0]) * 180) / Math.PI;
    const k = Math.hypot(...v) / Math.hypot(...u);
    set(e, "transform", `translate(${f(a[0])} ${f(a[1])}) rotate(${f(angle(v))}) scale(${k.toFixed(4)} 1) rotate(${f(-angle(u))}) translate(${-a0[0]} ${-a0[1]})`);
  }
}

/* Centres and the lines that find them. */
const make = (name, attributes, parent) => {
  const e = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) set(e, key, value);
  parent.appendChild(e);
  return e;
};
const stage = byId("centres");
const [LEFT, TOP, RIGHT, BOTTOM] = data.window;
const MIDDLE = [(LEFT + RIGHT) / 2, (TOP + BOTTOM) / 2];
if (stage) {
  const lined = make("g", { "clip-path": "url(#window)" }, stage);
  for (const c of centres)
    c.paths = c.lines.map((line, n) =>
      make("path", { class: "construction", id: c.id.replace("centre-", "line-") + "-" + (n + 1), "data-step": c.step }, lined));
  for (const c of centres) {
    c.group = make("g", { id: c.id, "data-step": c.step }, stage);
    make("title", {}, c.group).textContent = "I" + c.name;
    c.disc = make("circle", { class: c.primary ? "primary" : "secondary", r: c.primary ? 3.2 : 4.6 }, c.group);
    c.far = make("path", { class: "far", d: "M-30,0 L0,0 M-8,-4 L0,0 L-8,4" }, c.group);
    c.label = make("g", { class: "label cname" }, byId("labels"));
    c.text = make("text", { class: "t-centre", "font-size": 13, "text-anchor": "middle" }, c.label);
  }
}
const isFar = (c, r) => Math.abs(c.x[r]) >= INFINITE || Math.abs(c.y[r]) >= INFINITE;
function lineOf(c, line, r) {
  const ends = line.map((end) => (typeof end === "string" ? at(end, r) : [centres[end].x[r], centres[end].y[r]]));
  ends.push([c.x[r], c.y[r]]);
  if (ends.some((p) => !p || p[0] === null || p[1] === null)) return "";
  const near = ends.filter((p) => Math.max(Math.abs(p[0]), Math.abs(p[1])) < INFINITE);
  const away = ends.filter((p) => Math.max(Math.abs(p[0]), Math.abs(p[1])) >= INFINITE);
  if (!near.length) return "";
  const o = near[0];
  let far = o;
  for (const p of near) if (Math.hypot(p[0] - o[0], p[1] - o[1]) > Math.hypot(far[0] - o[0], far[1] - o[1])) far = p;
  let u = [far[0] - o[0], far[1] - o[1]];
  if (Math.hypot(...u) < 0.2) {
    if (!away.length) return "";
    u = away[0];
  }
  const length = Math.hypot(...u);
  u = [u[0] / length, u[1] / length];
  const reach = near.map((p) => (p[0] - o[0]) * u[0] + (p[1] - o[1]) * u[1]);
  const more = away.length ? 2e4 : 16;
  const first = Math.max(Math.min(...reach) - more, -2e4);
  const last = Math.min(Math.max(...reach) + more, 2e4);
  return `M${f(o[0] + first * u[0])},${f(o[1] + first * u[1])} L${f(o[0] + last * u[0])},${f(o[1] + last * u[1])}`;
}
const inside = (p) => p[0] >= LEFT && p[0] <= RIGHT && p[1] >= TOP && p[1] <= BOTTOM;
function edge(u, margin) {
  const across = u[0] ? ((u[0] > 0 ? RIGHT : LEFT) - MIDDLE[0]) / u[0] : Infinity;
  const down = u[1] ? ((u[1] > 0 ? BOTTOM : TOP) - MIDDLE[1]) / u[1] : Infinity;
  const reach = Math.min(across, down) - margin;
  return [MIDDLE[0] + u[0] * reach, MIDDLE[1] + u[1] * reach];
}
/* Names of centres; those in one place, or far in one direction, share one. */
function named(text, group, tail) {
  text.textContent = "";
  group.forEach((c, n) => {
    text.append(document.createTextNode((n ? ", " : "") + "I"));
    const low = make("tspan", { dy: 3.25, "font-size": 9.4 }, text);
    low.textContent = c.low;
    const back = make("tspan", { dy: -3.25 }, text);
    back.textContent = n + 1 === group.length ? tail || "\u200a" : "\u200a";
  });
}
function drawCentres(r) {
  const shared = new Map();
  let fars = 0;
  for (const c of centres) {
    const seen = c.step <= step && c.x[r] !== null && c.y[r] !== null;
    show(c.group, seen);
    show(c.label, false);
    c.paths.forEach((path, n) => {
      const d = c.step <= step ? lineOf(c, c.lines[n], r) : "";
      set(path, "d", d || "M0,0");
      show(path, Boolean(d));
      path.classList.toggle("now", !complete && c.step === step);
      path.classList.toggle("old", !complete && c.step !== step);
    });
    if (!seen) continue;
    const p = [c.x[r], c.y[r]];
    const away = isFar(c, r);
    const far = away || !inside(p);
    show(c.disc, !far);
    show(c.far, far);
    const from = away ? p : [p[0] - MIDDLE[0], p[1] - MIDDLE[1]];
    const size = Math.hypot(...from);
    const u = [from[0] / size, from[1] / size];
    const key = far ? (away ? `${f(u[0])} ${f(u[1])}` : `far ${c.id}`) : `${Math.round(p[0] / 2)},${Math.round(p[1] / 2)}`;
    if (shared.has(key)) {
      shared.get(key).group.push(c);
      show(c.far, false);
      show(c.disc, false);
      continue;
    }
    if (far) {
      const tip = edge(u, 10 + 3 * fars++);
      const turn = (Math.atan2(u[1], u[0]) * 180) / Math.PI;
      set(c.far, "transform", `translate(${f(tip[0])} ${f(tip[1])}) rotate(${f(turn)})`);
      const tail = away ? " ∞" : `, ${number(size / data.scale, 3)} ${data.length} away`;
      const along = [2, 9, 16, 23, 30].map((s) => [tip[0] - s * u[0], tip[1] - s * u[1], 4, 4]);
      shared.set(key, { group: [c], at: along[2], tail, gap: 8, along });
    } else {
      set(c.disc, "cx", f(p[0]));
      set(c.disc, "cy", f(p[1]));
      shared.set(key, { group: [c], at: p, tail: "", gap: 8 });
    }
  }
  const found = [];
  const arrows = [];
  for (const { group, at: p, tail, gap, along } of shared.values()) {
    if (along) arrows.push(...along);
    const c = group[0];
    const words = group.map((g) => g.low).join() + tail;
    if (c.words !== words) {
      named(c.text, group, tail);
      c.words = words;
      c.size = null;
    }
    show(c.label, true);
    c.size = c.size || boxOf(c.text);
    found.push({ element: c.label, anchor: p, size: c.size, gap, own: c, centre: true });
  }
  return [found, arrows];
}

/* Labels: each where it was placed beside what it names; another place where two would meet. */
const boxOf = (text) => {
  const b = text.getBBox();
  return [b.width / 2 + 1, b.height / 2];
};
const labels = all("#labels > [data-x]", figure).map((e) => {
  const home = [Number(e.dataset.x), Number(e.dataset.y)];
  const text = e.querySelector("text");
  const badge = e.querySelector(".badge");
  return { e, home, text, leader: e.querySelector(".leader"), badge, size: null, state: {}, ...e.dataset };
});
const COMPASS = [2, 6, 1, 7, 3, 5, 0, 4].map((k) => [Math.cos((k * Math.PI) / 4), Math.sin((k * Math.PI) / 4)]);
function homeOf(label, r) {
  if (label.at !== undefined) {
    const p = own(points, label.at);
    const now = p ? [p.x[r] - p.x[zero], p.y[r] - p.y[zero]] : [0, 0];
    return { home: [label.home[0] + now[0], label.home[1] + now[1]], anchor: p ? [p.x[r], p.y[r]] : null };
  }
  if (label.on !== undefined) {
    const p = carried([label.on, ...label.home], r);
    return { home: p, anchor: null };
  }
  const load = loads[label.label];
  const p = carried(load.on, r);
  const { way, flip } = turnOf(label.label, r);
  const a = load.torque || load.span ? 0 : ((way + (flip ? 180 : 0)) * Math.PI) / 180;
  const dx = label.home[0] - load.on[1];
  const dy = label.home[1] - load.on[2];
  return { home: [p[0] + Math.cos(a) * dx + Math.sin(a) * dy, p[1] - Math.sin(a) * dx + Math.cos(a) * dy], anchor: null };
}
function candidates(item) {
  const found = item.home ? [item.home] : [];
  const anchor = item.anchor || item.home;
  const [w, h] = item.size;
  for (const more of [0, 10, 24, 42, 66, 96])
    for (const [x, y] of COMPASS) {
      const gap = (item.anchor ? item.gap : 2) + more;
      found.push([anchor[0] + x * (gap + w), anchor[1] + y * (gap + h)]);
    }
  return found;
}
function overlap(p, size, boxes) {
  let sum = 0;
  for (const b of boxes) {
    const x = size[0] + b[2] - Math.abs(p[0] - b[0]);
    const y = size[1] + b[3] - Math.abs(p[1] - b[1]);
    if (x > 0 && y > 0) sum += 20 + x * y;
  }
  return sum;
}
function outside(p, size) {
  const x = Math.max(LEFT - p[0] + size[0], p[0] + size[0] - RIGHT, 0);
  const y = Math.max(TOP - p[1] + size[1], p[1] + size[1] - BOTTOM, 0);
  return 8 * (x + y);
}
function placeLabels(r, [more, far]) {
  const items = [];
  for (const label of labels) {
    if (!label.size) label.size = boxOf(label.badge || label.text);
    items.push({ element: label.e, own: label, size: label.size, gap: 9, ...homeOf(label, r) });
  }
  const boxes = [...pins(r), ...arrows(r), ...far];
  for (const item of [...items, ...more]) {
    const options = candidates(item);
    let best = null;
    options.forEach((p, n) => {
      const kept = item.own.choice === n ? -6 : 0;
      const cost = overlap(p, item.size, boxes) + outside(p, item.size) + (item.home && n === 0 ? 0 : 3 + 0.7 * n) + kept;
      if (!best || cost < best.cost) best = { cost, p, n };
    });
    item.own.choice = best.n;
    boxes.push([...best.p, ...item.size]);
    put(item, best);
  }
}
function put(item, { p, n }) {
  if (item.centre) {
    set(item.element, "transform", `translate(${f(p[0])} ${f(p[1] + 4.5)})`);
    return;
  }
  const home = item.own.home;
  set(item.element, "transform", `translate(${f(p[0] - home[0])} ${f(p[1] - home[1])})`);
  if (item.own.leader) show(item.own.leader, n === 0 && Boolean(item.own.at) === Boolean(item.anchor));
}
const pinned = all("#mechanism circle.pin", figure).map((e) => {
  const group = e.closest("[data-at]");
  return [Number(e.getAttribute("cx")), Number(e.getAttribute("cy")), group ? group.dataset.at : ""];
});
/* Arrows as a few small boxes along them, so that labels keep off. */
const shafts = pushes
  .filter(([e, load]) => !load.torque && !e.dataset.end)
  .map(([e, load, name]) => {
    const [, x1, y1, x2, y2] = /M(\S+),(\S+) (\S+),(\S+)/.exec(e.querySelector("path").getAttribute("d")).map(Number);
    return { load, name, along: [0, 0.33, 0.67, 1].map((s) => [x1 + s * (x2 - x1) - load.on[1], y1 + s * (y2 - y1) - load.on[2]]) };
  });
function arrows(r) {
  const found = [];
  for (const { load, name, along } of shafts) {
    const { way, flip } = turnOf(name, r);
    const p = carried(load.on, r);
    const a = ((way + (flip ? 180 : 0)) * Math.PI) / 180;
    for (const [x, y] of along) found.push([p[0] + Math.cos(a) * x + Math.sin(a) * y, p[1] - Math.sin(a) * x + Math.cos(a) * y, 5, 5]);
  }
  return found;
}
function pins(r) {
  return pinned.map(([x, y, name]) => {
    const p = own(points, name);
    return p ? [p.x[r], p.y[r], 5, 5] : [x, y, 5, 5];
  });
}

/* Words: answers, equation, the label of the unknown. */
function saying(answer, r) {
  const value = answer.values[r];
  const held = answer.holds && (answer.holds[r] ?? answer.holds[0]);
  if (held) return { text: ` ${held}`, sense: "" };
  if (value === null || value === undefined) return { text: " = no value", sense: "" };
  const sense = answer.senses[answer.sense[r]];
  return { text: ` = ${number(Math.abs(value), 6)} ${answer.unit}`.trimEnd(), sense };
}
const SHORT = { counterclockwise: " ccw", clockwise: " cw" };
function lastText(text) {
  let node = text.lastChild;
  while (node && node.lastChild) node = node.lastChild;
  return node;
}
function tell(r) {
  for (const answer of answers) {
    const { text, sense } = saying(answer, r);
    const line = byId("answers") && all("[data-answer]").find((e) => e.dataset.answer === answer.name);
    if (line) line.lastElementChild.textContent = text + (sense ? `, ${sense}` : "");
    const label = labels.find((l) => l.label === answer.name);
    if (!label || !motion || (answer.holds && answer.holds[r])) continue;
    const value = answer.values[r];
    const lead = answer.low ? "" : answer.base;
    const spring = loads[answer.name].span ? `: k` : "";
    const shown = value === null ? "no value" : `${number(Math.abs(value), 4)} ${answer.unit}${loads[answer.name].torque ? SHORT[sense] || "" : ""}`;
    lastText(label.text).data = `${lead}${spring} = ${shown}`;
    label.size = null;
  }
  const terms = data.terms;
  if (!terms) return;
  let sum = 0;
  terms.forEach((term, n) => {
    const ratio = term.ratio.v[r];
    const product = ratio === null ? null : ratio * term.value;
    sum += product === null ? NaN : product;
    byId(`ratio-${n}`).textContent = ratio === null ? "none" : number(ratio, 6);
    byId(`product-${n}`).textContent = product === null ? "none" : number(product, 6);
  });
  const value = answers[0].values[r];
  byId("root-product").textContent = value === null ? "none" : number(value, 6);
}

/* The position. */
const slider = byId("turn");
const hint = byId("hint");
const cursors = (data.plots || []).map((plot, n) => ({ ...plot, dots: plot.dots.map(places), svg: byId(`plot-${n}`) }));
const degreesOf = (r) => motion.first + motion.step * r;
function angleWords(r) {
  const degrees = Number(degreesOf(r).toFixed(3));
  if (degrees === 0) return "as written";
  return `${number(Math.abs(degrees), 5)}° ${degrees > 0 ? "counterclockwise" : "clockwise"}`;
}
function moveCursors(r) {
  for (const plot of cursors) {
    const [left, top, right, bottom] = plot.box;
    const x = left + ((degreesOf(r) - plot.x[0]) / (plot.x[1] - plot.x[0])) * (right - left);
    set(plot.svg.querySelector(".cursor"), "d", `M${f(x)},${top} L${f(x)},${bottom}`);
    all(".cursor-dot", plot.svg).forEach((dot, n) => {
      const y = plot.dots[n].y[r];
      show(dot, y !== null && y >= top - 0.1 && y <= bottom + 0.1);
      if (y !== null) {
        set(dot, "cx", f(x));
        set(dot, "cy", f(y));
      }
    });
  }
}
function render() {
  if (figure && stage) {
    if (motion) moveParts(row);
    tell(row);
    placeLabels(row, drawCentres(row));
  }
  if (!motion) return;
  moveCursors(row);
  byId("angle").textContent = angleWords(row);
  const said = answers.map((a) => a.name + saying(a, row).text + (saying(a, row).sense ? `, ${saying(a, row).sense}` : "")).join("; ");
  set(slider, "aria-valuetext", `${angleWords(row)}${said ? "; " + said : ""}`);
}
function hintOf(r, beyond) {
  if (beyond) return beyond;
  const found = motion.hints.find(([first, last]) => first <= r && r <= last);
  return found ? found[2] : "";
}
function moveTo(r, beyond = "") {
  row = Math.max(0, Math.min(rows - 1, Math.round(r)));
  slider.value = String(degreesOf(row));
  hint.textContent = hintOf(row, beyond);
  render();
}
function turnTo(degrees) {
  const r = (degrees - motion.first) / motion.step;
  const over = r < -0.5 || r > rows - 0.5;
  const end = degreesOf(r < 0 ? 0 : rows - 1);
  moveTo(r, over ? `The links do not meet beyond ${number(end, 5)}°.` : "");
}
let playing = 0;
const play = byId("play");
const still = window.matchMedia("(prefers-reduced-motion: reduce)");
function stop() {
  if (!playing) return;
  window.cancelAnimationFrame(playing);
  window.clearInterval(playing);
  playing = 0;
  play.textContent = "Play";
  set(byId("answers"), "aria-live", "polite");
}
function start() {
  set(byId("answers"), "aria-live", "off");
  play.textContent = "Pause";
  let place = row;
  let sign = 1;
  const advance = (amount) => {
    place += sign * amount;
    if (motion.turns) place = ((place % (rows - 1)) + rows - 1) % (rows - 1);
    else if (place > rows - 1 || place < 0) {
      sign = -sign;
      place = Math.max(0, Math.min(rows - 1, place));
    }
    moveTo(place);
  };
  if (still.matches) {
    playing = window.setInterval(() => advance(rows / 24), 1000);
    return;
  }
  let last = null;
  const frame = (now) => {
    if (last !== null) advance(((now - last) / 9000) * rows);
    last = now;
    playing = window.requestAnimationFrame(frame);
  };
  playing = window.requestAnimationFrame(frame);
}
if (motion) {
  slider.addEventListener("input", () => {
    stop();
    turnTo(Number(slider.value));
  });
  play.addEventListener("click", () => (playing ? stop() : start()));
  byId("written").addEventListener("click", () => {
    stop();
    moveTo(zero);
  });
  for (const plot of cursors) {
    const point = (event) => {
      if (event.type === "pointermove" && !event.buttons) return;
      stop();
      const matrix = plot.svg.getScreenCTM().inverse();
      const x = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix).x;
      const share = (x - plot.box[0]) / (plot.box[2] - plot.box[0]);
      turnTo(plot.x[0] + Math.max(0, Math.min(1, share)) * (plot.x[1] - plot.x[0]));
    };
    plot.svg.addEventListener("pointerdown", point);
    plot.svg.addEventListener("pointermove", point);
  }
}

/* The construction, a centre at a time. */
const buttons = all("ol.steps button");
const said = byId("said");
const SAID = said ? said.textContent : "";
const circle = byId("circle-figure");
function construct() {
  for (const b of buttons) {
    const n = Number(b.dataset.step);
    b.classList.toggle("later", n > step);
    if (!complete && n === step) set(b, "aria-current", "step");
    else b.removeAttribute("aria-current");
  }
  if (circle) {
    for (const e of all("[data-step]", circle)) {
      const n = Number(e.dataset.step);
      show(e, e.id.startsWith("closed-") ? !complete && n === step : n <= step);
      e.classList.toggle("now", !complete && n === step && n > 0);
    }
    for (const e of all('[id^="order-"]', circle)) show(e, Number(e.id.slice(6)) <= step);
  }
  if (said) {
    byId("back").disabled = byId("from-start").disabled = !complete && step === 0;
    byId("next").disabled = byId("whole").disabled = complete;
    const words = complete ? SAID : buttons.find((b) => Number(b.dataset.step) === step).textContent;
    if (said.textContent !== words) said.textContent = words;
  }
  render();
}
function go(n, whole = false) {
  step = Math.max(0, Math.min(data.steps, n));
  complete = whole;
  construct();
}
for (const b of buttons) b.addEventListener("click", () => go(Number(b.dataset.step)));
if (said) {
  byId("from-start").addEventListener("click", () => go(0));
  byId("back").addEventListener("click", () => go(complete ? data.steps : step - 1));
  byId("next").addEventListener("click", () => (step === data.steps ? go(step, true) : go(step + 1)));
  byId("whole").addEventListener("click", () => go(data.steps, true));
}
construct();
window.addEventListener("beforeprint", () => { for (const d of all("details")) d.open = true; });
if (document.fonts) document.fonts.ready.then(() => { for (const l of [...labels, ...centres]) l.size = null; render(); });
window.addEventListener("resize", () => { for (const l of [...labels, ...centres]) l.size = null; render(); });
})();
