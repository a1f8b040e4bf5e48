"""The rigid models of the race: the same in all programs, in joint coordinates."""
import sys

import race

AGREE = 1e-7                             # [m] between any two converged motions of the first second
STEPS = (1e-3, 2e-3, 5e-3, 1e-2)         # tried for every program; all divide the 10 ms of the comparison
TOLERANCES = (1e-9, 1e-6)                # tried for Floatframe
REFERENCE = {"step": 1e-4}


def peers(links):
    """(name, model, settings to try in addition to the step)"""
    import exudyn_peer
    import mujoco_peer
    import pinocchio_peer
    return [(f"MuJoCo {mujoco_peer.VERSION}", mujoco_peer.RigidChain(links),
             [{"integrator": name} for name in mujoco_peer.INTEGRATORS]),
            (f"Pinocchio {pinocchio_peer.VERSION}", pinocchio_peer.RigidChain(links), [{}]),
            (f"Exudyn {exudyn_peer.VERSION}", exudyn_peer.RigidChain(links),
             [{"integrator": "ExplicitEuler"}, {"integrator": "RK44"}])]


def setting(name, options):
    if name == "Floatframe":
        return f"relative coordinates, generalised alpha; tolerance {options['tolerance']:.0e}".replace("e-0", "e-")
    if name.startswith("Pinocchio"):
        return "Runge-Kutta 4, its four calls of `aba` a step only"
    words = {"implicitfast": "implicitfast", "Euler": "semi-implicit Euler", "RK4": "Runge-Kutta 4", "ExplicitEuler": "explicit Euler",
             "RK44": "kinematic tree, Runge-Kutta 4"}
    return words[options["integrator"]]


def tip(path):
    """Rows (time, x, z), of Floatframe without y."""
    return path[:, [0, 1, 3]] if path.shape[1] == 4 else path


def cheapest(name, chain, options, exact, wanted):
    """The options with the least time whose error is at most `wanted`, their error, or None."""
    found = []
    for o in options:
        for step in STEPS:
            o = {**o, "step": step}
            try:
                error = race.distance(tip(chain.run(record=race.SAMPLES, **o)[1]), exact)
                seconds = min(chain.run(**o)[0] for _ in range(2))
            except Exception as problem:  # not a candidate: the run failed
                print(f"  {name} {o}: {str(problem)[:80]}", file=sys.stderr)
                continue
            if error <= wanted:
                found.append((seconds, error, o))
    return min(found, key=lambda f: f[0], default=None)


def rigid_chain(links, program, rounds):
    import models
    return compare(f"rigid chain, N = {links}", f"rigid_{links}", models.chain_yaml(links, None), peers(links), program, rounds)


def vehicle(program, rounds):
    import models
    import mujoco_peer
    racers = [(f"MuJoCo {mujoco_peer.VERSION}", mujoco_peer.Vehicle(),
               [{"integrator": name} for name in mujoco_peer.INTEGRATORS])]
    return compare("rigid vehicle", "vehicle", models.vehicle_yaml(), racers, program, rounds)


def compare(title, name, text, racers, program, rounds):
    """One model: all motions against that of Floatframe, then the times; the last settings are the most accurate."""
    import floatframe_peer
    print(f"{title} ...", file=sys.stderr, flush=True)
    own = floatframe_peer.Chain(program, race.WORK, name, text)
    exact = tip(own.run(record=race.SAMPLES, step=race.REFERENCE_STEP["floatframe"])[1])

    def row(code, chain, error, o, more=""):
        return {"code": code, "setting": setting(code, o) + more, "step_s": o["step"], "error_m": error,
                "run": lambda: chain.run(**o)[0]}

    first = {"step": 1e-3, "tolerance": 1e-9}
    wanted = race.distance(tip(own.run(record=race.SAMPLES, **first)[1]), exact)
    rows = [row("Floatframe", own, wanted, first, ", at 1 ms")]
    best = cheapest("Floatframe", own, [{"tolerance": tolerance} for tolerance in TOLERANCES], exact, race.SLACK * wanted)
    if best[2] != first:
        rows.append(row("Floatframe", own, best[1], best[2]))
    apart = 0.0
    for name, chain, options in racers:
        reference = chain.run(record=race.SAMPLES, **options[-1], **REFERENCE)[1]
        apart = max(apart, race.distance(reference, exact))
        if apart > AGREE:
            sys.exit(f"race.py: {title}: {name} is {apart:.1e} m from Floatframe, allowed {AGREE:.1e}")
        best = cheapest(name, chain, options, exact, race.SLACK * wanted)
        if best:
            rows.append(row(name, chain, best[1], best[2]))
        for o in options:
            same = {**o, "step": 1e-3}
            try:
                error = race.distance(chain.run(record=race.SAMPLES, **same)[1], exact)
            except Exception as problem:  # the run failed
                print(f"  {name} {same}: {str(problem)[:80]}", file=sys.stderr)
                continue
            rows.append(row(name, chain, error, same, ", at 1 ms"))
    race.finish(rows, rounds)
    return {"model": title, "kind": "rigid", "apart_m": apart, "allowed_m": AGREE, "rows": rows}
