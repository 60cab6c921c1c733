/* Centres and the lines that find them. */
const make = (name, attributes, parent) => {
  const e = document.createElementNS(NS, name);
  for (const [key, value] of entries(attributes)) set(e, key, value);
  parent.appendChild(e);
  return e;
};
const stage = byId("centres");
let [LEFT, TOP, RIGHT, BOTTOM] = data.window;
let MIDDLE = [(LEFT + RIGHT) / 2, (TOP + BOTTOM) / 2];
/* The window with some more places in it, and the ends of arrows. */
function fit(more, ends = []) {
  const [left, top, right, bottom] = data.window;
  const room = (n, end, pick) =>
    [[more, 46], [ends, 12]].reduce((far, [some, by]) => some.reduce((all, p) => pick(all, p[n] + (pick === min ? -by : by)), far), end);
  [LEFT, TOP] = [room(0, left, min), room(1, top, min)];
  [RIGHT, BOTTOM] = [room(0, right, max), room(1, bottom, max)];
  MIDDLE = [(LEFT + RIGHT) / 2, (TOP + BOTTOM) / 2];
  set(figure, "viewBox", [LEFT, TOP, RIGHT - LEFT, BOTTOM - TOP].map(f).join(" "));
  const clip = figure.querySelector("#window rect");
  entries({ x: LEFT, y: TOP, width: RIGHT - LEFT, height: BOTTOM - TOP }).forEach(([key, v]) => set(clip, key, f(v)));
}
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
const isFar = (c, r) => abs(c.x[r]) >= INFINITE || abs(c.y[r]) >= INFINITE;
function lineOf(c, line, r) {
  const ends = line.map((end) => (typeof end === "string" ? at(end, r) : [centres[end].x[r], centres[end].y[r]]));
  ends.push([c.x[r], c.y[r]]);
  if (ends.some((p) => !p || p[0] === null || p[1] === null)) return "";
  const near = ends.filter((p) => max(abs(p[0]), abs(p[1])) < INFINITE);
  const away = ends.filter((p) => max(abs(p[0]), abs(p[1])) >= INFINITE);
  if (!near.length) return "";
  const o = near[0];
  let far = o;
  for (const p of near) if (hypot(p[0] - o[0], p[1] - o[1]) > hypot(far[0] - o[0], far[1] - o[1])) far = p;
  let u = minus(far, o);
  if (hypot(...u) < 0.2) {
    if (!away.length) return "";
    u = away[0];
  }
  const length = hypot(...u);
  u = [u[0] / length, u[1] / length];
  const reach = near.map((p) => (p[0] - o[0]) * u[0] + (p[1] - o[1]) * u[1]);
  const more = away.length ? 2e4 : 16;
  const first = max(min(...reach) - more, -2e4);
  const last = min(max(...reach) + more, 2e4);
  return `M${f(o[0] + first * u[0])},${f(o[1] + first * u[1])} L${f(o[0] + last * u[0])},${f(o[1] + last * u[1])}`;
}
const inside = (p) => p[0] >= LEFT && p[0] <= RIGHT && p[1] >= TOP && p[1] <= BOTTOM;
function edge(u, margin) {
  const across = u[0] ? ((u[0] > 0 ? RIGHT : LEFT) - MIDDLE[0]) / u[0] : Infinity;
  const down = u[1] ? ((u[1] > 0 ? BOTTOM : TOP) - MIDDLE[1]) / u[1] : Infinity;
  const reach = min(across, down) - margin;
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
function drawLines(c, r) {
  c.paths.forEach((path, n) => {
    const d = c.step <= step ? lineOf(c, c.lines[n], r) : "";
    set(path, "d", d || "M0,0");
    show(path, Boolean(d));
    path.classList.toggle("now", !complete && c.step === step);
    path.classList.toggle("old", !complete && c.step !== step);
  });
}
/* Where a centre is: in the picture, or in which direction it lies beyond. */
function spotOf(c, r) {
  const p = [c.x[r], c.y[r]];
  const away = isFar(c, r);
  if (!away && inside(p)) return { p, far: false, key: `${Math.round(p[0] / 2)},${Math.round(p[1] / 2)}`, tail: "" };
  const from = away ? p : [p[0] - MIDDLE[0], p[1] - MIDDLE[1]];
  const size = hypot(...from);
  const u = [from[0] / size, from[1] / size];
  const tail = away ? " ∞" : `, ${number(size / data.scale, 3)} ${data.length} away`;
  return { u, far: true, key: away ? `${f(u[0])} ${f(u[1])}` : `far ${c.id}`, tail };
}
/* An arrow at the edge of the picture; gives boxes along it, which labels keep off. */
function drawFar(c, u, count) {
  const tip = edge(u, 10 + 3 * count);
  const turn = (atan2(u[1], u[0]) * 180) / PI;
  set(c.far, "transform", `translate(${f(tip[0])} ${f(tip[1])}) rotate(${f(turn)})`);
  return [2, 9, 16, 23, 30].map((s) => [tip[0] - s * u[0], tip[1] - s * u[1], 4, 4]);
}
function drawSpot(c, spot, count) {
  show(c.far, spot.far);
  show(c.disc, !spot.far);
  if (spot.far) {
    const along = drawFar(c, spot.u, count);
    return { group: [c], tail: spot.tail, at: along[2], along };
  }
  set(c.disc, "cx", f(spot.p[0]));
  set(c.disc, "cy", f(spot.p[1]));
  return { group: [c], tail: "", at: spot.p, along: [] };
}
/* The label of centres that share a place, ready to be placed. */
function labelOf({ group, at: anchor, tail, along }) {
  const c = group[0];
  const words = group.map((g) => g.low).join() + tail;
  if (c.words !== words) {
    named(c.text, group, tail);
    c.words = words;
    c.size = null;
  }
  show(c.label, true);
  c.size = c.size || boxOf(c.text);
  return { element: c.label, anchor, size: c.size, gap: along.length ? 23 : 8, own: c, centre: true };
}
/* All centres and lines; gives their labels, and the boxes of the arrows. */
function drawCentres(r) {
  const shared = new Map();
  for (const c of centres) {
    const seen = c.step <= step && c.x[r] !== null && c.y[r] !== null;
    show(c.group, seen);
    show(c.label, false);
    drawLines(c, r);
    if (!seen) continue;
    const spot = spotOf(c, r);
    const first = shared.get(spot.key);
    if (first) {
      first.group.push(c);
      show(c.far, false);
      show(c.disc, false);
    } else shared.set(spot.key, drawSpot(c, spot, [...shared.values()].filter((s) => s.along.length).length));
  }
  const found = [...shared.values()];
  return [found.map(labelOf), found.flatMap((s) => s.along)];
}
