/* The live row: behind the presolved ones every column has one more, which the scene for the present numbers
   fills. */
const live = data.live || null;
const LIVE = rows;
const view = data.view;
const inPicture = ([x, y]) => [(x - view[1]) * view[0], (view[2] - y) * view[0]];
const inCase = ([x, y]) => [x / view[0] + view[1], view[2] - y / view[0]];
const fromFrame = ([x, y]) => [x / live.frame[2] + live.frame[0], y / live.frame[2] + live.frame[1]];
const numbers = live ? [...live.numbers] : [];
const lab = live ? figureOf(program, live, numbers) : null;
const scene = { status: "ok", words: "", changed: false, solved: null };
const handles = [];
const filled = (value) => Array(rows).fill(value);
const placeOf = (name) => inPicture(fromFrame(lab.points[live.points[name]]));
const turned = (u, v) => (atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]) * 180) / PI;
const wrenchOf = (load) => [load[1], -load[0]];
const written = {};

/* Which two points, or which guide, tell how a link lies. */
function poseOf(link) {
  const names = live.links[link];
  const from = own(links, link);
  const p = (from && names.find((n) => apart(written[n], from.from) < 0.2)) || names[0];
  const q = names.reduce((best, n) => (apart(written[n], written[p]) > apart(written[best], written[p]) ? n : best), p);
  return { p, q: apart(written[q], written[p]) > 0.5 ? q : null, guide: live.guides[link] };
}
const guideOf = (k, own) => [own[k][1], -own[k][0]];
if (live) {
  live.typed = () => null;
  lab.typed();
  scene.solved = scene.first = solvedScene(live, numbers, lab);
  for (const one of live.posed) scene.first.at = numbers[one.number];
  for (const name of Object.keys(live.points)) {
    written[name] = placeOf(name);
    if (!own(points, name)) points[name] = { x: filled(written[name][0]), y: filled(written[name][1]) };
  }
  live.poses = {};
  for (const link of Object.keys(live.links)) {
    if (link === live.frameLink || !live.links[link].length) continue;
    live.poses[link] = poseOf(link);
    const from = written[live.poses[link].p];
    if (!own(links, link)) links[link] = { from, a: filled(0), x: filled(from[0]), y: filled(from[1]) };
  }
  for (const load of Object.values(loads)) {
    load.way = load.way || filled(0);
    if (load.known !== undefined) load.values = filled(load.known);
    for (const place of [load.on, ...(load.span || [])])
      place.point = Object.keys(written).find((name) => apart(written[name], place.slice(1)) < 0.15);
  }
  for (const answer of live.posed.length ? [] : answers) answer.values[zero] = valueOf(answer.name, scene.first);
  resolve(false);
}
/* Of a structure the force of the first link of a joint on the second. */
function forceIn(name, solved) {
  const [by, on, where, before] = answers.find((answer) => answer.name === name).joint;
  const joins = ([a, b], n) => live.at[n] === where && (a === by ? b === on : a === on && b === by);
  const k = live.bonds.flatMap((bond, n) => (joins(bond, n) ? n : []))[before];
  const w = reactionsOf({ solved }).joints[k];
  const sign = w && live.bonds[k][0] === by ? 1 : -1;
  return w ? [sign * w[1], -sign * w[0]] : [NaN, NaN];
}
function valueOf(name, solved) {
  if (live.still) return hypot(...forceIn(name, solved));
  const asked = live.posed.find((one) => one.name === name);
  if (asked) return asked.turns && asked.range[0] === null ? ((solved.at % 360) + 360) % 360 : solved.at;
  const n = live.loads.findIndex((load) => load.name === name);
  if (n >= 0) return solved.values[n];
  const parts = ["x", "y"].map((axis) => solved.values[live.loads.findIndex((load) => load.name === `${name}.${axis}`)]);
  return hypot(...parts);
}
/* The sense of a load's value, in the words of the answer. */
function senseOf(name, solved) {
  const n = live.loads.findIndex((load) => load.name === name);
  const value = valueOf(name, solved);
  if (live.posed.length) return solved.stability || "";
  if (live.still) return value ? `at ${degreesWords((atan2(...forceIn(name, solved).reverse()) * 180) / PI)}` : "";
  if (value === 0) return "";
  if (n < 0) {
    const [x, y] = ["x", "y"].map((axis) => solved.values[live.loads.findIndex((load) => load.name === `${name}.${axis}`)]);
    return `at ${degreesWords((atan2(y, x) * 180) / PI)}`;
  }
  const load = live.loads[n];
  const wrench = solved.loads[n];
  const stands = load.on.startsWith("@");
  const turns = (yes) => (yes ? "counterclockwise" : "clockwise");
  if (load.kind === "Torque") return turns(value > 0 !== (load.cw || stands));
  if (load.kind === "TorsionSpring") return turns(value * wrench[3] > 0);
  if (load.kind === "Spring") return value * wrench[3] > 0 ? "pull" : "push";
  if (load.kind === "Force" && stands) return value > 0 ? "pull" : "push";
  if (load.kind === "Force" && load.toward) {
    const pulls = value > 0 !== load.away;
    if (load.held) return pulls ? "pull" : "push";
    if (pulls) return `toward ${load.toward}`;
  }
  const [x, y] = wrenchOf(wrench);
  return `at ${degreesWords((atan2(y, x) * 180) / PI + (value > 0 ? 0 : 180))}`;
}
function degreesWords(d) {
  return `${number(Number((((d % 360) + 360) % 360).toFixed(6)) % 360, 4)}°`;
}

/* Fill the live row from the scene; what has no answer leaves the places as they are. */
function fillPlaces() {
  for (const name of Object.keys(live.points)) {
    const now = placeOf(name);
    if (now.every(Number.isFinite)) [points[name].x[LIVE], points[name].y[LIVE]] = now;
  }
}
/* Place and angle of a link by where its points are. */
function poseIn(pose, place, ownNow) {
  const arm = (where) => [where(pose.q)[0] - where(pose.p)[0], where(pose.p)[1] - where(pose.q)[1]];
  if (pose.q) return [...place(pose.p), turned(arm((n) => written[n]), arm(place))];
  const turns = pose.guide !== undefined;
  return [...place(pose.p), turns ? turned(guideOf(pose.guide, scene.first.own), guideOf(pose.guide, ownNow)) : 0];
}
function fillLinks(ownNow) {
  for (const [link, pose] of entries(live.poses)) {
    const l = links[link];
    const now = poseIn(pose, placeOf, ownNow);
    if (now.every(Number.isFinite)) [l.x[LIVE], l.y[LIVE], l.a[LIVE]] = now;
  }
  for (const load of Object.values(loads))
    for (const place of [load.on, ...(load.span || [])]) if (place.point) place.now = placeOf(place.point);
}
function fillLoads(solved) {
  const [, , now] = lab.scene();
  live.loads.forEach(({ name, unknown }, n) => {
    const load = own(loads, name);
    const [u, v, couple] = solved ? solved.loads[n] : [];
    if (load && load.known !== undefined) load.values[LIVE] = now[n][4] * now[n][5];
    else if (load && load.values) load.values[LIVE] = !solved ? null : unknown ? solved.values[n] : load.torque ? couple : hypot(u, v);
    if (solved && load && !load.torque) load.way[LIVE] = turned(wrenchOf(scene.first.loads[n]), wrenchOf(solved.loads[n]));
  });
}
function centreOf(c, solved) {
  const pair = c.name.split("-");
  const bond = live.bonds.findIndex(([a, b, own]) => own && pair.includes(a) && pair.includes(b));
  if (bond >= 0) return solved.own[bond];
  const [a, b] = pair.map((link) => solved.twists[live.body[link]]);
  return a && b ? less(b, a) : null;
}
function fillCentres(solved) {
  const fast = solved ? largest(solved.twists.filter(Boolean).flat()) : 0;
  for (const c of centres) {
    const t = solved && centreOf(c, solved);
    [c.x[LIVE], c.y[LIVE]] = [null, null];
    if (!t || largest(t) <= 1e-11 * fast) continue;
    const reach = hypot(t[0], t[1]);
    if (abs(t[2]) * 1e7 <= reach) {
      const side = (t[1] < 0 || (t[1] === 0 && t[0] < 0) ? -2 : 2) * (INFINITE / reach);
      [c.x[LIVE], c.y[LIVE]] = [t[0] * side, -t[1] * side];
    } else [c.x[LIVE], c.y[LIVE]] = inPicture(fromFrame([t[0] / t[2], t[1] / t[2]]));
  }
}
function fillAnswers(solved) {
  for (const answer of answers) {
    answer.values[LIVE] = solved ? valueOf(answer.name, solved) : null;
    answer.word = solved ? senseOf(answer.name, solved) : "";
  }
  if (!data.terms) return;
  const root = live.loads.findIndex((load) => load.name === answers[0].name);
  data.terms.forEach((term) => {
    const n = live.loads.findIndex((load) => load.name === term.name);
    const exerts = (k) => (live.loads[k].kind === "Torque" ? 1 : solved.loads[k][3]);
    const share = solved && (solved.power[n][0] * live.loads[n].measure) / (solved.power[root][0] * live.loads[root].measure);
    const ratio = solved && (share * data.root.sign * exerts(root)) / (term.sign * exerts(n));
    term.size.v[LIVE] = solved ? exerts(n) * solved.values[n] : null;
    term.ratio.v[LIVE] = solved && Number.isFinite(ratio) ? ratio : null; // none where a change point has more motions
  });
}
/* The scene for the present numbers: as they are typed, or on from where it is. */
function resolve(dragged, toward, measured) {
  let solved = null;
  [scene.status, scene.words, scene.placed] = ["ok", "", false];
  let stability = "";
  const before = live.posed.map((one) => numbers[one.number]);
  try {
    if (live.posed.length) stability = restOf(live, numbers, lab);
    else if (dragged) lab.followed(measured, toward);
    else lab.typed();
    scene.placed = true;
    fillPlaces();
    fillLinks(ownOf(live, lab.scene()[3]));
    solved = solvedScene(live, numbers, lab);
    for (const one of live.posed) [solved.at, solved.stability] = [numbers[one.number], stability];
    scene.solved = solved;
  } catch (refusal) {
    refused(refusal);
    [scene.status, scene.words] = [refusal.status, refusal.words];
    live.posed.forEach((one, k) => { numbers[one.number] = before[k]; });
  }
  fillLoads(solved);
  fillCentres(solved);
  fillAnswers(solved);
}
