#!/usr/bin/env python3
"""Evaluate the alignments of a LandXML file by itself: usage: judge_landxml.py FILE.xml

Each Line, Curve and Spiral is walked by its length and radii from its Start, along the heading that the pieces before it lead to, and must
reach its End within 1 mm; spirals by scipy's Fresnel integrals. Points are northing, easting, as LandXML has them; `rot` is as seen from
above. The pieces must be joined, their lengths add up to the alignment's, and a profile's points follow each other. Points of a surface have
ids of their own, triangles three of them. `fault:` and `warning:` lines are for people, the `note:` line comes last; ends with 1 if there is a fault.
"""
import math
import sys
import xml.etree.ElementTree as ElementTree

from clothoid import clothoid_end, turned

GAP_M, GAP_RAD = 1e-3, 1e-3
MOST_POINTS = 100_000_000
faults, warnings = [], []


def local(element):
    """The name without its namespace: national profiles of LandXML have namespaces of their own."""
    return element.tag.rsplit("}", 1)[-1] if isinstance(element.tag, str) else ""


def named(element, name):
    return [child for child in element if local(child) == name]


def number(element, name):
    text = element.get(name)
    if text is None:
        raise ValueError(f"a {local(element)} lacks {name}")
    value = math.inf if text.strip().upper() in ("INF", "INFINITY") else float(text)
    if math.isnan(value):
        raise ValueError(f"{name} of a {local(element)} is no number")
    return value


def point(element, name):
    """Easting and northing, so that headings turn to the left from the x axis."""
    found = named(element, name)
    if len(found) != 1 or len((found[0].text or "").split()) not in (2, 3):
        raise ValueError(f"a {local(element)} has no {name} of two or three numbers")
    northing, easting = (float(word) for word in found[0].text.split()[:2])
    return easting, northing


def direction(a, b):
    return math.atan2(b[1] - a[1], b[0] - a[0])


def side(element):
    """1 for a turn to the left, -1 for one to the right."""
    rot = element.get("rot")
    if rot not in ("cw", "ccw"):
        raise ValueError(f"rot of a {local(element)} is {rot}, which is neither cw nor ccw")
    return 1.0 if rot == "ccw" else -1.0


def walk(piece, heading):
    """Where a piece leads: its end by the walk and the headings at both ends; it begins with `heading` where it does not say one itself."""
    kind, length, start = local(piece), number(piece, "length"), point(piece, "Start")
    if not length > 0 or math.isinf(length):
        raise ValueError(f"a {kind} is {length} m long")
    if kind == "Line":
        heading = direction(start, point(piece, "End"))
        kappa0 = kappa1 = 0.0
    elif kind == "Curve":
        turn, centre = side(piece), point(piece, "Center")
        heading = direction(centre, start) + turn * math.pi / 2
        kappa0 = kappa1 = turn / number(piece, "radius")
    elif kind == "Spiral":
        if piece.get("spiType") != "clothoid":
            raise ValueError(f"this judge knows no spiral of the type {piece.get('spiType')}")
        kappa0, kappa1 = (side(piece) / number(piece, name) for name in ("radiusStart", "radiusEnd"))
        tangent = direction(start, point(piece, "PI"))
        if heading is None:
            heading = tangent
        compare_angles(f"the PI of a Spiral at {start}", heading, tangent)
    else:
        raise ValueError(f"this judge knows no {kind}")
    dx, dy, turn = clothoid_end(kappa0, kappa1, length)
    return turned(*start, heading, dx, dy), heading, heading + turn


def compare_angles(where, a, b):
    gap = abs(math.remainder(a - b, 2 * math.pi))
    if gap > GAP_RAD:
        warnings.append(f"{where}: the heading differs by {gap:.2g}")
    return gap


def judge_alignment(alignment):
    """The worst distances and gaps in heading, and how many pieces there are of each kind."""
    name = alignment.get("name")
    worst_end = worst_join = worst_angle = 0.0
    counts, end, heading, total = {}, None, None, 0.0
    for geometry in named(alignment, "CoordGeom"):
        for piece in geometry:
            if local(piece) not in ("Line", "Curve", "Spiral", "IrregularLine", "Chain"):
                continue
            start, last = point(piece, "Start"), point(piece, "End")
            where = f"{name}, {local(piece)} at station {total:.3f}"
            reached, begun, left = walk(piece, heading)
            counts[local(piece)] = counts.get(local(piece), 0) + 1
            total += number(piece, "length")
            worst_end = max(worst_end, math.dist(reached, last))
            if not math.dist(reached, last) <= GAP_M:
                faults.append(f"{where}: leads {math.dist(reached, last):.6f} m beside its End")
            if local(piece) == "Spiral":
                compare_angles(f"{where}, from PI to End", left, direction(point(piece, "PI"), last))
            if end is not None:
                worst_join = max(worst_join, math.dist(start, end))
                if not math.dist(start, end) <= GAP_M:
                    faults.append(f"{where}: begins {math.dist(start, end):.6f} m beside the end of the piece before")
                worst_angle = max(worst_angle, compare_angles(f"{where}, to the piece before", begun, heading))
            end, heading = last, left
    if not counts:
        raise ValueError(f"{name} has no piece of geometry")
    if abs(total - number(alignment, "length")) > GAP_M:
        faults.append(f"{name}: said to be {number(alignment, 'length')} m long, its pieces are {total:.6f} m long")
    for profile in named(alignment, "Profile"):
        for design in named(profile, "ProfAlign"):
            judge_profile(f"{name}, profile {design.get('name')}", design)
    return worst_end, worst_join, worst_angle, counts


def judge_profile(where, design):
    """A profile's points lie at rising stations, and its curves do not overlap."""
    free_from = -math.inf
    for pvi in design:
        if local(pvi) not in ("PVI", "ParaCurve", "CircCurve"):
            continue
        station, _ = (float(word) for word in (pvi.text or "").split())
        half = 0.0 if local(pvi) == "PVI" else number(pvi, "length") / 2
        if not station - half >= free_from - GAP_M:
            faults.append(f"{where}: what stands at station {station} reaches into the point before")
        free_from = station + half


def read_alignments(file):
    """The alignments of a file, without holding in memory the surfaces, which are most of it. Points of a surface must have ids of their own, and triangles three of these."""
    alignments, points = [], bytearray()
    for _, element in ElementTree.iterparse(file):
        kind = local(element)
        if kind == "Alignment":
            alignments.append(element)
        elif kind == "Surface":
            points = bytearray()
        elif kind == "P":
            own = int(element.get("id", "0"))
            if not 0 < own <= MOST_POINTS:
                raise ValueError(f"a point of a surface has the id {own}")
            if own >= len(points):
                points.extend(bytes(own + 1 - len(points)))
            if points[own]:
                raise ValueError(f"two points of a surface have the id {own}")
            points[own] = 1
            element.clear()
        elif kind == "F":
            corners = [int(word) for word in (element.text or "").split()]
            if not all(0 < corner < len(points) and points[corner] for corner in corners) or len(set(corners)) != 3:
                raise ValueError(f"a triangle of a surface has the corners {corners}")
            element.clear()
    return alignments


def judge(file):
    alignments = read_alignments(file)
    if not alignments:
        raise ValueError("no alignment in it")
    results = [judge_alignment(alignment) for alignment in alignments]
    counts = {}
    for result in results:
        for kind, count in result[3].items():
            counts[kind] = counts.get(kind, 0) + count
    ends, joins, angles = (max(result[i] for result in results) for i in range(3))
    pieces = ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items()))
    return f"{len(alignments)} alignments of {pieces}; worst: end {ends:.2g} m, join {joins:.2g} m, heading {angles:.2g}"


try:
    note = judge(sys.argv[1])
except (ElementTree.ParseError, ValueError, OSError) as error:
    faults.append(str(error))
    note = "not evaluated to its end"
for text in faults:
    print(f"fault: {text}")
for text in warnings:
    print(f"warning: {text}")
print(f"note: {note}")
sys.exit(1 if faults else 0)
