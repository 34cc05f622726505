"""The named lengths of a robot and their values, read-only."""

from collections.abc import Iterator, Mapping


class Parameters(Mapping[str, float]):
    """Name → value, as a mapping that cannot be written to.

    `types.MappingProxyType` is such a mapping too, but it can be neither pickled nor copied.
    """

    def __init__(self, values: Mapping[str, float] | None = None) -> None:
        self._values = dict(values or {})

    def __getitem__(self, name: str) -> float:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return repr(self._values)
