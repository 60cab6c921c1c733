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
  return { way: (load.way && load.way[r]) || 0, flip: value !== null && value < 0 !== written < 0, gone: value === null };
}
function moveParts(r) {
  for (const [e, l] of turning)
    set(e, "transform", `translate(${f(l.x[r])} ${f(l.y[r])}) rotate(${f(-l.a[r])}) translate(${-l.from[0]} ${-l.from[1]})`);
  for (const e of contacts) show(e, r === zero || own(points, e.dataset.at));
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
