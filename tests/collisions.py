"""Checks collisions with another library: Pinocchio and its coal (PyPI `pin`), on three robots with primitive shapes.

python tests/collisions.py runs CGDA_BINARY [JOBS [SEED]]: executes random jobs (random starts, goals and obstacles, all of
    them reachable without a collision) and checks every point of their trajectories, and points between, for contacts of
    the robot with itself and with obstacles. Prints "N trajectories, M points, K collisions"; fails if K is not 0.
python tests/collisions.py poses: writes the clearances of random poses to tests/fixtures/collisions/, with which the unit
    tests of the collision model compare theirs.
"""

import csv
import random
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import coal
import numpy as np
import pinocchio as pin

ROOT = Path(__file__).resolve().parent.parent
MARGIN_M = 0.001
# Largest motion of a joint between two checks, rad: below 5 mm at a reach of 1 m.
BETWEEN_RAD = 0.005


@dataclass
class Robot:
    """A robot, pairs whose shapes overlap by design, and the radius around its base that obstacles stay out of."""

    urdf: Path
    tip: str
    overlapping: tuple = ()
    free_radius_m: float = 0.25


ROBOTS = [
    Robot(ROOT / "examples/robots/teo_right_arm.urdf", "object", (("shoulder", "upper_arm"),), 0.5),
    Robot(ROOT / "tests/fixtures/robots/six_joint_arm.urdf", "tool"),
    Robot(ROOT / "examples/robots/seven_joint_arm.urdf", "tool"),
]
# The surroundings of the poses; the unit tests have the same.
BOX = ([0.2, 0.3, 0.4], [0.45, 0.25, 0.3])
SPHERE = (0.1, [0.3, -0.4, 0.5])


class Scene:
    """A robot among obstacles, as Pinocchio sees it."""

    def __init__(self, robot: Robot, boxes=(), spheres=()):
        self.model = pin.buildModelFromUrdf(str(robot.urdf))
        self.geometry = pin.buildGeomFromUrdf(self.model, str(robot.urdf), pin.GeometryType.COLLISION)
        links = len(self.geometry.geometryObjects)
        solids = [(coal.Box(*size), centre) for size, centre in boxes]
        solids += [(coal.Sphere(radius), centre) for radius, centre in spheres]
        for index, (shape, centre) in enumerate(solids):
            place = pin.SE3(np.eye(3), np.array(centre, dtype=float))
            self.geometry.addGeometryObject(pin.GeometryObject(f"obstacle_{index}", 0, 0, place, shape))
        objects = self.geometry.geometryObjects
        names = [self.model.frames[shape.parentFrame].name for shape in objects[:links]]
        excluded = {frozenset(pair) for pair in robot.overlapping} | adjacent(self.model, set(names))
        for i in range(links):
            for j in range(i + 1, len(objects)):
                if objects[i].parentJoint == objects[j].parentJoint:
                    continue
                if j < links and frozenset((names[i], names[j])) in excluded:
                    continue
                self.geometry.addCollisionPair(pin.CollisionPair(i, j))
        self.data, self.geometry_data = self.model.createData(), self.geometry.createData()
        self.tip = self.model.getFrameId(robot.tip)

    def clearance(self, q) -> float:
        """Least distance of all pairs at `q`, metres; 0 or less in a collision."""
        pin.updateGeometryPlacements(self.model, self.data, self.geometry, self.geometry_data, np.array(q))
        pin.computeDistances(self.geometry, self.geometry_data)
        return min(result.min_distance for result in self.geometry_data.distanceResults)

    def tool_mm(self, q) -> list:
        """Position of the tip link, millimetres."""
        pin.framesForwardKinematics(self.model, self.data, np.array(q))
        return (1000.0 * self.data.oMf[self.tip].translation).tolist()

    def pose(self, source: random.Random) -> list:
        """A random pose within the limits."""
        limits = zip(self.model.lowerPositionLimit, self.model.upperPositionLimit)
        return [source.uniform(float(lower), float(upper)) for lower, upper in limits]

    def free_pose(self, source: random.Random, clearance_m: float) -> list:
        """A random pose with that clearance."""
        while True:
            pose = self.pose(source)
            if self.clearance(pose) > clearance_m:
                return pose


def adjacent(model, shaped: set) -> set:
    """Pairs of links with a shape that a joint connects, directly or through links without one."""
    bodies = [frame for frame in model.frames if frame.type == pin.FrameType.BODY]
    parents = {}
    for frame in bodies:
        at = frame.parentFrame
        while at != 0 and model.frames[at].type != pin.FrameType.BODY:
            at = model.frames[at].parentFrame
        if at != 0:
            parents[frame.name] = model.frames[at].name
    neighbours = {frame.name: set() for frame in bodies}
    for child, parent in parents.items():
        neighbours[child].add(parent)
        neighbours[parent].add(child)
    pairs = set()
    for link in shaped:
        seen, pending = {link}, [link]
        while pending:
            for other in neighbours[pending.pop()] - seen:
                seen.add(other)
                if other in shaped:
                    pairs.add(frozenset((link, other)))
                else:
                    pending.append(other)
    return pairs


def write_poses() -> None:
    """Clearances of random poses, among which some are in collision, to tests/fixtures/collisions/."""
    folder = ROOT / "tests/fixtures/collisions"
    folder.mkdir(exist_ok=True)
    for robot in ROBOTS:
        scene, source = Scene(robot, [BOX], [SPHERE]), random.Random(1)
        with open(folder / f"{robot.urdf.stem}.csv", "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow([*scene.model.names[1:], "clearance_m"])
            for _ in range(300):
                pose = [round(value, 6) for value in scene.pose(source)]
                writer.writerow([*pose, f"{max(scene.clearance(pose), 0.0):.6f}"])
        print(f"{robot.urdf.stem}: 300 poses")


def job(folder: Path, index: int, source: random.Random) -> tuple:
    """Writes a preset of a random job to `folder`; returns its path and its scene."""
    robot = ROBOTS[index % len(ROBOTS)]
    boxes, spheres = [], []
    for _ in range(source.randint(1, 2)):
        centre = [source.uniform(-0.8, 0.8), source.uniform(-0.8, 0.8), source.uniform(0.1, 0.9)]
        size = [source.uniform(0.05, 0.25) for _ in range(3)]
        if np.hypot(centre[0], centre[1]) > robot.free_radius_m + 0.2:
            boxes.append((size, centre))
    spheres.append((0.08, [0.0, -robot.free_radius_m - 0.3, source.uniform(0.2, 0.8)]))
    scene = Scene(robot, boxes, spheres)
    # More than the margin: the two libraries need not agree to the last digit.
    home = scene.free_pose(source, 3 * MARGIN_M)
    goals = [scene.tool_mm(scene.free_pose(source, 3 * MARGIN_M)) for _ in range(4)]
    names = list(scene.model.names[1:])
    method = ["model", "broyden", "sst"][(index // len(ROBOTS)) % 3]
    lines = [f'description = "random job {index}"', 'world = "world.toml"', "[goals]"]
    lines += ["features = [" + ", ".join(f'{{ name = "{axis}", unit = "mm" }}' for axis in "xyz") + "]"]
    lines += [f"goals = {goals}", "[robot]", f'urdf = "{robot.urdf}"']
    lines += ["home = { " + ", ".join(f"{name} = {value!r}" for name, value in zip(names, home)) + " }"]
    lines += ["acceleration = { " + ", ".join(f"{name} = 6.0" for name in names) + " }"]
    lines += ["[execution]", 'metric = "multivariate"']
    lines += ["max_evaluations_per_goal = 150"] if method == "sst" else []
    lines += ["[execution.method]"]
    lines += [f'name = "{method}"', "[[execution.constraints]]", 'kind = "collision_free"']
    for number, (size, centre) in enumerate(boxes):
        shape = f'{{ kind = "box", size_m = {size}, center_m = {centre} }}'
        lines += ["[[execution.constraints.obstacles]]", f'name = "box {number}"', f"shape = {shape}"]
    for number, (radius, centre) in enumerate(spheres):
        shape = f'{{ kind = "sphere", radius_m = {radius}, center_m = {centre} }}'
        lines += ["[[execution.constraints.obstacles]]", f'name = "sphere {number}"', f"shape = {shape}"]
    preset = folder / f"job-{index}.toml"
    preset.write_text("\n".join(lines) + "\n")
    (folder / "world.toml").write_text('kind = "tool_position"\nunit = "mm"\n')
    return preset, scene


def between(points: list) -> list:
    """The points, and as many between them that no joint moves more than BETWEEN_RAD from one to the next."""
    dense = [points[0]]
    for start, end in zip(points, points[1:]):
        start, end = np.array(start), np.array(end)
        steps = max(1, int(np.ceil(np.abs(end - start).max() / BETWEEN_RAD)))
        dense += [start + (end - start) * step / steps for step in range(1, steps + 1)]
    return dense


def check_runs(binary: str, jobs: int, seed: int) -> None:
    """Executes random jobs and checks their trajectories."""
    source, trajectories, checked, collisions = random.Random(seed), 0, 0, []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for index in range(jobs):
            preset, scene = job(folder, index, source)
            out = folder / f"out-{index}"
            command = [binary, "run", "--preset", preset, "--seed", str(seed + index), "--out", out]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(f"{preset.name}: {done.stderr}\n{preset.read_text()}")
            for file in out.glob("*.csv"):
                with open(file) as rows:
                    table = list(csv.DictReader(rows))
                columns = [f"{joint}_position" for joint in scene.model.names[1:]]
                points = between([[float(row[column]) for column in columns] for row in table])
                trajectories += 1
                checked += len(points)
                worst = min((scene.clearance(point), at) for at, point in enumerate(points))
                if worst[0] <= 0.0:
                    collisions.append(f"{preset.name}: {worst[0]:.5f} m at point {worst[1]} of {len(points)}")
    print(*collisions, sep="\n", end="\n" if collisions else "")
    print(f"{trajectories} trajectories, {checked} points, {len(collisions)} collisions")
    if collisions or trajectories == 0:
        sys.exit(1)


def main(arguments: list) -> None:
    match arguments:
        case ["poses"]:
            write_poses()
        case ["runs", binary, *numbers] if len(numbers) <= 2:
            jobs, seed = [*map(int, numbers), *[30, 1][len(numbers) :]]
            check_runs(binary, jobs, seed)
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
