#!/usr/bin/env python3
"""Figures of the project that must not grow unseen: figures.txt beside this file holds the most that each may be, the least
of those that end with "at least".

usage: tests/held_figures/held_figures_test.py [--instructions PROGRAM] [--print]

Without options: what the sources alone show. --instructions: instructions of the steps of a run and of full Newton
iterations, counted by valgrind in a release build (its copy for the processor's instruction set). --print: only prints what
is measured, in the format of figures.txt. Exit code 1 and one line for each figure that is larger; a figure that has become
smaller by more than a tenth should be entered anew.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SOURCES = ROOT / "src" / "floatframe"
COUNTED = "floatframe_counted_steps"
COUNTED_START = "floatframe_counted_start"
COMPILER = "GNU 12"
ROOMS_OF_RUNS = ["loops", "tangents", "start", "reactions", "stepping", "run", "linear", "rotors", "advice"]
ROOMS_OF_STEPS = {"math", "inertia", "model", "formulation", "integrator", "tangents", "start", "reactions", "stepping", "run"}
LISTS = {
    "joint": ("description/joint_list.hpp", "JointType"),
    "constraint": ("model/constraint_list.hpp", "ConstraintType"),
    "force": ("description/elements.hpp", "ElementType"),
    "output": ("description/output_list.hpp", "OutputType"),
    "element": ("fe/element_list.hpp", "FeElementType"),
}
# From the flat onto the waves; its inputs jump by 8 N, what the skyhook of the example changes in a step of 1 ms.
DAMPER = ["examples/active_damper/active_damper.yaml", "--duration", "0.6", "--set", "largest_force=400", "--coordinates"]
JUMPED = 1.7  # what a step whose inputs have jumped may cost, of one whose inputs have not
ROTOR = ["examples/rotor/rotor.yaml", "--coordinates", "relative", "--iterations", "200"]
# name -> arguments of `floatframe bench step`
COUNTS = {
    "iltis, relative": ["iltis", "--coordinates", "relative", "--duration", "0.2"],
    "iltis, absolute": ["iltis", "--coordinates", "absolute", "--duration", "0.2"],
    "chain of 4 links, relative": ["chain", "--coordinates", "relative", "--duration", "0.2"],
    "chain of 4 links, absolute": ["chain", "--coordinates", "absolute", "--duration", "0.2"],
    "active damper, relative": DAMPER + ["relative"],
    "active damper, relative, inputs that jump": DAMPER + ["relative", "--inputs-jump"],
    "active damper, absolute": DAMPER + ["absolute"],
    "active damper, absolute, inputs that jump": DAMPER + ["absolute", "--inputs-jump"],
    "rotor, sections without inertia": ROTOR + ["--set", "section_inertia=false", "--set", "stiffening=false"],
    "rotor, sections with inertia": ROTOR + ["--set", "stiffening=false"],
    "rotor, with geometric stiffening": ROTOR,
}


# The same force in C++ and as a formula.
LAWS = [["--coordinates", "relative"], ["--coordinates", "absolute"]]

# Starts of systems with massless directions, which dense linear algebra took 20 s for, and of many loops; of the Iltis
# with its equilibrium, which finite differences took 190 million for.
STARTS = {
    "Iltis": ["iltis", "--duration", "0.01"],
    "chain of 111 links, relative": ["chain", "--links", "111", "--coordinates", "relative", "--duration", "0.001"],
    "ladder of 100 fields, relative": ["ladder", "--links", "100", "--coordinates", "relative", "--duration", "0.001"],
    "ladder of 400 fields, relative": ["ladder", "--links", "400", "--coordinates", "relative", "--duration", "0.001"],
    "chain of 111 links, absolute": ["chain", "--links", "111", "--coordinates", "absolute", "--duration", "0.001"],
}


def source_texts():
    return {path: path.read_text(encoding="utf-8") for suffix in ("cpp", "hpp") for path in SOURCES.rglob("*." + suffix)}


def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


def source_figures():
    texts = {path: without_comments(text) for path, text in source_texts().items()}
    figures = {
        "casts in src": sum(len(re.findall(r"\b(?:static|const|reinterpret|dynamic)_cast<", t)) for t in texts.values()),
        "lines of src": sum(t.count("\n") for t in texts.values()),
        "templates over a formulation": sum(len(re.findall(r"template ?<.*(?:class|typename) F\b", t)) for t in texts.values()),
        "asserts in rooms of steps, at least": sum(len(re.findall(r"\bassert\(", t)) for p, t in texts.items()
                                                   if p.relative_to(SOURCES).parts[0] in ROOMS_OF_STEPS),
        "lines of the largest room from loops to advice": max(
            sum(t.count("\n") for p, t in texts.items() if SOURCES / room in p.parents) for room in ROOMS_OF_RUNS),
        "lines of decks and formats": sum(t.count("\n") for p, t in texts.items() if {SOURCES / "formats", SOURCES / "decks"} & set(p.parents)),
        "lines of tests": sum(p.read_text(encoding="utf-8").count("\n") for p in (ROOT / "tests").rglob("*") if p.suffix in (".cpp", ".hpp", ".py")),
    }
    folder = tempfile.mkdtemp(prefix="floatframe-headers-")
    try:
        generated = pathlib.Path(folder) / "generated/floatframe/core"
        generated.mkdir(parents=True)
        (generated / "version.hpp").write_text("#pragma once\n", encoding="utf-8")
        subprocess.run(["cmake", f"-DSOURCE={ROOT / 'src'}", f"-DGENERATED={folder}/generated", f"-DOUTPUT={folder}/out",
                        "-P", str(ROOT / "cmake/public_headers.cmake")], check=True, capture_output=True)
        headers = list(pathlib.Path(folder, "out").rglob("*.hpp"))
        figures["headers installed"] = len(headers)
        figures["lines of headers installed"] = sum(h.read_text(encoding="utf-8").count("\n") for h in headers)
    finally:
        shutil.rmtree(folder)
    # What is added is one file and one entry: other files that name it are what more there is to touch.
    for kind, (list_file, enum) in LISTS.items():
        entries = re.findall(r"entry\((\w+)(?:, \w+)?\)", texts[SOURCES / list_file])
        touched = [sum(1 for p, t in texts.items() if p != SOURCES / list_file and p.stem != name
                       and re.search(rf"\b{enum}::{name}\b", t)) for name in entries]
        figures[f"other files that name a {kind} by its type, all of them"] = sum(touched)
    return figures


def collected(program, arguments, counted=COUNTED):
    """Instructions of a step, of a full iteration or of the start, and the facts that the program writes of the run."""
    with tempfile.TemporaryDirectory(prefix="floatframe-count-") as folder:
        facts = pathlib.Path(folder) / "facts.json"
        command = ["valgrind", "--tool=callgrind", f"--toggle-collect={counted}", f"--callgrind-out-file={folder}/out",
                   str(program), "bench", "step", *arguments, "--json", str(facts)]
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT,
                              env={**os.environ, "LD_BIND_NOW": "1"})
        if done.returncode:
            sys.exit(f"held_figures: `{' '.join(command)}` failed:\n{done.stderr[-2000:]}")
        total = int(re.search(r"Collected : (\d+)", done.stderr)[1])
        words = facts.read_text(encoding="utf-8")
        number = {key: int(re.search(rf'"{key}": (\d+)', words)[1]) for key in ("steps", "full_iterations")}
        each = 1 if counted == COUNTED_START else number["full_iterations"] or number["steps"]
        return total / each, words


def row_of_parallelograms(cells, outputs):
    """Planar, each field repeats three constraints."""
    bar = "{{rigid: {{mass: 1, centre_of_mass: [{}, 0, {}], inertia: [.1, .1, .1]}}}}\n".format
    hinge = "{{type: revolute, parent: {}, child: {}, at: [{}, 0, {}], axis: y{}}}\n".format
    bodies, joints = ["  c0: " + bar(0, 0.5)], ["  a0: " + hinge("ground", "c0", 0, 0, ", velocity: 3")]
    for k in range(1, cells + 1):
        bodies += [f"  c{k}: " + bar(k, 0.5), f"  r{k}: " + bar(k - 0.5, 1)]
        joints += [f"  a{k}: " + hinge("ground", f"c{k}", k, 0, ""), f"  b{k}: " + hinge(f"c{k - 1}", f"r{k}", k - 1, 1, ""),
                   f"  d{k}: " + hinge(f"c{k}", f"r{k}", k, 1, "")]
    return ("floatframe: 1\nbodies:\n" + "".join(bodies) + "joints:\n" + "".join(joints) + "outputs:\n" + outputs +
            "simulation: {step: 0.002, duration: 1}\n")


def six_legs(outputs):
    text = (ROOT / "tests/data/loops/six_legs.yaml").read_text(encoding="utf-8")
    return text[:text.index("outputs:")] + "outputs:\n" + outputs + text[text.index("simulation:"):]


def chain(links, outputs):
    """No loops: reactions are those of the tree."""
    bodies = "".join(f"  b{k}: {{rigid: {{mass: 1, centre_of_mass: [{k + 0.5}, 0, 0], inertia: [.01, .1, .1]}}}}\n"
                     for k in range(links))
    joints = "".join(f"  j{k}: {{type: revolute, parent: {f'b{k - 1}' if k else 'ground'}, child: b{k}, at: [{k}, 0, 0], axis: y}}\n"
                     for k in range(links))
    return ("floatframe: 1\nbodies:\n" + bodies + "joints:\n" + joints + "outputs:\n" + outputs +
            "simulation: {step: 0.001, duration: 1}\n")


def driven_chain(force):
    """Of four links, with this force on each of its joints."""
    forces = "".join(f"  f{k}: {force.format(k=k, next=(k + 1) % 4)}\n" for k in range(4))
    return chain(4, "  q: {joint_position: j0}\n").replace("outputs:", "forces:\n" + forces + "outputs:")


def cost_of_reactions(program, with_outputs, kinds):
    """Of the steps of a mechanism with the second of two kinds of entries, reactions in every row, by those with the first: a
    run less a shorter one."""
    steps = {}
    with tempfile.TemporaryDirectory(prefix="floatframe-count-") as folder:
        model = pathlib.Path(folder) / "row.yaml"
        for name, outputs in zip(("without", "with"), kinds):
            model.write_text(with_outputs(outputs), encoding="utf-8")
            counts = []
            for duration in ("0.1", "0.3"):
                command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", str(program), "run", str(model),
                           "--duration", duration, "--out", f"{folder}/run", "--overwrite", "--quiet", "--no-report",
                           "--record", "none"]
                done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
                if done.returncode:
                    sys.exit(f"held_figures: `{' '.join(command)}` failed:\n{done.stderr[-2000:]}")
                counts.append(int(re.search(r"Collected : (\d+)", done.stderr)[1]))
            steps[name] = counts[1] - counts[0]
    return steps["with"] / steps["without"]


def cost_of_page(program, model, durations):
    """Instructions of writing the page of a run, of those of the run: a run less a shorter one, so without what a page and a
    start cost whatever the run is."""
    counts = {}
    with tempfile.TemporaryDirectory(prefix="floatframe-count-") as folder:
        if not isinstance(model, pathlib.Path):
            (pathlib.Path(folder) / "model.yaml").write_text(model, encoding="utf-8")
            model = pathlib.Path(folder) / "model.yaml"
        for page in (False, True):
            for duration in durations:
                command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", str(program), "run", str(model),
                           "--step", "0.001", "--duration", duration, "--out", f"{folder}/run", "--overwrite", "--quiet",
                           *([] if page else ["--no-report"])]
                done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
                if done.returncode:
                    sys.exit(f"held_figures: `{' '.join(command)}` failed:\n{done.stderr[-2000:]}")
                counts[page, duration] = int(re.search(r"Collected : (\d+)", done.stderr)[1])
    short, long = durations
    run = counts[False, long] - counts[False, short]
    return (counts[True, long] - counts[True, short] - run) / run


def share_of_tyres(program):
    """Of the instructions of a step of the rigid Iltis on tyres of the Magic Formula, the part in their laws."""
    with tempfile.TemporaryDirectory(prefix="floatframe-count-") as folder:
        out = pathlib.Path(folder) / "cost.json"
        done = subprocess.run([sys.executable, str(ROOT / "bench/vehicle_cost.py"), "--program", str(program), "--coordinates", "relative",
                               "--json", str(out)], capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"held_figures: bench/vehicle_cost.py failed:\n{done.stderr[-2000:]}")
        return json.loads(out.read_text(encoding="utf-8"))["relative"]["share of tyres"]


def cost_in_fmus(program):
    """Instructions of doStep in an FMU, of those of `Simulation::step`; no step there may take memory from the heap."""
    with tempfile.TemporaryDirectory(prefix="floatframe-count-") as folder:
        out = pathlib.Path(folder) / "cost.json"
        done = subprocess.run([sys.executable, "-B", str(ROOT / "bench/fmu_cost.py"), "--program", str(program), "--no-times",
                               "--json", str(out)], capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"held_figures: bench/fmu_cost.py failed:\n{done.stdout}{done.stderr[-2000:]}")
        return {f"doStep of an FMU, of a step of the class Simulation: {name}": round(figures["ratio"], 4)
                for name, figures in json.loads(out.read_text(encoding="utf-8")).items()}


def instruction_figures(program):
    if not shutil.which("valgrind"):
        sys.exit("held_figures: valgrind not found; Debian package: valgrind")
    figures = {}
    for name, arguments in COUNTS.items():
        count, facts = collected(program, arguments)
        if COMPILER not in facts:
            print(f"not compared: figures.txt holds what {COMPILER} makes")
            sys.exit(0)
        kind = "iteration" if "--iterations" in arguments else "step"
        figures[f"instructions per {kind}: {name}"] = round(count)
    for name, arguments in STARTS.items():
        figures[f"instructions of the start: {name}"] = round(collected(program, arguments, COUNTED_START)[0])
    figures["tyres of the Magic Formula, of a step of the rigid Iltis, relative"] = share_of_tyres(program)
    figures["page of a run, of the run: Iltis, 8 s"] = cost_of_page(program, ROOT / "examples/iltis/iltis.yaml", ("0.1", "8"))
    figures["page of a run, of the run: chain of 200 links"] = cost_of_page(
        program, chain(200, "  q: {joint_position: j0}\n"), ("0.05", "0.25"))
    figures["steps with reactions of 18 parallelograms, of those without"] = cost_of_reactions(
        program, lambda outputs: row_of_parallelograms(18, outputs), ("  c0: {position: c0}\n", "  a0: {joint_force: a0}\n"))
    figures["steps with reactions of six legs, of those without"] = cost_of_reactions(
        program, six_legs, ("  c: {position: crank}\n", "  c: {joint_force: crank}\n"))
    figures["steps with reactions of a chain of 36, of those without"] = cost_of_reactions(
        program, lambda outputs: chain(36, outputs), ("  c: {position: b0}\n", "  c: {joint_force: j0}\n"))
    spring = "{{type: joint_spring, joint: j{k}, spring: 40, damper: 3}}"
    actuator = "{{type: joint_spring, joint: j{k}, actuator: {{formula: '-40 * angle(j{k}) - 3 * rate(j{k})%s'}}}}"
    for name, more in (("", ""), (" of other joints", " + 0 * angle(j{next})")):
        figures[f"steps with actuators by formulas{name}, of those with springs"] = cost_of_reactions(
            program, driven_chain, (spring, actuator % more))
    for options in LAWS:
        by_formula, in_cpp = (collected(program, [model, *options])[0] for model in ("formulas", "laws"))
        figures[f"steps with laws by formulas, of those with the same laws in C++, {options[1]}"] = round(by_formula / in_cpp, 3)
    if (pathlib.Path(program).resolve().parent / "lib/fmu/linux64/floatframe_fmu.so").exists():
        figures.update(cost_in_fmus(program))
    with_inertia, stiffened = (figures["instructions per iteration: rotor, " + key]
                               for key in ("sections with inertia", "with geometric stiffening"))
    print(f"sections with inertia cost {with_inertia / stiffened:.3f} of geometric stiffening")
    for coordinates in ("relative", "absolute"):
        key = f"instructions per step: active damper, {coordinates}"
        ratio = figures[key + ", inputs that jump"] / figures[key]
        print(f"a step whose inputs jump costs {ratio:.3f} of one whose inputs are held on, {coordinates}")
        if ratio > JUMPED:
            sys.exit(f"held_figures: that is more than {JUMPED}")
    return figures


def held():
    table = {}
    for line in (HERE / "figures.txt").read_text(encoding="utf-8").splitlines():
        if line.strip() and not line.startswith("#"):
            name, limit = line.rsplit(None, 1)
            table[name.strip()] = float(limit)
    return table


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--instructions", metavar="PROGRAM")
    parser.add_argument("--print", action="store_true", dest="only_print")
    arguments = parser.parse_args()
    figures = instruction_figures(arguments.instructions) if arguments.instructions else source_figures()
    limits, failures = held(), 0
    for name, value in figures.items():
        print(f"{name:70} {value:g}" if value < 1e5 else f"{name:70} {value}")
        if arguments.only_print:
            continue
        if name not in limits:
            print(f"held_figures: '{name}' has no line in figures.txt", file=sys.stderr)
            failures += 1
        elif name.endswith("at least"):
            if value < limits[name]:
                print(f"held_figures: '{name}' {limits[name]:g} are held, found {value:g}", file=sys.stderr)
                failures += 1
        elif value > limits[name]:
            print(f"held_figures: '{name}' is {value:g}, at most {limits[name]:g} is held", file=sys.stderr)
            failures += 1
        elif value < 0.9 * limits[name]:
            print(f"  (held: {limits[name]:g}, enter the smaller figure)")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
