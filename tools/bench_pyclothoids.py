"""Prints the time pyclothoids takes for what `cargo bench -p fairpath-curve` times: evaluating and projecting.

    python tools/bench_pyclothoids.py

The same 64 ordinary segments and points beside them as in benches/kernel.rs. The C++ objects are called directly; an empty
call of the same kind is timed too, since much of the rest is Python's own.
"""

import math
import timeit

import pyclothoids


def ordinary():
    for i in range(64):
        u = i / 63
        length, turn = 20 + 60 * u, 0.1 + 1.9 * math.fmod(u * 7, 1)
        skew = 1.2 * math.fmod(u * 5, 1)
        kappa0, kappa1 = turn * (1 - skew) / length, turn * (1 + skew) / length
        yield pyclothoids.Clothoid.StandardParams(100 * u, 50, 6 * u - 3, kappa0, (kappa1 - kappa0) / length, length)


def nanoseconds(run, count):
    return min(timeit.repeat(run, number=20, repeat=9)) / 20 / count * 1e9


def main():
    curves = list(ordinary())
    cases = []
    for i, c in enumerate(curves):
        s = math.fmod(i * 0.618, 1) * c.length
        away = (0.25 * math.fmod(i * 0.37, 1) - 0.125) * c.length
        heading = c.Theta(s)
        cases.append((c, c.X(s) - away * math.sin(heading), c.Y(s) + away * math.cos(heading), 0.7 * c.length))
    for c, x, y, s in cases:
        at = c.Distance(x, y)
        assert all(math.hypot(c.X(t) - x, c.Y(t) - y) >= at - 1e-6 for t in (0, s, c.length)), "not the nearest"

    def empty():
        for c, x, y, s in cases:
            c.Theta(s)

    def evaluate():
        for c, x, y, s in cases:
            c.X(s)

    def project():
        for c, x, y, s in cases:
            c.Distance(x, y)

    print(f"pyclothoids, heading at s (mostly the call itself): {nanoseconds(empty, 64):.0f} ns")
    print(f"pyclothoids, x at s: {nanoseconds(evaluate, 64):.0f} ns")
    print(f"pyclothoids, distance of a point: {nanoseconds(project, 64):.0f} ns")


if __name__ == "__main__":
    main()
