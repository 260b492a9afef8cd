"""Motion of each model under one command, against its closed form or a fine integration of its published equations."""

import math

from .chart import chart, table

STEPS_MS = [1, 2, 5, 10, 25, 50]
SECONDS = 5
GRAVITY = 9.80665


def scenario(model, step, parameters, height=0.0):
    listed = "\n".join(f"{name} = {value}" for name, value in parameters.items())
    return f"""
program = "drive"
duration = "{SECONDS}s"
goal = "duration"
[parameters]
{listed}
[physics]
step = "{step}ms"
[trace]
pose_period = "{step}ms"
[[robots]]
model = "{model}"
control_period = "50ms"
[[robots.start]]
position = [0, 0, {height}]
"""


def arc(speed, rate):
    """Position on an arc that begins at the origin along x."""

    def place(time):
        if rate == 0:
            return speed * time, 0.0
        return speed / rate * math.sin(rate * time), speed / rate * (1 - math.cos(rate * time))

    return place


def integrated(start, slope, fine=1e-4):
    """The solution of an ordinary differential equation by the classical Runge-Kutta method, at a tenth of a millisecond."""
    states, state, add = [start], start, lambda a, b, share: [x + share * y for x, y in zip(a, b)]
    for number in range(round((SECONDS + 0.1) / fine)):
        time = number * fine
        a = slope(time, state)
        b = slope(time + fine / 2, add(state, a, fine / 2))
        c = slope(time + fine / 2, add(state, b, fine / 2))
        d = slope(time + fine, add(state, c, fine))
        state = [x + fine / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip(state, a, b, c, d)]
        states.append(state)
    return lambda time: tuple(states[round(time / fine)][:2])


def car(speed, angle):
    """The kinematic bicycle (Kong et al. 2015) with constant rates of speed and steering angle."""

    def slope(time, state):
        v, d = min(speed, 2.5 * time), min(angle, math.radians(183) * time)
        b = math.atan(math.tan(d) / 2)
        yaw = state[2]
        return [v * math.cos(yaw + b), v * math.sin(yaw + b), v * math.cos(b) * math.tan(d) / 0.33]

    return integrated([0.0, 0.0, 0.0], slope)


def quadcopter(pitch, frequency=10.0, drag=0.3 / 0.42):
    """A tilt with critically damped attitude and linear drag: closed form of the tilt, and Newton's law."""

    def slope(time, state):
        tilt = pitch * (1 - (1 + frequency * time) * math.exp(-frequency * time))
        return [state[2], 0.0, GRAVITY * math.tan(tilt) - drag * state[2]]

    return integrated([0.0, 0.0, 0.0], slope)


CASES = [
    ("create", "arc of two wheels, closed form", {"command": '"wheels"', "left": 0.2, "right": 0.3}, arc(0.25, 0.1 / 0.258)),
    ("differential", "arc of two wheels, closed form", {"command": '"wheels"', "left": 0.1, "right": 0.2}, arc(0.15, 0.1 / 0.14)),
    ("holonomic", "straight line, closed form", {"command": '"velocity"', "speed": 0.7}, arc(0.7, 0.0)),
    ("car", "kinematic bicycle, integrated", {"command": '"steer"', "speed": 1.2, "angle": 0.3}, car(1.2, 0.3)),
    ("drone", "tilt and drag, integrated", {"command": '"attitude"', "pitch": 0.2}, quadcopter(0.2)),
]


def errors(simulator, model, parameters, expected, step):
    """Times and distances from where the robot should be. It begins to move in the step of its first activation."""
    trace = simulator.run(scenario(model, step, parameters, 2.0 if model == "drone" else 0.0))
    poses = [(time * 1e-9, pose["x"], pose["y"]) for time, pose in trace["pose"]]
    moves = next(index for index, (_, x, y) in enumerate(poses) if x or y)
    begin = poses[moves][0] - step * 1e-3
    found = []
    for time, x, y in poses[moves:]:
        at = expected(time - begin)
        found.append((time - begin, math.dist((x, y), at)))
    return found


def validate(simulator, folder):
    rows, lines = [], []
    for model, what, parameters, expected in CASES:
        worst = []
        for step in STEPS_MS:
            found = errors(simulator, model, parameters, expected, step)
            assert found[-1][0] > SECONDS - 0.2
            worst.append(max(error for _, error in found))
        rows.append([f"`{model}`", what, *(f"{error:.1e}" for error in worst)])
        # Nothing is exact to less than a picometre after rounding.
        lines.append((model, [(step, max(error, 1e-16)) for step, error in zip(STEPS_MS, worst)]))
    picture = chart(
        "Greatest error of the position in 5 s", "physics step, ms", "metres", lines, log_x=True, log_y=True
    )
    (folder / "steps.svg").write_text(picture)
    return table(["model", "against", *(f"{step} ms" for step in STEPS_MS)], rows)
