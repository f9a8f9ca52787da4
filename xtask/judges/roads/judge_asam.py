#!/usr/bin/env python3
"""Judge an OpenDRIVE file by ASAM's checker: usage: judge_asam.py FILE.xodr SCRATCH_FOLDER

Errors are faults, everything else is a warning. A check that broke on the file is a fault, and so is a version for which gaps should have
been looked for and were not; that the version is too old for this is a warning. `fault:` and `warning:` lines are for people, the `note:`
line comes last; ends with 1 if there is a fault.
"""
import contextlib
import io
import logging
import os
import sys
import xml.etree.ElementTree as ElementTree
from xml.sax.saxutils import quoteattr

from qc_opendrive.main import main

file, folder = sys.argv[1:]
config, result = os.path.join(folder, "asam-config.xml"), os.path.join(folder, "asam-result.xqar")
with contextlib.suppress(FileNotFoundError):
    os.remove(result)
with open(config, "w", encoding="utf-8") as out:
    out.write(
        f'<Config><Param name="InputFile" value={quoteattr(file)}/><CheckerBundle application="xodrBundle">'
        f'<Param name="resultFile" value={quoteattr(result)}/></CheckerBundle></Config>'
    )
logging.disable(logging.CRITICAL)
sys.argv = ["qc_opendrive", "-c", config]
with contextlib.redirect_stdout(io.StringIO()):
    main()

# Before this version of OpenDRIVE the checker does not look for gaps.
GAPS_FROM = (1, 7)
GAPS = "check_asam_xodr_lane_smoothness_contact_point_no_horizontal_gaps"
faults, warnings = [], []
checkers = {checker.get("checkerId"): checker for checker in ElementTree.parse(result).getroot().iter("Checker")}
states = {name: checker.get("status") for name, checker in checkers.items()}
for name, checker in checkers.items():
    if states[name] not in ("completed", "skipped"):
        faults.append(f"{name} broke: {checker.get('summary')}")
    for issue in checker.iter("Issue"):
        texts = dict.fromkeys([issue.get("description"), *(place.get("description") for place in issue.iter("Locations"))])
        places = [place.get("xpath") for place in issue.iter("XMLLocation")]
        rule, text = issue.get("ruleUID").split(":", 3)[-1], "; ".join(text for text in texts if text)
        is_error = issue.get("level") == "1"
        (faults if is_error else warnings).append(f"{rule}: {text} at {', '.join(places[:2]) or 'no place'}")
if not faults and states.get(GAPS) != "completed":
    header = ElementTree.parse(file).getroot().find("header")
    version = tuple(int(header.get(part)) for part in ("revMajor", "revMinor"))
    text = f"gaps were not looked for in a file of version {version[0]}.{version[1]}"
    (faults if version >= GAPS_FROM else warnings).append(text)
for text in faults:
    print(f"fault: {text}")
for text in warnings:
    print(f"warning: {text}")
done = list(states.values()).count("completed")
print(f"note: {len(faults)} errors and {len(warnings)} warnings of {done} checks, {len(states) - done} did not apply")
sys.exit(1 if faults else 0)
