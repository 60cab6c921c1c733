"""Random loads on a scene, with one unknown, far from a dead centre by the reference's own check."""

from __future__ import annotations

from random import Random
from typing import Any

import reference
import transcribe
import witness
from mechanisms import Generator, heading, spot
from transcribe import Scene


def random_load(rng: Random, base: Scene, link: str, number: Any) -> dict[str, Any]:
    """A load of any kind on a link, with a number or `unknown`."""
    links = [n for n in transcribe.case(base).links if n != link]
    other = {"against": rng.choice(links)} if rng.random() < 0.25 else {}
    names = list(base["points"])
    at: Any = spot(rng) if not names or rng.random() < 0.3 else rng.choice(names)
    toward = (
        {rng.choice(["toward", "away"]): rng.choice([n for n in names if n != at])} if len(names) > 2 else {}
    )
    directed: dict[str, Any] = rng.choice(
        [{"angle": heading(rng)}, {"slope": [rng.randrange(-5, 6), 3]}, toward or {"angle": 30.0}]
    )
    kinds: list[dict[str, Any]] = [
        {"force": number, "link": link, "at": at} | directed | other,
        {"torque": number, "link": link} | ({"turns": "cw"} if rng.random() < 0.3 else {}) | other,
        {rng.choice(["weight", "mass"]) if number == "unknown" else "weight": number, "link": link, "at": at},
    ]
    if len(names) > 2:
        ends = rng.sample(names, 2)
        kinds.append({"spring": number, "free": 0.125, "link": link, "at": ends[0], "to": ends[1]} | other)
    if number != "unknown":
        kinds.append({"force": [number, round(rng.uniform(-50, 50), 2)], "link": link, "at": at} | other)
        kinds.append({"mass": f"{abs(number)} kg", "link": link, "at": at})
    return rng.choice(kinds)


def loaded(rng: Random, base: Scene, unknowns: int = 1) -> Scene:
    """The scene with known loads, and the unknowns `U` (and `V`), each on a link of its own choice."""
    links = [n for n in transcribe.case(base).links if n != "1"]
    known = rng.choices(links, k=rng.randrange(1, 4))
    loads = {
        f"P{k}": random_load(rng, base, n, round(rng.uniform(5, 200), 2)) for k, n in enumerate(known, 1)
    }
    for name in "UV"[:unknowns]:
        loads[name] = random_load(rng, base, rng.choice(links), "unknown")
    if rng.random() < 0.2:
        loads |= alike(rng, rng.choice(list(loads)), loads, links)
    return base | {"loads": loads}


def alike(rng: Random, name: str, loads: dict[str, Any], links: list[str]) -> dict[str, Any]:
    """A load `L` as large as another, or a multiple of it."""
    kind = next(iter(loads[name]))
    number = {"like": name} | rng.choice([{}, {"times": -0.5}])
    if kind == "torque":
        return {"L": {"torque": number, "link": rng.choice(links)}}
    if kind in ("force", "weight") and not isinstance(loads[name][kind], list):
        return {"L": {"force": number, "link": rng.choice(links), "at": spot(rng), "angle": heading(rng)}}
    return {}


def sound(trial: Scene, freedoms: int = 1) -> bool:
    """The right mobility, well away from another; unknown and known loads that do work in it,
    and no unknown that has nothing to balance."""
    case = transcribe.case(trial)
    points = reference.points_of(case)
    if reference.clearance(case, points) < 1e-3:
        return False
    found = reference.motions(case, points)
    if len(found.basis) != freedoms or witness.firmness(found) < 1e-2:
        return False
    return min(map(abs, witness.answers(found).values())) > 1e-6


def drawn(seed: int, generator: Generator) -> Scene:
    """The first sound scene, with loads, that a generator makes from a seed."""
    rng = Random(f"{generator.__name__} {seed}")
    for _ in range(2000):
        trial = loaded(rng, generator(rng))
        if sound(trial):
            return trial
    raise AssertionError(f"no sound scene of {generator} from seed {seed}")
