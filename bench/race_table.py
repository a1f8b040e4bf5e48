"""The tables of the race (bench/peers) for docs/performance.md, from bench/peers/record.json."""
import json
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECORD = ROOT / "bench" / "peers" / "record.json"


def small(x):
    mantissa, exponent = f"{x:.1e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def digits(x):
    return f"{x:.3g}" if abs(x) < 100 else f"{x:,.0f}".replace(",", " ")


def model(entry, date):
    checked = f"Converged answers {small(entry['apart_m'])} m apart (allowed: {small(entry['allowed_m'])} m)"
    if entry.get("date", date) != date:
        checked += f"; of {entry['date']}"
    if "apart_bar_m" in entry:
        checked += (f"; Exudyn with its load on the body (timed) {small(entry['apart_timed_m'])} m, beams and bricks of "
                    f"Floatframe {small(entry['apart_bar_m'])} m")
    lines = [f"**{entry['model']}.** {checked}.", "",
             "| program | setting | step [ms] | largest error [m] | CPU µs per step | CPU ms per second | ratio |",
             "|---|---|---|---|---|---|---|"]
    for row in entry["rows"]:
        lines.append("| " + " | ".join([row["code"], row["setting"], f"{1e3 * row['step_s']:g}", small(row["error_m"]),
                                        digits(row["us_per_step"]), digits(1e3 * row["cpu_s"]),
                                        digits(row["ratio"])]) + " |")
    return "\n".join(lines)


def text(record):
    versions = ", ".join(f"{name} {version}" for name, version in record["versions"].items())
    head = (f"{record['cpu']}; {record['build']}; Python {record['python']}, {versions}; one thread, least of "
            f"{record['rounds']} rounds in turn after one of warm-up; {record['date'][:10]}.")
    return "\n\n".join([head + (" " + record["note"] if record.get("note") else "")]
                       + [model(entry, record["date"][:10]) for entry in record["models"]])


def block(_run=None):
    """The block `race` of the page."""
    return text(json.loads(RECORD.read_text())) if RECORD.is_file() else "Not recorded yet: `make race`."


def fill_page(name="race", content=None):
    """Replaces one block of docs/performance.md."""
    page = ROOT / "docs" / "performance.md"
    pattern = re.compile(rf"(<!-- BEGIN {name} -->\n).*?(<!-- END {name} -->)", re.S)
    page.write_text(pattern.sub(lambda m: m[1] + (content or block()) + "\n" + m[2], page.read_text(encoding="utf-8")),
                    encoding="utf-8")
