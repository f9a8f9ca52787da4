#!/usr/bin/env python3
"""Evaluate the plan geometry of an OpenDRIVE file by itself: usage: judge_plan.py FILE.xodr

Lines, arcs, spirals (by scipy's Fresnel integrals) and paramPoly3 are walked from their start poses; each must end where the next one
starts, within a road and at every link to another road, where the borders of linked lanes must meet. Gaps of more than 1 mm or 1 mrad are
faults, and so are lengths that do not add up and connecting roads that their junction does not mention; breaks in slope, which roads may
have, are warnings. `fault:` and `warning:` lines are for people, the `note:` line comes last; ends with 1 if there is a fault.
"""
import math
import sys
import xml.etree.ElementTree as ElementTree

from clothoid import clothoid_end, turned

GAP_M, GAP_RAD, GAP_SLOPE = 1e-3, 1e-3, 1e-3
faults, warnings, worst = [], [], {}


def numbers(element, *names):
    values = [float(element.get(name, "nan")) for name in names]
    if not all(math.isfinite(value) for value in values):
        raise ValueError(f"<{element.tag}> at s={element.get('s')} lacks a finite number in {', '.join(names)}")
    return values


def geometry_end(geometry, length):
    """The pose after `length` metres of a <geometry>: x, y, heading."""
    x, y, heading = numbers(geometry, "x", "y", "hdg")
    shape = geometry[0]
    if shape.tag == "line":
        dx, dy, turn = length, 0.0, 0.0
    elif shape.tag == "arc":
        (kappa,) = numbers(shape, "curvature")
        dx, dy, turn = clothoid_end(kappa, kappa, length)
    elif shape.tag == "spiral":
        dx, dy, turn = clothoid_end(*numbers(shape, "curvStart", "curvEnd"), length)
    elif shape.tag == "paramPoly3":
        u, v = numbers(shape, "aU", "bU", "cU", "dU"), numbers(shape, "aV", "bV", "cV", "dV")
        p = length if shape.get("pRange") == "arcLength" else 1.0
        value = lambda c: c[0] + p * (c[1] + p * (c[2] + p * c[3]))
        slope = lambda c: c[1] + p * (2 * c[2] + p * 3 * c[3])
        dx, dy, turn = value(u), value(v), math.atan2(slope(v), slope(u))
    else:
        raise ValueError(f"<{shape.tag}> is no shape that this judge knows")
    return *turned(x, y, heading, dx, dy), heading + turn


def profile_at(records, s):
    """Height and slope of an <elevationProfile> at s."""
    valid = [record for record in records if record[0] <= s + 1e-9]
    if not valid:
        return 0.0, 0.0
    s0, a, b, c, d = valid[-1]
    ds = s - s0
    return a + ds * (b + ds * (c + ds * d)), b + ds * (2 * c + ds * 3 * d)


def seen(kind, gap, limit, where, is_fault):
    if gap > worst.get(kind, (-1.0, ""))[0]:
        worst[kind] = (gap, where)
    if not gap <= limit:
        (faults if is_fault else warnings).append(f"{where}: {kind} gap {gap:.6g}")


def angle(a, b):
    return abs(math.remainder(a - b, 2 * math.pi))


def measure_road(road):
    """Both end poses of a road, (x, y, heading, height, slope), after comparing its pieces."""
    name = f"road {road.get('id')}"
    (road_length,) = numbers(road, "length")
    geometries = road.findall("planView/geometry")
    if not geometries:
        raise ValueError(f"{name} has no geometry")
    s_expected, end = 0.0, None
    for geometry in geometries:
        s, x, y, heading, length = numbers(geometry, "s", "x", "y", "hdg", "length")
        where = f"{name}, s={s:.3f}"
        if length <= 0:
            faults.append(f"{where}: a geometry {length} m long")
        seen("station", abs(s - s_expected), GAP_M, where, True)
        if end is not None:
            seen("position", math.dist(end[:2], (x, y)), GAP_M, where, True)
            seen("heading", angle(end[2], heading), GAP_RAD, where, True)
        s_expected, end = s + length, geometry_end(geometry, length)
    seen("station", abs(s_expected - road_length), GAP_M, f"{name}, its length", True)
    records = [numbers(e, "s", "a", "b", "c", "d") for e in road.findall("elevationProfile/elevation")]
    for before, after in zip(records, records[1:]):
        z, slope = profile_at([before], after[0])
        where = f"{name}, elevation at s={after[0]:.3f}"
        seen("height", abs(z - after[1]), GAP_M, where, True)
        seen("slope", abs(slope - after[2]), GAP_SLOPE, where, False)
    x, y, heading = numbers(geometries[0], "x", "y", "hdg")
    return {"start": (x, y, heading, *profile_at(records, 0.0)), "end": (*end, *profile_at(records, road_length))}


def lane_borders(road, contact, pose):
    """For each lane id at one end of a road the points of its inner and its outer border, without superelevation."""
    sections = road.findall("lanes/laneSection")
    if not sections:
        return {}
    (road_length,) = numbers(road, "length")
    s, section = (0.0, sections[0]) if contact == "start" else (road_length, sections[-1])
    (section_start,) = numbers(section, "s")
    offsets = [numbers(e, "s", "a", "b", "c", "d") for e in road.findall("lanes/laneOffset")]
    centre = profile_at(offsets, s)[0]
    lanes = {int(lane.get("id")): lane for lane in section.iter("lane")}
    borders = {}
    for side in (1, -1):
        t = centre
        for lane_id in sorted((i for i in lanes if i * side > 0), key=abs):
            widths = [numbers(e, "sOffset", "a", "b", "c", "d") for e in lanes[lane_id].findall("width")]
            if not widths:
                raise ValueError(f"road {road.get('id')}, lane {lane_id} has no width")
            inner, t = t, t + side * profile_at(widths, s - section_start)[0]
            borders[lane_id] = [turned(*pose[:3], 0.0, offset) for offset in (inner, t)]
    return borders


def compare_lanes(where, here, there, pairs):
    """Whether the borders of linked lanes meet."""
    for a, b in pairs:
        if a not in here or b not in there:
            faults.append(f"{where}: lane {a} is linked with {b}, and one of them is not there")
            continue
        for p, q in zip(here[a], there[b]):
            seen("lane border", math.dist(p, q), GAP_M, f"{where}, lane {a} to {b}", True)


def compare_link(road, side, ends, borders):
    """A road's end against the end of the road that it says it is linked with; the number of links compared."""
    link = road.find(f"link/{side}")
    if link is None or link.get("elementType") != "road":
        return 0
    here, contact, other = "start" if side == "predecessor" else "end", link.get("contactPoint"), link.get("elementId")
    where = f"road {road.get('id')}, {side} road {other}"
    if other not in ends or contact not in ("start", "end"):
        faults.append(f"{where}: no such road or contact point")
        return 0
    a, b = ends[road.get("id")][here], ends[other][contact]
    # Two roads that meet with the same ends run against each other.
    against = here == contact
    section = road.findall("lanes/laneSection")[0 if here == "start" else -1]
    pairs = [(int(e.get("id")), int(to.get("id"))) for e in section.iter("lane") for to in e.findall(f"link/{side}")]
    if pairs:
        # A connecting road may begin at any lane, so that its reference line begins beside that of the road before it.
        compare_lanes(where, borders[road.get("id")][here], borders[other][contact], pairs)
    else:
        seen("link position", math.dist(a[:2], b[:2]), GAP_M, where, True)
    seen("link heading", angle(a[2], b[2] + (math.pi if against else 0.0)), GAP_RAD, where, True)
    seen("link height", abs(a[3] - b[3]), GAP_M, where, True)
    seen("link slope", abs(a[4] - (-b[4] if against else b[4])), GAP_SLOPE, where, False)
    return 1


def compare_connection(junction, connection, roads, borders):
    """The lanes of an incoming road against those of the connecting road; the number of connections compared."""
    incoming, connecting = connection.get("incomingRoad"), connection.get("connectingRoad")
    where = f"junction {junction.get('id')}, connection {connection.get('id')}"
    contact = connection.get("contactPoint")
    if incoming not in roads or connecting not in roads or contact not in ("start", "end"):
        faults.append(f"{where}: no such road or contact point")
        return 0
    sides = [
        end
        for side, end in (("predecessor", "start"), ("successor", "end"))
        for link in roads[incoming].findall(f"link/{side}")
        if (link.get("elementType"), link.get("elementId")) == ("junction", junction.get("id"))
    ]
    if not sides:
        faults.append(f"{where}: the incoming road {incoming} does not lead to this junction")
        return 0
    pairs = [(int(link.get("from")), int(link.get("to"))) for link in connection.findall("laneLink")]
    # A loop reaches the same junction with both ends: the one that lies at the connecting road is meant.
    point = borders[connecting][contact][pairs[0][1]][0] if pairs and pairs[0][1] in borders[connecting][contact] else None
    far = lambda end: math.dist(point, borders[incoming][end].get(pairs[0][0], [(math.inf, math.inf)])[0]) if point else 0.0
    compare_lanes(where, borders[incoming][min(sides, key=far)], borders[connecting][contact], pairs)
    return 1


def judge(file):
    root = ElementTree.parse(file).getroot()
    roads = {road.get("id"): road for road in root.findall("road")}
    if not roads:
        raise ValueError("no road in it")
    ends = {name: measure_road(road) for name, road in roads.items()}
    borders = {name: {end: lane_borders(road, end, ends[name][end]) for end in ends[name]} for name, road in roads.items()}
    links = sum(compare_link(road, side, ends, borders) for road in roads.values() for side in ("predecessor", "successor"))
    links += sum(compare_connection(j, c, roads, borders) for j in root.findall("junction") for c in j.findall("connection"))
    mentioned = {c.get("connectingRoad") for j in root.findall("junction") for c in j.findall("connection")}
    for name, road in roads.items():
        if road.get("junction", "-1") != "-1" and name not in mentioned:
            faults.append(f"road {name}: belongs to junction {road.get('junction')}, where no connection leads over it")
    pieces = sum(len(road.findall("planView/geometry")) for road in roads.values())
    gaps = ", ".join(f"{kind} {gap:.2g}" for kind, (gap, _) in worst.items())
    return f"{len(roads)} roads, {pieces} geometries, {links} links; worst gaps (m, rad): {gaps}"


try:
    note = judge(sys.argv[1])
except (ElementTree.ParseError, ValueError, IndexError, OSError) as error:
    faults.append(str(error))
    note = "not evaluated to its end"
for text in faults:
    print(f"fault: {text}")
for text in warnings:
    print(f"warning: {text}")
print(f"note: {note}")
sys.exit(1 if faults else 0)
