# The names of `mechsheet.units`: a test compares them with the definitions.
from mechsheet.units.definitions import PURE as PURE
from mechsheet.units.definitions import Constant as Constant
from mechsheet.units.definitions import Dims as Dims
from mechsheet.units.definitions import Unit as Unit
from mechsheet.units.definitions import celsius as celsius
from mechsheet.units.definitions import constant as constant
from mechsheet.units.definitions import define as define
from mechsheet.units.definitions import known as known
from mechsheet.units.definitions import names as names
from mechsheet.units.definitions import nearest as nearest
from mechsheet.units.definitions import parse as parse
from mechsheet.units.exchange import ANGLE as ANGLE
from mechsheet.units.exchange import BARE as BARE
from mechsheet.units.exchange import CYCLES as CYCLES
from mechsheet.units.exchange import alike as alike
from mechsheet.units.exchange import conversion as conversion
from mechsheet.units.exchange import convertible as convertible
from mechsheet.units.exchange import kind as kind
from mechsheet.units.exchange import turned as turned
from mechsheet.units.printing import raised as raised
from mechsheet.units.printing import shown as shown
from mechsheet.units.printing import si as si
from mechsheet.units.printing import word as word
from mechsheet.units.text import UNKNOWN as UNKNOWN
from mechsheet.units.text import plain as plain

_floats: tuple[float, ...]
# fmt: off
m, kg, s, A, K, mol, cd, N, Pa, J, W, Hz, C, V, F, ohm, S, Wb, T, H, lm, lx, Bq, Gy, Sv, kat, sr, g, L, l = _floats
bar, Wh, t, min, h, day, degC, inch, mil, ft, yd, mile, nmi, knot, acre, gal, inHg, lb, oz, slug, kgf, tf = _floats
lbf, kip, psi, ksi, atm = _floats
at, mmHg, hp, PS, cal, BTU, rad, deg, arcmin, arcsec, rev, rpm, qm, rm, ym, zm, am, fm, pm, nm, um, mm, cm = _floats
dm, dam, hm, km, Mm, Gm, Tm, Pm, Em, Zm, Ym, Rm, Qm, qs, rs, ys, zs, fs, ps, ns, us, ms, cs, ds, das, hs, ks = _floats
Ms, Gs, Ts, Ps, Es, Zs, Ys, Rs, Qs, qA, rA, yA, zA, aA, fA, pA, nA, uA, mA, cA, dA, daA, hA, kA, MA, GA, TA = _floats
PA, EA, ZA, YA, RA, QA, qK, rK, yK, zK, aK, fK, pK, nK, uK, mK, cK, dK, daK, hK, kK, MK, GK, TK, PK, EK, ZK = _floats
YK, RK, QK, qmol, rmol, ymol, zmol, amol, fmol, pmol, nmol, umol, mmol, cmol, dmol, damol, hmol, kmol, Mmol = _floats
Gmol, Tmol, Pmol, Emol, Zmol, Ymol, Rmol, Qmol, qcd, rcd, ycd, zcd, acd, fcd, pcd, ncd, ucd, mcd, ccd, dcd = _floats
dacd, hcd, kcd, Mcd, Gcd, Tcd, Pcd, Ecd, Zcd, Ycd, Rcd, Qcd, qHz, rHz, yHz, zHz, aHz, fHz, pHz, nHz, uHz = _floats
mHz, cHz, dHz, daHz, hHz, kHz, MHz, GHz, THz, PHz, EHz, ZHz, YHz, RHz, QHz, qN, rN, yN, zN, aN, fN, pN, nN = _floats
uN, mN, cN, dN, daN, hN, kN, MN, GN, TN, PN, EN, ZN, YN, RN, QN, qPa, rPa, yPa, zPa, aPa, fPa, pPa, nPa, uPa = _floats
mPa, cPa, dPa, daPa, hPa, kPa, MPa, GPa, TPa, PPa, EPa, ZPa, YPa, RPa, QPa, qJ, rJ, yJ, zJ, aJ, fJ, pJ, nJ = _floats
uJ, mJ, cJ, dJ, daJ, hJ, kJ, MJ, GJ, TJ, PJ, EJ, ZJ, YJ, RJ, QJ, qW, rW, yW, zW, aW, fW, pW, nW, uW, mW, cW = _floats
dW, daW, hW, kW, MW, GW, TW, PW, EW, ZW, YW, RW, QW, qC, rC, yC, zC, aC, fC, pC, nC, uC, mC, cC, dC, daC, hC = _floats
kC, MC, GC, TC, PC, EC, ZC, YC, RC, QC, qV, rV, yV, zV, aV, fV, pV, nV, uV, mV, cV, dV, daV, hV, kV, MV, GV = _floats
TV, PV, EV, ZV, YV, RV, QV, qF, rF, yF, zF, aF, fF, pF, nF, uF, mF, cF, dF, daF, hF, kF, MF, GF, TF, PF, EF = _floats
ZF, YF, RF, QF, qohm, rohm, yohm, zohm, aohm, fohm, pohm, nohm, uohm, mohm, cohm, dohm, daohm, hohm, kohm = _floats
Mohm, Gohm, Tohm, Pohm, Eohm, Zohm, Yohm, Rohm, Qohm, qS, rS, yS, zS, aS, fS, pS, nS, uS, mS, cS, dS, daS = _floats
hS, kS, MS, GS, TS, ES, ZS, YS, RS, QS, qWb, rWb, yWb, zWb, aWb, fWb, pWb, nWb, uWb, mWb, cWb, dWb, daWb = _floats
hWb, kWb, MWb, GWb, TWb, PWb, EWb, ZWb, YWb, RWb, QWb, qT, rT, yT, zT, aT, fT, pT, nT, uT, mT, cT, dT, daT = _floats
hT, kT, MT, GT, TT, PT, ET, ZT, YT, RT, QT, qH, rH, yH, zH, aH, fH, pH, nH, uH, mH, cH, dH, daH, hH, kH, MH = _floats
GH, TH, PH, EH, ZH, YH, RH, QH, qlm, rlm, ylm, zlm, alm, flm, plm, nlm, ulm, mlm, clm, dlm, dalm, hlm, klm = _floats
Mlm, Glm, Tlm, Plm, Elm, Zlm, Ylm, Rlm, Qlm, qlx, rlx, ylx, zlx, alx, flx, plx, nlx, ulx, mlx, clx, dlx = _floats
dalx, hlx, klx, Mlx, Glx, Tlx, Plx, Elx, Zlx, Ylx, Rlx, Qlx, qBq, rBq, yBq, zBq, aBq, fBq, pBq, nBq, uBq = _floats
mBq, cBq, dBq, daBq, hBq, kBq, MBq, GBq, TBq, PBq, EBq, ZBq, YBq, RBq, QBq, qGy, rGy, yGy, zGy, aGy, fGy = _floats
pGy, nGy, uGy, mGy, cGy, dGy, daGy, hGy, kGy, MGy, GGy, TGy, PGy, EGy, ZGy, YGy, RGy, QGy, qSv, rSv, ySv = _floats
zSv, aSv, fSv, pSv, nSv, uSv, mSv, cSv, dSv, daSv, hSv, kSv, MSv, GSv, TSv, PSv, ESv, ZSv, YSv, RSv, QSv = _floats
qkat, rkat, ykat, zkat, akat, fkat, pkat, nkat, ukat, mkat, ckat, dkat, dakat, hkat, kkat, Mkat, Gkat, Tkat = _floats
Pkat, Ekat, Zkat, Ykat, Rkat, Qkat, qsr, rsr, ysr, zsr, asr, fsr, psr, nsr, usr, msr, csr, dsr, dasr, hsr = _floats
ksr, Msr, Gsr, Tsr, Psr, Esr, Zsr, Ysr, Rsr, Qsr, qg, rg, yg, zg, ag, fg, pg, ng, ug, mg, cg, dg, dag, hg = _floats
Mg, Gg, Tg, Pg, Eg, Zg, Yg, Rg, Qg, qL, rL, yL, zL, aL, fL, pL, nL, uL, mL, cL, dL, daL, hL, kL, ML, GL, TL = _floats
PL, EL, ZL, YL, RL, QL, ql, rl, yl, zl, al, fl, pl, nl, ul, ml, cl, dl, dal, hl, kl, Ml, Gl, Tl, Pl, El, Zl = _floats
Yl, Rl, Ql, urad, mrad, ubar, mbar, kbar, Mbar, mWh, kWh, MWh, GWh, kt, Mt, Gt, kcal = _floats
