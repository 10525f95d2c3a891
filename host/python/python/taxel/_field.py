"""Attributes of an event, and of a part of one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, Protocol, TypeVar, overload

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)


class _Holder(Protocol):
    def _value(self, name: str) -> Any: ...


class Field(Generic[T_co]):
    """A read-only attribute, by its name in the message; None if the message does not have it."""

    def __init__(self, made: Callable[[Any], Any] | str, doc: str = "") -> None:
        self._made: Callable[[Any], Any] | None = None if isinstance(made, str) else made
        self.__doc__ = made if isinstance(made, str) else doc
        self._name = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, holder: None, owner: type) -> Field[T_co]: ...
    @overload
    def __get__(self, holder: _Holder, owner: type | None = None) -> T_co: ...
    def __get__(self, holder: _Holder | None, owner: type | None = None) -> Any:
        if holder is None:
            return self
        value = holder._value(self._name)
        return value if self._made is None or value is None else self._made(value)

    def __set__(self, holder: _Holder, value: Any) -> None:
        raise AttributeError(f"{self._name} is what a board has said")


def each(made: Callable[[Any], T]) -> Callable[[list[Any]], list[T]]:
    """Returns what makes a list of the items of a list."""
    return lambda items: [made(item) for item in items]


class Part:
    """A part of an event."""

    __slots__ = ("_fields",)

    def __init__(self, fields: dict[str, Any]) -> None:
        self._fields = fields

    def _value(self, name: str) -> Any:
        return self._fields.get(name)

    def to_dict(self) -> dict[str, Any]:
        """The part as a dict, as ``taxel live --json`` prints it."""
        return self._fields

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Part) and self._fields == other._fields

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" for name, value in self._fields.items())
        return f"{type(self).__name__}({values})"
