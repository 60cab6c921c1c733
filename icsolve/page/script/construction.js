/* The construction, a centre at a time. */
const buttons = all("ol.steps button");
const said = byId("said");
const SAID = said ? said.textContent : "";
const circle = byId("circle-figure");
function construct() {
  for (const b of buttons) {
    const n = Number(b.dataset.step);
    b.classList.toggle("later", n > step);
    if (!complete && n === step) set(b, "aria-current", "step");
    else b.removeAttribute("aria-current");
  }
  if (circle) {
    for (const e of all("[data-step]", circle)) {
      const n = Number(e.dataset.step);
      show(e, e.id.startsWith("closed-") ? !complete && n === step : n <= step);
      e.classList.toggle("now", !complete && n === step && n > 0);
    }
    for (const e of all('[id^="order-"]', circle)) show(e, Number(e.id.slice(6)) <= step);
  }
  if (said) {
    byId("back").disabled = byId("from-start").disabled = !complete && step === 0;
    byId("next").disabled = byId("whole").disabled = complete;
    const words = complete ? SAID : buttons.find((b) => Number(b.dataset.step) === step).textContent;
    if (said.textContent !== words) said.textContent = words;
  }
  render();
}
function go(n, whole = false) {
  step = max(0, min(data.steps, n));
  complete = whole;
  construct();
}
for (const b of buttons) b.addEventListener("click", () => go(Number(b.dataset.step)));
if (said) {
  byId("from-start").addEventListener("click", () => go(0));
  byId("back").addEventListener("click", () => go(complete ? data.steps : step - 1));
  byId("next").addEventListener("click", () => (step === data.steps ? go(step, true) : go(step + 1)));
  byId("whole").addEventListener("click", () => go(data.steps, true));
}
construct();
window.addEventListener("beforeprint", () => { for (const d of all("details")) d.open = true; });
if (document.fonts) document.fonts.ready.then(() => { for (const l of [...labels, ...centres]) l.size = null; render(); });
window.addEventListener("resize", () => { for (const l of [...labels, ...centres]) l.size = null; render(); });
