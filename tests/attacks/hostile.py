"""Hostile text and bytes, made from valid ones by random numbers."""
import re

NUMBERS = ("0", "-1", "1e308", "-1e308", "1e-308", "nan", "inf", "-.inf", "1e999", "9223372036854775808", "0x10", "1_000", "1e6",
           "1e-12", "12345678901234567890123", "-0.0", "2147483648", "3", "${1/0}", "${missing}", "${sqrt(-1)}", "''", "~", "[]", "{}",
           "true", "[1, 2, 3]", "1e9", "'x'")
WORDS = ("x", "ground", "", "мост", "車両", "a b", "../../etc/passwd", "y" * 5000, "${", "null", "*x", "&x", "!!binary x", "-", "\x07",
         "name", "type", "{a: {b: {c: d}}}", "%s%n", "|")
LINES = ("", "  ", "\t", "---", "...", "? x", "- - - -", "{", "]", "include: model.yaml", "bodies:", "joints: {}", "# x", "\x00",
         "simulation: {step: 1e-300}", "simulation: {duration: 1e300, step: 1e-9}", "a: &a [*a, *a]")


NUMBER = r"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?(?![\w.])"
FACTORS = (-1.0, 0.0, 1e-9, 1e-3, 0.3, 3.0, 30.0, 1e3, 1e6, 1e9, 1e-15)


def unlikely(random, good):
    """The text with one to three of its numbers multiplied: what reads well and means something else."""
    for _ in range(random.randint(1, 3)):
        found = list(re.finditer(NUMBER, good))
        if not found:
            return good
        one = random.choice(found)
        good = f"{good[:one.start()]}{float(one[0]) * random.choice(FACTORS):.12g}{good[one.end():]}"
    return good


def text(random, good, changes=None):
    """The lines of a good file after one to four changes, or with unlikely numbers."""
    if random.random() < 0.6:
        return unlikely(random, good)
    lines = good.split("\n")
    for _ in range(changes or random.randint(1, 4)):
        if not lines:
            return ""
        k = random.randrange(len(lines))
        change = random.randrange(9)
        if change == 0:
            del lines[k]
        elif change == 1:
            lines.insert(k, lines[random.randrange(len(lines))])
        elif change == 2:
            lines.insert(k, random.choice(LINES))
        elif change == 3:
            lines[k] = " " * random.randint(0, 8) + lines[k].strip()
        elif change == 4:
            lines = lines[:k]
        elif change == 5:
            j = random.randrange(len(lines))
            lines[k], lines[j] = lines[j], lines[k]
        elif change == 6:
            lines[k] = replaced(random, lines[k], r"[A-Za-z_][A-Za-z_0-9]*", random.choice(WORDS))
        else:
            lines[k] = replaced(random, lines[k], NUMBER, random.choice(NUMBERS))
    return "\n".join(lines)


def replaced(random, line, pattern, by):
    found = list(re.finditer(pattern, line))
    if not found:
        return line
    one = random.choice(found)
    return line[:one.start()] + by + line[one.end():]


def data(random, good, changes=None):
    """The bytes of a good file after one to four changes."""
    changed = bytearray(good)
    for _ in range(changes or random.randint(1, 4)):
        if not changed:
            break
        k = random.randrange(len(changed))
        change = random.randrange(6)
        if change == 0:
            changed[k] ^= 1 << random.randrange(8)
        elif change == 1:
            del changed[k:]
        elif change == 2:
            del changed[k:k + random.randint(1, 64)]
        elif change == 3:
            changed[k:k + 8] = random.choice((b"\xff" * 8, b"\0" * 8, b"\xff\xff\xff\x7f" * 2, b"\0\0\0\0\0\0\xf8\x7f"))
        elif change == 4:
            changed[k:k] = random.randbytes(random.randint(1, 64))
        else:
            changed[k:k] = changed[k // 2:k]
    return bytes(changed)
