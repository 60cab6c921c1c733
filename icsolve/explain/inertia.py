"""Inertia forces: -m a at the centre of mass and -J alpha of every link that has a mass, as loads."""

from __future__ import annotations

from collections.abc import Iterable

from icsolve.case import ForceVector, Like, Torque
from icsolve.explain.document import Block, Section, formula, words
from icsolve.explain.formula import Name, Product, minus, product
from icsolve.explain.given import Figures, load_name
from icsolve.report.derivation.known import Known

DALEMBERT = (
    "With the inertia forces of its motion among the loads a mechanism counts as in equilibrium "
    "(d'Alembert). They act against the accelerations, which the second derivative of the figure gives:"
)


def inertia_section(known: Known, figures: Figures) -> Section | None:
    """The inertia force and couple of every link; None where there are none."""
    loads = [load for load in known.case.loads if load.name.startswith("inertia ")]
    blocks = [block for load in loads for block in _inertia(known, figures, load)]
    return Section("Inertia forces", (words(DALEMBERT), *blocks)) if blocks else None


def _inertia(known: Known, figures: Figures, load: object) -> Iterable[Block]:
    answer, units = known.answer, known.case.units
    if answer is None:
        return
    if isinstance(load, ForceVector):
        given = known.case.inertia[load.link]
        place = (answer.accelerations or {}).get((load.at, load.link))
        if given.mass is None or place is None or isinstance(place, str):
            return
        a = figures.quantity(place[0], ""), figures.quantity(place[1], "")
        yield words(
            f"Link {load.link}, ", Name("m", load.link), " = ", figures.quantity(given.mass.value, "kg"),
            f", moves {load.at} with ", Name("a", load.at), " = (", a[0].number, ", ", a[1].number,
            f") {units.length}/s^2:",
        )  # fmt: skip
        symbol, scale = load_name(load.name), units.force_per_newton / units.length_per_metre
        for axis, size, force in zip("xy", place, (load.x.value, load.y.value), strict=True):
            if force:
                own, rate = Name(symbol.base, symbol.low + axis), Name("a", f"{load.at}{axis}")
                numbers = (figures.number(given.mass.value), figures.number(size))
                more = () if scale == 1.0 else (figures.number(scale),)
                whole = figures.quantity(force, units.force)
                yield formula(
                    own, minus(product(Name("m", load.link), rate)), minus(Product((*numbers, *more))), whole
                )
    if isinstance(load, Torque) and load.value is not None:
        moment = known.case.inertia[load.link].moment
        rate_of = (answer.angular_accelerations or {}).get(load.link)
        if moment is None or rate_of is None or isinstance(rate_of, str) or isinstance(load.value, Like):
            return
        speed, own = Name("alpha", load.link), Name("J", load.link)
        yield words(
            f"Link {load.link} has ", own, " = ", figures.quantity(moment.value, "kg*m^2"),
            " and turns with ", speed, " = ", figures.quantity(rate_of, "rad/s^2"), ":",
        )  # fmt: skip
        scale = units.force_per_newton * units.length_per_metre * units.torque_per_force_length
        numbers = (figures.number(moment.value), figures.number(rate_of))
        more = () if scale == 1.0 else (figures.number(scale),)
        whole = figures.quantity(load.value.value, units.torque)
        yield formula(
            load_name(load.name), minus(product(own, speed)), minus(Product((*numbers, *more))), whole
        )
