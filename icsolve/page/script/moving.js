/* Links, joints, loads. */
const turning = all("[data-turn]", figure).map((e) => [e, own(links, e.dataset.turn)]).filter(([, l]) => l);
const following = all("#mechanism [data-at], #loads [data-at]", figure)
  .map((e) => [e, own(points, e.dataset.at)])
  .filter(([, p]) => p);
const contacts = all('#mechanism [data-at^="@"]', figure);
const pushes = all("[data-load]", figure).map((e) => [e, loads[e.dataset.load], e.dataset.load]);
/* The line through the tails of a force per length: the points at its ends, and how far from these it ends. */
const tails = all("[data-tails]", figure).map((e) => {
  const [name, a, b, ...far] = e.dataset.tails.split(" ");
  return [e, name, [a, b].map((p, n) => [p, +far[2 * n], +far[2 * n + 1]])];
});
const springs = all("[data-span]", figure).map((e) => [e, loads[e.dataset.span]]);
const unknown = (name) => answers.find((a) => a.name === name);

/* What lies between two places, between two others. */
function stretch(e, [a0, b0], [a, b]) {
  const [u, v] = [minus(b0, a0), minus(b, a)];
  const angle = (w) => (atan2(w[1], w[0]) * 180) / PI;
  const k = hypot(...v) / (hypot(...u) || 1);
  set(e, "transform", `translate(${f(a[0])} ${f(a[1])}) rotate(${f(angle(v))}) scale(${k.toFixed(4)} 1) rotate(${f(-angle(u))}) translate(${-a0[0]} ${-a0[1]})`);
}
/* Where a load's arrow was written and is: at a point, at a share of the way between two, else on its link. */
function placesOf(end, load, r) {
  const [a, b = a, s = 0] = (end || "").split(" ");
  if (!at(a, r) || !at(b, r)) return [load.on.slice(1), carried(load.on, r)];
  return [zero, r].map((n) => [0, 1].map((c) => at(a, n)[c] + s * (at(b, n)[c] - at(a, n)[c])));
}
function turnOf(name, r) {
  const load = loads[name];
  const { values, reach } = unknown(name) || load;
  const [value, written] = values ? [values[r], values[zero]] : [1, 1];
  return { way: (load.way && load.way[r]) || 0, flip: value !== null && value < 0 !== written < 0, gone: value === null && !(reach && reach[r]) };
}
/* In the live row a link may have another shape: an outline about its points, or what it was, stretched. */
const HALF = 6.5;
const plainBody = (e) => all("path", e).length === 1 && e.querySelector("path.body") && !e.querySelector("circle");
function hullOf(some) {
  const sorted = [...some].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turnsLeft = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]) > 1e-9;
  const chain = (list) => {
    const out = [];
    for (const p of list) {
      while (out.length > 1 && !turnsLeft(out[out.length - 2], out[out.length - 1], p)) out.pop();
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...chain(sorted), ...chain([...sorted].reverse())];
}
function outlineOf(some) {
  const hull = hullOf(some);
  const parts = hull.map((p, n) => {
    const q = hull[(n + 1) % hull.length];
    const size = apart(p, q) || 1;
    const [x, y] = [((q[1] - p[1]) / size) * HALF, ((p[0] - q[0]) / size) * HALF];
    return `${n ? `A${HALF},${HALF} 0 0 1` : "M"} ${f(p[0] + x)},${f(p[1] + y)} L${f(q[0] + x)},${f(q[1] + y)}`;
  });
  const start = parts[0].slice(1, parts[0].indexOf("L"));
  return `${parts.join(" ")} A${HALF},${HALF} 0 0 1 ${start}Z`;
}
function stretched(before, after) {
  const [p, q] = before;
  const [a, b] = after;
  const third = before.findIndex((s) => abs((q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0])) > 30);
  const [u, v] = [minus(q, p), minus(b, a)];
  const w = third < 0 ? [-u[1], u[0]] : [before[third][0] - p[0], before[third][1] - p[1]];
  const k = hypot(...u) / (hypot(...v) || 1);
  const x = third < 0 ? [-v[1] * k, v[0] * k] : [after[third][0] - a[0], after[third][1] - a[1]];
  const d = u[0] * w[1] - u[1] * w[0];
  const m = [(v[0] * w[1] - x[0] * u[1]) / d, (v[1] * w[1] - x[1] * u[1]) / d, (x[0] * u[0] - v[0] * w[0]) / d, (x[1] * u[0] - v[1] * w[0]) / d];
  return `matrix(${m.map((c) => c.toFixed(5)).join()},${f(a[0] - m[0] * p[0] - m[2] * p[1])},${f(a[1] - m[1] * p[0] - m[3] * p[1])})`;
}
function bent(e, r) {
  const own = e.querySelector(".bent");
  if (own) own.remove();
  const body = e.querySelector("path.body");
  if (body) show(body, true);
  const names = r === LIVE && live.links[e.dataset.turn];
  if (!names) return false;
  const before = names.map((n) => written[n]);
  const after = names.map((n) => [points[n].x[r], points[n].y[r]]);
  if (!after.flat().every(Number.isFinite)) return false;
  if (before.every((p, i) => before.every((q, j) => abs(apart(p, q) - apart(after[i], after[j])) < 0.3))) return false;
  if (plainBody(e)) {
    show(body, false);
    e.removeAttribute("transform");
    make("path", { class: "body bent", d: outlineOf(after) }, e);
    return true;
  }
  const far = before.reduce((best, p, n) => (apart(p, before[0]) > apart(before[best], before[0]) ? n : best), 0);
  if (!far) return false;
  const order = [0, far, ...names.map((_, n) => n).filter((n) => n && n !== far)];
  set(e, "transform", stretched(order.map((n) => before[n]), order.map((n) => after[n])));
  return true;
}
/* A rail of the frame goes where its guide has gone, not along it. */
function moveRail(e, r) {
  const at = e.dataset.rail;
  if (r !== LIVE || !own(written, at)) return e.removeAttribute("transform");
  const [before, now] = [guideOf(live.rails[at], scene.first.own), guideOf(live.rails[at], ownOf(live, lab.scene()[3]))];
  const [p, q] = [written[at], [points[at].x[r], points[at].y[r]]];
  const across = (q[0] - p[0]) * now[1] + (q[1] - p[1]) * now[0];
  set(e, "transform", `translate(${f(p[0] + across * now[1])} ${f(p[1] + across * now[0])}) rotate(${f(-turned(before, now))}) translate(${-p[0]} ${-p[1]})`);
}
const rails = all("[data-rail]", figure);
/* How many times as large as written a radius is. */
function grown(path, r) {
  const n = r === LIVE ? live.paths.indexOf(path) : -1;
  return n < 0 ? 1 : numbers[n] / live.numbers[n];
}
/* A rope round its circles: parts that touch two of them, and arcs between. */
function layRope(e, circles, r) {
  const where = ([name, x, y, s, path]) => {
    const p = own(points, name);
    const now = s * grown(path, r);
    return p ? [x + p.x[r] - p.x[zero], y + p.y[r] - p.y[zero], now] : [x, y, now];
  };
  const round = circles.map(where);
  let d = "";
  let before = null;
  for (let k = 1; k < round.length; k++) {
    const [[ax, ay, s], [bx, by, t]] = [round[k - 1], round[k]];
    const [dx, dy, between] = [bx - ax, by - ay, t - s];
    const square = dx * dx + dy * dy;
    const length = Math.sqrt(square - between * between);
    const [ux, uy] = [(length * dx + between * dy) / square, (length * dy - between * dx) / square];
    const start = [ax + s * uy, ay - s * ux];
    const turn = before ? atan2(before[0] * uy - before[1] * ux, before[0] * ux + before[1] * uy) * Math.sign(s) : 0;
    const large = turn < -1e-6 ? 1 : 0;
    d += s && before ? `A${f(abs(s))},${f(abs(s))} 0 ${large} ${s > 0 ? 1 : 0} ` : before ? "L" : "M";
    d += `${start.map(f)} L${f(start[0] + length * ux)},${f(start[1] + length * uy)}`;
    before = [ux, uy];
  }
  const laid = !d.includes("NaN");
  show(e, laid);
  if (laid) set(e.querySelector("path"), "d", d);
}
const ropes = all("[data-rope]", figure).map((e) => [e, data.ropes[e.dataset.rope]]);
/* The wheels that ropes go round, with the paths of their radii. */
const rounds = new Map();
for (const [, x, y, s, path] of Object.values(data.ropes || {}).flat())
  for (const e of path ? all("#mechanism circle", figure) : []) {
    const [cx, cy, size] = ["cx", "cy", "r"].map((name) => Number(e.getAttribute(name)));
    if (apart([cx, cy], [x, y]) > 0.15 || abs(size - abs(s)) > 0.15) continue;
    const before = rounds.get(e);
    const spokes = [...e.parentNode.querySelectorAll("path.faint")];
    rounds.set(e, before ? { ...before, paths: [...before.paths, path] } : { at: [cx, cy], size, spokes, paths: [path] });
  }
function moveParts(r) {
  for (const [e, { at: [x, y], size, spokes, paths }] of rounds) {
    const k = max(...paths.map((path) => grown(path, r)));
    set(e, "r", f(size * k));
    for (const spoke of spokes) set(spoke, "transform", `translate(${x} ${y}) scale(${k}) translate(${-x} ${-y})`);
  }
  for (const [e, circles] of ropes) layRope(e, circles, r);
  for (const [e, l] of turning)
    if (!bent(e, r))
      set(e, "transform", `translate(${f(l.x[r])} ${f(l.y[r])}) rotate(${f(-l.a[r])}) translate(${-l.from[0]} ${-l.from[1]})`);
  if (live) for (const e of rails) moveRail(e, r);
  for (const e of contacts) show(e, r === zero || own(points, e.dataset.at));
  for (const [e, p] of following) set(e, "transform", `translate(${f(p.x[r] - p.x[zero])} ${f(p.y[r] - p.y[zero])})`);
  for (const [e, load, name] of pushes) {
    const { way, flip, gone } = turnOf(name, r);
    e.classList.toggle("ghost", gone);
    const [from, to] = placesOf(e.dataset.end, load, r);
    const turned = load.torque ? (flip ? "scale(-1 1)" : "") : `rotate(${f(-way - (flip ? 180 : 0))})`;
    set(e, "transform", `translate(${f(to[0])} ${f(to[1])}) ${turned} translate(${-from[0]} ${-from[1]})`);
  }
  for (const [e, name, ends] of tails) {
    const { way, flip, gone } = turnOf(name, r);
    e.classList.toggle("ghost", gone);
    const placed = (n, a) => ends.map(([p, x, y]) => [at(p, n)[0] + cos(a) * x + sin(a) * y, at(p, n)[1] - sin(a) * x + cos(a) * y]);
    stretch(e, placed(zero, 0), placed(r, (way / 180 + flip) * PI));
  }
  for (const [e, load] of springs) stretch(e, load.span.map((s) => s.slice(1)), load.span.map((s) => carried(s, r)));
}
