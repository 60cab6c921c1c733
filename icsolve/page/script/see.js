/* What can be seen beside: velocities, rotations about centres, curves of points, centrodes, free bodies. */
const overlay = byId("see") && make("g", { id: "overlay", "clip-path": "url(#window)" }, figure);
if (overlay) figure.insertBefore(overlay, byId("labels"));
for (const { pushes } of Object.values((data.forces && data.forces.links) || {}))
  for (const one of pushes) for (const part of ["x", "y", "u", "v", "couple"]) one[part] = column(one[part]);
/* What is told of links: of a live page its scene, of another what was solved beforehand, in case units. */
const before = !live && data.forces && data.forces.links;
const told = live || (before && {
  frame: [0, 0, 1],
  unit: data.forces.units[2],
  links: Object.fromEntries(entries(before).map(([link, one]) => [link, one.names])),
});
for (const one of Object.values(before || {})) one.twist = one.twist.map(column);
const placeIn = ([x, y]) => inPicture([x / told.frame[2] + told.frame[0], y / told.frame[2] + told.frame[1]]);
const ticked = (selector) => all(selector).filter((e) => e.checked);

/* A scene of its own for the positions of the turn, followed from one to the next. */
const shadow = live ? { numbers: [...live.numbers], key: "", list: null } : null;
if (shadow) {
  shadow.figure = figureOf(program, live, shadow.numbers);
  shadow.figure.typed();
}
const stateOf = (lab, solved) => {
  const place = (name) => inPicture(fromFrame(lab.points[live.points[name]]));
  const places = Object.fromEntries(Object.keys(live.points).map((name) => [name, place(name)]));
  const poses = Object.fromEntries(entries(live.poses).map(([link, pose]) => [link, poseIn(pose, (n) => places[n], solved.own)]));
  const frame = lab.points.map((p) => [...p]);
  return { places, poses, solved, frame, twist: (link) => solved.twists[live.body[link]], where: (name) => frame[live.points[name]] };
};
function stateBefore(r) {
  const known = Object.values(before).some((one) => one.twist[0][r] !== null);
  if (!known) return null;
  const spots = entries(before).flatMap(([, one]) => one.names.map((name, n) => [name, own(points, name) ? at(name, r) : one.spots[n]]));
  const places = Object.fromEntries(spots);
  const poses = Object.fromEntries(entries(links).map(([link, l]) => [link, [l.x[r], l.y[r], l.a[r]]]));
  const twist = (link) => { const t = before[link].twist.map((part) => part[r]); return t[0] === null ? null : t; };
  return { places, poses, twist, where: (name) => inCase(places[name]) };
}
function shadowed(numbersNow) {
  numbersNow.forEach((value, n) => (shadow.numbers[n] = value));
  try {
    shadow.figure.followed(true, mover ? carriedTo : undefined);
    return stateOf(shadow.figure, solvedScene(live, shadow.numbers, shadow.figure));
  } catch (refusal) {
    refused(refusal);
    return null;
  }
}
/* The numbers in a position of the turn; null where they do not tell it. */
function numbersAt(r) {
  if (mover) return r === zero && !scene.changed ? live.numbers : turnedTo(live.input, degreesOf(r));
  if (r !== zero && (!live.moves || live.posed.length || scene.changed)) return null;
  const some = [...live.numbers];
  if (r !== zero)
    for (const [name, moves] of entries(live.handles))
      for (const [kind, n] of moves) some[n] = inCase([points[name].x[r], points[name].y[r]])[kind === "x" ? 0 : 1];
  return some;
}
function stateAt(r) {
  if (!live) return stateBefore(r);
  if (r === LIVE) return scene.status === "ok" ? stateOf(lab, scene.solved) : null;
  const some = numbersAt(r);
  return some && shadowed(some);
}
/* All positions of the turn, every other one; solved once for the same numbers. */
function turnTable() {
  if (!motion) return [];
  if (!live) return [...Array(rows).keys()].map(stateBefore);
  const key = mover ? `${live.input} ${mover.numbers.join()}` : String(scene.changed);
  if (shadow.key !== key) {
    shadow.key = key;
    const pace = max(1, Math.round(rows / 180));
    const some = [...Array(rows).keys()].filter((r) => r % pace === 0);
    const held = mover && [{ ...mover.at }, [...mover.pose]];
    const home = () => { if (held) [mover.at, mover.pose] = [{ ...held[0] }, [...held[1]]]; };
    const middle = some.findIndex((r) => r >= zero);
    shadow.figure.adopt(lab.state());
    const up = some.slice(middle).map(stateAt);
    home();
    shadow.figure.adopt(lab.state());
    const down = some.slice(0, middle).reverse().map(stateAt);
    home();
    shadow.list = [...down.reverse(), ...up];
  }
  return shadow.list;
}

/* --- marks -------------------------------------------------------------------------------------------- */

function arrow(parent, kind, [x, y], [u, v], words) {
  const size = hypot(u, v);
  if (!(size > 1.5)) return;
  const [a, b] = [u / size, v / size];
  const head = min(9, size);
  const g = make("g", { class: kind }, parent);
  make("path", { d: `M${f(x)},${f(y)} L${f(x + u - a * head * 0.8)},${f(y + v - b * head * 0.8)}` }, g);
  const side = [-b * head * 0.38, a * head * 0.38];
  const base = [x + u - a * head, y + v - b * head];
  make("path", { class: "tip", d: `M${f(x + u)},${f(y + v)} L${f(base[0] + side[0])},${f(base[1] + side[1])} L${f(base[0] - side[0])},${f(base[1] - side[1])}Z` }, g);
  if (words) nameAt(g, kind, [x + u, y + v], [a, b], words);
}
/* A name beyond the end of a line that goes that way. */
function nameAt(parent, kind, [x, y], [u, v], words) {
  const [a, b] = [u / (hypot(u, v) || 1), v / (hypot(u, v) || 1)];
  make("text", { class: kind, x: f(x + a * 12), y: f(y + b * 12 + 4), "text-anchor": a > 0.3 ? "start" : a < -0.3 ? "end" : "middle", "font-size": 12 }, parent).textContent = words;
}
const FASTEST = 80;
function drawVelocities(state) {
  const some = [];
  const least = (live ? 1e-7 : 1e-3) * told.frame[2] / view[0]; // a point that a turning link leaves at rest
  for (const [link, names] of entries(told.links)) {
    const t = state.twist(link);
    for (const name of t ? names : []) {
      const v = velocity(t, state.where(name));
      if (!name.startsWith("@") && v.every(Number.isFinite) && hypot(...v) > least * abs(t[2]) && !some.some((one) => one.name === name && apart(one.v, v) < (live ? 1e-9 : 1e-4 * hypot(...v)))) some.push({ name, link, v });
    }
  }
  const most = max(...some.map(({ v }) => hypot(...v)));
  const several = (name) => some.filter((one) => one.name === name).length > 1;
  const called = ({ name, link }) => `v${name}${several(name) ? ` on ${link}` : ""}`;
  for (const one of most > 0 ? some : []) {
    const { name, v } = one;
    const [u, w] = [(v[0] / most) * FASTEST, (-v[1] / most) * FASTEST];
    arrow(overlay, "v-arrow", state.places[name], [u, w], called(one));
  }
  return some.filter(({ v }) => hypot(...v) > (live ? 1e-9 : 1e-5) * most).map((one) => `${called(one)} = ${number(hypot(...one.v) / told.frame[2], 4)} ${told.unit}/s`).join(", ");
}
/* The rotation of a link: rays from its centre, and how each point goes about it. */
function drawRotation(state, link) {
  const t = state.twist(link);
  if (!t || largest(t) === 0) return;
  const spots = spotsOf(state, link);
  const far = abs(t[2]) * 1e7 <= hypot(t[0], t[1]);
  const g = make("g", { class: "rotation" }, overlay);
  if (far) {
    const v = [t[1], -t[0]];
    const size = hypot(...v);
    for (const p of spots) arrow(g, "spin", p, [(v[0] / size) * 40, (-v[1] / size) * 40]);
    return;
  }
  const c = placeIn([t[0] / t[2], t[1] / t[2]]);
  const sign = t[2] > 0 ? -1 : 1;
  for (const p of spots) {
    const r = apart(p, c);
    if (r < 1 || r > 1e5) continue;
    make("path", { d: `M${f(c[0])},${f(c[1])} L${f(p[0])},${f(p[1])}` }, g);
    const a = atan2(p[1] - c[1], p[0] - c[0]);
    const wide = min(0.5, 60 / r) * sign;
    const at = (b) => [c[0] + r * cos(b), c[1] + r * sin(b)];
    const [from, to] = [at(a - wide), at(a + wide)];
    make("path", { class: "sweep", d: `M${f(from[0])},${f(from[1])} A${f(r)},${f(r)} 0 0 ${sign > 0 ? 1 : 0} ${f(to[0])},${f(to[1])}` }, g);
    arrow(g, "spin", at(a + wide * 0.9), [to[0] - at(a + wide * 0.9)[0] + cos(a + wide + sign * 1.571) * 9, to[1] - at(a + wide * 0.9)[1] + sin(a + wide + sign * 1.571) * 9]);
  }
  const low = document.createElementNS(NS, "text");
  for (const [key, value] of entries({ x: f(c[0] + 9), y: f(c[1] - 9), "font-size": 12 })) set(low, key, value);
  low.textContent = `ω${link} = ${number(t[2], 4)} rad/s`;
  g.appendChild(low);
}
/* The points of a link that have a place. */
const spotsOf = (state, link) => told.links[link].map((name) => state.places[name]).filter((p) => p && p.every(Number.isFinite));
const path = (places) => {
  let d = "";
  let before = null;
  for (const p of places) {
    if (p) d += `${before && apart(p, before) < 400 ? "L" : "M"}${f(p[0])},${f(p[1])} `;
    before = p;
  }
  return d;
};
function drawCurve(name) {
  const places = (live && scene.changed) || !motion ? turnTable().map((state) => state && state.places[name]) : points[name].x.slice(0, rows).map((x, r) => [x, points[name].y[r]]);
  if (places.length) make("path", { class: "curve", d: path(places) }, overlay);
}
/* Where the centre of a link and the frame goes: in the frame, and in the link itself. */
function drawCentrodes(state, link) {
  const table = turnTable();
  const centre = (one) => {
    const t = one && one.twist(link);
    return t && abs(t[2]) * 1e5 > hypot(t[0], t[1]) * told.frame[2] && t[2] !== 0 ? placeIn([t[0] / t[2], t[1] / t[2]]) : null;
  };
  const near = (p) => p && max(abs(p[0]), abs(p[1])) < 5000;
  const fixed = table.map(centre).map((p) => (near(p) ? p : null));
  const back = (p, [x, y, a]) => {
    const b = (a * PI) / 180;
    return [cos(b) * (p[0] - x) - sin(b) * (p[1] - y), sin(b) * (p[0] - x) + cos(b) * (p[1] - y)];
  };
  const forth = ([u, v], [x, y, a]) => {
    const b = (a * PI) / 180;
    return [x + cos(b) * u + sin(b) * v, y - sin(b) * u + cos(b) * v];
  };
  make("path", { class: "fixed-centrode", d: path(fixed) || "M0,0" }, overlay);
  const moving = state && fixed.map((p, n) => p && forth(back(p, table[n].poses[link]), state.poses[link]));
  if (moving) make("path", { class: "moving-centrode", d: path(moving) || "M0,0" }, overlay);
}

/* --- free bodies -------------------------------------------------------------------------------------- */

/* Wrenches that a joint transmits, by its freedoms. */
function transmitted(basis) {
  const [a, b] = basis;
  if (b) return [[1, 2, 0].map((m, n) => times(a[m], b[3 - m - n]) - times(a[3 - m - n], b[m]))];
  const [x, y, w] = a;
  return w ? [[w, of(0), -x], [of(0), w, -y]] : [[of(0), of(0), of(1)], [y, -x, of(0)]];
}
/* The wrench of every joint on its second link, of every load, and the pull of every rope; null for what
   statics leaves open. Of any numbers; `open` where doubles do not tell whether ropes pull. */
function reactionsOf({ solved }) {
  const onBody = (v, body, by, on) => (live.body[by] === live.body[on] ? of(0) : live.body[on] === body ? v : live.body[by] === body ? -v : of(0));
  const added = (some) => some.reduce((sum, v) => sum + v, of(0));
  const columns = live.bonds.flatMap((_, k) => transmitted(solved.bases[k]).map((w) => [k, w]));
  const pulled = (k, body, m) =>
    added(live.ropes[k].parts.map(([a, b], n) => onBody(solved.courses[k][n][1 + m], body, b, a)));
  const loadsNow = live.loads.map((load, n) => {
    const amount = times(times(solved.loads[n][3], of(load.measure)), solved.values[n]);
    return [0, 1, 2].map((m) => times(solved.loads[n][m], amount));
  });
  const rows = [];
  const most = largest(loadsNow.flat()) || of(1);
  for (let body = 0; body < live.bodies; body++) {
    if (body === live.ground) continue;
    for (let m = 0; m < 3; m++) {
      const row = columns.map(([k, w]) => onBody(w[m], body, ...live.bonds[k]));
      const sum = added(loadsNow.map((w, n) => onBody(w[m], body, live.loads[n].against, live.loads[n].on)));
      const driven = added(live.screws.map(([by, on], k) => onBody(solved.thrusts[k][m], body, by, on)));
      rows.push([...row, ...live.ropes.map((_, k) => pulled(k, body, m)), over(sum + driven, most)]);
    }
  }
  live.ropes.forEach((rope, k) => {
    if (!rope.end) return;
    const [x, y] = solved.courses[k][rope.parts.length - 1].slice(4);
    const own = loadsNow.filter((_, n) => live.loads[n].on === rope.end);
    const pull = added(own.map((w) => times(w[1], x) - times(w[0], y)));
    rows.push([...columns.map(() => of(0)), ...live.ropes.map((_, n) => of(n === k ? -1 : 0)), over(pull, most)]);
  });
  const count = columns.length + live.ropes.length;
  const { basis, pivots, dropped } = nullSpace(rows, count + 1, 1e-12);
  const first = basis.reduce((best, v) => (!best || abs(v[count]) > abs(best[count]) ? v : best), null);
  if (!first || isNothing(first[count], of(1), 1e-9)) return { loads: loadsNow, most, joints: live.bonds.map(() => null), ropes: live.ropes.map(() => null), shares: true, open: true };
  const unit = first.map((v) => over(v, first[count]));
  const left = basis.filter((v) => v !== first).map((v) => v.map((x, k) => x - times(v[count], unit[k])));
  const isOpen = (n) => left.some((v) => !isNothing(v[n], of(1), 1e-9));
  const pulls = live.ropes.map((_, k) => [unit, ...left].map((v) => v[columns.length + k]));
  const ropes = live.ropes.map((_, k) => (isOpen(columns.length + k) ? null : times(unit[columns.length + k], most)));
  const least = leastShared(pulls, left.length);
  const shares = !(least < 0) || isNothing(least, of(1), 1e-11);
  const told = [least, ...pulls.flatMap(([pull, ...more]) => [pull, ...more.filter((v) => v)])];
  const open = dropped > 0 || [...pivots, ...told.map((v) => abs(v))].some((part) => part < SURE);
  const joints = live.bonds.map((_, k) => {
    const own = columns.map((c, n) => n).filter((n) => columns[n][0] === k);
    if (own.some(isOpen)) return null;
    const screw = live.screws.findIndex(([by, on]) => on === live.bonds[k][0] && by === live.bonds[k][1]);
    const thrust = screw < 0 ? [of(0), of(0), of(0)] : solved.thrusts[screw];
    return [0, 1, 2].map((m) => own.reduce((sum, n) => sum + times(times(unit[n], most), columns[n][1][m]), -thrust[m]));
  });
  return { loads: loadsNow, most, joints, ropes, shares, open };
}
/* What is open, so many numbers, can be such that none of the rows, a value and the shares in these, is less than
   zero where what is given is not: one number after the other is eliminated. Rows without a share are told by
   themselves. */
function leastShared(rows, count) {
  const nothing = (v) => isNothing(v, of(1), 1e-9);
  let left = rows.map((row) => row.map((v, k) => (k && nothing(v) ? of(0) : v))).filter((row) => row.some((v, k) => k && v));
  for (let k = count; k; k--) {
    const above = left.filter((row) => row[k] > 0), below = left.filter((row) => row[k] < 0);
    const between = above.flatMap((a) => below.map((b) => a.slice(0, k).map((v, n) => over(v, a[k]) - over(b[n], b[k]))));
    left = [...left.filter((row) => !row[k]), ...between];
  }
  return left.reduce((least, [value]) => (value < least ? value : least), Infinity);
}
/* What acts on a link: names, forces, couples about where they act. */
function actingOn(state, link) {
  const body = live.body[link];
  const { loads: loadsNow, joints, ropes } = reactionsOf(state);
  const found = [];
  const add = (name, w, at, sign, known, touches = false) => {
    const force = [sign * w[1], -sign * w[0]];
    const place = at && state.places[at] ? state.frame[live.points[at]] : null;
    const couple = sign * w[2] - (place ? place[0] * force[1] - place[1] * force[0] : 0);
    const size = dot(force, force);
    if (touches && place && size > 0) {
      // a rope pulls along its own line, not through the middle of its pulley
      const foot = [place[0] + (couple * force[1]) / size, place[1] - (couple * force[0]) / size];
      found.push({ name, force, couple: 0, at: inPicture(fromFrame(foot)), known });
      return;
    }
    found.push({ name, force, couple: (couple / live.frame[2]) * live.torque, at: place && state.places[at], known });
  };
  live.bonds.forEach(([a, b], k) => {
    if (live.body[a] !== body && live.body[b] !== body) return;
    const onSecond = live.body[b] === body;
    const [by, on] = onSecond ? [a, b] : [b, a];
    if (!joints[k]) found.push({ name: `F${by}${on}`, open: true });
    else add(`F${by.length + on.length === 2 ? by + on : `${by}-${on}`}`, joints[k], live.at[k], onSecond ? 1 : -1, false);
  });
  live.ropes.forEach(({ name, points, parts }, k) =>
    parts.forEach((pair, n) =>
      pair.forEach((one, end) => {
        if (live.body[one] !== body) return;
        if (ropes[k] === null) found.push({ name: `T ${name}`, open: true });
        else add(`T ${name}`, state.solved.courses[k][n].slice(1, 4).map((v) => v * ropes[k]), points[n + end], end ? -1 : 1, false, true);
      })));
  live.loads.forEach((load, n) => {
    if (live.body[load.on] === body) add(load.name, loadsNow[n], load.at, 1, true);
    if (live.body[load.against] === body && load.held) add(`−${load.name}`, loadsNow[n], load.to || load.at, -1, true);
  });
  return found;
}
/* The same of a page that is solved beforehand; null where it is not known. */
function solvedBefore(link) {
  const some = data.forces.links[link].pushes.filter((one) => one.u[row] !== null);
  return some.length ? some.map((one) => ({ ...one, at: [one.x[row], one.y[row]], force: [one.u[row], one.v[row]], couple: one.couple[row] })) : null;
}
/* What acts on a link, where, and its units; ``least`` is the couple that a unit of force has as rounding. */
function drawBody(link, acting, spots, [force, torque], least) {
  const svg = byId("body-figure");
  svg.textContent = "";
  const said = byId("body-said");
  if (!acting) {
    said.textContent = "No position here in which forces are known.";
    return;
  }
  const found = acting.filter((one) => one.open || hypot(...one.force) > 1e-9 || abs(one.couple) > 1e-3 * least);
  const forces = found.filter((one) => !one.open && hypot(...one.force) > 0);
  const most = max(...forces.map((one) => hypot(...one.force)), 1e-300);
  const real = forces.filter((one) => hypot(...one.force) > 1e-9 * most);
  if (!spots.length) {
    said.textContent = "No point of this link has a place of its own.";
    return;
  }
  const wheel = figure.querySelector(`[id="wheel-${CSS.escape(link)}"] circle`);
  const disc = wheel && [carried([link, ...["cx", "cy"].map((c) => Number(wheel.getAttribute(c)))], row), Number(wheel.getAttribute("r"))];
  const middle = (n) => (min(...spots.map((p) => p[n])) + max(...spots.map((p) => p[n]))) / 2;
  const reach = max(...spots.map((p) => max(abs(p[0] - middle(0)), abs(p[1] - middle(1)))), disc ? disc[1] : 1);
  const zoom = min(1, 60 / reach);
  const here = (p) => [170 + (p[0] - middle(0)) * zoom, 150 + (p[1] - middle(1)) * zoom];
  if (disc) {
    const [x, y] = here(disc[0]);
    make("circle", { class: "body", cx: f(x), cy: f(y), r: f(disc[1] * zoom) }, svg);
  }
  if (!disc || spots.length > 1) make("path", { class: "body", d: spots.length > 1 ? outlineOf(spots.map(here)) : `M154,140 h32 v20 h-32Z` }, svg);
  for (const one of real) {
    const [x, y] = here(one.at || spots[0]);
    const pin = one.touches && spots.reduce((best, p) => (apart(p, one.at) < apart(best, one.at) ? p : best));
    if (pin) make("circle", { class: "rim", cx: f(here(pin)[0]), cy: f(here(pin)[1]), r: f(apart(pin, one.at) * zoom) }, svg);
    const [u, v] = [(one.force[0] / most) * 62, (-one.force[1] / most) * 62];
    const pushes = (170 - x) * u + (150 - y) * v > 0; // drawn from outside, as on a body that is pressed
    const kind = one.known ? "f-load" : "f-joint";
    arrow(svg, kind, pushes ? [x - u, y - v] : [x, y], [u, v], pushes ? "" : one.name);
    if (pushes) nameAt(svg, kind, [x - u, y - v], [-u, -v], one.name);
  }
  const ends = [[0, 0]];
  for (const { force } of real) ends.push([ends[ends.length - 1][0] + force[0], ends[ends.length - 1][1] - force[1]]);
  const span = (n) => [min(...ends.map((p) => p[n])), max(...ends.map((p) => p[n]))];
  const [[left, right], [top, bottom]] = [span(0), span(1)];
  const scale = 170 / max(right - left, bottom - top, 1e-300);
  const put2 = (p) => [450 + (p[0] - (left + right) / 2) * scale, 150 + (p[1] - (top + bottom) / 2) * scale];
  real.forEach((one, n) => {
    const [a, b] = [put2(ends[n]), put2(ends[n + 1])];
    arrow(svg, one.known ? "f-load" : "f-joint", a, minus(b, a));
    const size = apart(a, b) || 1;
    const off = [((b[1] - a[1]) / size) * 14, ((a[0] - b[0]) / size) * 14];
    make("text", { x: f((a[0] + b[0]) / 2 + off[0]), y: f((a[1] + b[1]) / 2 + off[1] + 4), "text-anchor": "middle", "font-size": 12, class: one.known ? "f-load" : "f-joint" }, svg).textContent = one.name;
  });
  const toward = (one) => degreesWords((atan2(one.force[1], one.force[0]) * 180) / PI);
  const words = real.map((one) => `${one.name} = ${number(hypot(...one.force), 4)} ${force} at ${toward(one)}`);
  const couples = found.filter((one) => !one.open && abs(one.couple) > most * least);
  words.push(...couples.map((one) => `${one.at ? "couple of " : ""}${one.name} = ${number(one.couple, 4)} ${torque}`));
  words.push(...found.filter((one) => one.open).map((one) => `${one.name} is not determined by statics`));
  said.textContent = `${words.join("; ")}.`;
}
/* The equation of power of each motion in which one driver turns at 1 rad/s and the others are held. */
function tellMotions() {
  if (!live.drivers.length) return;
  const state = stateAt(row);
  const count = live.drivers.length;
  live.drivers.forEach((_, n) => (byId(`motion-${n}`).textContent = state ? equationOf(state.solved, n, count) : "No position here in which it is known."));
}
function equationOf({ motions, loads, power, values }, n, count) {
  const rates = live.drivers.map((link, k) => [...motions.twists[live.body[link]].map((t) => t[2]), k === n ? -1 : 0]);
  const { basis } = nullSpace(rates, count + 1, 1e-12);
  if (basis.length !== 1 || abs(basis[0][count]) < 1e-12) return "The drivers do not move apart from each other here.";
  const mix = basis[0].slice(0, count).map((v) => v / basis[0][count]);
  const fastest = largest(motions.twists.map((ts) => [0, 1, 2].map((m) => dot(mix, ts.map((t) => t[m])))).flat());
  const terms = live.loads.flatMap((load, k) => {
    const factor = dot(mix, power[k]);
    if (abs(factor) <= 1e-12 * fastest * abs(loads[k][3]) * largest(loads[k].slice(0, 3))) return [];
    const told = number(((factor * load.measure) / live.frame[2]) * live.torque, 6);
    const first = load.unknown ? load.name : number(values[k], 6);
    const bracketed = told.startsWith("−") ? `(${told})` : told;
    return [told === "1" ? first : `${first.startsWith("−") ? `(${first})` : first} × ${bracketed}`];
  });
  return terms.length ? `${terms.join(" + ")} = 0` : "In this motion no load does work.";
}
function see() {
  if (!overlay) return;
  const chosen = byId("see-body") ? byId("see-body").value : "";
  byId("body-panel").hidden = !chosen;
  if (live) tellMotions();
  overlay.textContent = "";
  const rotations = ticked("[data-rotation]");
  const curves = ticked("[data-curve]");
  const rolls = ticked("[data-centrode]");
  const velocities = byId("see-velocities") && byId("see-velocities").checked;
  const wanted = velocities || rotations.length || rolls.length || chosen;
  const state = wanted ? stateAt(row) : null;
  let said = wanted && !state ? "Nothing of this is known in this position." : "";
  for (const e of curves) drawCurve(e.dataset.curve);
  for (const e of rolls) drawCentrodes(state, e.dataset.centrode);
  if (state) for (const e of rotations) drawRotation(state, e.dataset.rotation);
  if (state && velocities) said = drawVelocities(state);
  if (byId("see-hint").textContent !== said) byId("see-hint").textContent = said;
  if (!chosen) return;
  if (live) drawBody(chosen, state && actingOn(state, chosen), state && spotsOf(state, chosen), live.units, (1e-9 / live.frame[2]) * live.torque);
  else drawBody(chosen, solvedBefore(chosen), state && spotsOf(state, chosen), data.forces.units, 0);
}
if (overlay) {
  byId("see").addEventListener("change", see);
  seeing = true;
  see();
}
