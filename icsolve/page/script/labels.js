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
    const x = size[0] + b[2] - Math.abs(p[0] - b[0]);
    const y = size[1] + b[3] - Math.abs(p[1] - b[1]);
    if (x > 0 && y > 0) sum += (b[4] || 1) * (60 + 2 * x * y);
  }
  return sum;
}
/* The nearest place that is whole in the picture. */
function held(p, size) {
  const x = Math.max(LEFT + size[0], Math.min(RIGHT - size[0], p[0]));
  const y = Math.max(TOP + size[1], Math.min(BOTTOM - size[1], p[1]));
  return [x, y];
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
    options.forEach((wished, n) => {
      const p = held(wished, item.size);
      const kept = item.own.choice === n ? -6 : 0;
      const cost = overlap(p, item.size, boxes) + (item.home && n === 0 ? 0 : 3 + 0.7 * n) + kept;
      if (!best || cost < best.cost) best = { cost, p, n };
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
    const a = ((way + (flip ? 180 : 0)) * Math.PI) / 180;
    for (const [x, y] of along) found.push([p[0] + Math.cos(a) * x + Math.sin(a) * y, p[1] - Math.sin(a) * x + Math.cos(a) * y, 5, 5]);
  }
  return found;
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
