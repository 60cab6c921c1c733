/* A scene for any numbers: the figure by the construction of the case, its way of assembling by `near` or by
   continuity; motions from the loop equations; the unknown loads from the sums of power. As `icsolve solve`. */
const UNIT = 2 ** -53;
const NOISE = 2e-14;
const EVEN = 0.99;
const SIDEWAYS = 0.05;
const TOO_CLOSE = 1e-14;
const NEAR = 1e-6;
const SAME = 1e-11;
class Refusal {
  constructor(status, words = "", amount = Infinity) { Object.assign(this, { status, words, amount }); }
}
const refuse = (...why) => { throw new Refusal(...why); };
/* Nothing but a refusal is expected. */
const refused = (error) => { if (!(error instanceof Refusal)) throw error; };
const spread = (some) => hypot(...some.flat());
const apart = (p, q) => hypot(p[0] - q[0], p[1] - q[1]);
const largest = (some) => some.reduce((most, v) => (abs(v) <= most || most !== most ? most : abs(v)), of(0));
const powerOfTwo = (v) => (isFine(v) ? of(powerOfTwo(plainly(v))) : v > 0 && Number.isFinite(v) ? 2 ** (floor(Math.log2(v)) + 1) : 1);

/* All x with rows x = 0, by elimination with complete pivoting. */
function nullSpace(rows, columns, zero = 64 * UNIT, unit = 0) {
  const work = rows.map((row) => [...row]);
  const order = [...Array(columns).keys()];
  const limit = zero * max(work.length, 1);
  const pivots = [];
  let [rank, dropped, sign] = [0, 0, 1];
  while (rank < min(work.length, columns)) {
    let best = of(-1);
    let at = [rank, rank];
    for (let r = rank; r < work.length; r++)
      for (let c = rank; c < columns; c++)
        if (abs(work[r][c]) > best) [best, at] = [abs(work[r][c]), [r, c]];
    const first = pivots.length ? pivots[0] : largest([best, of(unit)]);
    if (!(best > 0) || isNothing(best, first, limit)) {
      dropped = best > 0 ? ratio(best, first) : 0;
      break;
    }
    pivots.push(best);
    [work[rank], work[at[0]]] = [work[at[0]], work[rank]];
    [order[rank], order[at[1]]] = [order[at[1]], order[rank]];
    for (const row of work) [row[rank], row[at[1]]] = [row[at[1]], row[rank]];
    const top = work[rank];
    if ((top[rank] < 0) !== ((at[0] !== rank) !== (at[1] !== rank))) sign = -sign;
    for (const row of work.slice(rank + 1)) {
      if (!row[rank]) continue;
      const part = over(row[rank], top[rank]);
      for (let k = rank + 1; k < columns; k++) row[k] -= times(part, top[k]);
      row[rank] = of(0);
    }
    rank += 1;
  }
  const basis = [];
  for (let free = rank; free < columns; free++) {
    const x = Array(columns).fill(of(0));
    x[free] = of(1);
    for (let r = rank - 1; r >= 0; r--) {
      let total = work[r][free];
      for (let k = r + 1; k < rank; k++) total += times(work[r][k], x[k]);
      x[r] = over(-total, work[r][r]);
    }
    const vector = Array(columns).fill(of(0));
    order.forEach((column, place) => (vector[column] = x[place]));
    basis.push(vector);
  }
  return { basis, rank, pivots: pivots.map((p) => ratio(p, pivots[0])), dropped, sign };
}

/* --- the figure -------------------------------------------------------------------------------------- */

/* Whether the first of two placements of some points is clearly the nearer to `near`. */
function nearer(one, two, near) {
  const away = (p, q) => spread(p.map((at, n) => [at[0] - q[n][0], at[1] - q[n][1]]));
  const [first, second, half] = [away(one, near), away(two, near), away(one, two) / 2];
  if (half === 0 || first < EVEN * second) return half > 0;
  return ((second - first) * (second + first)) / (4 * half) > SIDEWAYS * Math.sqrt((first * first + second * second) / 2);
}
const line = (path) => {
  const out = [];
  for (let at = path; at; at = at.before) out.unshift(at);
  return out;
};

/* What the program gives with accelerations of links in the sense that their speeds have now: it was written
   for that which they have in the case. (Those of points go as their points do.) */
function inTheSenseOfSpeeds(told, x, work) {
  const ofLinks = told.motion.filter((own) => own.acceleration !== undefined && own.point === undefined);
  const back = ofLinks.filter((own) => x[own.speed] < 0 !== own.back);
  const turn = () => back.forEach((own) => (x[own.acceleration] = -x[own.acceleration]));
  turn();
  const found = work();
  turn();
  return found;
}
/* What the rates of twists fulfil, and the wrenches of inertia forces by these, as a program on such arrays has them. */
const ratesOf = (told, x, t, r, { rates, inertia }) => ({
  rates: (twists) => (t.splice(0, t.length, ...twists), inTheSenseOfSpeeds(told, x, rates)),
  inertia: (changes) => (r.splice(0, r.length, ...changes), inertia()),
});
function figureOf(program, told, x) {
  const points = [];
  const s = [];
  const q = [];
  const [t, r, w] = [[], [], []];
  let typed = true;
  const own = program(DOUBLES, x, s, q, t, r, w);
  const { steps, scene, tied } = own;
  /* Where Newton's method stands with a point. */
  function stand(k, at) { [q[2 * k], q[2 * k + 1]] = at; }
  const near = new Map(entries(told.near).map(([k, at]) => [Number(k), at]));
  for (const step of told.steps) {
    if (step.sign !== undefined) s[step.p[0]] = step.sign;
    (step.start || []).forEach((at, n) => stand(step.p[n], at));
  }
  const size = () => {
    const own = Object.values(told.points).map((k) => points[k]).filter(Boolean);
    const span = (n) => max(...own.map((p) => p[n])) - min(...own.map((p) => p[n]));
    return max(span(0), span(1));
  };

  /* A step with the branch that `s` has: its places, and what else it gives. */
  function run(n) {
    const step = told.steps[n];
    const values = steps[n]();
    step.p.forEach((k, m) => (points[k] = [values[2 * m], values[2 * m + 1]]));
    let at = 2 * step.p.length;
    const take = (count) => values.slice(at, (at += count));
    const found = { apart: take(step.apart), gaps: take(step.gaps || 0) };
    found.loci = (step.loci || []).map(take);
    found.rest = values.slice(at);
    return found;
  }
  const sound = (n) => told.steps[n].p.every((k) => points[k].every(Number.isFinite));

  /* Newton's method from where `q` stands; whether it arrives. */
  function iterate(n) {
    const step = told.steps[n];
    const start = [...q];
    for (let round = 0; round < 60; round++) {
      const { rest } = run(n);
      if (!sound(n)) break;
      let move = step.p.map((k) => [points[k][0] - q[2 * k], points[k][1] - q[2 * k + 1]]);
      const longest = largest(move.flat());
      const share = min(1, 0.4 / (longest || 1));
      step.p.forEach((k, m) => {
        q[2 * k] += share * move[m][0];
        q[2 * k + 1] += share * move[m][1];
      });
      if (longest < 4e-15 || (longest < 1e-12 && round > 40)) return largest(rest) < 1e-9;
    }
    q.splice(0, q.length, ...start);
    return false;
  }

  /* What a step can be here: branches to try, or why there is none. */
  function options(n) {
    const step = told.steps[n];
    if (step.start) return newton(n);
    if (step.sign !== undefined) s[step.p[0]] = 1;
    const { apart: pairs, gaps, loci } = run(n);
    const name = plain(step.p[0]);
    if (pairs.some((d) => !(d > TOO_CLOSE * TOO_CLOSE)))
      return new Refusal("cannot-assemble", `${name} has no place: two points that give its direction coincide`);
    if (step.lines) {
      if (abs(gaps[0]) > 1e-14) return [null];
      const [p, r] = loci;
      const off = abs(p[2] * (r[1] - p[1]) - p[3] * (r[0] - p[0]));
      if (off <= 1e-12 * (1 + hypot(p[0], p[1]) + hypot(r[0], r[1])))
        return new Refusal("underdetermined", `${name} may lie anywhere on a line`, 0);
      return new Refusal("cannot-assemble", `two lines that are to meet at ${name} are parallel`, off);
    }
    if (step.sign === undefined) return sound(n) ? [null] : new Refusal("cannot-assemble", `${name} has no place`);
    const slack = 16 * UNIT * max(1, largest(gaps));
    if (step.round) {
      const [far, over, under] = gaps;
      const d = (over + under) / 2;
      if (d <= slack) {
        const other = abs(under - over) / 2;
        if (other <= 1e-12 * abs(far + d)) return new Refusal("underdetermined", `${name} may lie anywhere on a circle`, 0);
        return new Refusal("cannot-assemble", `${name}: two circles about one centre do not meet`, other);
      }
    }
    const least = min(...gaps);
    if (least < -slack) {
      const words = `the links do not meet at ${name}: they miss each other by ${measure(-least)}`;
      points[step.p[0]] = between(step, loci, gaps);
      return Object.assign(new Refusal("cannot-assemble", words, -least), { placed: true });
    }
    if (!(least > slack)) return [0];
    const wish = near.get(step.p[0]);
    if (!wish) return [1, -1];
    const one = points[step.p[0]];
    s[step.p[0]] = -1;
    run(n);
    return apart(one, wish) <= apart(points[step.p[0]], wish) ? [1, -1] : [-1, 1];
  }
  const plain = (k) => (Object.keys(told.points).find((name) => told.points[name] === k) || "a point").replace(/^@/, "");
  const measure = (length) => `${number(length / told.frame[2], 6)} ${told.unit}`;

  /* Where two loci that do not meet come closest. */
  function between(step, [p, r], gaps) {
    if (!step.round) {
      const along = (r[0] - p[0]) * p[2] + (r[1] - p[1]) * p[3];
      const [px, py] = [p[0] + along * p[2], p[1] + along * p[3]];
      const share = (1 + r[2] / (hypot(px - r[0], py - r[1]) || 1)) / 2;
      return [r[0] + (px - r[0]) * share, r[1] + (py - r[1]) * share];
    }
    const [a, b, d] = [p[2], r[2], hypot(r[0] - p[0], r[1] - p[1])];
    const along = gaps[0] < 0 ? (a + d - b) / 2 : gaps[1] < 0 ? (a + d + b) / 2 : -(a + b - d) / 2;
    return [p[0] + (along * (r[0] - p[0])) / (d || 1), p[1] + (along * (r[1] - p[1])) / (d || 1)];
  }
  function newton(n) {
    const step = told.steps[n];
    const last = [...q];
    const written = (k, m) => step.start[m];
    const found = [];
    const starts = [(k) => near.get(k), written, (k) => last.slice(2 * k, 2 * k + 2)];
    for (const start of starts) {
      step.p.forEach((k, m) => stand(k, start(k, m) || written(k, m)));
      if (!iterate(n)) continue;
      const places = step.p.map((k) => [...points[k]]);
      if (!found.some((one) => one.every((at, m) => apart(at, places[m]) < 1e-9))) found.push(places);
    }
    q.splice(0, q.length, ...last);
    const off = (one) => spread(one.map((at, m) => (near.has(step.p[m]) ? [apart(at, near.get(step.p[m]))] : [0])));
    found.sort((a, b) => off(a) - off(b));
    return found.length ? found : new Refusal("cannot-assemble", `the links do not meet at ${plain(step.p[0])}`);
  }
  function take(n, option) {
    const step = told.steps[n];
    if (step.start) step.p.forEach((k, m) => stand(k, option[m]));
    else if (step.sign !== undefined) s[step.p[0]] = option;
    return run(n);
  }

  /* Whether the points meet the data that made none of them; else the refusal. */
  function contradicted(list) {
    const whole = size();
    const placed = new Set(list.flatMap((n) => told.steps[n].p));
    for (const [kind, names, place] of told.checks) {
      if (!names.every((k) => placed.has(k))) continue;
      const [off, ahead] = residual(kind, names, place);
      const words = `more data than the figure needs, and these contradict each other at ${plain(names[0])}`;
      if (!ahead) return new Refusal("inconsistent", words);
      if (abs(off) <= 1e-10 * whole) continue;
      const most = min(0.002 * whole, allowance(kind, names, place, off));
      if (!(abs(off) <= most)) return new Refusal("inconsistent", `${words}: off by ${measure(abs(off))}`, abs(off));
    }
    return null;
  }
  function residual(kind, names, place) {
    const [p, o, v, w] = names.map((k) => points[k]);
    if (kind === "rope") return scene() && [tied()[place], true];
    const value = place === null ? 0 : x[place];
    const turned = (d) => [cos((d * PI) / 180), sin((d * PI) / 180)];
    if (kind === "length") return [apart(p, o) - value * told.frame[2], true];
    if (kind === "x" || kind === "y") {
      const n = kind === "x" ? 0 : 1;
      return [p[n] - (value - told.frame[n]) * told.frame[2], true];
    }
    if (kind === "mean") {
      const of = names.slice(1).map((k) => points[k]);
      const miss = [0, 1].map((n) => p[n] - of.reduce((sum, at) => sum + at[n], 0) / of.length);
      return [abs(miss[0]) > abs(miss[1]) ? miss[0] : miss[1], true];
    }
    if (kind === "line") {
      const d = apart(v, w);
      return d <= TOO_CLOSE ? [d, false] : [((w[0] - v[0]) * (p[1] - o[1]) - (w[1] - v[1]) * (p[0] - o[0])) / d, true];
    }
    const [c, t] = turned(value);
    if (kind === "guide") return [c * (p[1] - o[1]) - t * (p[0] - o[0]), true];
    if (kind === "ray") {
      const [dx, dy] = minus(o, p);
      return [c * dy - t * dx, c * dx + t * dy > TOO_CLOSE || hypot(dx, dy) <= TOO_CLOSE];
    }
    const [one, two] = [minus(p, o), minus(v, o)];
    const arms = [hypot(...one), hypot(...two)];
    /* An arm whose length is a datum may be so short that doubles tell no direction. */
    const isLength = (a) => told.checks.some(([k, ends]) => k === "length" && ends.includes(a) && ends.includes(names[1]));
    if (arms.some((arm, n) => arm <= NEAR && isLength(names[2 * n]))) return [0, true];
    if (min(...arms) <= TOO_CLOSE) return [max(...arms), false];
    const [tx, ty] = [c * one[0] - t * one[1], t * one[0] + c * one[1]];
    return [(tx * two[1] - ty * two[0]) / min(...arms), tx * two[0] + ty * two[1] > 0];
  }
  /* What half a unit of the last decimal of each number does to a residual, added up. */
  function allowance(kind, names, place, off) {
    let total = 0;
    told.halves.forEach((half, n) => {
      if (!half) return;
      const written = x[n];
      x[n] += half;
      told.steps.forEach((_, k) => run(k));
      total += abs(residual(kind, names, place)[0] - off) || 0;
      x[n] = written;
    });
    told.steps.forEach((_, k) => run(k));
    return total;
  }

  /* The least sum of squared distances from `near` that a shape on its own has wherever it is put. */
  function offOfShape(path) {
    let [count, ax, ay, bx, by, sizes, c, t] = [0, 0, 0, 0, 0, 0, 0, 0];
    for (let one = path; one; one = one.before) {
      const { p, shape, own } = told.steps[one.n];
      if (shape === told.steps[path.n].shape)
        p.forEach((k, m) => {
          const wish = near.get(own[m]);
          if (!wish) return;
          const [[x, y], [u, v]] = [one.places.get(k), wish];
          count += 1;
          [ax, ay, bx, by] = [ax + x, ay + y, bx + u, by + v];
          sizes += x * x + y * y + u * u + v * v;
          [c, t] = [c + x * u + y * v, t + x * v - y * u];
        });
    }
    if (!count) return 0;
    const middles = (ax * ax + ay * ay + bx * bx + by * by) / count;
    const fit = hypot(c - (ax * bx + ay * by) / count, t - (ax * by - ay * bx) / count);
    return sizes - middles - 2 * fit - count * sizes * 2 ** -50;
  }
  /* Every way of assembling that is not clearly farther from `near` than another. */
  function walk(list) {
    const modes = [];
    const ends = [];
    let best = Infinity;
    let budget = 20000;
    const longer = (before, n, off) => {
      const places = new Map(told.steps[n].p.map((k) => [k, points[k]]));
      let sum = off;
      for (const [k, at] of places) if (near.has(k)) sum += apart(at, near.get(k)) ** 2;
      const own = { before, n, places, off: sum, least: max(sum, before ? before.least : 0) };
      if (told.steps[n].shape) own.least = max(own.least, offOfShape(own));
      return own;
    };
    const beyond = (path) => best < EVEN * EVEN * path.least;
    const advance = (depth, path) => {
      if (--budget < 0) return;
      const n = list[depth];
      if (depth === list.length) {
        const miss = contradicted(list);
        if (miss) ends.push({ depth, miss, path });
        else {
          modes.push({ path, points: points.map((p) => [...p]), s: [...s], q: [...q] });
          best = min(best, path.off);
        }
        return;
      }
      const off = path ? path.off : 0;
      const some = options(n);
      if (some instanceof Refusal) {
        ends.push({ depth, miss: some, path: some.placed ? longer(path, n, off) : path });
        return;
      }
      const tried = some.map((option) => {
        const { rest } = take(n, option);
        const own = longer(path, n, off);
        const behind = told.steps[n].start ? [] : rest.filter((v) => !(v > TOO_CLOSE));
        if (!behind.length) return { option, own };
        const words = `the links meet at ${plain(told.steps[n].p[0])} only on the wrong side`;
        ends.push({ depth, miss: new Refusal("cannot-assemble", words, abs(behind[0])), path: own });
        return null;
      });
      const kept = tried.filter((one) => one && !beyond(one.own)).sort(
        (a, b) => a.own.least - b.own.least || a.own.off - b.own.off,
      );
      for (const { option, own } of kept) {
        if (beyond(own)) continue;
        take(n, option);
        advance(depth + 1, own);
      }
    };
    advance(0, null);
    return { modes: modes.filter((mode) => !beyond(mode.path)), ends, spent: budget < 0 || modes.length > 256 };
  }
  /* The places with a `near` of two ways, from where they part. */
  function parted(one, two) {
    const [ours, theirs] = [line(one), line(two)];
    let at = 0;
    while (at < min(ours.length, theirs.length) && ours[at] === theirs[at]) at += 1;
    const places = (paths) => new Map(paths.flatMap((path) => [...path.places]).filter(([k]) => near.has(k)));
    return [places(ours.slice(at)), places(theirs.slice(at))];
  }
  function clearly(one, other) {
    const [ours, theirs] = parted(one.path, other);
    const held = [...ours.keys()].filter((k) => theirs.has(k));
    return nearer(held.map((k) => ours.get(k)), held.map((k) => theirs.get(k)), held.map((k) => near.get(k)));
  }
  function chosen({ modes, ends, spent }) {
    if (spent) refuse("ambiguous", "the figure has too many open branches to try them all");
    if (!modes.length) {
      const first = ends.filter((end) => !clearly(ends[0], end.path));
      const worst = (first.length ? first : ends).sort((a, b) => b.depth - a.depth || a.miss.amount - b.miss.amount)[0];
      throw worst.miss;
    }
    modes.sort((a, b) => a.path.off - b.path.off);
    for (const end of ends)
      if (clearly(end, modes[0].path))
        refuse(end.miss.status, `what lies at near: does not assemble: ${end.miss.words}`, end.miss.amount);
    const names = Object.values(told.points);
    const differing = (a, b) => names.filter((k) => apart(a.points[k], b.points[k]) > SAME * (1 + hypot(...a.points[k])));
    const best = modes[0];
    const rivals = modes.filter((mode) => {
      const other = differing(best, mode);
      const held = other.filter((k) => near.has(k));
      return other.length && !nearer(held.map((k) => best.points[k]), held.map((k) => mode.points[k]), held.map((k) => near.get(k)));
    });
    if (rivals.length) {
      const k = differing(best, rivals[0])[0];
      refuse("ambiguous", `the figure assembles in several ways, of which nothing picks one, at ${plain(k)}`);
    }
    return best;
  }
  /* Newton's method in digits, from where doubles stand; where it goes slowly doubles do not tell where to. */
  function arrive({ p }, put, P, Q) {
    p.forEach((k) => points[k].forEach((v, m) => (Q[2 * k + m] = exactly(v))));
    for (let round = 0; round < 12; round++) {
      put();
      const move = largest(p.flatMap((k) => P[k].map((v, m) => v - Q[2 * k + m])));
      p.forEach((k) => P[k].forEach((v, m) => (Q[2 * k + m] = v)));
      if (isNothing(move, WHOLE)) return;
    }
    refuse("near-singular");
  }
  /* Two loci in digits: on the side that was taken, and where doubles had them touch on the one near which it is. */
  function meet(step, put, P, S) {
    const [k] = step.p;
    const at = 2 + step.apart;
    S[k] = 0n;
    const least = put().slice(at, at + step.gaps).reduce((a, b) => (a < b ? a : b));
    if (isNothing(least, WHOLE)) return;
    if (least < 0n) refuse("cannot-assemble", `the links do not meet at ${plain(k)}: they miss each other by ${measure(plainly(-least))}`, plainly(-least));
    const wish = near.get(k);
    if (!s[k] && !wish) refuse("near-singular");
    const off = [1, -1].map((side) => {
      S[k] = exactly(side);
      put();
      return wish && P[k].reduce((sum, v, m) => sum + times(v - exactly(wish[m]), v - exactly(wish[m])), 0n);
    });
    S[k] = exactly(s[k] || (off[0] <= off[1] ? 1 : -1));
    put();
  }
  const every = told.steps.map((_, n) => n);
  const needed = every.filter((n) => !told.steps[n].spare);
  function settle(list) {
    const mode = chosen(walk(list));
    s.splice(0, s.length, ...mode.s);
    q.splice(0, q.length, ...mode.q);
    every.forEach((n) => run(n));
    if (list !== every) for (const n of every.filter((k) => !list.includes(k))) for (const k of told.steps[n].p) points[k] = [NaN, NaN];
  }
  /* Of all numbers the one whose last digits part two loci the farthest, and its value then. */
  function parting(n) {
    const before = every.slice(0, n);
    const some = x.flatMap((written, k) => [1, -1].map((side) => {
      x[k] = written * (1 + 4 * side * UNIT);
      before.forEach(run);
      const found = [k, x[k], min(...run(n).gaps)];
      x[k] = written;
      return found;
    }));
    before.forEach(run);
    return some.reduce((best, one) => (one[2] > best[2] ? one : best));
  }
  /* Turns of torsion springs: as typed, or on from where they are. */
  const wind = (k) => told.wound[0] && scene()[6].forEach((one, n) => (w[n] = one[k]));
  return {
    points,
    scene,
    near,
    w,
    ...ratesOf(told, x, t, r, own),
    isTyped: () => typed,
    /* Branches, and where Newton's method stands. */
    state: () => [[...s], [...q], [...w]],
    adopt([branches, starts, turns]) {
      w.splice(0, w.length, ...turns);
      s.splice(0, s.length, ...branches);
      q.splice(0, q.length, ...starts);
    },
    /* As the case with these numbers is solved; points that nothing needs may be missing. */
    typed() {
      typed = true;
      try {
        settle(every);
      } catch (refusal) {
        if (!(refusal instanceof Refusal) || needed.length === every.length) throw refusal;
        settle(needed);
      }
      wind(1);
      wind(0);
    },
    /* Whether a half chord of two loci has lost digits, or a direction. */
    isRough: () => every.some((n) => {
      const { gaps, apart: squares } = run(n);
      const least = told.steps[n].sign === undefined ? 1 : abs(min(...gaps));
      return !(min(least, ...squares.map(Math.sqrt)) > ROUGH);
    }),
    /* The figure as it stands, of the numbers as written, in digits. */
    inDigits() {
      const X = x.map((v, n) => asWritten(v, v === told.numbers[n] ? told.exact[n] : null, told.typed(n)));
      const [S, Q, T, R, P] = [[], [], [], [], []];
      const made = program(DIGITS, X, S, Q, T, R, w.map(exactly));
      const put = (n) => {
        const values = made.steps[n]();
        told.steps[n].p.forEach((k, m) => (P[k] = [values[2 * m], values[2 * m + 1]]));
        return values;
      };
      told.steps.forEach((step, n) => {
        if (!step.p.every((k) => points[k].every(Number.isFinite))) return;
        if (step.start) arrive(step, () => put(n), P, Q);
        else if (step.sign === undefined) put(n);
        else meet(step, () => put(n), P, S);
      });
      return { points: P, scene: made.scene, numbers: X, ...ratesOf(told, X, T, R, made) };
    },
    /* The figure as rounding may have it where two loci all but touch: with a longer half of their chord, or
       with one where they were taken to touch, as long as a last digit of a number makes it; one such step a
       time, and at last as it is. */
    *shaken() {
      const again = () => every.forEach(run);
      for (const n of every) {
        const [k, { gaps }] = [told.steps[n].p[0], run(n)];
        const own = s[k];
        const left = (2 * UNIT * max(1, largest(gaps))) / abs(min(...gaps));
        if (told.steps[n].sign !== undefined && left > LEAST_TRUST) {
          const [number, value] = own ? [0, x[0]] : parting(n);
          const written = x[number];
          x[number] = value;
          for (s[k] of own ? [own + own * left] : [1, -1]) yield again();
          x[number] = written;
        }
        s[k] = own;
      }
      again();
    },
    /* From where it is: the same branches, Newton's method from the last places; a point of which `toward` has
       a place goes to the side on which that is. Numbers that a motion has measured are rounded. */
    followed(measured, toward = () => null) {
      typed = !measured;
      told.steps.forEach((step, n) => {
        if (step.start) {
          if (!iterate(n)) refuse("cannot-assemble", `the links do not meet at ${plain(step.p[0])}`);
          return;
        }
        const branch = s[step.p[0]];
        const some = options(n);
        if (some instanceof Refusal) {
          if (step.sign !== undefined) s[step.p[0]] = branch;
          if (!step.spare) throw some;
          for (const k of step.p) points[k] = [NaN, NaN];
          return;
        }
        const touching = step.sign !== undefined && some.length === 1;
        let side = branch || 1;
        const aim = step.sign !== undefined && !touching && toward(step.p[0]);
        if (aim) {
          const off = [1, -1].map((one) => (take(n, one), apart(points[step.p[0]], aim)));
          side = off[0] <= off[1] ? 1 : -1;
        }
        const { rest } = take(n, touching ? 0 : side);
        if (step.sign !== undefined) s[step.p[0]] = side;
        if (!step.spare && rest.some((v) => !(v > TOO_CLOSE)))
          refuse("cannot-assemble", `the links meet at ${plain(step.p[0])} only on the wrong side`);
      });
      const miss = contradicted(needed);
      if (miss) throw miss;
      wind(0);
    },
  };
}

/* --- motions and loads -------------------------------------------------------------------------------- */

const pairing = (w, t) => dot(w.slice(0, 3), t);
const less = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/* The twists of what stands for links: ends of ropes that loads pull, along their last parts; screws. */
function withEnds(told, twists, courses, threads, points) {
  const twistsOf = (link) => twists[told.body[link]];
  told.ropes.forEach((rope, k) => {
    if (!rope.end) return;
    const [x, y] = courses[k][courses[k].length - 1].slice(4);
    twists.push(twists[0].map((_, m) => {
      const speed = rope.parts.reduce((sum, [a, b], n) => {
        const w = courses[k][n].slice(1);
        return sum + pairing(w, twistsOf(a)[m]) - (b ? pairing(w, twistsOf(b)[m]) : of(0));
      }, of(0));
      return [-times(speed, y), times(speed, x), of(0)];
    }));
  });
  told.screws.forEach(([by, on, at], k) =>
    twists.push(twistsOf(on).map((t, m) => [of(0), of(0), dot(threads[k], velocity(less(t, twistsOf(by)[m]), points[at]))])));
}
/* For each body a twist per freedom. */
function motionsOf(told, [rows, paths, , , courses, threads], points) {
  let found = nullSpace(rows, told.columns, 64 * UNIT, 1);
  const last = found.pivots.length ? found.pivots[found.pivots.length - 1] : 1;
  const exact = found.basis.length > 0;
  if (!exact && told.inexact && last < 2e-3 && told.ropes.every((rope) => rope.end)) {
    const nearly = nullSpace(rows, told.columns, 2e-3 / found.pivots.length, 1);
    if (nearly.basis.length === 1) found = nearly;
  }
  const asked = told.given || told.loads.some((load) => load.unknown);
  if (!found.basis.length && !asked && last > LEAST_TRUST) {
    const twists = paths.map(() => []);
    withEnds(told, twists, courses, threads, points);
    return { twists, mobility: 0, redundant: 0, trust: last, open: last < SURE };
  }
  if (!found.basis.length) {
    if (told.given) refuse("contradictory-centres");
    refuse(last < 1e-6 ? "near-singular" : "structure");
  }
  const twists = paths.map((path) =>
    found.basis.map((rates) =>
      path.reduce((t, [k, ...own]) => own.map((v, m) => t[m] + times(rates[index(k)], v)), [of(0), of(0), of(0)])));
  const mobility = found.basis.length;
  withEnds(told, twists, courses, threads, points);
  const open = found.dropped > 0 || last < SURE;
  return { twists, mobility, redundant: max(mobility - told.freedoms, 0), trust: exact ? last : 1, open };
}

/* The unknown loads from the sums of power of all motions; `power` is that of a unit of each load. */
function balanceOf(told, loads, motions) {
  const unknown = told.loads.map((load, n) => n).filter((n) => told.loads[n].unknown);
  const place = new Map(unknown.map((n, k) => [told.loads[n].root, k]));
  const relative = told.loads.map(({ on, against }) =>
    motions.twists[told.body[on]].map((t, m) => less(t, motions.twists[told.body[against]][m])));
  const power = loads.map((load, n) => relative[n].map((t) => times(load[3], pairing(load, t))));
  const most = largest(loads.filter((_, n) => !place.has(told.loads[n].root)).map((load, n) => times(load[5], load[3])));
  const scale = over(of(1), powerOfTwo(most));
  const columns = unknown.length + 1;
  const rows = [...Array(motions.mobility).keys()].map((m) => {
    const sums = Array(columns).fill(of(0));
    const terms = Array(columns).fill(of(0));
    const fastest = largest(motions.twists.map((ts) => ts[m]).flat());
    loads.forEach((load, n) => {
      const { root, measure } = told.loads[n];
      const k = place.get(root);
      const amount = times(load[4], k !== undefined ? of(measure / told.loads[unknown[k]].measure) : times(times(load[5], scale), of(measure)));
      const own = k === undefined ? columns - 1 : k;
      sums[own] += times(amount, power[n][m]);
      terms[own] += times(times(abs(amount), abs(load[3])), times(abs(load[0]) + abs(load[1]) + abs(load[2]), fastest));
    });
    return { sums: sums.map((v, k) => (isNothing(v, terms[k]) ? of(0) : v)), parts: sums.map((v, k) => (terms[k] ? ratio(abs(v), terms[k]) : 1)) };
  });
  const trust = min(1, ...rows.flatMap(({ sums, parts }) => parts.filter((_, k) => sums[k] && k < unknown.length)));
  const plain = rows.map(({ sums }) => sums);
  const working = plain.filter((row) => row.some((v) => v));
  const idle = plain.length - working.length;
  const found = solved(working, idle, unknown.map((n) => told.loads[n]), scale);
  const open = found.open || rows.some(({ parts }) => parts.some((part) => part < SURE));
  return { ...found, idle, relative, power, trust, unknown, open };
}
function solved(working, idle, unknown, scale) {
  const count = unknown.length;
  if (working.length === 1 && count === 1) {
    const [factor, known] = working[0];
    if (!factor) return { verdict: "no value", culprit: 0 };
    return { verdict: "balanced", values: [over(over(-known, times(factor, scale)), of(unknown[0].measure))] };
  }
  const rows = working.map((row) => row.map((v) => over(v, powerOfTwo(largest(row)))));
  const free = nullSpace(rows.map((row) => row.slice(0, count)), count, 1e-13);
  const whole = nullSpace(rows, count + 1, 1e-13);
  const workless = max(0, unknown.findIndex((_, k) => rows.every((row) => !row[k])));
  if (whole.rank > free.rank)
    return { verdict: free.rank < count && rows.length <= count ? "no value" : "too few unknowns", culprit: workless };
  if (free.rank < count) return { verdict: count > rows.length + idle ? "too many unknowns" : "any value", culprit: workless };
  if (!whole.basis.length || !count) return { verdict: "balanced", values: Array(count).fill(of(0)) };
  const vector = whole.basis[0];
  const last = vector[count];
  if (isNothing(last, of(1))) refuse("near-singular");
  const most = largest(vector);
  const values = vector.slice(0, count).map((v, k) => (isNothing(v, most) ? of(0) : over(v, times(times(last, scale), of(unknown[k].measure)))));
  const open = [...free.pivots, ratio(abs(last), most), ...vector.map((v) => (v ? ratio(abs(v), most) : 1))].some((part) => part < SURE);
  return { verdict: "balanced", values, open };
}
/* Why power does not determine the unknown loads. */
function refuseUnbalanced(told, motions, found) {
  const count = found.unknown.length;
  if (found.verdict === "balanced" || !count) return;
  const active = motions.mobility - found.idle;
  if (motions.redundant && told.freedoms === count && count < motions.mobility) refuse("change-point");
  if (found.verdict.startsWith("too") || count > max(active, 1)) refuse("mobility");
  const load = told.loads[found.unknown[found.culprit]];
  const others = found.verdict === "no value";
  const fast = largest(motions.twists.flat(2));
  const rests = found.relative[found.unknown[found.culprit]].every((t) => t.every((v) => isNothing(v, fast)));
  if (load.on === load.against || !rests) refuse(others ? "no-value" : "any-value");
  refuse(others ? "dead-centre" : "any-value");
}
const velocity = (t, p) => [t[1] - times(t[2], p[1]), times(t[2], p[0]) - t[0]];
const dot = (a, b) => a.reduce((sum, v, k) => sum + times(v, b[k]), isFine(a[0]) ? 0n : 0);
const sizeOf = (v) => (isFine(v[0]) ? root(dot(v, v)) : hypot(...v));

/* Which of the motions is meant, and how fast: its coefficients, and those that stay open. */
function speedOf(told, x, motions, points) {
  const fast = largest(motions.twists.flat(2));
  const still = (...some) => some.every((v) => isNothing(v, fast));
  const twists = (link) => motions.twists[told.body[link]];
  const rows = told.motion.map((given) => {
    const own = twists(given.link);
    if (given.point === undefined) {
      const rates = own.map((t) => t[2]);
      if (still(...rates)) refuse("dead-centre", `link ${given.link} cannot drive in this position`);
      const speed = given.speed === undefined ? of(1) : x[given.speed];
      return [...rates, given.cw ? speed : -speed];
    }
    const speeds = own.map((t) => velocity(t, points[given.point]));
    if (still(...speeds.flat())) refuse("dead-centre", `the point to which link ${given.link}'s motion is given is at rest`);
    const target = times(-x[given.speed], of(told.frame[2]));
    if (given.angle === undefined) return [...speeds.map((v) => dot(v, rightward(longest(speeds), still))), target];
    const along = (fine ? DIGITS : DOUBLES).turn(x[given.angle]);
    if (own.length > 1) return [...speeds.map((v) => dot(v, along)), target];
    const [v] = speeds;
    const size = sizeOf(v);
    if (abs(times(v[0], along[1]) - times(v[1], along[0])) > times(size, of(sin(PI / 180))))
      refuse("inconsistent", `the point of link ${given.link} cannot move in the direction that the motion gives`);
    return [dot(v, along) > 0 ? size : -size, target];
  });
  if (!rows.length) rows.push(normal(told, twists, still));
  if (motions.mobility === 1) {
    const meant = over(-rows[0][1], rows[0][0]);
    const room = told.motion.map(({ half, point }) => of(half * (point === undefined ? 1 : told.frame[2])));
    rows.slice(1).forEach(([value, target], n) => {
      const allowed = room[n + 1] + times(abs(over(value, rows[0][0])), room[0]) + times(of(1e-12), abs(target));
      if (abs(times(value, meant) + target) > allowed)
        refuse("inconsistent", "the motions given contradict each other");
    });
    return { meant: [meant], open: [] };
  }
  const scaled = rows.map((row) => row.map((v) => over(v, powerOfTwo(largest(row)))));
  const found = nullSpace(scaled, motions.mobility + 1, 1e-12).basis;
  const first = found.find((v) => !isNothing(v[motions.mobility], of(1), 1e-9));
  if (!first) refuse("inconsistent", "the motions given contradict each other");
  const meant = first.slice(0, -1).map((v) => over(v, first[motions.mobility]));
  return { meant, open: found.filter((v) => v !== first).map((v) => meant.map((m, k) => v[k] - times(v[motions.mobility], m))) };
}
const longest = (some) => some.reduce((best, v) => (sizeOf(v) > sizeOf(best) ? v : best));
function rightward(v, still) {
  const size = (still(v[0]) ? v[1] > 0 : v[0] > 0) ? sizeOf(v) : -sizeOf(v);
  return v.map((part) => over(part, size));
}
/* Where no motion is given: the first link that turns does so at 1; where none turns, the first that moves. */
function normal(told, twists, still) {
  const turning = told.order.map((link) => twists(link).map((t) => t[2])).find((rates) => !still(...rates));
  if (turning) return [...turning, of(-1)];
  const moving = told.order.map((link) => twists(link).map((t) => [t[1], -t[0]])).find((speeds) => !still(...speeds.flat()));
  if (!moving) refuse("structure");
  return [...moving.map((v) => dot(v, rightward(longest(moving), still))), of(-told.frame[2])];
}
/* What two points or teeth must not be. */
function refuseMisfit(told, x, points) {
  for (const [a, b] of told.aims)
    if (points[a].every((p, n) => isNothing(points[b][n] - p, of(1) + abs(p)))) refuse("inconsistent", "two points that give a direction lie at one place");
  for (const [a, b, one, two, size, module, helix] of told.meshes) {
    const pitch = plainly(x[size]), slant = helix === null ? 1 : Math.cos((plainly(x[helix]) * Math.PI) / 180);
    const fit = (abs(plainly(x[one] + x[two])) * (module ? pitch : 1 / pitch)) / slant / 2;
    if (abs(apart(plainly(points[a]), plainly(points[b])) / told.frame[2] - fit) > 2e-3 * fit)
      refuse("inconsistent", "the teeth do not fit the distance of the pivots");
  }
  for (const [contact, radii, pairs] of told.held)
    if (pairs.every((pair) => rollingMargins(told, x, points, contact, radii, pair).some((margin) => margin < 0)))
      refuse("inconsistent", "the radii of two links that roll do not fit the figure");
}
/* Numbers of which none is negative where radii fit the centres of two links that roll; a straight one has none. */
function rollingMargins(told, x, points, contact, radii, pair) {
  const arms = pair.flatMap((k, n) => {
    const r = plainly(x[radii[n]]) * told.frame[2];
    return k === null || !r ? [] : [[minus(plainly(points[contact]), plainly(points[k])), r]];
  });
  const round = arms.map(([arm, r]) => (2 * told.offRadius * r * r) ** 2 - (dot(arm, arm) - r * r) ** 2);
  if (arms.length < 2) return round;
  const [[a, r], [b, s]] = arms;
  return [...round, (told.offRadius * (r * r + s * s)) ** 2 - (a[1] * b[0] - a[0] * b[1]) ** 2, -dot(a, b) * r * s];
}
/* The basis twist that tells a joint's own centre, or the direction of its guide. */
const ownOf = (told, bases) => bases.map((basis, k) => (told.bonds[k][2] ? basis[0] : basis[basis.length - 1]));
/* What each screw does on its nut: the wrench of the force along its axis whose work is that of the torques on it. */
const thrustsOf = (told, loads, values, threads, points) =>
  told.screws.map(([, , at, rotor], k) => {
    const turning = told.loads.reduce((sum, { on, measure }, n) => (on === rotor ? sum + times(times(loads[n][2], loads[n][3]), times(of(measure), values[n])) : sum), of(0));
    const [fx, fy] = threads[k].map((part) => times(part, turning)), [x, y] = points[at];
    return [-fy, fx, times(x, fy) - times(y, fx)];
  });
const LEAST_TRUST = 1e-11;
const LEAST_DIGITS = 1e-5;
/* What is a smaller part of its terms has lost digits; and so have the half chord of loci, and the direction of
   points, that miss by less. */
const SURE = 1e-4;
const ROUGH = 1e-6;
/* The twist of every body in the motion that is meant; in `twists` null where that leaves it open. */
function movedAs(told, x, motions, points) {
  if (!motions.mobility) return { meant: [], twists: motions.twists.map(() => null) };
  const speed = speedOf(told, x, motions, points);
  const mix = (by, ts) => [0, 1, 2].map((k) => dot(by, ts.map((t) => t[k])));
  const fast = largest(motions.twists.flat(2));
  const meant = motions.twists.map((ts) => mix(speed.meant, ts));
  const isOpen = (ts) => speed.open.some((by) => !isNothing(largest(mix(by, ts)), fast, 1e-9));
  return { meant, twists: motions.twists.map((ts, n) => (isOpen(ts) ? null : meant[n])) };
}
/* Whether a wheel has its radius still: its centre lies so far from where it touches. */
function rollsOn(told, x, { points }, [n, contact, centre]) {
  if (!x[n] !== !told.numbers[n]) return false;
  return rollingMargins(told, x, points, contact, [n], [centre]).every((margin) => margin >= 0);
}
/* The inertia forces of the given motion among the loads. */
function withInertia(told, x, figure, motions, { meant, twists }, loads) {
  if (told.rolls.some((wheel) => !rollsOn(told, x, figure, wheel))) refuse("unsupported");
  const starts = (own) => own.point !== undefined && own.acceleration !== undefined && !x[own.speed];
  if (told.motion.some(starts)) refuse("unsupported"); // the path of the point is told by its speed
  const count = 3 * told.bodies;
  const rows = figure.rates(meant.slice(0, told.bodies).flat()).map((row) => {
    const dense = Array(count + 1).fill(of(0));
    for (const [k, value] of row.map(([k, value]) => [index(k), value])) if (floor(k / 3) !== told.ground) dense[k] += value;
    return dense;
  });
  /* What speeds make, beside coefficients of 1. */
  const size = powerOfTwo(largest(rows.map((row) => row[count])));
  rows.forEach((row) => (row[count] = over(row[count], size)));
  const held = [0, 1, 2].map((n) => [...Array(count + 1).keys()].map((k) => of(k === 3 * told.ground + n ? 1 : 0)));
  const { basis } = nullSpace([...rows, ...held], count + 1, 1e-13);
  const first = basis.reduce((best, v) => (abs(v[count]) > abs(best ? best[count] : 0) ? v : best), null);
  if (!first || isNothing(first[count], largest(first), 1e-12)) refuse("change-point");
  const part = ratio(abs(first[count]), largest(first));
  /* Beside a change point places, speeds and accelerations lose digits each, beside a point's rest the last two. */
  const trust = motions.trust ** 3 * part ** 2;
  if (!fine && trust < LEAST_TRUST) refuse("near-singular");
  const unit = first.map((v) => over(v, first[count]));
  const open = basis.filter((v) => v !== first).map((v) => v.map((x, k) => x - times(v[count], unit[k])));
  const isOpen = (link) => open.some((v) => !isNothing(largest(v.slice(3 * told.body[link], 3 * told.body[link] + 3)), of(1), 1e-9));
  if (told.heavy.some((link) => !twists[told.body[link]] || isOpen(link))) refuse("mobility");
  const forces = figure.inertia(unit.slice(0, count).map((v) => times(v, size)));
  const own = told.loads.map((_, n) => n).filter((n) => told.loads[n].name.startsWith("inertia "));
  own.forEach((n, k) => { loads[n] = [...forces[k], loads[n][3], loads[n][4], of(1)]; });
  return trust < SURE;
}
/* A scene whose points are placed: of numbers as typed what doubles leave open is decided in digits. */
function solvedScene(told, x, figure) {
  if (!figure.isTyped() || told.inexact) return solvedAsFollowed(told, x, figure);
  let open = figure.isRough();
  try {
    const solved = open ? null : sceneAsPlaced(told, x, figure);
    if (solved && !solved.open) return solved;
  } catch (refusal) {
    open = refused(refusal);
  }
  refuseUnfit(told, x, figure);
  fine = true;
  let solved;
  try {
    const placed = figure.inDigits();
    refuseMisfit(told, placed.numbers, placed.points);
    const found = sceneOf(told, placed.numbers, placed);
    refuseSlack(told, found);
    solved = plainly(found);
  } finally {
    fine = false;
  }
  return solved;
}
/* Of numbers that a motion has measured: refused where what rounding leaves of the places gives other loads. */
function solvedAsFollowed(told, x, figure) {
  const solved = sceneAsPlaced(told, x, figure);
  const most = LEAST_DIGITS * largest(solved.values);
  let alike = true;
  for (const _ of figure.shaken())
    try {
      alike &&= sceneAsPlaced(told, x, figure).values.every((v, n) => abs(v - solved.values[n]) <= most);
    } catch (refusal) {
      alike = refused(refusal);
    }
  if (!alike) refuse("near-singular");
  return solved;
}
/* All of a scene whose points are placed: loads, and the twist of every body in the motion that is meant (null
   where that is left open). */
function sceneAsPlaced(told, x, figure) {
  refuseUnfit(told, x, figure);
  const solved = sceneOf(told, x, figure);
  return { ...solved, open: refuseSlack(told, solved) || solved.open };
}
/* What is refused before anything moves. */
function refuseUnfit(told, x, figure) {
  refuseMisfit(told, x, figure.points);
  const [, , , , courses] = figure.scene();
  if (courses.flat().some((part) => !(part[0] > 0)))
    refuse("inconsistent", "a rope has no straight part between two of its points");
  told.loads.forEach(({ kind, on }) => {
    const k = kind === "Weight" ? told.ropes.findIndex((rope) => rope.end === on) : -1;
    const last = k < 0 ? [0, -1] : courses[k][courses[k].length - 1].slice(4);
    if (abs(last[0]) > told.hangs || last[1] > 0)
      refuse("inconsistent", "a weight hangs from a part of a rope that does not hang");
  });
}
/* Whether doubles leave open if all ropes pull; refused where one does not. */
function refuseSlack(told, solved) {
  if (!told.ropes.length || !(told.loads.some((load) => load.unknown) || told.posed.length || !solved.motions.mobility)) return false;
  const { ropes, most, shares, open } = reactionsOf({ solved });
  if (!shares || ropes.some((pull) => pull !== null && pull < 0 && !isNothing(pull, most, 1e-11))) refuse("slack");
  return open;
}
function sceneOf(told, x, figure) {
  const parts = figure.scene();
  const [, , loads, bases, courses, threads] = parts;
  const motions = motionsOf(told, parts, figure.points);
  const moved = told.dynamic ? movedAs(told, x, motions, figure.points) : null;
  const hasten = moved && withInertia(told, x, figure, motions, moved, loads);
  const found = balanceOf(told, loads, motions);
  refuseUnbalanced(told, motions, found);
  if (!fine && min(motions.trust, found.trust) < LEAST_TRUST) refuse("near-singular");
  const { twists } = moved || movedAs(told, x, motions, figure.points);
  const asked = new Map(found.unknown.map((n, k) => [told.loads[n].root, found.values ? found.values[k] : of(0)]));
  const values = told.loads.map((load, n) => times(loads[n][4], asked.has(load.root) ? asked.get(load.root) : loads[n][5]));
  const thrusts = thrustsOf(told, loads, values, threads, figure.points);
  const open = motions.open || found.open || hasten;
  return { motions, twists, values, loads, bases, courses, thrusts, own: ownOf(told, bases), power: found.power, open };
}
