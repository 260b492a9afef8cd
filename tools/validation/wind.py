"""A drone that holds its place in wind."""

import math

from .chart import chart, table

HOLD = """/// Holds its first waypoint.
program Hold

motion = ReachAvoid()

go()
    pre not motion.active and not motion.done
    eff if some place = way_points().first()
            motion.reach_avoid(place, obstacles())
"""


def offsets(simulator, steady, gust=0.0, period=5.0, noise=0):
    """Seconds and distances in the plane from the waypoint, after 15 s."""
    trace = simulator.run(
        f"""
program = "hold.starl"
duration = "60s"
goal = "duration"
[[world.way_point]]
name = "home"
position = [0, 0, 2]
[positioning]
position_noise = "{noise}mm"
[wind]
steady = [{steady}, 0]
gust = [{gust}, 0]
gust_period = "{period}s"
[[robots]]
model = "drone"
[[robots.start]]
position = [0, 0, 2]
""",
        hold=HOLD,
    )
    poses = [(time * 1e-9, math.hypot(pose["x"], pose["y"])) for time, pose in trace["pose"]]
    return [(time, offset) for time, offset in poses if time >= 15]


def validate(simulator, folder):
    drag, tilt = 0.3 / 0.42, math.radians(20)
    most = 9.80665 * math.tan(tilt) / drag
    speeds = [0, 1, 2, 3, 4, 4.5, 4.8, 5.0, 5.2]
    worst = lambda found: max(offset for _, offset in found)
    noises = [0, 10]
    steady = [(noise, [(speed, worst(offsets(simulator, speed, noise=noise))) for speed in speeds]) for noise in noises]
    periods = [0.5, 1, 2, 3, 5, 7, 10]
    gusts = [(size, [(period, worst(offsets(simulator, 2, size, period))) for period in periods]) for size in (1, 2)]
    held = [(f"noise of {noise} mm", [(at, offset) for at, offset in found if at < most]) for noise, found in steady]
    (folder / "wind.svg").write_text(chart("A drone in steady wind", "wind, m/s", "greatest offset, m", held))
    lines = [(f"gusts of {size} m/s", found) for size, found in gusts]
    limit = [(period, 0.2) for period in periods]
    (folder / "gusts.svg").write_text(
        chart("Gusts around a wind of 2 m/s", "period, s", "greatest offset, m", [*lines, ("0.2 m", limit, "dashed")])
    )
    first = table(
        ["steady wind, m/s", *speeds],
        [
            [f"noise of {noise} mm: greatest offset, m", *(f"{offset:.4f}" for _, offset in found)]
            for noise, found in steady
        ],
    )
    second = table(
        ["period of gusts, s", *periods],
        [[f"gusts of {size} m/s: greatest offset, m", *(f"{offset:.2f}" for _, offset in found)] for size, found in gusts],
    )
    strongest = f"The greatest tilt holds against {most:.2f} m/s."
    return f"{strongest}\n\n{first}\n\n{second}"
