"""Where clothoids lead, by scipy's Fresnel integrals, for the judges of roads."""
import math

from scipy.special import fresnel


def turned(x, y, heading, dx, dy):
    """The point that lies dx ahead and dy to the left of a pose."""
    cos, sin = math.cos(heading), math.sin(heading)
    return x + dx * cos - dy * sin, y + dx * sin + dy * cos


def clothoid_end(kappa0, kappa1, length):
    """Where a curve ends that starts at the origin along x and whose curvature changes linearly: x, y, heading."""
    sharpness = (kappa1 - kappa0) / length
    turn = length * (kappa0 + kappa1) / 2
    if abs(sharpness) * length * length < 1e-9:
        # The change of curvature moves the end by less than a nanometre for each metre.
        mean = turn / length
        if abs(turn) < 1e-9:
            return length, length * turn / 2, turn
        return math.sin(turn) / mean, 2 * math.sin(turn / 2) ** 2 / mean, turn
    # Completing the square: the heading is sharpness / 2 * (s + shift)^2 + base.
    shift = kappa0 / sharpness
    base = -sharpness * shift * shift / 2
    scale = math.sqrt(math.pi / abs(sharpness))
    s1, c1 = fresnel((length + shift) / scale)
    s0, c0 = fresnel(shift / scale)
    x, y = scale * (c1 - c0), math.copysign(scale, sharpness) * (s1 - s0)
    return *turned(0, 0, base, x, y), turn
