#!/usr/bin/env python3
"""Fits the polynomials of `crates/lobe/src/number/elementary.rs` and `approximate.rs`, and those of an azimuth in
`crates/lobe-sampling/src/map.rs`, and prints coefficients and bounds.

    pip install mpmath && python3 tools/minimax.py

Each fit is minimax (Remez exchange on the relative error of the whole function). Coefficients are rounded to f32 one
after the other, lowest order first, and the rest is fitted again after each, so that the last ones make up for the
rounding of the first; all at once where 0 is inside the range, since nothing makes up for the first one there. The bound printed is that of the rounded polynomial in exact arithmetic.
"""
import mpmath as mp
import struct

mp.mp.dps = 50


def f32(x):
    return mp.mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def remez(target, basis, weight, lo, hi):
    """Coefficients c that minimise max |weight (target - sum c_i basis_i)| on [lo, hi], and that maximum."""
    n = len(basis)
    points = [(lo + hi) / 2 + (hi - lo) / 2 * mp.cos(mp.pi * (n - i) / n) for i in range(n + 1)]
    grid = [lo + (hi - lo) * mp.mpf(i) / 4000 for i in range(4001)]
    table = [(x, weight(x), target(x), [b(x) for b in basis]) for x in grid]
    for _ in range(30):
        rows, rhs = [], []
        for i, x in enumerate(points):
            w = weight(x)
            rows.append([w * b(x) for b in basis] + [mp.mpf(-1) ** i])
            rhs.append(w * target(x))
        solution = mp.lu_solve(mp.matrix(rows), mp.matrix(rhs))
        c = [solution[i] for i in range(n)]
        errors = [w * (t - sum(ci * bi for ci, bi in zip(c, b))) for _, w, t, b in table]
        extrema, start = [], 0
        for i in range(1, len(errors) + 1):
            if i == len(errors) or (errors[i] >= 0) != (errors[start] >= 0):
                extrema.append(max(range(start, i), key=lambda k: abs(errors[k])))
                start = i
        while len(extrema) > n + 1:
            drop = 0 if abs(errors[extrema[0]]) < abs(errors[extrema[-1]]) else len(extrema) - 1
            extrema.pop(drop)
        if len(extrema) < n + 1:
            break
        points = [grid[i] for i in extrema]
        sizes = [abs(errors[i]) for i in extrema]
        if max(sizes) / min(sizes) < mp.mpf("1.001"):
            break
    return c, max(abs(e) for e in errors)


def fit(name, target, basis, weight, lo, hi, one_by_one=True):
    lo, hi = mp.mpf(lo), mp.mpf(hi)
    fixed = [] if one_by_one else [f32(c) for c in remez(target, basis, weight, lo, hi)[0]]
    for i in range(len(fixed), len(basis)):
        rest = lambda x: target(x) - sum(c * b(x) for c, b in zip(fixed, basis))
        c, _ = remez(rest, basis[i:], weight, lo, hi)
        fixed.append(f32(c[0]))
    grid = [lo + (hi - lo) * mp.mpf(i) / 20000 for i in range(20001)]
    worst = max(abs(weight(x) * (target(x) - sum(c * b(x) for c, b in zip(fixed, basis)))) for x in grid)
    print(f"{name}: relative error {mp.nstr(worst, 3)} = 2^{mp.nstr(mp.log(worst, 2), 4)}")
    for c in fixed:
        print(f"    {mp.nstr(c, 12)}")


def powers(first, count, step=1):
    return [lambda x, k=first + step * i: x**k for i in range(count)]


ln2 = mp.log(2)
tiny = mp.mpf("1e-6")

# 2^r = 1 + r P(r), |r| <= 1/2.
fit("exp2: 2^r - 1 = r P(r)", lambda r: mp.mpf(2) ** r - 1, powers(1, 6), lambda r: mp.mpf(2) ** -r, "-0.5", "0.5")

# log2((1+s)/(1-s)) = (2/ln 2) s + s^3 Q(s^2), |s| <= 1/5. The head is rounded afterwards, which costs another 2^-26.2:
# fitted to the rounded head, the polynomial would only wobble around an error at s = 0 that it cannot mend.
head = 2 / ln2
fit(
    f"log2_1p_div: 2/ln2 atanh(s) = {mp.nstr(f32(head), 12)} s + s^3 Q(s^2)",
    lambda s: 2 / ln2 * mp.atanh(s) - head * s,
    powers(3, 3, 2),
    lambda s: 1 / (2 / ln2 * mp.atanh(s)),
    tiny,
    "0.2",
)

# 3 atanh(s)/s = 3 + s^2 + s^4 R(s^2), |s| <= 1/5.
fit(
    "log2, log2_1p, pow: 3 atanh(s)/s = 3 + s^2 + s^4 R(s^2)",
    lambda s: 3 * mp.atanh(s) / s - 3 - s**2,
    powers(4, 4, 2),
    lambda s: mp.mpf(1) / 3,
    tiny,
    "0.2",
)

quarter = mp.pi / 4 * (1 + mp.mpf(2) ** -20)
fit("sin: sin r = r + r^3 S(r^2)", lambda r: mp.sin(r) - r, powers(3, 4, 2), lambda r: 1 / mp.sin(r), tiny, quarter)
fit("cos: cos r = 1 - r^2/2 + r^4 C(r^2)", lambda r: mp.cos(r) - 1 + r**2 / 2, powers(4, 3, 2), lambda r: 1 / mp.cos(r), tiny, quarter)

eighth = mp.tan(mp.pi / 8) * (1 + mp.mpf(2) ** -20)
fit("atan2: atan t = t + t^3 A(t^2)", lambda t: mp.atan(t) - t, powers(3, 5, 2), lambda t: 1 / mp.atan(t), tiny, eighth)


# With 3 the rounding of the coefficients happens to cost less than with 2 or 2.5.
def scaled_erfc(t):
    x = 3 * (1 + t) / (1 - t)
    return (x + 3) * mp.exp(x * x) * mp.erfc(x)


end = (mp.mpf("9.2") - 3) / (mp.mpf("9.2") + 3)
name = "erfc: (x + 3) exp(x^2) erfc(x) = P(t), t = (x - 3)/(x + 3)"
fit(name, scaled_erfc, powers(0, 10), lambda t: 1 / scaled_erfc(t), -1, end, one_by_one=False)

fit("erfc: 1 - erfc(x) = x E(x^2)", mp.erf, powers(1, 5, 2), lambda x: 1 / mp.erfc(x), tiny, "0.625")

# Constants in parts that multiply exactly with 9-bit integers.
rest = mp.pi / 2
for i, bits in enumerate([15, 15, 15, 24]):
    e = mp.floor(mp.log(rest, 2))
    unit = mp.mpf(2) ** (e - bits + 1)
    part = mp.floor(rest / unit) * unit
    print(f"    pi/2 part {i + 1}: {mp.nstr(part, 20)}")
    rest -= part
cp = 2 / (3 * ln2)
unit = mp.mpf(2) ** -12
hi = mp.floor(cp / unit) * unit
print(f"    2/(3 ln 2) = {mp.nstr(hi, 20)} + {mp.nstr(f32(cp - hi), 12)}")


# --- `approximate.rs`: the same functions to 13 and to 10 digits ------------------------------------------------------

for precision, exp2, log2, atan, erfc in [("Fast", 4, 5, 3, 6), ("Coarse", 3, 4, 2, 5)]:
    fit(
        f"{precision} exp2: 2^r = P(r)",
        lambda r: mp.mpf(2) ** r,
        powers(0, exp2),
        lambda r: mp.mpf(2) ** -r,
        "-0.5",
        "0.5",
        one_by_one=False,
    )
    fit(
        f"{precision} log2: log2(1 + t) = t P(t)",
        lambda t: mp.log(1 + t) / t / ln2 if t else 1 / ln2,
        powers(0, log2),
        lambda t: t * ln2 / mp.log(1 + t) if t else ln2,
        mp.mpf(-1) / 3,
        "0.5",
        one_by_one=False,
    )
    fit(f"{precision} atan2: atan t = t A(t^2)", mp.atan, powers(1, atan, 2), lambda t: 1 / mp.atan(t), tiny, eighth, one_by_one=False)
    name = f"{precision} erfc: (x + 3) exp(x^2) erfc(x) = P(t), t = (x - 3)/(x + 3)"
    fit(name, scaled_erfc, powers(0, erfc), lambda t: 1 / scaled_erfc(t), -1, end, one_by_one=False)

fit("log2_1p_div: 2/ln2 atanh(s) = s Q(s^2)", lambda s: 2 / ln2 * mp.atanh(s), powers(1, 2, 2), lambda s: ln2 / 2 / mp.atanh(s), tiny, "0.2", one_by_one=False)
fit("Fast sin: sin r = r S(r^2)", mp.sin, powers(1, 3, 2), lambda r: 1 / mp.sin(r), tiny, quarter, one_by_one=False)
fit("Coarse sin: sin r = r S(r^2)", mp.sin, powers(1, 2, 2), lambda r: 1 / mp.sin(r), tiny, quarter, one_by_one=False)
fit("Fast cos: cos r = C(r^2)", mp.cos, powers(0, 3, 2), lambda r: 1 / mp.cos(r), tiny, quarter, one_by_one=False)
fit("Coarse cos: cos r = C(r^2)", mp.cos, powers(0, 2, 2), lambda r: 1 / mp.cos(r), tiny, quarter, one_by_one=False)


def bits(x):
    return struct.unpack("I", struct.pack("f", x))[0]


def number(i):
    return struct.unpack("f", struct.pack("I", i & 0xFFFFFFFF))[0]


# A first guess y of 1/sqrt(x) from the bits, and a polynomial P of r = x y^2 that mends it, y P(r) = 1/sqrt(x). The start
# is the one whose r has the smallest ratio of its ends. A step of 2^23 doubles every guess, which changes no ratio: one
# octave of starts holds them all.
def ends(magic):
    # Two octaves: the exponent is halved.
    sample = [number(bits(1.0) + (i << 12)) for i in range(1 << 12)]
    r = [x * number(magic - (bits(x) >> 1)) ** 2 for x in sample]
    return min(r), max(r)


def ratio(magic):
    lo, hi = ends(magic)
    return hi / lo


magic = min(range(0x5F000000, 0x5F800000, 0x8000), key=ratio)
lo, hi = ends(magic)
print(f"rsqrt: magic {magic:#x}, r from {lo:.6} to {hi:.6}")
for degree in [1, 2]:
    fit(f"rsqrt: degree {degree}", lambda r: r ** mp.mpf(-0.5), powers(0, degree + 1), lambda r: r ** mp.mpf(0.5), lo, hi, one_by_one=False)


# --- `lobe-sampling`, `map.rs`: sine and cosine of pi b, by the absolute error, in double precision -------------------

for name, target, basis in [
    ("sin: sin(pi b) = b S(b^2)", lambda b: mp.sin(mp.pi * b), powers(1, 8, 2)),
    ("cos: cos(pi b) = 1 + b^2 C(b^2)", lambda b: mp.cos(mp.pi * b) - 1, powers(2, 7, 2)),
]:
    c, worst = remez(target, basis, lambda b: mp.mpf(1), tiny, mp.mpf("0.5"))
    print(f"azimuth {name}: error {mp.nstr(worst, 3)}")
    for x in c:
        print(f"    {mp.nstr(x, 17)}")
