"""Named tuples that cost little to make: those of `typing`, without its checks of every annotation and name.

A hundred are made at each start, and each by `typing.NamedTuple` takes as long as ten plain classes. Modules
that have some put annotations off (``from __future__``), so that making one evaluates none.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

__all__ = ["NamedTuple"]

if TYPE_CHECKING:
    from typing import NamedTuple
else:
    from operator import itemgetter
    from types import CodeType, FunctionType

    try:
        from _collections import _tuplegetter as field_of
    except ImportError:

        def field_of(place: int, words: str) -> property:
            """The attribute that reads a field, where the interpreter has none of its own."""
            return property(itemgetter(place), doc=words)

    class _Fields(tuple):
        """What all named tuples share."""

        __slots__ = ()

        @classmethod
        def _make(cls, values):
            made = tuple.__new__(cls, values)
            if len(made) != len(cls._fields):
                raise TypeError(f"Expected {len(cls._fields)} arguments, got {len(made)}")
            return made

        def _replace(self, /, **changed):
            made = self._make(map(changed.pop, self._fields, self))
            if changed:
                raise ValueError(f"Got unexpected field names: {list(changed)!r}")
            return made

        def _asdict(self) -> dict[str, Any]:
            return dict(zip(self._fields, self, strict=True))

        def __repr__(self) -> str:
            inside = ", ".join(f"{name}={value!r}" for name, value in zip(self._fields, self, strict=True))
            return f"{type(self).__name__}({inside})"

        def __getnewargs__(self) -> tuple[Any, ...]:
            return tuple(self)

    class _Maker(type):
        """Makes a plain class of what stands in a class statement over `NamedTuple`."""

        def __new__(meta: type[_Maker], name: str, bases: tuple[type, ...], inside: dict[str, Any]) -> type:
            annotations = inside.get("__annotations__", {})
            fields = tuple(annotations)
            defaults = {field: inside[field] for field in fields if field in inside}
            if fields[len(fields) - len(defaults) :] != tuple(defaults):
                raise TypeError(f"{name}: a field without a default follows one that has one")
            code = _maker_of(len(fields)).replace(co_varnames=("_cls", *fields))
            new = FunctionType(code, {"_new": tuple.__new__}, "__new__", tuple(defaults.values()))
            new.__annotations__ = annotations
            inside |= {field: field_of(place, "") for place, field in enumerate(fields)}
            inside |= {"_fields": fields, "_field_defaults": defaults, "__match_args__": fields}
            inside |= {"__new__": new, "__slots__": ()}
            return type(name, tuple(_Fields if base is NamedTuple else base for base in bases), inside)

    @cache
    def _maker_of(fields: int) -> CodeType:
        """What makes a tuple of so many fields."""
        names = "".join(f"_{place}, " for place in range(fields))
        return eval(f"lambda _cls, {names}: _new(_cls, ({names}))").__code__

    NamedTuple = type.__new__(_Maker, "NamedTuple", (), {})
