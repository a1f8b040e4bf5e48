#!/usr/bin/env python3
"""Fills the tables and plots of docs/performance.md from a recorded benchmark run.

usage: bench/make_performance_page.py [RUN]

RUN is a file of bench/history (or a part of its name); without it the newest one. Everything between the marks <!-- BEGIN name
--> and <!-- END name --> is replaced, and the plots in docs/figures are redrawn.
"""
import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import history  # noqa: E402
import paper_figures  # noqa: E402
import race_table  # noqa: E402
import start_table  # noqa: E402
import svg_chart  # noqa: E402

PAGE = history.ROOT / "docs" / "performance.md"
FIGURES = history.ROOT / "docs" / "figures"
COMBINATIONS = [(c, i) for c in ("relative", "absolute") for i in ("preprocessing", "projection")]


def name(row):
    return f"{row['coordinates'][:3].capitalize()}. + {'P' if row['inertia'] == 'preprocessing' else 'B'}"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def small(x):
    """3.2e-6; nothing for None."""
    if x is None:
        return ""
    mantissa, exponent = f"{x:.1e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def digits(x):
    """Three digits."""
    return f"{x:.3g}" if abs(x) < 100 else f"{x:,.0f}".replace(",", " ")


def find(rows, **wanted):
    return next((row for row in rows if all(row[key] == value for key, value in wanted.items())), None)


REL_P = {"coordinates": "relative", "inertia": "preprocessing"}
ABS_P = {"coordinates": "absolute", "inertia": "preprocessing"}


def machine(run):
    lines = [f"Figures on this page: {run['cpu']}; floatframe {run['build']}; recorded on {run['date'][:10]} at commit "
             f"{run['commit']}{' with changes' if run['changed_files'] else ''}; one LLT = "
             f"{run['dense_llt_98_us']:.1f} µs."]
    return "\n".join(lines + ([run["note"]] if run.get("note") else []))


def summary(run):
    rows = []

    def add(what, value, goal, met, form="{:.2f}"):
        rows.append([what, form.format(value), goal, "yes" if met else "no"])

    chain, llt = run["chain"]["rows"], run["chain"]["dense_llt_98_us"]
    for links, goal in ((1, 0.25), (4, 1.5), (16, 6.5)):
        row = find(chain, links=links, modes=8, **REL_P)
        if row:
            value = row["us_per_step_min"] / llt
            add(f"chain of {links}, Rel. + P, a step [LLTs]", value, f"at most {goal}", value <= goal, "{:.3f}")
    row = find(chain, links=4, modes=8, **REL_P)
    if row and row["tip_error_m"] is not None:
        add("chain of 4, tip error against 0.05 ms [m]", row["tip_error_m"], "below 3e-5", row["tip_error_m"] < 3e-5,
            "{:.1e}")
        add("chain of 4, tip to solid elements [m]", row["tip_to_published_m"], "below 3e-4",
            row["tip_to_published_m"] < 3e-4, "{:.1e}")
    scaling = run.get("scaling", {}).get("rows", [])
    bodies = {r["value"]: r["us_per_iteration_min"] / r["value"] for r in scaling
              if r["sweep"] == "bodies" and name(r) == "Rel. + P" and r["failure"] is None}
    for links in (64, 256):
        if links in bodies and 16 in bodies:
            value = bodies[links] / bodies[16]
            add(f"chain of {links}, an iteration per link, over that of 16 links", value, "within 15 %",
                abs(value - 1) <= 0.15)
    for sweep, what in (("elements", "36 to 100 206 degrees of freedom per link"), ("interface-nodes", "4 to 100 interface nodes")):
        ratios = [r["iteration_ratio"] for r in scaling if r["sweep"] == sweep and name(r) == "Rel. + P"]
        if ratios:
            worst = max(ratios, key=lambda x: abs(x - 1))
            add(f"{what}, an iteration: ratio farthest from 1", worst, "1.00 ± 0.05", abs(worst - 1) <= 0.05)
    iltis, llt = run["iltis"]["rows"], run["iltis"]["dense_llt_98_us"]
    elements = max(r["elements_per_bar"] for r in iltis)
    rel, absolute = (find(iltis, elements_per_bar=elements, **c) for c in (REL_P, ABS_P))
    value = rel["llt_per_step_min"]
    add("Iltis, Rel. + P, a step of 10 ms [LLTs]", value, "at most 2.5", value <= 2.5)
    with_error = ", ".join(f"{digits(1e3 * e['step_s'])} ms: {small(e['error_m'])} m" for e in run["iltis"].get("errors", [])[:1])
    add("Iltis, Rel. + P, times real time" + (f" (step and error: {with_error})" if with_error else ""),
        rel["real_time_factor"], "about 200", rel["real_time_factor"] >= 200, "{:.0f}")
    value = run["iltis"]["rel_p_iteration_us"] / llt
    add("Iltis, Rel. + P, one full Newton iteration [LLTs]", value, "at most 1", value <= 1)
    value = absolute["cpu_s_min"] / rel["cpu_s_min"]
    add("Iltis, Abs. + P over Rel. + P", value, "at most 4", value <= 4)
    for what, case in run.get("instructions", {}).get("cases", {}).items():
        if "relative" in what:
            calls = case["heap_calls"] + case["memory_copy_calls"] + case["virtual_calls"]
            add(f"{what}: calls of malloc, memcpy, virtual functions", calls, "0", calls == 0, "{}")
    return table(["figure", "here", "goal", "met"], rows)


def chain(run):
    rows = run["chain"]["rows"]
    out = []
    for row in rows:
        if row["failure"] is not None:
            out.append([str(row["links"]), name(row)] + [""] * 8)
            continue
        out.append([str(row["links"]), name(row), digits(row["us_per_step_min"]), digits(row["us_per_step_median"]),
                    f"{row['llt_per_step_min']:.3f}", f"{row['iterations_per_step']:.2f}",
                    f"{row['factorizations_per_step']:.2f}", small(row["tip_error_m"]), small(row["tip_to_published_m"]),
                    small(row["energy_drift"])])
    series = [(name(dict(coordinates=c, inertia=i)),
               [(r["links"], r["llt_per_step_min"]) for r in rows
                if (r["coordinates"], r["inertia"]) == (c, i) and r["modes"] == 8 and r["failure"] is None])
              for c, i in COMBINATIONS]
    series = [s for s in series if s[1]]
    first = series[0][1]
    series.append(("linear in N*", [(n, first[0][1] * n / first[0][0]) for n, _ in first]))
    (FIGURES / "chain_links.svg").write_text(svg_chart.curves(
        "Chain of flexible links, 8 modes, 1 ms", "links N", "time per step [LLTs]", series))
    steps = {r["steps"] for r in rows}
    note = ""
    if len(steps) > 1:
        shorter = ", ".join(f"{r['links']} links {name(r)} {r['steps']}" for r in rows if r["steps"] < max(steps))
        note = f"\n\nRuns of {max(steps)} steps; those that take long are cut: {shorter} steps."
    return table(["N", "", "µs per step, minimum", "median", "LLTs", "iterations", "factorisations", "tip error [m]",
                  "to published [m]", "energy drift"], out) + note


def sweep_table(run, sweep, header):
    rows = [r for r in run.get("scaling", {}).get("rows", []) if r["sweep"] == sweep and r["failure"] is None]
    counted = {}
    key = {"elements": "elements", "interface-nodes": "interface nodes", "modes": "modes", "bodies": "links"}[sweep]
    for what, case in run.get("instructions", {}).get("cases", {}).items():
        match = re.fullmatch(rf"{key} (\d+)", what)
        if match:
            counted[int(match[1])] = case["instructions_per_iteration"]
    combinations = [c for c in COMBINATIONS if any((r["coordinates"], r["inertia"]) == c for r in rows)]
    head = list(header)
    for c, i in combinations:
        head += [f"{name(dict(coordinates=c, inertia=i))}, µs per iteration", "ratio"]
        if sweep == "bodies":
            head += ["per link"]
    if counted:
        head += ["Rel. + P, instructions per iteration"]
    lines = []
    for value in sorted({r["value"] for r in rows}):
        here = [r for r in rows if r["value"] == value]
        line = [f"{value}"] + ([f"{here[0]['finite_element_dofs']}"] if len(header) > 1 else [])
        for c, i in combinations:
            row = find(here, coordinates=c, inertia=i)
            line += [digits(row["us_per_iteration_min"]), f"{row['iteration_ratio']:.3f}"] if row else ["", ""]
            if sweep == "bodies":
                line += [digits(row["us_per_iteration_min"] / value) if row else ""]
        if counted:
            line += [f"{counted[value]:,.0f}".replace(",", " ") if value in counted else ""]
        lines.append(line)
    return table(head, lines) if lines else "Not in this recorded run."


def scaling_plots(run):
    rows = [r for r in run.get("scaling", {}).get("rows", []) if r["failure"] is None]

    def series(sweep, x, y):
        out = []
        for c, i in COMBINATIONS:
            points = [(r[x], r[y]) for r in rows if r["sweep"] == sweep and (r["coordinates"], r["inertia"]) == (c, i)]
            if points:
                out.append((name(dict(coordinates=c, inertia=i)), points))
        return out

    mesh = series("elements", "finite_element_dofs", "iteration_ratio")
    if mesh:
        (FIGURES / "mesh.svg").write_text(svg_chart.curves(
            "Time of a Newton iteration against the mesh (20 elements: 1)", "degrees of freedom per link", "ratio", mesh,
            y_log=False, y_range=(0.0, 1.5)))
    modes = series("modes", "value", "us_per_iteration_min")
    if modes:
        base = dict(modes[0][1]).get(8)
        if base:
            modes.append(("k²*", [(k, base * (k / 8) ** 2) for k, _ in modes[0][1] if k >= 8]))
        (FIGURES / "modes.svg").write_text(svg_chart.curves(
            "Chain of four links: time of a Newton iteration", "modes per link", "µs", modes))


def iltis(run):
    rows, llt = run["iltis"]["rows"], run["iltis"]["dense_llt_98_us"]
    elements = sorted({r["elements_per_bar"] for r in rows})
    times, cost = [], []
    for c, i in [("absolute", "projection"), ("absolute", "preprocessing"), ("relative", "projection"),
                 ("relative", "preprocessing")]:
        of = [find(rows, coordinates=c, inertia=i, elements_per_bar=n) for n in elements]
        title = name(of[0])
        if elements == [5, 10, 50, 100]:
            times.append([f"{title}, paper"] + [f"{s:.2f}" for s in paper_figures.PAPER[c, i]])
        times.append([f"{title}, here"] + [f"{r['cpu_s_min']:.4f}" for r in of])
        last = of[-1]
        cost.append([title, f"{1e6 * last['cpu_s_min'] / last['iterations']:.1f}", f"{last['us_per_step_min']:.1f}",
                     f"{last['llt_per_step_min']:.2f}", f"{last['real_time_factor']:.0f}",
                     f"{last['iterations'] / last['steps']:.2f}", f"{last['factorizations'] / last['steps']:.2f}",
                     small(last["max_position_violation_m"]), small(last["max_velocity_violation_m_s"])])
    (FIGURES / "paper_7.svg").write_text(paper_figures.time_figure(rows))
    one = run["iltis"]["rel_p_iteration_us"]
    errors = [[digits(1e3 * e["step_s"]), f"{e['cpu_s_min']:.4f}", digits(e["real_time_factor"]), small(e["error_m"]),
               e["channel"], digits(e["time_s"])] for e in run["iltis"].get("errors", [])]
    return "\n\n".join([
        table([""] + [str(n) for n in elements], times),
        f"The cost of a step at {elements[-1]} elements per bar:",
        table(["", "µs per iteration", "µs per step", "LLTs", "times real time", "iterations", "factorisations",
               "positions [m]", "velocities [m/s]"], cost),
        *(["Cost beside error, Rel. + P: the largest error of a position among the outputs, against steps of a hundredth:",
           table(["step [ms]", "processor seconds", "times real time", "largest error [m]", "of", "at [s]"], errors)]
          if errors else []),
        f"One full Newton iteration, Rel. + P (kinematics, inertia, forces, residual, factorisation, solution): "
        f"{one:.1f} µs, {one / llt:.2f} LLT."])


def preprocessing(run):
    rows = run["iltis"]["preprocessing"]
    return table([""] + [str(r["elements_per_bar"]) for r in rows],
                 [["reading the model file"] + [f"{1e3 * r['read_s']:.1f}" for r in rows],
                  ["preprocessing"] + [f"{1e3 * r['build_s']:.1f}" for r in rows]])


def instructions(run):
    cases = run.get("instructions", {}).get("cases", {})
    shown = {what: case for what, case in cases.items() if "," in what}
    if not shown:
        return "Not in this recorded run."
    rooms = sorted({room for case in shown.values() for room in case["rooms"]},
                   key=lambda room: -sum(case["rooms"].get(room, 0) for case in shown.values()))
    number = "{:,.0f}".format
    lines = [[room] + [number(case["rooms"].get(room, 0)).replace(",", " ") for case in shown.values()] for room in rooms]
    for title, key in (("**all**, a step", "instructions_per_step"), ("an iteration", "instructions_per_iteration")):
        lines.append([title] + [number(case[key]).replace(",", " ") for case in shown.values()])
    for title, key in (("iterations per step", "iterations_per_step"), ("factorisations per step", "factorizations_per_step")):
        lines.append([title] + [f"{case[key]:.2f}" for case in shown.values()])
    for title, key in (("calls of malloc and free", "heap_calls"), ("calls of memcpy and memmove", "memory_copy_calls"),
                       ("virtual calls", "virtual_calls")):
        lines.append([title] + [str(case[key]) for case in shown.values()])
    (FIGURES / "instructions.svg").write_text(svg_chart.stacked_bars(
        "Instructions per step", "thousands",
        [(what.replace("preprocessing", "P"), {room: n / 1e3 for room, n in case["rooms"].items()
                                               if n >= 0.005 * case["instructions_per_step"]})
         for what, case in shown.items()]))
    text = table(["room"] + list(shown), lines)
    return text + (f"\n\nBuild: {run['instructions']['build']}, with line tables. Calls are those of all steps of "
                   "a run.\n\n![instructions per step by room](figures/instructions.svg)")


def kernels(run):
    if "kernels" not in run:
        return "Not in this recorded run."
    found = {}
    for entry in run["kernels"]:
        match = re.fullmatch(r"(\w+)_cell/nodes:(\d+)/modes:(\d+)", entry["name"])
        if match:
            found[(match[1].replace("_", ", "), int(match[2]), int(match[3]))] = entry["us"]
    parts = []
    for fixed, what in ((6, "6 modes, by nodes"), (101, "101 nodes, by modes")):
        index = 2 if fixed == 6 else 1
        columns = sorted({k[3 - index] for k in found if k[index] == fixed})
        cells = list(dict.fromkeys(k[0] for k in found))
        lines = []
        for cell in cells:
            keys = [(cell, n, fixed) if fixed == 6 else (cell, fixed, n) for n in columns]
            lines.append([cell] + [f"{found[k]:.3g}" if k in found else "" for k in keys])
        parts.append(table([what] + [str(n) for n in columns], lines))
    return "\n\n".join(parts)


BLOCKS = {
    "machine": machine, "summary": summary, "chain": chain,
    "elements": lambda run: sweep_table(run, "elements", ["elements", "degrees of freedom"]),
    "interface-nodes": lambda run: sweep_table(run, "interface-nodes", ["face nodes", "degrees of freedom"]),
    "modes": lambda run: sweep_table(run, "modes", ["modes"]),
    "bodies": lambda run: sweep_table(run, "bodies", ["links"]),
    "iltis": iltis, "preprocessing": preprocessing, "instructions": instructions, "kernels": kernels,
    "starts": start_table.block,  # from the record bench/starts.json
    "race": race_table.block,  # from the record bench/peers/record.json
}


def main():
    if len(sys.argv) > 2 or (len(sys.argv) == 2 and sys.argv[1] in ("-h", "--help")):
        print(__doc__)
        return 0 if len(sys.argv) == 2 else 2
    file = history.load(sys.argv[1] if len(sys.argv) == 2 else None, 1)
    run = json.loads(file.read_text())
    FIGURES.mkdir(exist_ok=True)
    text = PAGE.read_text(encoding="utf-8")
    for block, fill in BLOCKS.items():
        pattern = re.compile(rf"(<!-- BEGIN {block} -->\n).*?(<!-- END {block} -->)", re.S)
        content = fill(run)
        text, count = pattern.subn(lambda m: m[1] + content + "\n" + m[2], text)
        if count != 1:
            history.fail(f"{PAGE.name}: found {count} blocks '{block}', expected one")
    scaling_plots(run)
    PAGE.write_text(text, encoding="utf-8")
    print(f"{PAGE.relative_to(history.ROOT)} from {file.name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
