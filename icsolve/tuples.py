"""Named tuples and frozen classes that cost little to make: those of `typing` and `dataclasses`, uncompiled;
and modules that are imported on use.

A hundred are made at each start, and each by `typing.NamedTuple` takes as long as ten plain classes. Modules
that have some put annotations off (``from __future__``), so that making one evaluates none.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__all__ = [
    "Generic",
    "LateModule",
    "NamedTuple",
    "Protocol",
    "TypeVar",
    "cached_property",
    "dataclass",
    "field",
    "replace",
]


class LateModule:
    """A module that is imported when something of it is first used: words of refusals, what few cases need.

    Where it stands a type checker is given the import itself.
    """

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, name: str) -> Any:
        value = getattr(import_module(self._name), name)
        setattr(self, name, value)
        return value


if TYPE_CHECKING:
    from dataclasses import dataclass, field, replace
    from functools import cached_property
    from typing import Generic, NamedTuple, Protocol, TypeVar
else:
    from operator import itemgetter
    from types import FunctionType

    try:
        from _collections import _tuplegetter as field_of
    except ImportError:

        def field_of(place: int, words: str) -> property:
            """The attribute that reads a field, where the interpreter has none of its own."""
            return property(itemgetter(place), doc=words)

    class Generic:
        """What only a type checker reads, as is `Protocol`: those of `typing` do far more with each class."""

        __slots__ = ()

        def __class_getitem__(cls, _of: object) -> type:
            return cls

    Protocol = Generic

    def TypeVar(_name: str, *_of: object, **_bound: object) -> type:  # noqa: N802
        """What only a type checker reads too; that of `typing` compiles the words of its bound."""
        return Generic

    @classmethod
    def _make(cls, values):
        made = tuple.__new__(cls, values)
        if len(made) != len(cls._fields):
            raise TypeError(f"Expected {len(cls._fields)} arguments, got {len(made)}")
        return made

    def _replace(self, /, **changed):
        made = tuple.__new__(self.__class__, map(changed.pop, self._fields, self))
        if changed:
            raise ValueError(f"Got unexpected field names: {list(changed)!r}")
        return made

    def _asdict(self) -> dict[str, Any]:
        return dict(zip(self._fields, self, strict=True))

    def _repr(self) -> str:
        inside = ", ".join(f"{name}={value!r}" for name, value in zip(self._fields, self, strict=True))
        return f"{type(self).__name__}({inside})"

    def _values(self) -> tuple[Any, ...]:
        return tuple(self)

    _SHARED = {
        "__slots__": (),
        "__repr__": _repr,
        "__getnewargs__": _values,
        "_make": _make,
        "_replace": _replace,
        "_asdict": _asdict,
    }
    """What all named tuples share; put into each, as a class is made the faster the fewer it stands on."""

    class _Maker(type):
        """Makes a plain class of what stands in a class statement over `NamedTuple`."""

        def __new__(meta: type[_Maker], name: str, bases: tuple[type, ...], inside: dict[str, Any]) -> type:
            annotations = inside.get("__annotations__", {})
            fields = tuple(annotations)
            defaults = {field: inside[field] for field in fields if field in inside}
            if defaults and fields[-len(defaults) :] != tuple(defaults):
                raise TypeError(f"{name}: a field without a default follows one that has one")
            code = _MAKERS[len(fields)].__code__.replace(co_varnames=("_cls", *fields))
            new = FunctionType(code, _MADE_BY, "__new__", tuple(defaults.values()))
            new.__annotations__ = annotations
            inside.update(zip(fields, _GETTERS, strict=False))
            inside["__new__"], inside["_field_defaults"] = new, defaults
            inside["_fields"] = inside["__match_args__"] = fields
            on = (tuple,) if bases == _ALONE else tuple([tuple if b is NamedTuple else b for b in bases])
            return type(name, on, _SHARED | inside)

    class _Makers(dict):
        """What makes a tuple of so many fields; the usual ones need not be compiled at each start."""

        def __missing__(self, fields: int) -> FunctionType:
            names = "".join(f"_{place}, " for place in range(fields))
            return eval(f"lambda _cls, {names}: _t(_cls, ({names}))", _MADE_BY)

    _t = tuple.__new__
    _MADE_BY = {"_t": _t}
    _USUAL = (
        lambda z, a: _t(z, (a,)),
        lambda z, a, b: _t(z, (a, b)),
        lambda z, a, b, c: _t(z, (a, b, c)),
        lambda z, a, b, c, d: _t(z, (a, b, c, d)),
        lambda z, a, b, c, d, e: _t(z, (a, b, c, d, e)),
        lambda z, a, b, c, d, e, f: _t(z, (a, b, c, d, e, f)),
        lambda z, a, b, c, d, e, f, g: _t(z, (a, b, c, d, e, f, g)),
        lambda z, a, b, c, d, e, f, g, h: _t(z, (a, b, c, d, e, f, g, h)),
        lambda z, a, b, c, d, e, f, g, h, i: _t(z, (a, b, c, d, e, f, g, h, i)),
        lambda z, a, b, c, d, e, f, g, h, i, j: _t(z, (a, b, c, d, e, f, g, h, i, j)),
        lambda z, a, b, c, d, e, f, g, h, i, j, k: _t(z, (a, b, c, d, e, f, g, h, i, j, k)),
        lambda z, a, b, c, d, e, f, g, h, i, j, k, m: _t(z, (a, b, c, d, e, f, g, h, i, j, k, m)),
        lambda z, a, b, c, d, e, f, g, h, i, j, k, m, n: _t(z, (a, b, c, d, e, f, g, h, i, j, k, m, n)),
        lambda z, a, b, c, d, e, f, g, h, i, j, k, m, n, p: _t(z, (a, b, c, d, e, f, g, h, i, j, k, m, n, p)),
    )
    _MAKERS = _Makers(enumerate(_USUAL, 1))
    _GETTERS = [field_of(place, "") for place in range(64)]

    NamedTuple = type.__new__(_Maker, "NamedTuple", (), {})
    _ALONE = (NamedTuple,)
    _ALONE = (NamedTuple,)

    class _Made:
        """The default of a field that is made anew for every object."""

        def __init__(self, default_factory):
            self.make = default_factory

    field = _Made

    class cached_property:  # noqa: N801
        """That of `functools`, without the lock that it has before Python 3.12."""

        def __init__(self, make):
            self.make, self.__doc__ = make, make.__doc__

        def __set_name__(self, owner, name):
            self.name = name

        def __get__(self, instance, owner=None):
            if instance is None:
                return self
            found = instance.__dict__[self.name] = self.make(instance)
            return found

    def dataclass(**how: bool):
        """A class whose frozen objects keep what the annotated names say; any two are different."""
        assert how == {"frozen": True, "eq": False, "repr": False}

        def finished(kind: type) -> type:
            kind._fields = tuple(kind.__annotations__)
            defaults = {name: kind.__dict__[name] for name in kind._fields if name in kind.__dict__}
            kind._made = {name: default.make for name, default in defaults.items() if type(default) is _Made}
            for name in kind._made:
                delattr(kind, name)
            kind._plain = {name: default for name, default in defaults.items() if name not in kind._made}
            kind.__init__, kind.__replace__ = _keep, replace
            kind.__setattr__ = kind.__delattr__ = _refuse
            kind.__dataclass_fields__, kind.__signature__ = _LibraryFields(), _CallSignature()
            return kind

        return finished

    def _keep(self, *values, **named) -> None:
        kind, own = type(self), self.__dict__
        own.update(kind._plain)
        own.update(named)
        if values:
            own.update(zip(kind._fields, values, strict=False))
        for name, make in kind._made.items():
            if name not in own:
                own[name] = make()
        twice = values and len(values) + len(named) > len(named.keys() | kind._fields[: len(values)])
        if twice or len(own) != len(kind._fields):
            odd = set(kind._fields) ^ set(own) or "too many values, or one twice"
            raise TypeError(f"{kind.__name__}: wrong values: {odd}")

    def replace(value, /, **changes):
        """The same with other values in some fields."""
        kind, old = type(value), value.__dict__
        other = object.__new__(kind)
        other.__dict__.update({name: old[name] for name in kind._fields}, **changes)
        if len(other.__dict__) != len(kind._fields):
            raise TypeError(f"{kind.__name__} has no {set(changes) - set(kind._fields)}")
        return other

    def _refuse(self, name: str, *value: object) -> None:
        raise AttributeError(
            f"{name!r} is of a frozen {type(self).__name__}: `dataclasses.replace` makes another"
        )

    class _LibraryFields:
        """What the library's own `dataclasses.replace` and `fields` ask for."""

        def __get__(self, instance: object, kind: type) -> dict[str, Any]:
            from dataclasses import make_dataclass

            return make_dataclass(kind.__name__, kind._fields).__dataclass_fields__

    class _CallSignature:
        """How a class is called, for `help` and `inspect.signature`."""

        def __get__(self, instance: object, kind: type) -> Any:
            from inspect import Parameter, Signature

            defaults = kind._plain | {name: make() for name, make in kind._made.items()}
            how = Parameter.POSITIONAL_OR_KEYWORD
            return Signature(
                Parameter(name, how, default=defaults.get(name, Parameter.empty), annotation=told)
                for name, told in kind.__annotations__.items()
            )
