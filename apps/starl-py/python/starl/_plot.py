"""Runs as figures of Matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from starl._extras import needed

if TYPE_CHECKING:
    import matplotlib.axes

    from starl._tables import Table

#: Seconds between the points of a path.
_PERIOD_NS = 100_000_000


def paths(poses: Table) -> dict[int, NDArray[np.float64]]:
    """The path of each robot from the records of poses: rows of time, x, y, z, every tenth of a second."""
    columns = poses.to_numpy()
    rows = np.column_stack([columns[name] for name in ("time", "x", "y", "z")])
    found = {}
    for robot in np.unique(columns["robot"]):
        own = columns["robot"] == robot
        tenths = columns["time_ns"][own] // _PERIOD_NS
        first = np.concatenate([[True], tenths[1:] != tenths[:-1]])
        first[-1] = True
        found[int(robot)] = rows[own][first]
    return found


def plot(
    poses: Table, names: list[str], world: dict[str, Any], ax: matplotlib.axes.Axes | None
) -> matplotlib.axes.Axes:
    """Draws the world from above, the robots' paths and where they end."""
    if ax is None:
        ax = needed("matplotlib.pyplot", "plot").subplots(figsize=(6.4, 6.4), layout="constrained")[1]
    for one in world["obstacles"]:
        _draw(ax, one["obstacle"])
    for point in world["way_points"]:
        place = (point["position"]["x"], point["position"]["y"])
        ax.plot(*place, marker="x", color="0.4", linestyle="none")
        ax.annotate(point["name"], place, (3, 3), textcoords="offset points", color="0.4", fontsize=7)
    for robot, path in paths(poses).items():
        name = names[robot] if robot < len(names) else str(robot)
        [line] = ax.plot(path[:, 1], path[:, 2], linewidth=1, label=name)
        ax.plot(path[-1, 1], path[-1, 2], marker="o", color=line.get_color())
    ax.set_aspect("equal")
    ax.set_xlabel("x (m)")
    ax.set_ylabel("y (m)")
    if 1 < len(names) <= 12 and ax.get_legend_handles_labels()[0]:
        ax.legend(fontsize=7)
    return ax


def _draw(ax: matplotlib.axes.Axes, obstacle: dict[str, Any]) -> None:
    """Draws the outline of an obstacle; a polygon of two corners is a wall."""
    from matplotlib.patches import Circle, Patch, Polygon

    [(shape, of)] = obstacle.items()
    look: dict[str, Any] = {"facecolor": "0.85", "edgecolor": "0.4", "zorder": 0}
    patch: Patch
    if shape == "Circle":
        patch = Circle((of["center"]["x"], of["center"]["y"]), of["radius"], **look)
    elif shape == "Cuboid":
        low, high = of["low"], of["high"]
        corners = [(low["x"], low["y"]), (high["x"], low["y"]), (high["x"], high["y"]), (low["x"], high["y"])]
        patch = Polygon(corners, closed=True, **look)
    else:
        patch = Polygon([(corner["x"], corner["y"]) for corner in of["base"]], closed=True, **look)
    ax.add_patch(patch)
