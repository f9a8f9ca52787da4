#!/usr/bin/env python3
"""Draws the examples of this folder, as a hand would: usage: python3 examples/draw.py

Each figure is a handful of points that a smooth path goes through, or corners between straight strokes. The hand moves along
it with varying speed, sampled 100 times a second, and trembles: slowly by about a pixel, and from sample to sample by a third of one.
Needs nothing but Python; the seed is fixed, so the files come out the same.
"""
import json
import math
import random
from pathlib import Path

HERE = Path(__file__).parent
RATE_HZ = 100
random.seed(20100903)


def smooth(knots, per_span=60):
    """A Catmull-Rom curve through the knots, finely sampled."""
    ends = [knots[0], *knots, knots[-1]]
    out = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:]):
        for i in range(per_span):
            t = i / per_span
            w = (-t + 2 * t**2 - t**3, 2 - 5 * t**2 + 3 * t**3, t + 4 * t**2 - 3 * t**3, -(t**2) + t**3)
            out.append(tuple(sum(wi * p[k] for wi, p in zip(w, (a, b, c, d))) / 2 for k in (0, 1)))
    return [*out, knots[-1]]


def straight(corners, per_span=60):
    out = []
    for (x0, y0), (x1, y1) in zip(corners, corners[1:]):
        out += [(x0 + (x1 - x0) * i / per_span, y0 + (y1 - y0) * i / per_span) for i in range(per_span)]
    return [*out, corners[-1]]


def turn(path, i):
    """How sharply the path turns about its i-th point, radians."""
    (ax, ay), (bx, by), (cx, cy) = path[max(i - 6, 0)], path[i], path[min(i + 6, len(path) - 1)]
    a, b = math.atan2(by - ay, bx - ax), math.atan2(cy - by, cx - bx)
    return abs((b - a + math.pi) % (2 * math.pi) - math.pi)


def draw(name, path, speed=420.0):
    """Samples a path as a trembling hand at about so many px/s, slower in bends."""
    waves = [(random.uniform(0.012, 0.03), random.uniform(0, 6.3), random.uniform(0.3, 0.7)) for _ in range(4)]
    points, along, due, time = [], 0.0, 0.0, 0.0
    for i, ((x0, y0), (x1, y1)) in enumerate(zip(path, path[1:])):
        along += math.hypot(x1 - x0, y1 - y0)
        if along < due and i < len(path) - 2:
            continue
        wobble = [sum(a * math.sin(2 * math.pi * f * along + p) for f, p, a in waves[k : k + 2]) for k in (0, 2)]
        x, y = (v + w + random.gauss(0, 0.33) for v, w in zip((x1, y1), wobble))
        points.append([round(x, 1), round(y, 1), round(time, 3), round(min(1, 0.25 + time * 4) * random.uniform(0.55, 0.62), 2)])
        pace = speed / (1 + 1.6 * turn(path, i)) * random.uniform(0.85, 1.15)
        due = along + pace / RATE_HZ
        time += 1 / RATE_HZ
    return {"name": name, "points": points}


def hello():
    word = [
        (40, 196), (66, 160), (92, 100), (93, 64), (80, 62), (73, 100), (70, 150), (67, 199),
        (74, 163), (92, 139), (108, 146), (110, 172), (116, 197), (132, 196),
        (156, 178), (178, 152), (174, 133), (157, 140), (150, 166), (160, 195), (182, 197), (206, 172),
        (232, 118), (241, 78), (231, 61), (219, 84), (214, 132), (217, 178), (231, 199), (250, 183),
        (278, 122), (288, 80), (278, 61), (266, 84), (261, 132), (264, 178), (278, 199), (296, 184),
        (316, 152), (338, 135), (322, 140), (310, 166), (320, 195), (345, 192), (355, 164), (343, 140),
        (334, 146), (350, 158), (374, 148), (398, 141),
    ]
    circle = [(520 + 62 * math.cos(a), 125 + 60 * math.sin(a)) for a in (-1.9 + 0.4 * i for i in range(17))]
    star = [(140 + 72 * math.cos(a), 345 + 70 * math.sin(a)) for a in (-math.pi / 2 + i * 0.8 * math.pi for i in range(6))]
    letter = [(372, 285), (345, 272), (316, 282), (307, 308), (329, 332), (360, 350), (372, 380), (350, 409), (316, 408), (297, 392)]
    path = [(452, 390), (480, 340), (520, 320), (560, 345), (585, 380), (620, 385)]
    return [
        draw("hello", smooth(word)), draw("circle", smooth(circle)), draw("star", straight(star)),
        draw("letter S", smooth(letter)), draw("bend", smooth(path)),
    ]


def write_json(file, strokes):
    rows = ",\n".join(
        f'  {{"name":{json.dumps(s["name"])},"points":{json.dumps(s["points"], separators=(",", ":"))}}}' for s in strokes
    )
    text = f'{{"format":"fairpath-strokes","version":1,"unit":"px","dpi":100,"y":"down",\n "strokes":[\n{rows}\n]}}\n'
    (HERE / file).write_text(text)


def write_svg(file, strokes):
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" width="420" height="260" viewBox="0 0 420 260">']
    lines.append('  <g fill="none" stroke="black" transform="translate(10 10)">')
    for s in strokes:
        pairs = " ".join(f"{x},{y}" for x, y, *_ in s["points"])
        lines.append(f'    <polyline id="{s["name"]}" points="{pairs}"/>')
    (HERE / file).write_text("\n".join([*lines, "  </g>", "</svg>", ""]))


def write_csv(file, strokes):
    blocks = ["\n".join([f'# name: {s["name"]}', *(f"{x},{y},{t}" for x, y, t, _ in s["points"])]) for s in strokes]
    (HERE / file).write_text("x,y,t\n" + "\n\n".join(blocks) + "\n")


def write_inkml(file, strokes):
    lines = ['<ink xmlns="http://www.w3.org/2003/InkML">']
    for s in strokes:
        lines.append(f'  <trace xml:id="{s["name"]}">' + ", ".join(f"{x} {y}" for x, y, *_ in s["points"]) + "</trace>")
    (HERE / file).write_text("\n".join([*lines, "</ink>", ""]))


write_json("hello.json", hello())
leaf = [(20, 200), (70, 110), (160, 50), (270, 40), (365, 70), (330, 150), (245, 205), (140, 215), (20, 200)]
write_svg("leaf.svg", [draw("outline", smooth(leaf)), draw("midrib", smooth([(25, 198), (120, 150), (230, 105), (352, 76)]))])
spiral = [(200 + (14 + 11 * a) * math.cos(a), 180 + (14 + 11 * a) * math.sin(a)) for a in (0.35 * i for i in range(38))]
write_csv("spiral.csv", [draw("spiral", smooth(spiral)), draw("tangent", smooth([(60, 330), (180, 336), (330, 322)]))])
three = [(40, 62), (66, 40), (98, 52), (96, 84), (66, 98), (104, 112), (108, 152), (72, 172), (38, 156)]
write_inkml("note.inkml", [draw("three", smooth(three)), draw("tick", straight([(150, 120), (176, 162), (240, 52)]))])
duck = [
    (28, 118), (78, 148), (140, 150), (196, 132), (214, 100), (206, 66), (222, 34), (258, 20), (292, 32), (306, 58),
    (340, 72), (346, 84), (312, 92), (292, 104), (292, 130), (310, 170), (302, 214), (256, 246), (180, 256), (104, 240),
    (56, 200), (34, 158), (28, 118),
]
write_json("duck.json", [draw("duck", smooth(duck))])
