/* The mechanism with its present numbers moved: every body rigid, its place by Newton's method on the joints and
   the inputs, from one position to the next. What the numbers of the case then are is measured. */
const PLAIN = ["Pin", "Slide", "Slot", "Gears", "Belt"];
const mover = live && !live.posed.length && !live.still && live.kinds.every((kind) => PLAIN.includes(kind)) && live.measures ? { inputs: [], at: {} } : null;
const perp = ([x, y]) => [-y, x];
/* Whether an input is told by its angle: others by how far they go. */
const isTurned = (link) => live.turning.includes(link) || Boolean(motion && motion.verb === "turned" && motion.driver === link);

/* Bodies at rest: where the mechanism now is. */
function restHere() {
  if (!mover) return;
  mover.rest = lab.points.map((p) => [...p]);
  mover.numbers = [...numbers];
  mover.own = ownOf(live, lab.scene()[3]);
  mover.bodies = [...Array(live.bodies).keys()].filter((b) => b !== live.ground);
  mover.pose = Array(3 * mover.bodies.length).fill(0);
  mover.twists = scene.solved.motions.twists;
  mover.at = {};
  mover.ends = {};
  mover.turns = {};
  mover.w = [...lab.w];
  mover.of = new Map(entries(live.owner).map(([name, link]) => [live.points[name], live.body[link]]));
}
const slotOf = (body) => 3 * mover.bodies.indexOf(body);
/* A place of a body now, and how it goes with x, y and angle of the body. */
function carriedBy(body, p) {
  if (body === live.ground) return { at: p, arm: [0, 0] };
  const [x, y, a] = mover.pose.slice(slotOf(body), slotOf(body) + 3);
  const arm = [cos(a) * p[0] - sin(a) * p[1], sin(a) * p[0] + cos(a) * p[1]];
  return { at: [arm[0] + x, arm[1] + y], arm };
}
const angleOf = (body) => (body === live.ground ? 0 : mover.pose[slotOf(body) + 2]);
/* Conditions: [value, [place among the unknowns, derivative]...]. */
function conditions() {
  const found = [];
  const point = (body, { arm }, n, factor) =>
    body === live.ground ? [] : [[slotOf(body) + n, factor], [slotOf(body) + 2, factor * perp(arm)[n]]];
  const along = (body, place, u, factor) => [...point(body, place, 0, u[0] * factor), ...point(body, place, 1, u[1] * factor)];
  const angle = (body, factor) => (body === live.ground ? [] : [[slotOf(body) + 2, factor]]);
  live.bonds.forEach(([one, two], k) => {
    const [a, b] = [live.body[one], live.body[two]];
    const kind = live.kinds[k];
    if (kind === "Gears" || kind === "Belt") {
      const [p, q, c] = mover.meshes[k];
      found.push([q * (angleOf(a) - angleOf(c)) + p * (angleOf(b) - angleOf(c)), ...angle(a, q), ...angle(b, p), ...angle(c, -p - q)]);
      return;
    }
    const home = mover.rest[live.points[live.at[k]]];
    const [here, there] = [carriedBy(a, home), carriedBy(b, home)];
    const off = [here.at[0] - there.at[0], here.at[1] - there.at[1]];
    if (kind === "Pin") {
      for (const n of [0, 1]) found.push([off[n], ...point(a, here, n, 1), ...point(b, there, n, -1)]);
      return;
    }
    if (kind === "Slide") found.push([angleOf(a) - angleOf(b), ...angle(a, 1), ...angle(b, -1)]);
    const guide = carriedBy(b, perp(guideOf(k, mover.own))).arm;
    const across = b === live.ground ? perp(guideOf(k, mover.own)) : guide;
    found.push([dot(across, off), ...along(a, here, across, 1), ...along(b, there, across, -1), ...angle(b, dot(perp(across), off))]);
  });
  for (const link of mover.inputs) {
    const body = live.body[link];
    const target = own(mover.at, link) || 0;
    const [t] = mover.twists[body];
    if (isTurned(link)) found.push([angleOf(body) - (target * PI) / 180, ...angle(body, 1)]);
    else {
      const size = hypot(t[0], t[1]) || 1;
      const way = [t[1] / size, -t[0] / size];
      const sign = way[0] < -1e-9 || (abs(way[0]) <= 1e-9 && way[1] < 0) ? -1 : 1;
      const c = slotOf(body);
      found.push([sign * (way[0] * mover.pose[c] + way[1] * mover.pose[c + 1]) - target * live.frame[2], [c, sign * way[0]], [c + 1, sign * way[1]]]);
    }
  }
  return found;
}
/* Torsion springs turn with the bodies that they are between, from rest on. */
const windUp = () => live.wound.forEach(([a, b], n) => (lab.w[n] = mover.w[n] + ((angleOf(a) - angleOf(b)) * 180) / PI));
/* What the meshes keep: weights of both wheels, and the body that carries them. */
function meshesOf() {
  mover.meshes = live.bonds.map(([one, two], k) => {
    if (!live.pivots[k]) return null;
    const [a, b] = live.pivots[k].map((name) => mover.rest[live.points[name]]);
    const [x, y, w] = mover.own[k];
    const arm = minus(b, a);
    const q = dot([x - w * a[0], y - w * a[1]], arm) / (dot(arm, arm) || NaN);
    const pinned = (at) => live.bonds.flatMap((bond, n) => (live.kinds[n] === "Pin" && live.at[n] === at ? bond.slice(0, 2) : []));
    const carrier = pinned(live.pivots[k][0]).find((link) => link !== one && link !== two && pinned(live.pivots[k][1]).includes(link));
    return [w - q, q, live.body[carrier]];
  });
}
/* The derivatives of conditions. */
const rowsOf = (found) => found.map(([, ...parts]) => parts.reduce((row, [i, d]) => ((row[i] += d), row), Array(mover.pose.length).fill(0)));
/* How the bodies go with an input (unit by unit of its condition); null where that does not tell. */
function paceOf(input) {
  const count = mover.pose.length;
  const found = conditions();
  const own = found.length - mover.inputs.length + mover.inputs.indexOf(input);
  const rows = rowsOf(found).map((row, n) => [...row, n === own ? -1 : 0]);
  const [pace, more] = nullSpace(rows, count + 1, 1e-10).basis;
  return more || !pace || abs(pace[count]) < 1e-9 * largest(pace) ? null : pace.map((v) => v / pace[count]);
}
/* The velocity of a point of a link as the input grows. */
function pathOf({ link, point }) {
  const [pace, body] = [paceOf(mover.inputs[0]), live.body[link]];
  if (!pace || body === live.ground) return null;
  const [x, y, w] = pace.slice(slotOf(body));
  const turn = perp(carriedBy(body, mover.rest[point]).arm);
  return [x + w * turn[0], y + w * turn[1]];
}
/* Where the bodies carry a point. */
const carriedTo = (k) => mover.of.has(k) && carriedBy(mover.of.get(k), mover.rest[k]).at;
function arrive() {
  const count = mover.pose.length;
  for (let round = 0; round < 25; round++) {
    const found = conditions();
    const normal = [...Array(count)].map(() => Array(count + 1).fill(0));
    for (const [value, ...parts] of found)
      for (const [i, d] of parts) {
        for (const [j, e] of parts) normal[i][j] += d * e;
        normal[i][count] += d * value;
      }
    const { basis } = nullSpace(normal, count + 1, 1e-13);
    if (basis.length !== 1 || !(abs(basis[0][count]) > 1e-12)) return false;
    const step = basis[0].slice(0, count).map((v) => v / basis[0][count]);
    if (!step.every(Number.isFinite)) return false;
    step.forEach((v, n) => (mover.pose[n] += v));
    if (largest(step) < 1e-13) return largest(conditions().map(([value]) => value)) < 1e-9;
  }
  return largest(conditions().map(([value]) => value)) < 1e-9;
}
/* The sign of the determinant of the conditions, which changes at limits and change points alone; 0 where some of
   them repeat others. */
function senseHere() {
  const rows = rowsOf(conditions());
  return rows.length === mover.pose.length ? nullSpace(rows, rows.length, 0).sign : 0;
}
const plus = (one, other, factor) => one.map((v, k) => v + (other[k] || 0) * factor);
/* The numbers of the case with inputs turned (or moved) so far from rest; null where the links do not meet, and
   where they stand in a change point, which `passes`. Steps along the tangent are halved until what Newton's method
   adds is small beside them, and no sign changes: else it is another branch. No step is small enough at a limit and
   at a change point; through the latter it goes straight on, and beyond it the tangent is as before. */
function numbersMoved(targets) {
  meshesOf();
  const [from, first] = [{ ...mover.at }, mover.pose];
  const ways = entries(targets).map(([link, v]) => [link, v - (own(from, link) || 0), isTurned(link) ? PI / 180 : live.frame[2]]);
  const steps = max(1, Math.ceil(max(...ways.map(([, v, unit]) => abs(v * unit))) / 0.02));
  const along = () =>
    ways.reduce((sum, [link, v, unit]) => plus(sum, paceOf(link) || [], (v * unit) / steps), first.map(() => 0));
  const off = (one, other) => hypot(...plus(one, other, -1));
  let [pose, done, tangent, size, sense] = [first, 0, null, 1, senseHere()];
  const stepTo = (n, share) => {
    tangent ||= along();
    const ahead = plus(pose, tangent, n - done);
    mover.pose = [...ahead];
    for (const [link, v] of ways) mover.at[link] = (own(from, link) || 0) + (v * n) / steps;
    return arrive() && off(mover.pose, ahead) <= share * (off(pose, ahead) || Infinity);
  };
  const passes = (n) => stepTo(n, 1) && off(along(), tangent) <= 0.5 * (hypot(...tangent) || Infinity);
  while (done < steps) {
    let n = min(done + size, steps);
    let arrived = stepTo(n, 0.25) && senseHere() * sense >= 0;
    if (!arrived && size > 2 ** -16) {
      size /= 2;
      continue;
    }
    for (let k = 1; !arrived && k < 4 && floor(done) + k <= steps; k++) arrived = passes((n = floor(done) + k));
    if (!arrived) {
      mover.passes = n === steps && passes(n + 1);
      mover.stop = (own(from, ways[0][0]) || 0) + (ways[0][1] * done) / steps;
      [mover.at, mover.pose] = [from, first];
      return null;
    }
    [pose, done, tangent, size, sense] = [mover.pose, n, null, min(1, 2 * size), senseHere()];
  }
  return measured();
}
/* An input turned; beyond a limit the other way round, as a sweep goes, where a whole turn changes nothing. What is
   reached straight from rest is that, also for one who comes from the other side. */
function turnedTo(link, degrees) {
  const whole = isTurned(link) && !live.wound.length && !live.pivots.some(Boolean);
  mover.passes = false;
  for (const to of whole ? [degrees, degrees - 360 * Math.sign(degrees)] : [degrees]) {
    const [low, high] = own(mover.ends, link) || [-Infinity, Infinity];
    const some = to < low || to > high ? null : numbersMoved({ [link]: to });
    if (some || mover.passes) return some;
    const stop = mover.stop;
    if (mover.inputs.length === 1 && low <= to && to <= high) mover.ends[link] = to > stop ? [low, stop] : [stop, high];
  }
  return null;
}
function measured() {
  const some = [...mover.numbers];
  const now = (k) => carriedTo(k) || mover.rest[k];
  const change = (p, q) => turned([mover.rest[q][0] - mover.rest[p][0], mover.rest[q][1] - mover.rest[p][1]], [now(q)[0] - now(p)[0], now(q)[1] - now(p)[1]]);
  const put = (n, value) => { if (abs(value - some[n]) > 1e-9 * max(1, abs(some[n]))) some[n] = value; };
  for (const [kind, n, ...what] of live.measures) {
    if (kind === "x" || kind === "y") put(n, fromFrame(now(what[0]))[kind === "x" ? 0 : 1]);
    else if (kind === "length") put(n, apart(now(what[0]), now(what[1])) / live.frame[2]);
    else if (kind === "ray") put(n, some[n] + change(what[0], what[1]));
    else if (kind === "corner") put(n, some[n] + change(what[1], what[2]) - change(what[1], what[0]));
    else put(n, some[n] + (angleOf(live.body[what[0]]) * 180) / PI);
  }
  const { pose } = mover;
  for (const given of mover.inputs.length > 1 ? [] : live.motion.filter((own) => own.angle !== undefined)) {
    mover.pose = pose.map(() => 0);
    const before = pathOf(given);
    mover.pose = pose;
    const after = before && pathOf(given);
    if (after) put(given.angle, some[given.angle] + turned(before, after));
  }
  return some;
}
/* Inputs: one a freedom, the one that is chosen first, and those whose rates are not tied to it. */
function chooseInputs(first) {
  const { twists } = mover;
  const mobility = twists[0].length;
  const wish = [first, ...live.turning, ...Object.keys(live.links)].filter((link) => link && live.body[link] !== live.ground);
  const chosen = [];
  const rows = [];
  for (const link of wish) {
    const ts = twists[live.body[link]];
    const row = isTurned(link) ? ts.map((t) => t[2]) : ts.map((t) => t[1] + 0.618 * t[0]);
    if (chosen.length < mobility && nullSpace([...rows, row], mobility, 1e-9, largest(twists.flat(2))).rank === rows.length + 1) {
      rows.push(row);
      chosen.push(link);
    }
  }
  mover.inputs = chosen;
}
