"""Small charts as SVG text: curves on logarithmic axes and stacked bars. Uses only the standard library."""
import html
import math

# Colours that colour-blind readers can distinguish (Okabe and Ito), and a dash pattern each for grey print.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999", "#8c564b", "#f0e442"]
DASHES = ["", "6 3", "2 3", "8 3 2 3", "1 2", "10 4"]
FONT = 'font-family="sans-serif" font-size="12"'


def _frame(width, height, title, body):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'role="img" aria-label="{html.escape(title)}">\n<rect width="{width}" height="{height}" fill="white"/>\n'
            f'<text x="{width / 2}" y="18" text-anchor="middle" {FONT} font-weight="bold">{html.escape(title)}</text>\n'
            + "\n".join(body) + "\n</svg>\n")


def _number(x):
    return f"{x:g}" if 1e-3 <= abs(x) < 1e6 or x == 0 else f"{x:.0e}"


def _ticks(low, high, logarithmic):
    if logarithmic:
        ticks = [10.0 ** k for k in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)]
        if len(ticks) < 3:
            ticks = sorted(t * m for t in ticks for m in (1, 2, 5))
        return [t for t in ticks if low * 0.999 <= t <= high * 1.001]
    step = 10.0 ** math.floor(math.log10((high - low) / 4 or 1.0))
    step *= next(m for m in (1, 2, 5, 10) if (high - low) / (step * m) <= 6)
    first = math.ceil(low / step - 1e-9)
    return [round(k * step, 12) for k in range(first, math.floor(high / step + 1e-9) + 1)]


def curves(title, x_label, y_label, series, x_log=True, y_log=True, y_range=None):
    """series: list of (name, [(x, y), ...]) or (name, points, colour, dashes), the last two as indices; a name that ends in *
    is drawn without markers (a reference line)."""
    series = [(s[0], s[1], *(s[2:] or (k, k))) for k, s in enumerate(series)]
    rows = max(2, (len(series) + 2) // 3)
    width, left, right, top, bottom = 640, 66, 20, 34, 56 + 18 * rows
    height = 288 + bottom
    xs = [x for _, points, *_ in series for x, _ in points]
    ys = [y for _, points, *_ in series for _, y in points]
    x_low, x_high = min(xs), max(xs)
    y_low, y_high = y_range or (min(ys), max(ys))
    if y_log and not y_range:
        y_low, y_high = y_low / 1.4, y_high * 1.4

    def place(value, low, high, log, start, length):
        if log:
            value, low, high = math.log10(value), math.log10(low), math.log10(high)
        return start + length * ((value - low) / (high - low) if high > low else 0.5)

    def at(x, y):
        return (place(x, x_low, x_high, x_log, left, width - left - right),
                place(y, y_low, y_high, y_log, height - bottom, -(height - top - bottom)))

    body = []
    for tick in _ticks(y_low, y_high, y_log):
        y = at(x_low, tick)[1]
        body.append(f'<line x1="{left}" x2="{width - right}" y1="{y:.1f}" y2="{y:.1f}" stroke="#dddddd"/>'
                    f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end" {FONT}>{_number(tick)}</text>')
    for tick in _ticks(x_low, x_high, x_log):
        x = at(tick, y_low)[0]
        body.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{height - bottom}" stroke="#eeeeee"/>'
                    f'<text x="{x:.1f}" y="{height - bottom + 16}" text-anchor="middle" {FONT}>{_number(tick)}</text>')
    body.append(f'<rect x="{left}" y="{top}" width="{width - left - right}" height="{height - top - bottom}" fill="none" '
                f'stroke="#444444"/>')
    body.append(f'<text x="{(left + width - right) / 2}" y="{height - bottom + 36}" text-anchor="middle" {FONT}>'
                f'{html.escape(x_label)}</text>')
    middle = (top + height - bottom) / 2
    body.append(f'<text x="16" y="{middle}" text-anchor="middle" transform="rotate(-90 16 {middle})" {FONT}>'
                f'{html.escape(y_label)}</text>')
    for index, (name, points, colour, dash) in enumerate(series):
        colour, dash = COLOURS[colour % len(COLOURS)], DASHES[dash % len(DASHES)]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (at(*p) for p in sorted(points)))
        body.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2" '
                    f'stroke-dasharray="{dash}"/>')
        if not name.endswith("*"):
            body += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in (at(*p) for p in points)]
        column, row = index % 3, index // 3
        x, y = left + column * 190, height - 18 * rows + row * 18
        body.append(f'<line x1="{x}" x2="{x + 26}" y1="{y - 4}" y2="{y - 4}" stroke="{colour}" stroke-width="2" '
                    f'stroke-dasharray="{dash}"/><text x="{x + 32}" y="{y}" {FONT}>{html.escape(name.rstrip("*"))}</text>')
    return _frame(width, height, title, body)


def stacked_bars(title, x_label, bars):
    """bars: list of (name, {part: amount}), drawn from the left; the parts of all bars share one legend."""
    parts = []
    for _, amounts in bars:
        parts += [p for p in amounts if p not in parts]
    parts.sort(key=lambda p: -sum(amounts.get(p, 0) for _, amounts in bars))
    width, left, right, top, row = 640, 190, 20, 34, 34
    rows_of_legend = (len(parts) + 3) // 4
    height = top + row * len(bars) + 46 + 18 * rows_of_legend
    most = max(sum(amounts.values()) for _, amounts in bars)
    scale = (width - left - right) / most
    body = []
    bottom = top + row * len(bars)
    for tick in _ticks(0.0, most, False):
        x = left + tick * scale
        body.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{bottom}" stroke="#dddddd"/>'
                    f'<text x="{x:.1f}" y="{bottom + 15}" text-anchor="middle" {FONT}>{_number(tick)}</text>')
    body.append(f'<text x="{(left + width - right) / 2}" y="{bottom + 33}" text-anchor="middle" {FONT}>'
                f'{html.escape(x_label)}</text>')
    for index, (name, amounts) in enumerate(bars):
        y, x = top + row * index + 5, float(left)
        body.append(f'<text x="{left - 8}" y="{y + 16}" text-anchor="end" {FONT}>{html.escape(name)}</text>')
        for part in parts:
            length = amounts.get(part, 0) * scale
            if length > 0:
                body.append(f'<rect x="{x:.1f}" y="{y}" width="{length:.1f}" height="{row - 10}" '
                            f'fill="{COLOURS[parts.index(part) % len(COLOURS)]}" stroke="white" stroke-width="0.5"/>')
            x += length
    for index, part in enumerate(parts):
        x, y = 20 + (index % 4) * 152, bottom + 56 + 18 * (index // 4)
        body.append(f'<rect x="{x}" y="{y - 10}" width="12" height="12" fill="{COLOURS[index % len(COLOURS)]}"/>'
                    f'<text x="{x + 18}" y="{y}" {FONT}>{html.escape(part)}</text>')
    return _frame(width, height, title, body)
