"""Every line of the slotted link worksheet against the vector from B to the slider, differentiated."""

import numpy as np
import pytest
from independent import SLIDERS, disagreements, inputs, slopes, turns

STEP = 2e-3


def reference(g):
    sense = 1.0 if g.omega1 >= 0 else -1.0
    first = g.phi_0 + sense * 2 * np.pi * np.arange(g.n + 1) / g.n
    fine = g.phi_0 + sense * np.radians(np.arange(361))
    drawn = g.phi_0 + sense * np.radians(SLIDERS["part"].value)

    def slider(phi):
        return 1j * g.L0 + g.L1 * np.exp(1j * phi)

    def at(phi, end):
        """The link at these angles of the crank, by names that end so; w is what its vector turns by in time."""
        r, w = slider(phi), g.omega1
        (V, W), (turn, bend) = slopes(lambda p: abs(slider(p)), phi, STEP), turns(slider, phi, STEP)
        C1, C2 = slopes(lambda p: g.L3 * slider(p) / abs(slider(p)), phi, STEP)
        known = {"phi3": np.angle(r), "SAB": abs(r), "P_C": g.L3 * r / abs(r), "VC": w * C1, "WC": w**2 * C2}
        known |= {"omega_BC": w * turn, "VAB": w * V, "eps_BC": w**2 * bend, "WAB": w**2 * W}
        return {name + end: value for name, value in known.items()}

    k, t, one = at(first, "_k"), at(fine, "_t"), at(drawn, "_1")
    (VA, WA) = slopes(slider, first, STEP)
    known = {name: k[name] for name in k} | {name: t[name] for name in t if name not in ("VAB_t", "WAB_t")}
    known |= {name: one[name] for name in ("phi3_1", "VC_1", "WC_1")}
    known |= {"phi1": drawn, "phi1_t": fine, "phi1_k": first, "k": np.arange(g.n + 1), "dphi1": sense * 2 * np.pi / g.n}
    known |= {"phi3(phi1_k)": k["phi3_k"], "B": 0, "O1": 1j * g.L0, "A(phi1_k)": slider(first)}
    known |= {"VA(phi1_k)": g.omega1 * VA, "WA(phi1_k)": g.omega1**2 * WA}
    known |= {"u(phi1_k)": slider(first) / k["SAB_k"], "C(phi1_k)": k["P_C_k"]}
    functions = ("SAB", "omega_BC", "VAB", "eps_BC", "WAB", "VC", "WC")
    known |= {f"{name}(phi1_k)": k[f"{name}_k"] for name in functions}
    left = slider(first) / k["SAB_k"] * 1j
    known |= {"WCt_k": (k["WC_k"] / left).real, "WCn_k": (k["WC_k"] / left).imag}
    return known | equations(g, first) | found(k) | strokes(g, slider) | {"kappa": (g.L0 + g.L1) / min(k["SAB_k"])}


def equations(g, phi1):
    """What a link and a slider that move anyhow leave of the loop and of its derivatives, at each position."""
    x = [0.4, 1.3, -2.0, 0.7, 5.0, -3.0]

    def loop(t):
        link = x[0] + x[2] * t + x[4] * t**2 / 2
        return (
            (x[1] + x[3] * t + x[5] * t**2 / 2) * np.exp(1j * link)
            - 1j * g.L0
            - g.L1 * np.exp(1j * (phi1 + g.omega1 * t))
        )

    left = [loop(0.0), *slopes(loop, 0.0, 1e-3)]
    names = [("f1", "f2"), ("f3", "f4"), ("f5", "f6")]
    return {
        f"{name}(phi1_k, *{x[: 2 * order + 2]})": part
        for order, (pair, z) in enumerate(zip(names, left, strict=True))
        for name, part in zip(pair, (z.real, z.imag), strict=True)
    }


def found(k):
    """What Find ends in: each position on the branch on which its slider is, and for table 4 how many of each."""
    side = "np.sign(SAB_F)"
    names = {f"exp(1j * phi3_F) * {side}": np.exp(1j * k["phi3_k"]), f"SAB_F * {side}": k["SAB_k"]}
    names |= {"omega3_F": k["omega_BC_k"], f"VAB_F * {side}": k["VAB_k"]}
    names |= {"eps3_F": k["eps_BC_k"], f"WAB_F * {side}": k["WAB_k"]}
    names |= {"VC_F": abs(k["VC_k"]), f"(VCx_F + 1j * VCy_F) * {side}": k["VC_k"]}
    names |= {"WC_F": abs(k["WC_k"]), f"(WCx_F + 1j * WCy_F) * {side}": k["WC_k"]}
    return names | {
        "phi3_g": np.linspace(-np.pi, np.pi, 13),
        "N_F - F_found.evaluations": 0,
        "N_same - (G_found.value.SAB > 0).sum(1)": 0,
        "N_other - (G_found.value.SAB < 0).sum(1)": 0,
        "N_none - np.isnan(G_found.value.SAB).sum(1)": 0,
        "N_g - G_found.evaluations.sum(1)": 0,
    }


def strokes(g, slider):
    """The ends of the strokes, looked for at many angles of the crank; it points at B at -90 degrees."""
    end, width = 0.0, np.pi / 2  # to the far side: the other half mirrors it
    while width > 1e-9:
        phi = end + width * np.linspace(-1, 1, 20_002)[1:-1]
        swung = abs(np.angle(slider(phi) / 1j)) if g.L1 < g.L0 else -abs(slider(phi).imag)
        end, width = phi[swung.argmax()], width / 1000
    link = np.angle(slider(end) / 1j) if g.L1 < g.L0 else np.pi / 2
    quick, swing = 2 * (end + np.pi / 2), 2 * abs(link)
    near = turns(slider, -np.pi / 2, STEP)[0] * g.omega1
    far = turns(slider, np.pi / 2, STEP)[0] * g.omega1
    known = {"gap": g.L1 - g.L0, "phi_q": quick, "phi_w": 2 * np.pi - quick, "K": (2 * np.pi - quick) / quick}
    known |= {"s_e": abs(slider(end)), "phi_e1": -np.pi / 2 - quick / 2, "phi_e2": end, "psi": swing}
    return known | {"H": abs(g.L3 * (np.exp(1j * swing) - 1)), "omega_near": near, "omega_far": far}


@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"L1": 3.1, "omega1": 7.0, "n": 9, "phi_0": 0.3, "L3": 2.2},
        {"L1": 1.7, "omega1": 4.0, "L0": 2.9, "phi3_0": -1.5},
    ],
    ids=["as printed", "goes round", "swings widely"],
)
def test_every_line_is_that_of_the_vector_to_the_slider(changed):
    g = inputs("slotted_link", **changed)
    assert disagreements("slotted_link", g, reference(g), within=3e-6) == []
