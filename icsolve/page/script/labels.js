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
const COMPASS = [2, 6, 1, 7, 3, 5, 0, 4].map((k) => [cos((k * PI) / 4), sin((k * PI) / 4)]);
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
  const a = load.torque || load.span ? 0 : ((way + (flip ? 180 : 0)) * PI) / 180;
  const dx = label.home[0] - load.on[1];
  const dy = label.home[1] - load.on[2];
  return { home: [p[0] + cos(a) * dx + sin(a) * dy, p[1] - sin(a) * dx + cos(a) * dy], anchor: null };
}
function candidates(item) {
  const found = item.home ? [item.home] : [];
  const anchor = item.anchor || item.home;
  const [w, h] = item.size;
  for (const more of [0, 10, 24, 42, 66, 96, 130, 170, 220])
    for (const [x, y] of COMPASS) {
      const gap = (item.anchor ? item.gap : 2) + more;
      found.push([anchor[0] + x * (gap + w), anchor[1] + y * (gap + h)]);
    }
  return found;
}
/* It is worse to cover another label than an arrow or a pin. */
const ON_LABEL = 6;
function overlap(p, size, boxes) {
  let sum = 0;
  for (const b of boxes) {
    const x = size[0] + b[2] - abs(p[0] - b[0]);
    const y = size[1] + b[3] - abs(p[1] - b[1]);
    if (x > 0 && y > 0) sum += (b[4] || 1) * (60 + 2 * x * y);
  }
  return sum;
}
/* The nearest place that is whole in the picture. */
function held(p, size) {
  const x = max(LEFT + size[0], min(RIGHT - size[0], p[0]));
  const y = max(TOP + size[1], min(BOTTOM - size[1], p[1]));
  return [x, y];
}
/* What a label costs that lies on lines: more, the more of them it covers; no sum above `most` matters. */
function crossed([x, y], [w, h], strokes, most) {
  let sum = 0;
  for (const [x1, y1, x2, y2] of strokes) {
    if ((x1 < x - w && x2 < x - w) || (x1 > x + w && x2 > x + w)) continue;
    if ((y1 < y - h && y2 < y - h) || (y1 > y + h && y2 > y + h)) continue;
    const [dx, dy] = [x2 - x1 || 1e-9, y2 - y1 || 1e-9];
    const first = max(0, (x - x1 - w * Math.sign(dx)) / dx, (y - y1 - h * Math.sign(dy)) / dy);
    const last = min(1, (x - x1 + w * Math.sign(dx)) / dx, (y - y1 + h * Math.sign(dy)) / dy);
    if (last > first) sum += 4 + 0.25 * (last - first) * hypot(dx, dy);
    if (sum > most) break;
  }
  return sum;
}
function placeLabels(r, [more, far]) {
  const items = [];
  for (const label of labels) {
    if (!label.size) label.size = boxOf(label.badge || label.text);
    items.push({ element: label.e, own: label, size: label.size, gap: 9, ...homeOf(label, r) });
  }
  const boxes = [...pins(r), ...arrows(r), ...far];
  const strokes = [...outlines(), ...lines()];
  for (const item of [...items, ...more]) {
    const options = candidates(item);
    let best = null;
    options.forEach((wished, n) => {
      const own = (item.home && n === 0 ? 0 : 3 + 0.7 * n) - (item.own.choice === n ? 6 : 0);
      if (best && own >= best.cost) return;
      const p = held(wished, item.size);
      const most = best ? best.cost : Infinity;
      let cost = own + overlap(p, item.size, boxes);
      if (cost < most) cost += crossed(p, item.size, strokes, most - cost);
      if (cost < most) best = { cost, p, n };
    });
    item.own.choice = best.n;
    boxes.push([...best.p, ...item.size, ON_LABEL]);
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
    const a = ((way + (flip ? 180 : 0)) * PI) / 180;
    for (const [x, y] of along) found.push([p[0] + cos(a) * x + sin(a) * y, p[1] - sin(a) * x + cos(a) * y, 5, 5]);
  }
  return found;
}
/* What is drawn, as short lines where it was written, by the part that it moves with. */
const PIECE = 24;
function pieces(path) {
  const length = path.getTotalLength();
  const count = max(1, Math.ceil(length / PIECE));
  const ends = [...Array(count + 1).keys()].map((k) => path.getPointAtLength((length * k) / count));
  return ends.slice(1).map((q, k) => [ends[k].x, ends[k].y, q.x, q.y]);
}
const drawn = new Map();
for (const path of all("#mechanism path, #loads [data-load] path", figure)) {
  const part = path.closest("[data-turn], [data-at], [data-load]") || figure;
  drawn.set(part, [...(drawn.get(part) || []), ...pieces(path)]);
}
function outlines() {
  const found = [];
  for (const [part, all] of drawn) {
    const bent = part.querySelector(":scope > .bent");
    const moved = part === figure ? null : part.transform.baseVal.consolidate();
    const m = moved ? moved.matrix : { a: 1, b: 0, c: 0, d: 1, e: 0, f: 0 };
    const at = (x, y) => [m.a * x + m.c * y + m.e, m.b * x + m.d * y + m.f];
    for (const [x1, y1, x2, y2] of bent ? pieces(bent) : all) found.push([...at(x1, y1), ...at(x2, y2)]);
  }
  return found;
}
/* The lines that find the centres, as they are drawn. */
function lines() {
  const seen = centres.flatMap((c) => c.paths).map((path) => path.getAttribute("d").match(/-?[\d.]+/g).map(Number));
  return seen.filter((ends) => ends.length === 4);
}
if (stage) {
  fit([], [...Array(rows).keys()].flatMap(arrows).filter((p) => p.every(Number.isFinite)));
  data.window = [LEFT, TOP, RIGHT, BOTTOM];
}
function pins(r) {
  return pinned.map(([x, y, name]) => {
    const p = own(points, name);
    return p ? [p.x[r], p.y[r], 5, 5] : [x, y, 5, 5];
  });
}
