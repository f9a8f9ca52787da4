#!/usr/bin/env python3
"""Load an OpenDRIVE file with the simulator CARLA's own reader: usage: judge_carla.py FILE.xodr

It must load, and where the file has driving lanes there must be waypoints on them, and where roads are linked a topology. CARLA takes a
number that it cannot read for zero, and gaps for granted, so that it says no more than that a file can be driven. `fault:` lines are for
people, the `note:` line comes last; ends with 1 if there is a fault.
"""
import sys
import xml.etree.ElementTree as ElementTree

import carla

SPACING_M = 2.0
faults = []


def judge(file):
    with open(file, encoding="utf-8") as opened:
        text = opened.read()
    try:
        world = carla.Map("judged", text)
        waypoints, topology = world.generate_waypoints(SPACING_M), world.get_topology()
    except Exception as error:  # What CARLA throws has many types.
        faults.append(f"CARLA refuses it: {error}".replace("\n", " "))
        return "not loaded"
    roads = ElementTree.fromstring(text.encode()).findall("road")
    driven = any(lane.get("type") == "driving" and lane.get("id") != "0" for road in roads for lane in road.iter("lane"))
    linked = any(road.find(f"link/{side}") is not None for road in roads for side in ("predecessor", "successor"))
    if driven and not waypoints:
        faults.append("no waypoint on its driving lanes")
    if driven and linked and not topology:
        faults.append("no topology of its linked roads")
    ids = {waypoint.road_id for waypoint in waypoints}
    what = f"{len(waypoints)} waypoints every {SPACING_M} m on {len(ids)} roads, topology of {len(topology)} pieces"
    return what if driven else "loaded, with no driving lane to drive on"


note = judge(sys.argv[1])
for text in faults:
    print(f"fault: {text}")
print(f"note: {note}")
sys.exit(1 if faults else 0)
