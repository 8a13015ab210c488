#!/usr/bin/env python3
"""Replays exported trajectories over a surface with kinematics of its own, and compares the painted cells with the claim.

    cgda run FILES.. --robot URDF --world WORLD.toml --out DIR --json > RUNS.json
    examples/replay.py URDF WORLD.toml RUNS.json DIR

Export without --prefix, --rename and --omit-held. Nothing of cgda is used: the URDF is read here, and the tool's position is computed here. A cell is painted if the tool is
closer to its centre than the radius where the arm rests at a waypoint. At every point, the tool of the robot as described
must stay in front of the surface. A simulated real robot (--distort) has other links and another base: it paints with
those, and it may be nearer to the surface by as much as it deviates, which is printed.
"""
import json
import sys
import xml.etree.ElementTree as xml
from math import cos, sin
from pathlib import Path


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def moved(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def turned(axis, angle):
    (x, y, z), c, s = axis, cos(angle), sin(angle)
    rows = [[c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s, 0],
            [y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s, 0],
            [z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c), 0]]
    return rows + [[0, 0, 0, 1]]


def numbers(text):
    return [float(word) for word in text.split()]


def world_of(text):
    """The lines KEY = VALUE of a world's TOML file."""
    pairs = (line.split("=", 1) for line in text.splitlines() if "=" in line and not line.startswith("#"))
    return {key.strip(): json.loads(value) for key, value in pairs}


def chain(urdf):
    """Joints from the root to the only leaf."""
    joints = xml.parse(urdf).getroot().findall("joint")
    by_child = {joint.find("child").get("link"): joint for joint in joints}
    parents = {joint.find("parent").get("link") for joint in joints}
    (link,) = set(by_child) - parents
    path = []
    while link in by_child:
        path.insert(0, by_child[link])
        link = by_child[link].find("parent").get("link")
    return path


def tool(path, positions, free, robot):
    """Position of the tool in the base frame, m; links after each free joint as long as those of the simulated robot."""
    pose, link, scales = moved(*robot["base_shift_m"]), moved(0, 0, 0), [1.0] + robot["link_scales"]

    def joined():
        return product(pose, [row[:3] + [row[3] * (scales[0] if i < 3 else 1)] for i, row in enumerate(link)])

    for joint in path:
        origin = joint.find("origin")
        origin = {} if origin is None else origin.attrib
        roll, pitch, yaw = numbers(origin.get("rpy", "0 0 0"))
        link = product(link, moved(*numbers(origin.get("xyz", "0 0 0"))))
        for axis, angle in (((0, 0, 1), yaw), ((0, 1, 0), pitch), ((1, 0, 0), roll)):
            link = product(link, turned(axis, angle))
        if joint.get("type") != "fixed":
            axis = numbers(joint.find("axis").get("xyz"))
            value = positions[joint.get("name")]
            by = moved(*(a * value for a in axis)) if joint.get("type") == "prismatic" else turned(axis, value)
            if joint.get("name") in free:
                pose, link, scales = product(joined(), by), moved(0, 0, 0), scales[1:] or [1.0]
            else:
                link = product(link, by)
    return [row[3] for row in joined()[:3]]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def main(urdf, world, runs, directory):
    path, surface, runs = chain(urdf), world_of(Path(world).read_text()), json.loads(Path(runs).read_text())
    origin, column, row = surface["origin_m"], surface["column_step_m"], surface["row_step_m"]
    normal = cross(column, row)
    normal = [part / dot(normal, normal) ** 0.5 for part in normal]
    rows, columns = range(surface["rows"]), range(surface["columns"])
    centres = [[o + c * x + r * y for o, x, y in zip(origin, column, row)] for r in rows for c in columns]
    wrong = waypoints = points = behind = 0
    deepest = 0.0
    for run in runs["runs"]:
        if run["trajectory_problem"]:
            print(f"seed {run['seed']}: no trajectory: {run['trajectory_problem']}")
            continue
        name = f"{runs['preset']}-{runs['method']}-{run['seed']}.json"
        trajectory = json.loads((Path(directory) / name).read_text())
        painted, side, free = set(), None, [j for j in trajectory["joints"] if j not in trajectory["fixed_joints"]]
        missing = [j.get("name") for j in path if j.get("type") != "fixed" and j.get("name") not in trajectory["joints"]]
        if missing:
            sys.exit(f"{name} does not name {', '.join(missing)}: export without --prefix, --rename and --omit-held")
        described = {"base_shift_m": [0, 0, 0], "link_scales": [1.0] * len(free)}
        real = run.get("simulated_robot") or described
        for point in trajectory["points"]:
            positions = dict(zip(trajectory["joints"], point["positions"]))
            planned, at = (tool(path, positions, free, robot) for robot in (described, real))
            height, reached = (dot(normal, [a - o for a, o in zip(there, origin)]) for there in (planned, at))
            side = side or height
            points, behind = points + 1, behind + (height * side < 0)
            deepest = max(deepest, -reached if side > 0 else reached)
            if point["waypoint"] is not None:
                waypoints += 1
                near = [sum((a - b) ** 2 for a, b in zip(at, centre)) < surface["radius_m"] ** 2 for centre in centres]
                painted |= {cell for cell, is_near in enumerate(near) if is_near}
        if sorted(painted) != run["painted_cells"]:
            wrong += 1
            print(f"seed {run['seed']}: paints {sorted(painted)}, but claims {run['painted_cells']}")
    print(f"{len(runs['runs'])} runs, {waypoints} waypoints, {points} points: {wrong} paint other cells than claimed, "
          f"{behind} points behind the surface, {1000 * deepest:.0f} mm at most for the simulated real robot")
    return 1 if wrong or behind else 0


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
