#!/usr/bin/env python3
"""How many decks of a folder are read, why the others are not, and whether frequencies are those of other programs.

  scripts/deck_suite.py [FOLDER]                 CalculiX' own suite (Debian's calculix-ccx-test) if no folder is given; decks of
                                                 Abaqus and CalculiX (.inp) and of Nastran (.bdf, .nas, .dat, .blk, .bulk, .fem)
    --program FILE, --modes FILE                 build/floatframe, build/tests/deck_modes
    --free                                       free modes against CalculiX (ccx) on the converted deck
    --reference                                  modes of *FREQUENCY decks against their .dat.ref
    --options "..."                              options of all programs; of CalculiX' suite "--dialect calculix"
    --require NAME=NUMBER ...                    exit code 1 if a count is smaller
    --json FILE, --list                          all results; every deck with what became of it

A deck is read as it is, with --density where a density is missing, and with --contact ignore besides. Each program has 60 s and 4 GiB.
Decks may be compressed (.gz). Nastran decks are only read; each reason is counted with the decks in which it is the only one. Counts: decks, elastic, elastic_density, read, read_density, read_contact, density_read,
density_read_contact, free_compared, free_agree, matrices_agree, reference_compared, reference_agree, crashed, slow.
"""
import argparse
import collections
import concurrent.futures
import gzip
import json
import math
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
SUITE = pathlib.Path("/usr/share/doc/calculix-ccx-test/examples/test")
SECONDS, BYTES = 60, 4 << 30
TOLERANCE = 1e-5
DENSITY = ("--density", "7.8e-9")
CONTACT = ("--contact", "ignore")
# Three-dimensional structural elements and isotropic or other linear elasticity: what a flexible body can be made of.
STRUCTURE = re.compile(r"TYPE\s*=\s*(C3D|S[3468]|B3|SC|T3D|M3D)", re.IGNORECASE)
NASTRAN = (".bdf", ".nas", ".dat", ".blk", ".bulk", ".fem")
NASTRAN_STRUCTURE = re.compile(r"^(CTETRA|CHEXA|CPENTA|CPYRA|CQUAD|CTRIA|CSHEAR|CBAR|CBEAM|CROD|CONROD|CTUBE|CBEND|CELAS|CBUSH)",
                               re.IGNORECASE | re.MULTILINE)


def call(arguments, seconds=SECONDS, folder=None):
    """Exit code, output and errors; code None if it took too long, negative if it was killed."""
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    try:
        done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, errors="replace", timeout=seconds,
                              cwd=folder, preexec_fn=limit, env=environment)
    except subprocess.TimeoutExpired:
        return None, "", ""
    return done.returncode, done.stdout, done.stderr


def reasons(errors):
    """The errors without what differs from deck to deck, each once."""
    lines = [line for line in errors.splitlines() if re.match(r"\S*\.\w+(:\d+)*: |floatframe: ", line)] or errors.splitlines() or ["?"]
    found = []
    for line in lines:
        text = re.sub(r"^\S*?\.(inp|" + "|".join(s[1:] for s in NASTRAN) + r")(\.gz)?(:\d+)*:\s*", "", line.removeprefix("floatframe: "))
        text = re.sub(r"^([A-Z]+\d?) \d+:", r"\1:", text)
        found.append(re.sub(r"(?<![A-Z])[-+]?\d[\d.]*(e[-+]?\d+)?", "#", text)[:110])
    return list(dict.fromkeys(found))


def reason(errors):
    return reasons(errors)[0]


class Deck:
    def __init__(self, path, arguments):
        self.path, self.program, self.modes, self.options = path, arguments.program, arguments.modes, arguments.options
        self.name = path.name.removesuffix(".gz")
        self.nastran = pathlib.Path(self.name).suffix.lower() in NASTRAN
        self.text = (gzip.open(path, "rt", errors="replace") if path.suffix == ".gz" else open(path, errors="replace")).read()
        self.result = {"deck": self.name}

    def has(self, pattern):
        return re.search(pattern, self.text, re.IGNORECASE | re.MULTILINE) is not None

    def read(self):
        """The options with which the deck is read; None if it is not."""
        r = self.result
        if self.nastran:
            r["elastic"], r["density"] = bool(NASTRAN_STRUCTURE.search(self.text)), False
        else:
            r["elastic"] = bool(STRUCTURE.search(self.text)) and self.has(r"^\*\s*ELASTIC")
            r["density"] = self.has(r"^\*\s*DENSITY")
        for kind, options in (("read", self.options), ("contact", (*self.options, *CONTACT))):
            code, text, errors = call([self.program, "info", self.path, *options])
            if code is None or code < 0 or code > 2:
                r["state"], r["why"] = ("slow", "") if code is None else ("crashed", f"exit code {code}")
                return None
            if code == 0:
                r["state"] = kind
                return options
            r["state"], r["whys"] = "refused", reasons(errors)
            r["why"] = r["whys"][0]
            if "contact" not in errors.lower() and "gap" not in errors.lower():
                return None
        return None


def frequencies_of_dat(text):
    """[Hz] of the first table of eigenvalues."""
    table = re.search(r"E I G E N V A L U E   O U T P U T(.*?)(?:P A R T I C|E I G E N|\Z)", text, re.DOTALL)
    if not table:
        return []
    found = []
    for line in table[1].splitlines():
        fields = line.split()
        if len(fields) >= 2 and fields[0].isdigit() and len(fields[0]) < 6:
            value = float(fields[1])
            found.append(math.copysign(math.sqrt(abs(value)) / (2 * math.pi), value))
    return found


def difference(found, expected, count=10):
    """Largest relative difference of the first elastic frequencies, and how many there are. Rigid motions are left out."""
    if not found or not expected:
        return None, 0
    floor = max(1e-4 * max(abs(f) for f in expected), 1e-6 * max(abs(f) for f in found))
    a = sorted(f for f in found if abs(f) > floor)
    b = sorted(f for f in expected if abs(f) > floor)
    pairs = list(zip(a, b))[:count]
    if not pairs:
        return None, 0
    return max(abs(x / y - 1.0) for x, y in pairs), len(pairs)


def compare_free(deck, options, folder):
    """Free modes of the deck against those of CalculiX on the converted deck."""
    r = deck.result
    options = [*options, "--mass-form", "consistent", *(() if r["density"] else DENSITY)]
    code, text, errors = call([deck.program, "convert", deck.path, "part.inp", "--modes", "20", *options], folder=folder)
    if code != 0:
        r["free"] = "not written: " + reason(errors)
        return
    if "CalculiX makes solid elements of them" in text or "CalculiX has no pyramids" in text:
        r["free"] = "CalculiX has other elements"
        return
    code, text, errors = call([deck.modes, "modes", deck.path, "--ccx", "--modes", "20", *options])
    if code != 0:
        r["free"] = "no modes: " + (reason(errors) if code else "too slow")
        return
    found = json.loads(text)["frequencies"]
    code, text, errors = call(["ccx", "part"], 2 * SECONDS, folder)
    dat = pathlib.Path(folder, "part.dat")
    expected = frequencies_of_dat(dat.read_text()) if code == 0 and dat.exists() else []
    if not expected:
        lines = [line for line in text.splitlines() if "ERROR" in line] or ["too slow" if code is None else f"exit code {code}"]
        r["free"] = "CalculiX: " + re.sub(r"\d+", "#", lines[0].strip())[:80]
        return
    apart, count = difference(found, expected)
    r["free"] = "no elastic modes" if apart is None else "agrees" if apart < TOLERANCE else "differs"
    r["free_apart"], r["free_modes"] = apart, count
    if r["free"] in ("differs", "no elastic modes"):
        compare_matrices(deck, found, folder)


def compare_matrices(deck, found, folder):
    """Rigid motions make CalculiX' own search for modes rough, of several bodies above all: here with the stiffness and mass
    that it has assembled, and stores."""
    r = deck.result
    part = pathlib.Path(folder, "part.inp")
    part.write_text(part.read_text().replace("*FREQUENCY\n", "*FREQUENCY, SOLVER=MATRIXSTORAGE\n"))
    code, text, errors = call(["ccx", "part"], 2 * SECONDS, folder)
    if not part.with_suffix(".sti").exists():
        return
    code, text, errors = call([deck.modes, "modes", part.with_suffix(".sti"), "--modes", "20"])
    if code != 0:
        r["why_no_matrices"] = errors[:200]
        return
    apart, count = difference(json.loads(text)["frequencies"], found)
    if apart is not None and apart < TOLERANCE:
        r["free"], r["free_apart"], r["free_modes"] = "agrees by CalculiX' matrices, not by its modes", apart, count


# What makes the modes of a *FREQUENCY step others than those of the part.
UNLIKE = (("complex modes", r"^\*\s*COMPLEX"), ("cyclic symmetry", r"^\*\s*CYCLIC"), ("contact", r"^\*\s*CONTACT"),
          ("ties", r"^\*\s*TIE"), ("beams or shells, which CalculiX makes solids of", r"TYPE\s*=\s*(S[3468]|B3|T3D|M3D|CPE|CPS|CAX)"),
          ("not solids", r"TYPE\s*=\s*(F3D|D[CF]|AC3D|GAP|DASHPOT|U1|US)"), ("preload", r"PERTURBATION|NLGEOM|^\*\s*INITIAL CONDITIONS"),
          ("no elastic material", r"^\*\s*(HYPERELASTIC|USER MATERIAL|PLASTIC)"))


def held_deck(text):
    """Supports that stand in the step of the frequencies, before it: readers of parts pass steps over."""
    lines, inside, block, hoisted, before = text.splitlines(), False, False, [], []
    for line in lines:
        if line.startswith("*") and not line.startswith("**"):
            word = line.upper().replace(" ", "")
            inside = inside or word.startswith("*STEP")
            block = inside and word.startswith("*BOUNDARY")
        if block:
            hoisted.append(line)
        if not inside:
            before.append(line)
    return "\n".join([*before, *hoisted]) + "\n"


def compare_reference(deck, options, folder):
    """Modes as the deck holds the part, against the results that CalculiX comes with."""
    r = deck.result
    if not deck.has(r"^\*\s*FREQUENCY"):
        return
    ref = deck.path.with_name(deck.name.removesuffix(".inp") + ".dat.ref")
    ref = ref if ref.exists() else ref.with_name(ref.name + ".gz")
    if not ref.exists():
        r["reference"] = "no reference"
        return
    for why, pattern in UNLIKE:
        if deck.has(pattern):
            r["reference"] = why
            return
    if options is None:
        r["reference"] = "not read"
        return
    copy = pathlib.Path(folder, "held.inp")
    copy.write_text(held_deck(deck.text))
    code, text, errors = call([deck.modes, "modes", copy, "--ccx", "--held", "--modes", "30", "--mass-form", "consistent",
                               *options])
    if code != 0:
        r["reference"] = "no modes: " + (reason(errors) if code else "too slow")
        return
    expected = frequencies_of_dat((gzip.open(ref, "rt") if ref.suffix == ".gz" else open(ref)).read())
    apart, count = difference(json.loads(text)["frequencies"], expected, 30)
    r["reference"] = "no table" if apart is None else "agrees" if apart < TOLERANCE else "differs"
    r["reference_apart"], r["reference_modes"] = apart, count


def tried(path, arguments):
    deck = Deck(path, arguments)
    options = deck.read()
    if deck.result["elastic"] and not deck.nastran:
        with tempfile.TemporaryDirectory() as folder:
            if arguments.free and options is not None:
                compare_free(deck, options, folder)
            if arguments.reference:
                compare_reference(deck, options, folder)
    return deck.result


def counts_of(results):
    elastic = [r for r in results if r["elastic"]]
    both = [r for r in elastic if r["density"]]
    read = ("read", "contact")
    return {"decks": len(results), "elastic": len(elastic), "elastic_density": len(both),
            "read": sum(r["state"] == "read" for r in elastic), "read_contact": sum(r["state"] in read for r in elastic),
            "density_read": sum(r["state"] == "read" for r in both), "density_read_contact": sum(r["state"] in read for r in both),
            "free_compared": sum("free_apart" in r for r in results),
            "free_agree": sum(r.get("free") == "agrees" for r in results),
            "matrices_agree": sum(r.get("free", "").startswith("agrees by") for r in results),
            "reference_compared": sum(r.get("reference") in ("agrees", "differs") for r in results),
            "reference_agree": sum(r.get("reference") == "agrees" for r in results),
            "crashed": sum(r["state"] == "crashed" for r in results), "slow": sum(r["state"] == "slow" for r in results)}


def show(results, arguments):
    counts = counts_of(results)
    print("  ".join(f"{name} {count}" for name, count in counts.items()))
    for key, title in (("why", "refused (of those with elastic elements)"), ("free", "free modes"), ("reference", "*FREQUENCY decks")):
        tally, alone = collections.defaultdict(list), collections.Counter()
        for r in results:
            if not r["elastic"] or not r.get(key) or (key == "why" and r["state"] not in ("refused", "crashed")):
                continue
            several = r.get("whys", [r[key]]) if key == "why" else [r[key]]
            for what in several:
                tally[what].append(r["deck"])
            alone[several[0]] += len(several) == 1
        if tally:
            print(f"\n{title}")
        for what, decks in sorted(tally.items(), key=lambda item: -len(item[1])):
            only = f" ({alone[what]} alone)" if alone[what] not in (0, len(decks)) else ""
            print(f"  {len(decks):4}  {what}{only}: {', '.join(decks[:4])}{', ...' if len(decks) > 4 else ''}")
    for key in ("free", "reference"):
        apart = [r[f"{key}_apart"] for r in results if r.get(key, "").startswith("agrees")]
        if apart:
            print(f"\n{key}: those that agree do so to {max(apart):.1e}")
        for r in results:
            if r.get(key) == "differs":
                print(f"  {r['deck']} differs by {r[f'{key}_apart']:.1e}")
    if arguments.list:
        for r in results:
            print(f"{r['deck']:28}{r['state']:10}{r.get('why', '')}")
    return counts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=SUITE)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/floatframe")
    parser.add_argument("--modes", type=pathlib.Path, default=ROOT / "build/tests/deck_modes")
    parser.add_argument("--free", action="store_true")
    parser.add_argument("--reference", action="store_true")
    parser.add_argument("--require", nargs="*", default=[])
    parser.add_argument("--options", type=lambda text: tuple(text.split()))
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    arguments.program, arguments.modes = arguments.program.resolve(), arguments.modes.resolve()
    if arguments.options is None:
        arguments.options = ("--dialect", "calculix") if arguments.folder.resolve() == SUITE.resolve() else ()
    decks = sorted(p for p in arguments.folder.rglob("*") if p.name.removesuffix(".gz").lower().endswith((".inp", *NASTRAN)))
    if not decks:
        sys.exit(f"{arguments.folder}: found no decks (.inp, {', '.join(NASTRAN)}, also with .gz); CalculiX' are in Debian's package calculix-ccx-test")
    if arguments.free and not shutil.which("ccx"):
        sys.exit("ccx is missing, expected CalculiX (Debian's package calculix-ccx)")
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = list(pool.map(lambda path: tried(path, arguments), decks))
    counts = show(results, arguments)
    if arguments.json:
        arguments.json.write_text(json.dumps({"counts": counts, "decks": results}, indent=1) + "\n")
    short = [f"{name}: found {counts[name]}, expected at least {number}"
             for name, _, number in (item.partition("=") for item in arguments.require) if counts[name] < int(number)]
    if counts["crashed"]:
        short.append(f"{counts['crashed']} decks crashed the program")
    if short:
        sys.exit("\n".join(short))


if __name__ == "__main__":
    main()
