/* Two kinds of numbers: doubles, and, where these leave a scene open, whole multiples of 2 ** -400, which add up and
   compare as doubles do. What else is done with numbers is told here for both. */
const BITS = 400n;
const WHOLE = 1n << BITS;
const NOTHING = 250n;
let fine = false;
const isFine = (v) => typeof v === "bigint";
const times = (a, b) => (isFine(a) ? (a * b) >> BITS : a * b);
const over = (a, b) => {
  if (!isFine(a)) return a / b;
  return b ? (a << BITS) / b : refuse("near-singular");
};
/* A double as it is. */
function exactly(v) {
  let places = 0n;
  for (; !Number.isInteger(v); places += 1n) v *= 2;
  return (BigInt(v) << BITS) >> places;
}
/* A constant among the numbers with which a scene is solved. */
const of = (v) => (fine ? exactly(v) : v);
/* Whatever is made of such numbers, in doubles. */
function plainly(v) {
  if (isFine(v)) return Number(v) / 2 ** Number(BITS);
  if (!v || typeof v !== "object") return v;
  return Array.isArray(v) ? v.map(plainly) : Object.fromEntries(entries(v).map(([key, one]) => [key, plainly(one)]));
}
const index = (v) => Number(isFine(v) ? v >> BITS : v);
const ratio = (a, b) => plainly(a) / plainly(b);
/* What a numeral says. */
function decimal(text) {
  const [, sign, whole, part = "", power = "0"] = /^(-?)(\d*)\.?(\d*)(?:e(.*))?$/.exec(text);
  const places = BigInt(part.length) - BigInt(power.replace("+", ""));
  const digits = BigInt(sign + whole + part);
  return places > 0n ? (digits << BITS) / 10n ** places : (digits * 10n ** -places) << BITS;
}
const halfTurn = (() => {
  let made = null;
  const inverse = (n) => {
    let [term, sum] = [WHOLE / n, 0n];
    for (let k = 1n; term; k += 2n, term /= -n * n) sum += term / k;
    return sum;
  };
  return () => (made ||= 16n * inverse(5n) - 4n * inverse(239n));
})();
/* A number of the case as its field has it, which may have more digits than a double, else as its file has it: a
   numeral, or a ratio times a power of pi. */
function asWritten(value, exact, typed) {
  if (Number(typed) === value && /^-?[\d.]+(e[-+]?\d+)?$/.test(typed)) return decimal(typed);
  if (!exact) return decimal(String(value));
  const [num, den, power] = exact;
  const found = (BigInt(num) << BITS) / BigInt(den);
  return power ? (power > 0 ? times : over)(found, halfTurn()) : found;
}
const DOUBLES = {
  of: (v) => v,
  root: (x) => (x > 0 ? Math.sqrt(x) : 0),
  angle: (x, y) => Math.atan2(y, x) * (180 / Math.PI),
  nearest: (x) => { const n = Math.round(x); return Math.abs(x % 1) === 0.5 && n % 2 ? n - 1 : n; },
  turn: (d) => {
    const r = d % 360, q = DOUBLES.nearest(r / 90), a = (r - 90 * q) * (Math.PI / 180);
    return quarters(Math.cos(a), Math.sin(a), q);
  },
};
const quarters = (c, s, q) => [[c, s], [-s, c], [-c, -s], [s, -c]][((q % 4) + 4) % 4];
const DIGITS = {
  of: exactly,
  root: (x) => {
    if (x <= 0n) return 0n;
    const square = x << BITS;
    let r = 1n << BigInt((square.toString(16).length * 4) / 2 + 1);
    for (let next = 0n; ; r = next) if ((next = (r + square / r) >> 1n) >= r) return r;
  },
  angle: (x, y) => {
    let a = exactly(DOUBLES.angle(plainly(x), plainly(y)));
    for (let k = 0; k < 4; k++) {
      const [c, s] = DIGITS.turn(a);
      a += over(180n * over(times(c, y) - times(s, x), times(c, x) + times(s, y)), halfTurn());
    }
    return a;
  },
  nearest: (x) => ((x + (WHOLE >> 1n)) >> BITS) << BITS,
  turn: (d) => {
    const r = d % (360n * WHOLE), q = index(DIGITS.nearest(r / 90n)), a = times(r - 90n * BigInt(q) * WHOLE, halfTurn()) / 180n;
    const sums = [0n, 0n];
    for (let k = 0n, term = WHOLE; term; k += 1n, term = times(term, a) / k) sums[k % 2n] += k % 4n < 2n ? term : -term;
    return quarters(...sums, q);
  },
};
const root = (x) => (isFine(x) ? DIGITS : DOUBLES).root(x);
/* Whether a number is nothing beside another, to doubles as this part of it, and in digits for good. */
const isNothing = (v, most, part = NOISE) => (fine ? abs(v) <= most >> NOTHING : abs(v) <= part * most);
