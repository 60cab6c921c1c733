/* Fields of the numbers, handles of the points, and the case written with the numbers as they are. */
const fieldOf = (n) => byId(`number-${live.paths[n].replaceAll(" ", "-")}`);
const liveHint = byId("live-hint");
const halfOf = (text) => {
  const [digits, power] = text.toLowerCase().split("e");
  return 0.5 * 10 ** (Number(power || 0) - (digits.split(".")[1] || "").length);
};
/* The number that a text is; null where it is none, or one that cannot be there. */
function numberIn(text, bound) {
  const plain = text.trim().replace("−", "-").replace(/^(-?\d*),(\d+)$/, "$1.$2");
  const value = plain === "" ? NaN : Number(plain);
  if (!Number.isFinite(value)) return null;
  if (!live.bounds[bound].every(([than, limit]) => keeps[than](value, limit))) return null;
  return { value, half: halfOf(plain) };
}
const keeps = {
  ">": (value, limit) => value > limit,
  ">=": (value, limit) => value >= limit,
  "<": (value, limit) => value < limit,
  whole: (value, other) => Number.isInteger(value) && value !== other,
};
/* Back to the positions that were solved beforehand. */
function leave() {
  if (!live || !scene.changed) return;
  scene.changed = false;
  byId("mechanism").classList.remove("stale");
  writtenNumbers();
  lab.typed();
  scene.solved = scene.first;
  rested();
  fit([]);
}
function writtenNumbers() {
  live.numbers.forEach((value, n) => enter(n, value, live.firstHalves[n], live.texts[n]));
  for (const [k, at] of entries(live.near)) lab.near.set(Number(k), [...at]);
  liveHint.textContent = "";
}
function enter(n, value, half, text) {
  numbers[n] = value;
  live.halves[n] = half;
  const field = fieldOf(n);
  if (!field) return;
  field.value = text;
  field.removeAttribute("aria-invalid");
}
function changed(dragged, driven, toward, measured) {
  if (playing && !driven) stop();
  scene.changed = true;
  resolve(dragged, toward, measured);
  row = LIVE;
  if (hint) hint.textContent = "";
  const words = data.statuses[scene.status] || "";
  liveHint.textContent = scene.status === "ok" ? "" : `No answer (${scene.status}): ${scene.words ? scene.words + "." : words}`;
  if (!driven) rested();
  byId("mechanism").classList.toggle("stale", scene.status !== "ok" && !scene.placed);
  if (!dragged || driven) fitNow(driven ? [[LEFT + 12, TOP + 12], [RIGHT - 12, BOTTOM - 12]] : []);
  render();
  placeHandles();
}
const fitNow = (kept = []) =>
  row === LIVE ? fit(Object.keys(live.points).map((name) => [points[name].x[row], points[name].y[row]]), [...arrows(row), ...kept]) : fit([]);
/* From here the sliders count. */
function rested() {
  for (const e of all('[id^="turn"]')) e.value = "0";
  if (!mover) {
    if (hint) hint.textContent = "The slider turns the mechanism as it is written.";
  } else if (scene.placed && scene.solved) {
    restHere();
    chooseInputs(live.input);
  }
}
/* An input turned, with the other numbers as they are. */
function drive(degrees, link = live.input) {
  const some = turnedTo(link, degrees);
  if (!some && !mover.passes) {
    if (hint) hint.textContent = `The links do not meet beyond ${number((own(mover.at, link) || 0) - (own(mover.turns, link) || 0), 4)}.`;
    return;
  }
  if (some) {
    mover.turns[link] = mover.at[link] - degrees;
    enterAll(some);
    windUp();
  }
  changed(true, true, some ? carriedTo : () => refuse("change-point"), isMeasured());
  const input = link === live.input ? slider : byId(`turn-${link}`);
  if (input) input.value = degrees;
  if (link === live.input && byId("angle")) byId("angle").textContent = `${number(abs(degrees), 5)}${motion ? motion.unit : "°"} ${motion ? motion.senses[degrees >= 0 ? 0 : 1] : ""}`;
}
/* Whether more numbers than there are inputs have followed, which are rounded each; a motion's direction is none. */
const isMeasured = () => numbers.filter((v, n) => v !== mover.numbers[n] && !live.paths[n].startsWith("motion.")).length > mover.inputs.length;
function enterAll(some) {
  some.forEach((value, n) => {
    if (value === numbers[n]) return;
    const shown = Number(value.toPrecision(10));
    enter(n, shown, halfOf(String(shown)), String(shown));
  });
}
/* The choice of the input, and a slider for every other freedom. */
function inputs() {
  const room = byId("inputs");
  if (!mover || !room) return;
  const label = (text, e) => {
    const own = document.createElement("label");
    own.append(text, " ", e);
    room.append(own);
  };
  if (motion.verb === "turned" && live.turning.length > 1) {
    const select = document.createElement("select");
    select.id = "input";
    for (const link of live.turning) select.append(new Option(link, link, false, link === live.input));
    select.addEventListener("change", () => {
      live.input = select.value;
      document.querySelector(".turn label").textContent = `Link ${live.input} turned:`;
      changed(true, false, null, !lab.isTyped());
    });
    label("Input: link", select);
  }
  for (const link of mover.inputs.slice(1)) {
    const range = document.createElement("input");
    Object.assign(range, { type: "range", id: `turn-${link}`, min: -180, max: 180, step: 1, value: 0 });
    range.addEventListener("input", () => drive(Number(range.value), link));
    label(`Link ${link} turned`, range);
  }
}
/* The fields tell the position that the turn shows, where numbers of the case can. */
function follow(r) {
  const some = numbersAt(r);
  if (!some) return;
  if (r === zero) live.numbers.forEach((value, n) => enter(n, value, live.firstHalves[n], live.texts[n]));
  else {
    enterAll(some);
    if (mover) windUp();
  }
  try {
    if (r === zero) lab.typed();
    else lab.followed(true, mover ? carriedTo : undefined);
  } catch (refusal) {
    refused(refusal);
  }
}
const tidy = (value, unit) => Number((Math.round(value / unit) * unit).toFixed(max(0, -floor(Math.log10(unit)))));

/* --- handles ------------------------------------------------------------------------------------------ */

function placeHandles() {
  for (const h of handles) {
    const p = points[h.name];
    const x = p.x[row] === undefined ? p.x[zero] : p.x[row];
    const y = p.y[row] === undefined ? p.y[zero] : p.y[row];
    set(h.e, "transform", `translate(${f(x)} ${f(y)})`);
  }
}
/* A point pulled to a place (case units): the numbers that place it follow. */
function pull(h, to) {
  const base = (k) => fromFrame(lab.points[live.points[k]]);
  const step = 10 ** floor(Math.log10(1 / view[0]));
  for (const [kind, n, from, sense] of h.moves) {
    let [value, unit] = [0, step];
    if (kind === "x" || kind === "y") value = to[kind === "x" ? 0 : 1];
    else if (kind === "span") value = apart(base(from), to);
    else {
      const centre = base(from);
      const now = fromFrame(lab.points[live.points[h.name]]);
      const arm = (p) => minus(p, centre);
      [value, unit] = [numbers[n] + sense * turned(arm(now), arm(to)), 0.1];
    }
    const shown = tidy(value, unit);
    if (Number.isFinite(shown) && !(kind === "span" && shown <= 0)) enter(n, shown, unit / 2, String(shown));
  }
  const spans = h.moves.some(([kind]) => kind === "span");
  changed(true, false, (k) => spans && k === live.points[h.name] && to.map((v, m) => (v - live.frame[m]) * live.frame[2]));
}
function grip(name, moves) {
  const e = make("circle", { id: `handle-${name}`, class: "handle", r: 11, tabindex: 0, role: "button" }, byId("handles"));
  set(e, "aria-label", `Point ${name}: drag it, or move it with the arrow keys`);
  make("title", {}, e).textContent = `drag ${name}`;
  const h = { name, moves, e };
  const place = (event) => {
    const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(figure.getScreenCTM().inverse());
    return inCase([p.x, p.y]);
  };
  let held = null;
  const follow = (event) => {
    if (!held) return;
    const at = place(event);
    if (apart(at, held.last) === 0) return;
    held.last = at;
    pull(h, [at[0] - held.off[0], at[1] - held.off[1]]);
  };
  e.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    const at = place(event);
    const own = fromFrame(lab.points[live.points[name]]);
    held = { last: at, off: minus(at, own) };
    e.setPointerCapture(event.pointerId);
    event.preventDefault();
    e.focus({ preventScroll: true });
  });
  e.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false }); // or the page scrolls
  e.addEventListener("pointermove", follow);
  e.addEventListener("pointerup", (event) => {
    follow(event);
    if (held && row === LIVE) {
      fitNow();
      render();
    }
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) e.addEventListener(end, () => { held = null; });
  const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  e.addEventListener("keydown", (event) => {
    const way = WAYS[event.key];
    if (!way) return;
    event.preventDefault();
    const by = (event.shiftKey ? 20 : 4) / view[0];
    const [x, y] = fromFrame(lab.points[live.points[name]]);
    pull(h, [x + way[0] * by, y + way[1] * by]);
    fitNow();
    render();
  });
  return h;
}

/* --- the case with the numbers as they are ------------------------------------------------------------ */

const differing = () => numbers.map((value, n) => n).filter((n) => numbers[n] !== live.numbers[n] || live.text.set.includes(n));
const textOf = (n, e = fieldOf(n)) => (e && numberIn(e.value, e.dataset.bound) ? e.value.trim().replace("−", "-").replace(",", ".") : String(numbers[n]));
/* What `near` has to be so that the numbers alone lead here: nothing, where the way as typed is this one. */
function nearHere() {
  const here = lab.points.map((p) => [...p]);
  let same = false;
  try {
    const fresh = figureOf(program, live, numbers);
    fresh.typed();
    same = fresh.points.every((p, k) => apart(p, here[k]) < 1e-9);
  } catch (refusal) {
    refused(refusal);
    same = scene.status !== "ok";
  }
  return same ? {} : Object.fromEntries(Object.keys(live.near).map((k) => [k, fromFrame(here[k])]));
}
function caseText() {
  const { text, at, near } = live.text;
  const swaps = differing().filter((n) => at[n]).map((n) => [...at[n], `${textOf(n)} ${live.written[live.paths[n]] || ""}`.trim()]);
  const moved = nearHere();
  for (const [name, k] of entries(live.points))
    ["x", "y"].forEach((axis, m) => { if (moved[k] && near[`${name}.${axis}`]) swaps.push([...near[`${name}.${axis}`], number(moved[k][m], 6).replace("−", "-")]); });
  return swaps.sort((a, b) => b[0] - a[0]).reduce((all, [from, to, by]) => all.slice(0, from) + by + all.slice(to), text);
}
function linkText() {
  const parts = differing().map((n) => `${encodeURIComponent(live.paths[n])}=${encodeURIComponent(textOf(n))}`);
  const moved = nearHere();
  for (const [name, k] of entries(live.points))
    if (moved[k]) ["x", "y"].forEach((axis, m) => parts.push(`near.${name}.${axis}=${moved[k][m]}`));
  return parts.join("&");
}
function copied(text) {
  byId("copied-line").hidden = false;
  byId("copied").value = text;
  byId("copied").select();
  if (navigator.clipboard) navigator.clipboard.writeText(text).catch(() => {});
}
/* Numbers from the address. */
function fromAddress() {
  const asked = new URLSearchParams(location.hash.slice(1).replaceAll("+", "%2B"));
  let some = false;
  for (const [path, text] of asked) {
    const n = live.paths.indexOf(path);
    const found = numberIn(text, n < 0 || !fieldOf(n) ? "" : fieldOf(n).dataset.bound);
    const near = /^near\.(.+)\.([xy])$/.exec(path);
    if (found && n >= 0) enter(n, found.value, found.half, text);
    else if (found && near && live.near[live.points[near[1]]]) {
      const m = near[2] === "x" ? 0 : 1;
      lab.near.get(live.points[near[1]])[m] = (found.value - live.frame[m]) * live.frame[2];
    } else continue;
    some = true;
  }
  if (some) changed(false);
}
if (live) {
  live.firstHalves = [...live.halves];
  live.texts = live.paths.map((_, n) => (fieldOf(n) ? fieldOf(n).value : ""));
  live.typed = (n) => (fieldOf(n) && fieldOf(n).value !== live.texts[n] ? textOf(n).toLowerCase() : null);
  live.text = live.text || { set: [], at: [], near: {} };
  const fine = byId("fine");
  live.paths.forEach((path, n) => {
    const field = fieldOf(n);
    if (!field) return;
    field.addEventListener("input", () => {
      const found = numberIn(field.value, field.dataset.bound);
      if (!found) {
        set(field, "aria-invalid", "true");
        const limits = live.bounds[field.dataset.bound].map(([, , says]) => ` that ${says}`);
        liveHint.textContent = `${path}: a number${limits.join(" and")}.`;
        return;
      }
      field.removeAttribute("aria-invalid");
      numbers[n] = found.value;
      live.halves[n] = found.half;
      changed(false);
    });
    field.addEventListener("focus", () => {
      const angle = field.nextElementSibling && field.nextElementSibling.textContent === "°";
      const reach = angle ? 90 : abs(live.numbers[n]) || (path.startsWith("points.") ? 1 / live.frame[2] / 4 : 1);
      const limits = live.bounds[field.dataset.bound];
      const whole = limits.some(([than]) => than === "whole");
      const unit = whole ? 1 : angle ? 0.5 : 10 ** (floor(Math.log10(reach)) - 2);
      const within = [tidy(numbers[n] - reach, unit), tidy(numbers[n] + reach, unit)];
      for (const [than, limit] of limits) {
        if (than === "<" || (whole && numbers[n] < limit)) within[1] = min(within[1], limit - unit);
        else within[0] = max(within[0], limit + unit);
      }
      set(fine, "step", unit);
      set(fine, "min", within[0]);
      set(fine, "max", within[1]);
      fine.value = String(numbers[n]);
      byId("fine-name").textContent = field.getAttribute("aria-label");
      fine.dataset.n = n;
      fine.disabled = false;
    });
  });
  fine.addEventListener("input", () => {
    const n = Number(fine.dataset.n);
    enter(n, Number(fine.value), halfOf(fine.value), fine.value);
    changed(false);
  });
  byId("reset").addEventListener("click", () => {
    scene.changed = true;
    leave();
    if (motion) moveTo(zero);
    else { resolve(false); row = zero; render(); }
    placeHandles();
  });
  byId("copy-case").hidden = !live.text.text;
  byId("copy-case").addEventListener("click", () => copied(caseText()));
  byId("copy-link").addEventListener("click", () => {
    location.hash = linkText();
    copied(location.href);
  });
  make("g", { id: "handles" }, figure);
  for (const [name, moves] of entries(live.handles)) if (own(live.points, name) !== undefined) handles.push(grip(name, moves));
  placeHandles();
  live.input = motion ? motion.driver : live.turning[0];
  rested();
  inputs();
  if (location.hash.length > 1) fromAddress();
  window.addEventListener("hashchange", fromAddress);
}
