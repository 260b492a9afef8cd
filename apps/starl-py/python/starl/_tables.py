"""Records as data frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from starl import _native
from starl._extras import needed

if TYPE_CHECKING:
    import pandas
    import polars


class Table:
    """Rows of records, which Polars, pandas, PyArrow, DuckDB and others take over through the Arrow PyCapsule interface.

    Every table has the columns `time` (seconds), `time_ns` (nanoseconds, exact) and `robot` (its number; null where
    something happened to the world).
    """

    def __init__(self, native: _native.Table) -> None:
        self._native = native

    @property
    def columns(self) -> list[str]:
        """The names of the columns."""
        return self._native.columns

    def __len__(self) -> int:
        return len(self._native)

    def __repr__(self) -> str:
        return f"<starl.Table of {len(self):,} rows: {', '.join(self.columns)}>"

    def _repr_html_(self) -> str | None:
        try:
            return self.to_polars()._repr_html_()
        except (ImportError, TypeError):
            return None

    def to_polars(self) -> polars.DataFrame:
        """As a data frame of Polars, which needs version 1.3."""
        package = needed("polars", "frames")
        try:
            frame: polars.DataFrame = package.DataFrame(self)
        except TypeError:
            raise TypeError(f"this needs Polars 1.3 or later, not {package.__version__}") from None
        return frame

    def to_pandas(self) -> pandas.DataFrame:
        """As a data frame of pandas, which needs version 2.0 with PyArrow 14, or 3."""
        import pandas

        frame: pandas.DataFrame
        if from_arrow := getattr(pandas.DataFrame, "from_arrow", None):
            frame = from_arrow(self)
        else:
            import pyarrow

            frame = pyarrow.table(self).to_pandas()
        return frame

    def to_numpy(self) -> dict[str, NDArray[Any]]:
        """The columns of numbers, as arrays; NaN stands for what is missing."""
        found = {name: self._native.numbers(name) for name in self.columns}
        return {name: numbers for name, numbers in found.items() if numbers is not None}

    def __arrow_c_schema__(self) -> Any:
        return self._native.__arrow_c_schema__()

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        return self._native.__arrow_c_stream__(requested_schema)
