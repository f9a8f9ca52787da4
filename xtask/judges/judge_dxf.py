#!/usr/bin/env python3
"""Judge a DXF file with ezdxf: usage: judge_dxf.py FILE.dxf SPLINE.json

Exits 1 unless ezdxf reads the file, its audit finds nothing, and the curves in it are as long as those of the spline file.
"""
import json
import math
import sys

import ezdxf
from ezdxf import path

file, spline = sys.argv[1:]
try:
    doc = ezdxf.readfile(file)
except (IOError, ezdxf.DXFError) as error:
    sys.exit(f"ezdxf cannot read {file}: {error}")
audit = doc.audit()
if audit.errors or audit.fixes:
    sys.exit("\n".join(f"ezdxf: {entry.message}" for entry in [*audit.errors, *audit.fixes]))

# ezdxf measures the drawing by its own reading of each entity.
kinds, length = {}, 0.0
for entity in doc.modelspace():
    kinds[entity.dxftype()] = kinds.get(entity.dxftype(), 0) + 1
    points = list(path.make_path(entity).flattening(0.001))
    length += sum(a.distance(b) for a, b in zip(points, points[1:]))
wanted = sum(seg["length"] for s in json.load(open(spline))["splines"] for seg in s["segments"])
if not math.isclose(length, wanted, rel_tol=1e-3):
    sys.exit(f"the drawing's curves are {length:.3f} long, the spline file's {wanted:.3f}")
print(f"ezdxf {ezdxf.__version__}: no errors, {kinds}, curves {length:.2f} long of {wanted:.2f}")
