/* The position. */
const slider = byId("turn");
const hint = byId("hint");
const cursors = (data.plots || []).map((plot, n) => ({ ...plot, dots: plot.dots.map(places), svg: byId(`plot-${n}`) }));
const degreesOf = (r) => motion.first + motion.step * r;
function angleWords(r) {
  if (r === zero) return "as written";
  if (r === LIVE) return "with the numbers as they are";
  return `${number(abs(degreesOf(r)), 5)}${motion.unit} ${motion.senses[r > zero ? 0 : 1]}`;
}
function moveCursors(r) {
  for (const plot of cursors) {
    show(plot.svg.querySelector(".cursor"), r !== LIVE);
    const [left, top, right, bottom] = plot.box;
    const x = left + ((degreesOf(r) - plot.x[0]) / (plot.x[1] - plot.x[0])) * (right - left);
    set(plot.svg.querySelector(".cursor"), "d", `M${f(x)},${top} L${f(x)},${bottom}`);
    all(".cursor-dot", plot.svg).forEach((dot, n) => {
      const y = r === LIVE ? null : plot.dots[n].y[r];
      show(dot, y !== null && y >= top - 0.1 && y <= bottom + 0.1);
      if (y !== null) {
        set(dot, "cx", f(x));
        set(dot, "cy", f(y));
      }
    });
  }
}
let seeing = false;
function render() {
  if (figure && stage) {
    if (motion || live) moveParts(row);
    tell(row);
    placeLabels(row, drawCentres(row));
  }
  if (seeing) see();
  if (!motion) return;
  moveCursors(row);
  if (live) placeHandles();
  byId("angle").textContent = angleWords(row);
  const said = answers.map((a) => a.name + saying(a, row).text + (saying(a, row).sense ? `, ${saying(a, row).sense}` : "")).join("; ");
  set(slider, "aria-valuetext", `${angleWords(row)}${said ? "; " + said : ""}`);
}
function hintOf(r, beyond) {
  if (beyond) return beyond;
  const found = motion.hints.find(([first, last]) => first <= r && r <= last);
  return found ? found[2] : "";
}
function moveTo(r, beyond = "") {
  if (live && scene.changed && mover) {
    drive(degreesOf(r));
    return;
  }
  leave();
  row = max(0, min(rows - 1, Math.round(r)));
  if (live) follow(row);
  slider.value = degreesOf(row);
  hint.textContent = hintOf(row, beyond);
  render();
}
function turnTo(degrees) {
  const r = (degrees - motion.first) / motion.step;
  const over = r < -0.5 || r > rows - 0.5;
  const end = degreesOf(r < 0 ? 0 : rows - 1);
  moveTo(r, over ? `${motion.ends[0].toUpperCase()}${motion.ends.slice(1)} beyond ${number(end, 5)}${motion.unit}.` : "");
}
let playing = 0;
const play = byId("play");
const still = window.matchMedia("(prefers-reduced-motion: reduce)");
function stop() {
  if (!playing) return;
  window.cancelAnimationFrame(playing);
  window.clearInterval(playing);
  playing = 0;
  play.textContent = "Play";
  set(byId("answers"), "aria-live", "polite");
}
function start() {
  set(byId("answers"), "aria-live", "off");
  play.textContent = "Pause";
  let place = row;
  let sign = 1;
  const advance = (amount) => {
    place += sign * amount;
    if (motion.turns) place = ((place % (rows - 1)) + rows - 1) % (rows - 1);
    else if (place > rows - 1 || place < 0) {
      sign = -sign;
      place = max(0, min(rows - 1, place));
    }
    moveTo(place);
  };
  if (still.matches) {
    playing = window.setInterval(() => advance(rows / 24), 1000);
    return;
  }
  let last = null;
  const frame = (now) => {
    if (last !== null) advance(((now - last) / 9000) * rows);
    last = now;
    playing = window.requestAnimationFrame(frame);
  };
  playing = window.requestAnimationFrame(frame);
}
if (motion) {
  slider.addEventListener("input", () => {
    stop();
    turnTo(Number(slider.value));
  });
  play.addEventListener("click", () => (playing ? stop() : start()));
  byId("written").addEventListener("click", () => {
    stop();
    moveTo(zero);
  });
  for (const plot of cursors) {
    const point = (event) => {
      if (event.type === "pointermove" && !event.buttons) return;
      stop();
      const matrix = plot.svg.getScreenCTM().inverse();
      const x = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix).x;
      const share = (x - plot.box[0]) / (plot.box[2] - plot.box[0]);
      turnTo(plot.x[0] + max(0, min(1, share)) * (plot.x[1] - plot.x[0]));
    };
    plot.svg.addEventListener("pointerdown", point);
    plot.svg.addEventListener("pointermove", point);
  }
}
