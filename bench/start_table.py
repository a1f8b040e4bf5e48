#!/usr/bin/env python3
"""The table of starts in docs/performance.md.

usage: bench/start_table.py [--program FILE] [--from N] [--to N]

Runs `floatframe bench start`, writes bench/starts.json and fills the table.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import race_table  # noqa: E402
from race_table import digits  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECORD = ROOT / "bench" / "starts.json"


def series(record):
    found = {}
    for row in record["rows"]:
        found.setdefault((row["model"], row["flexible"], row["coordinates"]), []).append(row)
    return found


def exponent(rows):
    return math.log(rows[-1]["start_s"] / rows[0]["start_s"]) / math.log(rows[-1]["freedoms"] / rows[0]["freedoms"])


def text(record):
    lines = ["| model | | coordinates | freedoms | start [ms] | step [ms] | start / allowed | exponent |",
             "|---|---|---|---|---|---|---|---|"]
    for (model, flexible, coordinates), rows in series(record).items():
        lines.append("| " + " | ".join([
            model, "flexible" if flexible else "rigid", coordinates, ", ".join(str(r["freedoms"]) for r in rows),
            ", ".join(digits(1e3 * r["start_s"]) for r in rows), ", ".join(digits(1e3 * r["step_s"]) for r in rows),
            ", ".join(f"{r['start_s'] / r['allowed_s']:.2f}" for r in rows), f"{exponent(rows):.2f}"]) + " |")
    return f"{record['cpu']}; floatframe {record['build']}.\n\n" + "\n".join(lines)


def block(_run=None):
    """The block `starts` of the page."""
    return text(json.loads(RECORD.read_text())) if RECORD.is_file() else "Not recorded yet: `bench/start_table.py`."


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build" / "floatframe"))
    parser.add_argument("--from", dest="least", default="100")
    parser.add_argument("--to", dest="most", default="5000")
    options = parser.parse_args()
    done = subprocess.run([options.program, "bench", "start", "--from", options.least, "--to", options.most, "--overwrite",
                           "--json", str(RECORD)], check=False)
    if done.returncode:
        return done.returncode
    race_table.fill_page("starts", block())
    return 0


if __name__ == "__main__":
    sys.exit(main())
