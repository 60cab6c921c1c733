/* Words: answers, equation, the label of the unknown. */
function saying(answer, r) {
  const value = answer.values[r];
  const held = answer.holds && (answer.holds[r] ?? answer.holds[0]);
  if (held) return { text: ` ${held}`, sense: "" };
  if (value === null || value === undefined || Number.isNaN(value)) return { text: ` = no value (${statusAt(r)})`, sense: "" };
  const sense = r === LIVE ? answer.word : answer.senses[answer.sense[r]];
  if (answer.asked) return { text: ` = ${number(value, 6)}${answer.unit === "°" ? "" : " "}${answer.unit}`, sense };
  return { text: ` = ${number(abs(value), 6)} ${answer.unit}`.trimEnd(), sense };
}
const statusAt = (r) => {
  if (r === LIVE) return scene.status;
  const found = motion && motion.hints.find(([first, last]) => first <= r && r <= last);
  return found ? found[3] : "ok";
};
const SHORT = { counterclockwise: " ccw", clockwise: " cw" };
function lastText(text) {
  let node = text.lastChild;
  while (node && node.lastChild) node = node.lastChild;
  return node;
}
/* What stands beside a load in the figure, and what is said of it there. */
function relabel(name, { base, low, unit, values, reach }, r, sense) {
  const load = own(loads, name);
  if (!load) return;
  const turns = load.torque && !load.k && values[r] ? SHORT[sense] || "" : "";
  const shown = values[r] === null ? "no value" : `${number(abs(values[r]), 4)} ${unit}${turns}`;
  const text = reach && reach[r] ? `: ${reach[r]}` : `${load.k ? ": k" : ""} = ${shown}`;
  const title = byId(`load-${name}`) && byId(`load-${name}`).querySelector("title");
  if (title) title.textContent = base + low + text;
  const label = labels.find((l) => l.label === name);
  if (!label) return;
  lastText(label.text).data = (low ? "" : base) + text;
  label.size = null;
}
function tell(r) {
  for (const answer of answers) {
    const { text, sense } = saying(answer, r);
    const line = byId("answers") && all("[data-answer]").find((e) => e.dataset.answer === answer.name);
    if (line) {
      line.lastElementChild.textContent = text + (sense ? `, ${sense}` : "");
      line.dataset.value = typeof answer.values[r] === "number" ? String(answer.values[r]) : "";
      line.dataset.status = statusAt(r);
    }
    if (motion || live) relabel(answer.name, answer, r, sense);
  }
  for (const [name, load] of entries(loads))
    if (load.values) relabel(name, load, r, load.values[r] < 0 !== Boolean(load.cw) ? "clockwise" : "counterclockwise");
  const terms = data.terms;
  if (!terms) return;
  let sum = 0;
  terms.forEach((term, n) => {
    const ratio = term.ratio.v[r];
    const size = term.size.v[r];
    const product = ratio === null || size === null ? null : term.sign * ratio * size;
    sum += product === null ? NaN : product;
    byId(`size-${n}`).textContent = size === null ? "none" : number(size, 6);
    byId(`ratio-${n}`).textContent = ratio === null ? "none" : number(ratio, 6);
    byId(`product-${n}`).textContent = product === null ? "none" : number(product, 6);
  });
  const value = -data.root.sign * sum;
  byId("root-product").textContent = answers[0].values[r] === null || Number.isNaN(value) ? "none" : number(value, 6);
}
