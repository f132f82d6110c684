"""The names of points and runs, and numbers, in the words of the report."""

import re

CURVES = {
    "high": "μ = 1",
    "medium": "μ = 0.5",
    "low": "μ = 0.1",
    "no-wall": "μ_w = 0",
    "no-disc": "μ_d = 0",
    "no-vertical": "no vertical friction",
    "no-vertical-disc": "no vertical friction between spheres",
    "no-vertical-wall": "no vertical friction at the wall",
    "no-damping": "e = 1",
    "shell": "hollow spheres",
    "all": "all ingredients",
    "smooth": "smooth spheres",
    "rough": "roughened spheres",
    "half": "half the amplitude",
}
# A point, such as spheres_0.2_N16_25of75periods or run_no-wall_N48_200000events_seed3.
POINT = re.compile(
    r"\b(?:(?:run|measured|spheres|settled|steady|start|dense|varied)_)*"
    r"((?:(?:inertia|restitution|tangential)_|e)?[\d.]+|(?:no-)?[a-z][a-z-]*)"
    r"_N(\d+)(?:_\d+of\d+periods|_\d+events|_\d+periods)?(?:_seed(\d+))?\b"
)
FRICTION_PAIR = re.compile(r"\bmap_d([\d.]+)_w([\d.]+)_(?:\d+of\d+periods|\d+events|\d+periods)\b")
VARIED = re.compile(r"(inertia|restitution|tangential|e)_?(?=[\d.])")
SYMBOLS = {
    "inertia": "I",
    "restitution": "e",
    "e": "e",
    "tangential": "β",
    "tangential_restitution": "β",
}
PARAMETER = re.compile(rf"^({'|'.join(SYMBOLS)}) (?=[\d.])")
# Parts of a finding that the report leaves out: they are about the program, not about the result.
LEFT_OUT = (
    re.compile(r"^Figure \S+: (drawn; )?"),
    re.compile(r" Another --seed than \d+ may [a-z ]+\.|; docs/physics\.md"),
    re.compile(r"\s*\bhint: .*", re.DOTALL),
)

POWER_OF_TEN = re.compile(r"\b10\^(\d+)")
POWER = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)e([+-]?)0*(\d+)\b")
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def powers(text):
    """2e-09 as 2·10⁻⁹, 1e-11 as 10⁻¹¹, and 10^6 as 10⁶."""

    def power(match):
        digits, sign, exponent = match.groups()
        ten = "10" + (sign.replace("+", "") + exponent).translate(SUPERSCRIPTS)
        return ten if digits == "1" else f"{digits}·{ten}"

    text = POWER_OF_TEN.sub(lambda match: "10" + match.group(1).translate(SUPERSCRIPTS), text)
    return POWER.sub(power, text)


def point_in_words(match):
    curve, discs, seed = match.groups()
    rough = ", roughened" if curve.endswith("-rough") else ""
    curve = curve.removesuffix("-rough")
    if curve in CURVES:
        curve = CURVES[curve]
    elif curve[0].isdigit():
        curve = f"μ = {curve}"
    elif VARIED.match(curve):
        curve = VARIED.sub(lambda m: f"{SYMBOLS[m.group(1)]} = ", curve, count=1)
    else:
        curve = curve.replace("-", " ")
    return f"{curve}{rough} with N = {discs}" + (f" (seed {seed})" if seed else "")


def in_words(finding):
    """A finding without the names that the program gives its points."""
    for left_out in LEFT_OUT:
        finding = left_out.sub("", finding)
    finding = FRICTION_PAIR.sub(r"(μ_d, μ_w) = (\1, \2)", finding)
    finding = PARAMETER.sub(
        lambda match: f"{SYMBOLS[match.group(1)]} = ", POINT.sub(point_in_words, finding)
    )
    return powers(finding)
