/* Positions of equilibrium: from where the mechanism is to the nearest value of the datum that is asked for at
   which the loads do no work in the motion that the joints allow, and no rope would have to push. */
const SCANNED = 72;
const FEWER = 256;
/* The power of all loads at a value, over the size of the twists, in the sense of those before. */
function powerAt(told, x, figure, value, before) {
  x[told.posed[0].number] = value;
  if (before) figure.adopt(before.state);
  figure.followed(true);
  const parts = figure.scene();
  const motions = motionsOf(told, parts, figure.points);
  if (motions.mobility !== 1) refuse(motions.redundant ? "change-point" : "mobility");
  const { power } = balanceOf(told, parts[2], motions);
  const own = power.map(([one], n) => one * parts[2][n][4] * parts[2][n][5] * told.loads[n].measure);
  const twist = motions.twists.flat(2);
  const size = hypot(...twist) * (before && dot(twist, before.twist) < 0 ? -1 : 1);
  const terms = power.reduce((sum, _, n) => sum + abs(parts[2][n][3] * parts[2][n][5] * told.loads[n].measure) * largest(parts[2][n].slice(0, 3)), 0);
  const points = figure.points.map((p) => [...p]);
  return { value, power: own.reduce((sum, v) => sum + v, 0) / size, terms, twist: twist.map((v) => v / size), state: figure.state(), points };
}
function restOf(told, x, figure) {
  const [{ range, turns, number: n }] = told.posed;
  const [low, high] = range.map((end, k) => (end === null ? (k ? Infinity : -Infinity) : end));
  const pace = high - low < Infinity ? min((high - low) / SCANNED, turns ? 2.5 : Infinity) : turns ? 2.5 : 0.02 / told.frame[2];
  const at = (value, before) => {
    try {
      return powerAt(told, x, figure, value, before);
    } catch (refusal) {
      refused(refusal);
      return null;
    }
  };
  const first = min(max(x[n], low), high);
  let start = at(first, null);
  for (let k = 1; !start && k <= SCANNED; k++)
    for (const value of [first + k * pace, first - k * pace]) if (!start && value >= low && value <= high) start = at(value, null);
  start = start || powerAt(told, x, figure, first, null);
  const sides = [1, -1].map((way) => ({ way, last: start, pace, going: true }));
  let [moving, slack] = [false, false];
  for (let k = 0; k < 3 * SCANNED && sides.some((side) => side.going); k++)
    for (const side of sides) {
      if (!side.going) continue;
      const value = min(max(side.last.value + side.way * side.pace, low), high);
      const next = value === side.last.value ? null : at(value, side.last);
      if (!next) {
        side.pace /= 2;
        side.going = value !== side.last.value && side.pace > pace / FEWER;
        continue;
      }
      moving = moving || abs(next.power) > 1e-12 * next.terms;
      if (next.power > 0 !== side.last.power > 0) {
        const found = zeroBetween(at, side.last, next, 1e-3);
        const stability = found && restAt(told, x, figure, found, [side.last, next], at, 1e-3 * pace);
        if (found && isTaut(told, x, figure)) return stability;
        slack ||= Boolean(found);
      }
      side.last = next;
      if (abs(next.value - start.value) >= (turns ? 180 : SCANNED * pace)) side.going = false;
    }
  refuse(slack ? "slack" : moving ? "no-value" : "any-value");
}
/* Whether no rope would have to push where the figure stands. */
function isTaut(told, x, figure) {
  try {
    if (told.ropes.length) sceneAsPlaced(told, x, figure);
  } catch (refusal) {
    refused(refusal);
    return refusal.status !== "slack";
  }
  return true;
}
/* Where the power vanishes between two values, by false position and halving; null where it jumps there. */
function zeroBetween(at, a, b, jump) {
  const most = min(abs(a.power), abs(b.power));
  let [p, q] = [a, b];
  for (let k = 0; k < 120 && p.power && q.power && abs(q.value - p.value) > 2e-16 * max(abs(p.value), abs(q.value)); k++) {
    const share = k % 3 === 2 ? 0.5 : p.power / (p.power - q.power);
    const middle = at(p.value + share * (q.value - p.value), p);
    if (!middle) return null;
    if (middle.value === p.value || middle.value === q.value) break;
    if (middle.power > 0 === p.power > 0) p = middle;
    else q = middle;
    if (middle.power === 0) break;
  }
  const found = abs(p.power) < abs(q.power) ? p : q;
  return abs(found.power) <= jump * most || most <= 1e-10 * found.terms ? found : null;
}
/* The position: stable where the loads push back. With the datum the points go as the motion takes them. */
function restAt(told, x, figure, found, [one, two], at, little) {
  const [below, above] = [-1, 1].map((way) => at(found.value + way * little, found));
  powerAt(told, x, figure, found.value, found);
  if (below && above) {
    const ways = entries(told.owner).map(([name, link]) => {
      const [k, first] = [told.points[name], 3 * told.body[link]];
      return [velocity(found.twist.slice(first, first + 3), found.points[k]), [0, 1].map((m) => above.points[k][m] - below.points[k][m])];
    }).filter(([, change]) => change.every(Number.isFinite));
    const [v, change] = [ways.flatMap(([v]) => v), ways.flatMap(([, change]) => change)];
    const pace = dot(v, change) / dot(v, v);
    if (hypot(...change.map((c, k) => c - pace * v[k])) > 1e-4 * hypot(...change)) refuse("unsupported", `${told.posed[0].name} does not pose the figure`);
    [one, two] = pace > 0 ? [below, above] : [above, below];
  } else if (one.value > two.value) [one, two] = [two, one];
  const pushed = two.power - one.power;
  return abs(pushed) > 1e-9 * found.terms * (below ? little * told.frame[2] : 1) ? (pushed < 0 ? "stable" : "unstable") : "neutral";
}
