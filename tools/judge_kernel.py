"""Judges the clothoid kernel by programs that nobody here wrote: scipy's Fresnel integrals, mpmath and pyclothoids.

    cargo run --release -p fairpath-curve --example kernel_cases | python tools/judge_kernel.py

Needs numpy, scipy, mpmath and pyclothoids. Prints the worst relative error of each kind and `N passed, M failed`; ends with
1 on any failure, or if nothing was compared.
"""

import json
import math
import sys
from collections import Counter

import mpmath
import numpy as np
import pyclothoids
from scipy.special import fresnel

EVALUATION = 1e-12  # of the length
END = 1e-12  # of the length: G1
END_G2 = 1e-11  # of the length, three segments
NEAREST = 1e-12  # of length + distance
PEER = 1e-7  # agreement with pyclothoids, whose own residuals reach 1e-9
COST = 1.5  # a G2 answer may vary its curvature at most this much more than pyclothoids'


def by_fresnel(heading, kappa0, sharpness, s):
    """Displacement by scipy, and an estimate of its error: completing the square loses digits for small sharpness."""
    root = math.sqrt(abs(sharpness) / math.pi)
    if root == 0.0:
        return None, math.inf
    sign = math.copysign(1.0, sharpness)
    x0 = sign * kappa0 / (math.pi * root)
    x1 = x0 + s * root
    phase = heading - sign * 0.5 * math.pi * x0 * x0
    s0, c0 = fresnel(x0)
    s1, c1 = fresnel(x1)
    dc, ds = (c1 - c0) / root, sign * (s1 - s0) / root
    cos, sin = math.cos(phase), math.sin(phase)
    error = 3e-16 * (1 + abs(heading) + 4 * x0 * x0 + 4 * x1 * x1) * min(s, 1.0 / root) + 3e-16 * max(abs(x0), 1) / root
    return (cos * dc - sin * ds, sin * dc + cos * ds), error


def by_mpmath(heading, kappa0, kappa1, length, s):
    """The same to far more digits than needed."""
    with mpmath.workdps(60):
        heading, kappa0, kappa1, length, s = map(mpmath.mpf, (heading, kappa0, kappa1, length, s))
        sharpness = (kappa1 - kappa0) / length
        if sharpness == 0:
            if kappa0 == 0:
                return float(s * mpmath.cos(heading)), float(s * mpmath.sin(heading))
            end = heading + kappa0 * s
            dx = (mpmath.sin(end) - mpmath.sin(heading)) / kappa0
            return float(dx), float((mpmath.cos(heading) - mpmath.cos(end)) / kappa0)
        scale = float(abs(sharpness)) * float(s) ** 2
        if scale < 1e-6:
            # The square's completion would need many more digits: expand e^{i sharpness u²/2} to the fourth order instead.
            total = mpmath.mpc(0)
            for k in range(8):
                total += (1j * sharpness / 2) ** k / mpmath.factorial(k) * power_moment(kappa0, s, 2 * k)
            total *= mpmath.expj(heading)
            return float(total.real), float(total.imag)
        root = mpmath.sqrt(abs(sharpness) / mpmath.pi)
        sign = mpmath.sign(sharpness)
        x0 = sign * kappa0 / (mpmath.pi * root)
        x1 = x0 + s * root
        phase = mpmath.expj(heading - sign * mpmath.pi * x0 * x0 / 2)
        dc = (mpmath.fresnelc(x1) - mpmath.fresnelc(x0)) / root
        ds = sign * (mpmath.fresnels(x1) - mpmath.fresnels(x0)) / root
        total = phase * mpmath.mpc(dc, ds)
        return float(total.real), float(total.imag)


def power_moment(kappa, s, k):
    """The integral of u^k e^{i kappa u} over [0, s]: by its power series, whose digits the working precision pays for."""
    total, term, n = mpmath.mpc(0), mpmath.mpc(1), 0
    z = 1j * kappa * s
    with mpmath.extradps(int(abs(z) * 0.9) + 10):
        while True:
            total += term / (n + k + 1)
            n += 1
            term = term * z / n
            if abs(term) < mpmath.mpf(10) ** -70 and n > abs(z):
                return total * s ** (k + 1)


def displacement(segment, s, error_wanted):
    x, y, heading, length, kappa0, kappa1 = segment
    answer, error = by_fresnel(heading, kappa0, (kappa1 - kappa0) / length, s)
    if error > 0.1 * error_wanted:
        return by_mpmath(heading, kappa0, kappa1, length, s), "mpmath"
    return answer, "scipy"


NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)


def sample(segment, stations):
    """Points at increasing stations by numpy's own quadrature, one panel between neighbours: for dense searches."""
    x, y, heading, length, kappa0, kappa1 = segment
    sharpness = (kappa1 - kappa0) / length
    low, high = stations[:-1], stations[1:]
    mid, half = 0.5 * (low + high), 0.5 * (high - low)
    u = mid[:, None] + half[:, None] * NODES
    theta = heading + kappa0 * u + 0.5 * sharpness * u * u
    dx = half * (np.cos(theta) @ WEIGHTS)
    dy = half * (np.sin(theta) @ WEIGHTS)
    return x + np.concatenate([[0], np.cumsum(dx)]), y + np.concatenate([[0], np.cumsum(dy)])


def least_distance(segment, point):
    """Dense sampling, then ever denser around the best samples."""
    length = segment[3]
    stations = np.linspace(0.0, length, 3001)
    px, py = sample(segment, stations)
    d = np.hypot(px - point[0], py - point[1])
    step = length / 3000
    best = d.min()
    for i in np.flatnonzero(d <= best + step):
        if (i > 0 and d[i - 1] < d[i]) or (i < 3000 and d[i + 1] < d[i]):
            continue
        low, high = stations[max(i - 1, 0)], stations[min(i + 1, 3000)]
        for _ in range(6):
            fine = np.linspace(low, high, 41)
            qx, qy = sample(segment, np.concatenate([[0.0], stations[(stations > 0) & (stations < low)], fine]) if low > 0 else fine)
            e = np.hypot(qx[-41:] - point[0], qy[-41:] - point[1])
            j = int(e.argmin())
            best = min(best, e[j])
            low, high = fine[max(j - 1, 0)], fine[min(j + 1, 40)]
    return best


def end_gap(segments, end):
    """What a chain of segments misses of its end, by independent evaluation, in units of its length and in radians."""
    x, y = segments[0][0], segments[0][1]
    total = sum(s[3] for s in segments)
    gap = 0.0
    for s in segments:
        gap = max(gap, math.hypot(s[0] - x, s[1] - y))
        (dx, dy), _ = displacement(s, s[3], 1e-13 * total)
        x, y = s[0] + dx, s[1] + dy
    gap = max(gap, math.hypot(end[0] - x, end[1] - y)) / total
    last = segments[-1]
    turn = last[2] + 0.5 * (last[4] + last[5]) * last[3] - end[2]
    return gap, abs(math.remainder(turn, 2 * math.pi))


def variation(segments):
    """Integral of the squared sharpness times length³, the greatest sharpness times length², and the length."""
    length = sum(s[3] for s in segments)
    rates = [(s[5] - s[4]) / s[3] for s in segments]
    return sum(r * r * s[3] for r, s in zip(rates, segments)) * length**3, max(map(abs, rates)) * length**2, length


def of_pyclothoids(c):
    return [c.XStart, c.YStart, c.ThetaStart, c.length, c.KappaStart, c.KappaEnd]


class Judge:
    def __init__(self):
        self.passed = Counter()
        self.failed = Counter()
        self.worst = {}
        self.notes = Counter()
        self.ratios = []

    def check(self, kind, error, limit, case):
        self.worst[kind] = max(self.worst.get(kind, 0.0), error)
        if error <= limit:
            self.passed[kind] += 1
            return
        self.failed[kind] += 1
        if self.failed[kind] <= 3:
            print(f"FAILED {kind}: {error:.3e} > {limit:.1e}: {json.dumps(case)}")

    def evaluate(self, case):
        segment, s = case["segment"], case["s"]
        (dx, dy), by = displacement(segment, s, EVALUATION * segment[3])
        self.notes[f"evaluations by {by}"] += 1
        error = math.hypot(case["x"] - (segment[0] + dx), case["y"] - (segment[1] + dy)) / segment[3]
        self.check("evaluate", error, EVALUATION, case)

    def nearest(self, case):
        segment, point, s = case["segment"], case["point"], case["s"]
        scale = segment[3] + case["distance"]
        self.check("nearest: beyond dense search", (case["distance"] - least_distance(segment, point)) / scale, NEAREST, case)
        (dx, dy), _ = displacement(segment, s, EVALUATION * segment[3])
        there = math.hypot(segment[0] + dx - point[0], segment[1] + dy - point[1])
        self.check("nearest: distance at its arc length", abs(there - case["distance"]) / scale, NEAREST, case)

    def g1(self, case):
        start, end, answer = case["start"], case["end"], case["answer"]
        if answer is None:
            self.check("g1: no answer", 1.0, 0.0, case)
            return
        gap, turn = end_gap([answer], end)
        self.check("g1: end", gap, END, case)
        self.check("g1: end heading", turn, 1e-11, case)
        peer = of_pyclothoids(pyclothoids.Clothoid.G1Hermite(*start, *end))
        if not all(map(math.isfinite, peer)) or end_gap([peer], end)[0] > 1e-8:
            self.notes["g1: pyclothoids missed its own end"] += 1
            return
        length = answer[3]
        differs = max(abs(peer[3] / length - 1), abs(peer[4] - answer[4]) * length, abs(peer[5] - answer[5]) * length)
        self.check("g1: against pyclothoids", differs, PEER, case)

    def g2(self, case):
        start, end, answer = case["start"], case["end"], case["answer"]
        if answer is None:
            self.check("g2: no answer", 1.0, 0.0, case)
            return
        gap, turn = end_gap(answer, end)
        self.check("g2: end", gap, END_G2, case)
        self.check("g2: end heading", turn, 1e-10, case)
        for a, b in zip(answer, answer[1:]):
            join = abs(math.remainder(a[2] + 0.5 * (a[4] + a[5]) * a[3] - b[2], 2 * math.pi)) + abs(a[5] - b[4])
            self.check("g2: joins", join, 1e-10, case)
        self.check("g2: end curvatures", abs(answer[0][4] - start[3]) + abs(answer[2][5] - end[3]), 0.0, case)
        peer = [of_pyclothoids(c) for c in pyclothoids.SolveG2(*start, *end)]
        if end_gap(peer, end)[0] > 1e-6:
            self.notes["g2: pyclothoids missed its own end"] += 1
            return
        ours, theirs = variation(answer), variation(peer)
        # Straight lines vary by nothing: the floor keeps rounding out of the ratio.
        ratio = [(a + 1e-9) / (b + 1e-9) for a, b in zip(ours, theirs)]
        self.ratios.append(ratio)
        self.check("g2: variation of curvature against pyclothoids", ratio[0], COST, case)

    def report(self):
        for kind in sorted(set(self.passed) | set(self.failed)):
            print(f"{kind}: {self.passed[kind]} passed, {self.failed[kind]} failed, worst {self.worst[kind]:.2e}")
        for note, count in sorted(self.notes.items()):
            print(f"{note}: {count}")
        if self.ratios:
            for name, column in zip(("variation", "greatest sharpness", "length"), zip(*self.ratios)):
                low, mid, high = np.quantile(column, [0.05, 0.5, 0.95])
                print(f"g2, ours / pyclothoids, {name}: median {mid:.3f}, 5 % {low:.3f}, 95 % {high:.3f}")
        passed, failed = sum(self.passed.values()), sum(self.failed.values())
        print(f"{passed} passed, {failed} failed")
        kinds = {"evaluate", "nearest: beyond dense search", "g1: against pyclothoids", "g2: end"}
        missing = [k for k in sorted(kinds) if self.passed[k] + self.failed[k] == 0]
        if missing:
            print(f"nothing was compared: {', '.join(missing)}")
        return 1 if failed or missing else 0


def main():
    judge = Judge()
    for line in sys.stdin:
        if line.strip():
            case = json.loads(line)
            getattr(judge, case["case"])(case)
    return judge.report()


if __name__ == "__main__":
    sys.exit(main())
