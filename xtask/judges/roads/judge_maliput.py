#!/usr/bin/env python3
"""Judge an OpenDRIVE file by maliput: usage: judge_maliput.py FILE.xodr

The road network must load, all lanes of it and not only those that cars drive on, with gaps of less than 5 cm and 0.01 rad. Then every
lane is walked: its length, its centre at both ends and in between, and that all lanes which branch from one point meet there. A driving
lane of the file that was not loaded is a fault, and so is a lane of a connecting road that leads nowhere. `fault:` lines are for people,
the `note:` line comes last; ends with 1 if there is a fault.
"""
import itertools
import math
import os
import sys
import xml.etree.ElementTree as ElementTree

import maliput_malidrive

os.environ["MALIPUT_PLUGIN_PATH"] = maliput_malidrive.get_plugin_path()
import maliput.api as api
import maliput.plugin as plugin

LINEAR_M, ANGULAR_RAD = 0.05, 0.01
# Points along each lane lie no further apart than this, m, and there are 17 at least.
APART_M, PIECES = 5.0, 16
faults = []


def load(file):
    properties = {
        "opendrive_file": file,
        "road_geometry_id": "judged",
        "linear_tolerance": str(LINEAR_M),
        "angular_tolerance": str(ANGULAR_RAD),
        "omit_nondrivable_lanes": "false",
        "standard_strictness_policy": "strict",
    }
    return plugin.create_road_network("maliput_malidrive", properties)


def lanes_of(geometry):
    for j in range(geometry.num_junctions()):
        junction = geometry.junction(j)
        for s in range(junction.num_segments()):
            segment = junction.segment(s)
            for l in range(segment.num_lanes()):
                yield segment.lane(l)


def centre(lane, s):
    """The lane's centre at s, in the file's frame."""
    point = lane.ToInertialPosition(api.LanePosition(s, 0.0, 0.0))
    return point.x(), point.y(), point.z()


def walk(lane):
    """Compares a lane's length with points along it."""
    name, length = lane.id().string(), lane.length()
    pieces = max(PIECES, math.ceil(length / APART_M)) if 0 < length < math.inf else PIECES
    points = [centre(lane, length * i / pieces) for i in range(pieces + 1)]
    if not (length > 0 and all(math.isfinite(v) for point in points for v in point)):
        faults.append(f"lane {name} is {length} m long, or a point of it is no number")
    chords = sum(math.dist(a, b) for a, b in zip(points, points[1:]))
    if not 0.9 * length - LINEAR_M <= chords <= length + LINEAR_M:
        faults.append(f"lane {name} is said to be {length:.3f} m long, but its points are {chords:.3f} m apart")


def meet(branch):
    """How far the ends of lanes that branch from one point lie apart at most, and for each end whether lanes go on there."""
    # A lane's own way to its branch point hands out what Python then frees, so that the points are asked for their lanes.
    sides = [[side.get(i) for i in range(side.size())] for side in (branch.GetASide(), branch.GetBSide())]
    ends = {}
    for side, other in (sides, sides[::-1]):
        for end in side:
            is_start = end.end == api.Which.kStart
            point = centre(end.lane, 0.0 if is_start else end.lane.length())
            ends[end.lane.id().string(), "start" if is_start else "end"] = (point, bool(other))
    worst = 0.0
    for (a, (p, _)), (b, (q, _)) in itertools.combinations(ends.items(), 2):
        gap = math.dist(p, q)
        worst = max(worst, gap)
        if not gap <= LINEAR_M:
            faults.append(f"lane {a[0]} branches to {b[0]} over a gap of {gap:.3f} m")
    return worst, {end: goes_on for end, (_, goes_on) in ends.items()}


def judge(file):
    try:
        network = load(file)
    except Exception as error:  # What maliput throws has many types; its text begins with the place in its own source.
        faults.append(f"maliput refuses it: {error}".replace("\n", " "))
        return "not loaded"
    geometry = network.road_geometry()
    broken = geometry.CheckInvariants()
    faults.extend(f"maliput: {text}" for text in broken)
    wanted, connecting = set(), set()
    for road in ElementTree.parse(file).getroot().findall("road"):
        for number, section in enumerate(road.findall("lanes/laneSection")):
            for lane in section.iter("lane"):
                if lane.get("type") == "driving" and lane.get("id") != "0":
                    name = f"{road.get('id')}_{number}_{lane.get('id')}"
                    wanted.add(name)
                    if road.get("junction") not in (None, "-1"):
                        connecting.add(name)
    worst, metres, branches, loaded = 0.0, 0.0, geometry.num_branch_points(), set()
    for lane in lanes_of(geometry):
        loaded.add(lane.id().string())
        metres += lane.length()
        walk(lane)
    for i in range(branches):
        gap, ends = meet(geometry.branch_point(i))
        worst = max(worst, gap)
        for (name, end), goes_on in ends.items():
            if name in connecting and not goes_on:
                faults.append(f"lane {name} of a connecting road leads nowhere at its {end}")
    if not loaded:
        faults.append("no lane was loaded")
    faults.extend(f"the driving lane {name} was not loaded" for name in sorted(wanted - loaded))
    return f"{len(loaded)} lanes of {metres:.1f} m, {branches} branch points, worst gap {worst:.2g} m"


note = judge(sys.argv[1])
for text in faults:
    print(f"fault: {text}")
print(f"note: {note}")
sys.exit(1 if faults else 0)
