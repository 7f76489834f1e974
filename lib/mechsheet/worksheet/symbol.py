"""Names of variables as symbols of the field: ``phi34`` is φ with index 34."""

import re
from functools import cache
from html import escape

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "eps": "ε", "epsilon": "ε", "zeta": "ζ", "eta": "η",
    "theta": "θ", "kappa": "κ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ",
    "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω", "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Sigma": "Σ",
    "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω",
}  # fmt: skip
_TEX = {"eps": r"\varepsilon", "epsilon": r"\varepsilon", "phi": r"\varphi"}
_WORDS = "|".join(sorted(GREEK, key=len, reverse=True))
_NAME = re.compile(rf"(d(?=[A-Z]|{_WORDS}))?({_WORDS}|[A-Za-z])_?(\w*)")


@cache
def parts(name: str) -> tuple[str, str, str]:
    """Differential mark, base and index of a name; one word of small letters stays whole.

    The rule: a leading ``d`` before a Greek word or a capital letter is a difference or derivative; the base
    is one Greek word or one letter; the rest is the index, its underscores commas.

    >>> parts("phi34"), parts("GS6_max"), parts("dphi3"), parts("dRa"), parts("delta1"), parts("gap")
    (('', 'phi', '34'), ('', 'G', 'S6,max'), ('d', 'phi', '3'), ('d', 'R', 'a'), ('', 'delta', '1'), ('', 'gap', ''))
    """
    greek = re.match(_WORDS, name)
    if not greek and re.fullmatch(r"[a-z]{3,}", name) and not re.match(f"d({_WORDS})", name):
        return "", name, ""
    match = (re.fullmatch(rf"()({_WORDS})_?(\w*)", name) if greek else None) or _NAME.fullmatch(name)
    return (match[1] or "", match[2], match[3].strip("_").replace("_", ",")) if match else ("", name, "")


def is_field(name: str) -> bool:
    """Whether the name says "over S": ``phi34_S`` is printed φ34(S)."""
    return name.endswith("_S") and len(name) > 2


def plain(name: str) -> str:
    """Name as a table heading prints it: without the ``_S`` of a field and without underscores.

    >>> plain("phi34_S"), plain("GS6_max"), plain("S_p")
    ('phi34', 'GS6max', 'Sp')
    """
    return (name[:-2] if is_field(name) else name).replace("_", "")


def latex(name: str) -> str:
    r"""Name in LaTeX.

    >>> latex("phi34_S"), latex("dRa")
    ('\\varphi_{34}(S)', '\\Delta R_{\\mathrm{a}}')
    """
    mark, base, index = parts(name[:-2] if is_field(name) else name)
    if base in GREEK:
        text = _TEX.get(base, rf"\{base}")
    else:
        text = base if len(base) == 1 else rf"\mathrm{{{base}}}".replace("_", r"\_")
    if mark:
        text = rf"\mathrm{{d}}{text}" if base in GREEK else rf"\Delta {text}"
    if index:
        text += "_{" + (rf"\mathrm{{{index}}}" if re.search("[A-Za-z]", index) else index) + "}"
    return text + "(S)" * is_field(name)


def html(name: str) -> str:
    """Name in HTML, for headings of tables and legends.

    >>> html("phi34"), html("R56x")
    ('<i>φ</i><sub>34</sub>', '<i>R</i><sub>56x</sub>')
    """
    mark, base, index = parts(name[:-2] if is_field(name) else name)
    text = f"<i>{GREEK.get(base, base)}</i>"
    if mark:
        text = ("d" if base in GREEK else "Δ") + text
    return text + (f"<sub>{index}</sub>" if index else "")


def in_words(sentence: str) -> str:
    """A sentence in HTML, the names of quantities in it as their symbols.

    >>> in_words("omega3 < 1, theta/2")
    '<i>ω</i><sub>3</sub> &lt; 1, <i>θ</i>/2'
    """
    words = re.split(rf"\b((?:{_WORDS})\b|[A-Za-z]+[_\d]\w*)", sentence)
    return "".join(html(word) if i % 2 else escape(word) for i, word in enumerate(words))


def svg(name: str) -> str:
    """Name in SVG, its index lowered: the inside of a ``<text>`` element.

    >>> svg("S_p")
    '<tspan font-style="italic">S</tspan><tspan dy="4" font-size="11">p</tspan><tspan dy="-4">\u200b</tspan>'
    """
    mark, base, index = parts(name[:-2] if is_field(name) else name)
    mark = mark and ("d" if base in GREEK else "Δ")
    text = f'{mark}<tspan font-style="italic">{GREEK.get(base, base)}</tspan>'
    # the last part, of no width, takes what follows back to the line
    return text + (f'<tspan dy="4" font-size="11">{index}</tspan><tspan dy="-4">\u200b</tspan>' if index else "")


def text(name: str) -> str:
    """Name in plain characters, for charts and the terminal.

    >>> text("phi34"), text("dRa")
    ('φ34', 'ΔRa')
    """
    return re.sub("<[^>]*>", "", html(name))
