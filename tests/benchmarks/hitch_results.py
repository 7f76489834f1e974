"""What the sweep of the hitch and the loop by hand are asked for: inputs and results, in the order of their columns."""

INPUTS = (
    *("X01", "X03", "X05", "X07", "Y01", "Y03", "Y05", "Y07", "L3", "L5", "L6", "L34", "L56", "phi_BD"),
    *("L7_pre", "L4_pre", "Y56_min", "S_min", "S_max", "P6", "X6", "Y6", "Y_P56", "phi_P6"),
    *("eta", "D_gc", "P_gc_max", "k_gc", "a", "b", "L", "P_gr", "P_msha"),
)
#: results of a variant, then those of a position; a complex one takes two places
PER_VARIANT = (
    *("dS", "O1", "O3", "O5", "O7", "L13", "phi13", "L35", "delta1", "L4_0", "L4", "S_p", "L57", "delta2"),
    *("L7_0", "L7", "LS6", "r_s", "phiS6", "S_gc", "G6", "Ra_min"),
)
PER_POSITION = (
    *("S", "P23_S", "P34_S", "P45_S", "P56_S", "P67_S", "PS6_S", "phi12_S", "phi3_S", "phi34_S", "phi4_S", "phi5_S"),
    *("phi6_S", "phi7_S", "phi12_printed", "P23s_S", "P23c_S", "P34s_S", "P45s_S", "P67s_S", "U43", "U53", "U65"),
    *("U75", "dphi3", "dphi4", "dphi5", "dphi6", "dphi7", "I56", "IS6", "F_gc", "P_gc", "G56", "GS6", "dGS65"),
    *("R56", "R07", "R67", "R65", "R34", "R05", "R45", "R01", "R03", "R23"),
    *("Ra", "Rb", "dRa", "dRb", "GS6_max", "GS6_lim", "Imp", "Isp"),
)
COMPLEX = {"O1", "O3", "O5", "O7", "G6", *(name for name in PER_POSITION if name[0] in "PR" and name[1].isdigit())}
COMPLEX |= {"PS6_S"}


def widths(names: tuple[str, ...]) -> int:
    return sum(2 if name in COMPLEX else 1 for name in names)
