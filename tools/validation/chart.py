"""Line charts as SVG."""

import math

COLORS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#785e28"]
WIDTH, HEIGHT, LEFT, TOP = 460, 260, 70, 40


def ticks(low, high, log):
    if log:
        return [10.0**power for power in range(math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9) + 1)]
    rough = (high - low) / 6
    power = 10 ** math.floor(math.log10(rough))
    step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= rough)
    return [step * number for number in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def chart(title, x_axis, y_axis, lines, log_x=False, log_y=False):
    """A chart; `lines` are pairs of a name and points, with "dots" or "dashed" as an optional third member."""
    every = [point for line in lines for point in line[1]]
    scale = lambda log: (lambda value: math.log10(value)) if log else (lambda value: value)
    to_x, to_y = scale(log_x), scale(log_y)
    low_x, high_x = min(x for x, _ in every), max(x for x, _ in every)
    low_y, high_y = min(y for _, y in every), max(y for _, y in every)
    if log_y:
        low_y, high_y = 10 ** math.floor(math.log10(low_y)), 10 ** math.ceil(math.log10(high_y))
    else:
        low_y, high_y = min(low_y, 0), high_y * 1.05 or 1
    place = lambda low, high, value: (value - low) / ((high - low) or 1)
    spot = lambda x, y: (
        LEFT + WIDTH * place(to_x(low_x), to_x(high_x), to_x(x)),
        TOP + HEIGHT * (1 - place(to_y(low_y), to_y(high_y), to_y(y))),
    )
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH + 290}" height="{HEIGHT + 100}" '
        f'viewBox="0 0 {WIDTH + 290} {HEIGHT + 100}" font-family="DejaVu Sans, Verdana, Arial, sans-serif" font-size="12">',
        '<rect width="100%" height="100%" fill="#fff"/>',
        f'<text x="{LEFT}" y="22" font-size="15">{title}</text>',
    ]
    for x in ticks(low_x, high_x, log_x):
        at, base = spot(x, low_y)
        out.append(f'<path d="M{at:.1f} {base:.1f}V{TOP}" stroke="#e8e8e8"/>')
        out.append(f'<text x="{at:.1f}" y="{base + 17:.1f}" text-anchor="middle">{x:g}</text>')
    for y in ticks(low_y, high_y, log_y):
        left, at = spot(low_x, y)
        out.append(f'<path d="M{left:.1f} {at:.1f}H{LEFT + WIDTH}" stroke="#e8e8e8"/>')
        out.append(f'<text x="{left - 6:.1f}" y="{at + 4:.1f}" text-anchor="end">{y:g}</text>')
    out.append(f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#333"/>')
    for index, (name, points, *look) in enumerate(lines):
        color, row = COLORS[index % len(COLORS)], TOP + 10 + 20 * index
        spots = [spot(x, y) for x, y in points]
        dash = ' stroke-dasharray="6 4"' if "dashed" in look else ""
        if "dots" in look:
            out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.5" fill="{color}"/>' for x, y in spots]
            out.append(f'<circle cx="{LEFT + WIDTH + 30}" cy="{row}" r="2.5" fill="{color}"/>')
        else:
            path = "L".join(f"{x:.1f} {y:.1f}" for x, y in spots)
            out.append(f'<path d="M{path}" fill="none" stroke="{color}" stroke-width="1.6"{dash}/>')
            out.append(f'<path d="M{LEFT + WIDTH + 18} {row}h24" stroke="{color}" stroke-width="1.6"{dash}/>')
        out.append(f'<text x="{LEFT + WIDTH + 48}" y="{row + 4}">{name}</text>')
    middle = TOP + HEIGHT / 2
    out.append(f'<text x="{LEFT + WIDTH / 2}" y="{TOP + HEIGHT + 40}" text-anchor="middle">{x_axis}</text>')
    out.append(f'<text x="16" y="{middle}" text-anchor="middle" transform="rotate(-90 16 {middle})">{y_axis}</text>')
    return "\n".join([*out, "</svg>", ""])


def table(head, rows):
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)
