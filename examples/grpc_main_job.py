#!/usr/bin/env python3
"""The whole main job over gRPC, by reflection only: no generated stubs, no .proto files.

    pip install -r examples/requirements.txt
    examples/grpc_main_job.py [ADDRESS] [TOKEN]
    CGDA_ADDRESS=127.0.0.1:8080 CGDA_TOKEN=cgda_... examples/grpc_main_job.py

Uploads the shipped demonstrations, generalizes them, executes the action on the shipped arm, watches the job and
streams the trajectory. The last line on stdout is the digest of the run.
"""

import math
import os
import pathlib
import sys

import grpc
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from grpc_reflection.v1alpha import reflection_pb2

EXAMPLES = pathlib.Path(__file__).resolve().parent
PACKAGE = "cgda.v1"
CHUNK = 256 * 1024


def log(text):
    print(text, file=sys.stderr)


class Service:
    """Calls the methods the server describes by reflection (grpc.reflection.v1)."""

    def __init__(self, address, token):
        self.channel = grpc.insecure_channel(address)
        self.metadata = (("authorization", f"Bearer {token}"),)
        self.pool = descriptor_pool.DescriptorPool()
        self._load()

    def _load(self):
        # grpc.reflection.v1 and v1alpha have the same messages: only the method's path differs.
        ask = self.channel.stream_stream(
            "/grpc.reflection.v1.ServerReflection/ServerReflectionInfo",
            request_serializer=reflection_pb2.ServerReflectionRequest.SerializeToString,
            response_deserializer=reflection_pb2.ServerReflectionResponse.FromString,
        )

        def answer(**request):
            requests = iter([reflection_pb2.ServerReflectionRequest(**request)])
            return next(iter(ask(requests, metadata=self.metadata, timeout=10)))

        listed = answer(list_services="").list_services_response.service
        self.services = [service.name for service in listed if service.name.startswith(PACKAGE)]
        seen = set()
        for name in self.services:
            for blob in answer(file_containing_symbol=name).file_descriptor_response.file_descriptor_proto:
                self._add(blob, seen, answer)

    def _add(self, blob, seen, answer):
        file = descriptor_pb2.FileDescriptorProto.FromString(blob)
        if file.name in seen:
            return
        seen.add(file.name)
        for dependency in file.dependency:
            if dependency not in seen:
                for other in answer(file_by_filename=dependency).file_descriptor_response.file_descriptor_proto:
                    self._add(other, seen, answer)
        self.pool.Add(file)

    def message(self, kind, /, **fields):
        """A message of the package, for example message("GetJobRequest", id="...")."""
        descriptor = self.pool.FindMessageTypeByName(f"{PACKAGE}.{kind}")
        return message_factory.GetMessageClass(descriptor)(**fields)

    def call(self, service, method, request):
        """Calls a method; `request` is a message, or an iterator of them where the client streams."""
        described = self.pool.FindServiceByName(f"{PACKAGE}.{service}").FindMethodByName(method)
        output = message_factory.GetMessageClass(described.output_type)
        kind = f"{'stream' if described.client_streaming else 'unary'}_{'stream' if described.server_streaming else 'unary'}"
        stub = getattr(self.channel, kind)(
            f"/{PACKAGE}.{service}/{method}",
            request_serializer=lambda message: message.SerializeToString(),
            response_deserializer=output.FromString,
        )
        return stub(request, metadata=self.metadata)


def upload(service, path):
    def parts():
        yield service.message("UploadRequest", header=service.message("UploadHeader", name=f"wax-{path.stem}"))
        yield service.message("UploadRequest", file_name=path.name)
        data = path.read_bytes()
        for start in range(0, len(data), CHUNK):
            yield service.message("UploadRequest", content=data[start : start + CHUNK])

    made = service.call("DemonstrationService", "Upload", parts())
    log(f"  {made.name}: {made.streams[0].samples} samples, {made.duration_s:.2f} s, {made.findings} findings")
    return made.id


def watch(service, job):
    """Follows a job to its end; gives back the job as it ended."""
    request = service.message("WatchJobRequest", id=job.id)
    for event in service.call("JobService", "WatchJob", request):
        kind = event.WhichOneof("data")
        if kind == "state":
            states = event.state.DESCRIPTOR.fields_by_name["state"].enum_type.values_by_number
            log(f"  {states[event.state.state].name.removeprefix('JOB_STATE_').lower()} {event.state.reason}".rstrip())
        elif kind == "goal":
            log(f"  goal {event.goal.index}: {event.goal.evaluations} evaluations, "
                f"discrepancy {event.goal.discrepancy:.3f}")
        elif kind == "run":
            log(f"  run with seed {event.run.seed}: {event.run.evaluations} evaluations, "
                f"discrepancy {event.run.discrepancy:.3f}")
    done = service.call("JobService", "GetJob", service.message("GetJobRequest", id=job.id))
    states = done.DESCRIPTOR.fields_by_name["state"].enum_type.values_by_number
    if states[done.state].name != "JOB_STATE_SUCCEEDED":
        sys.exit(f"job {done.id} ended as {states[done.state].name}: {done.failure.message or done.state_reason}")
    return done


def main():
    address = sys.argv[1] if len(sys.argv) > 1 else os.environ.get("CGDA_ADDRESS", "127.0.0.1:8080")
    token = sys.argv[2] if len(sys.argv) > 2 else os.environ.get("CGDA_TOKEN")
    if not token:
        sys.exit("give the token that `cgda serve` printed as CGDA_TOKEN or as the second argument")
    service = Service(address.removeprefix("http://").rstrip("/"), token)
    log(f"services: {', '.join(service.services)}")

    log("1. demonstrations")
    demonstrations = [upload(service, path) for path in sorted((EXAMPLES / "demonstrations/wax").glob("*.csv"))]

    log("2. action")
    generalization = service.message("Generalization", name="wax", demonstrations=demonstrations, t_min_s=1.0)
    request = service.message("CreateActionRequest", generalization=generalization)
    action = watch(service, service.call("ActionService", "CreateAction", request)).result.action

    log("3. robot and world")
    spec = service.message(
        "RobotSpec",
        fixed={"shoulder_yaw": 0.0, "wrist_yaw": -math.pi / 4, "wrist_pitch": 0.0},
        acceleration={"shoulder_pitch": 2.0, "shoulder_roll": 2.0, "elbow_pitch": 2.0},
    )
    urdf = (EXAMPLES / "robots/teo_right_arm.urdf").read_text()
    request = service.message("CreateRobotRequest", name="right arm", urdf=urdf, spec=spec)
    robot = service.call("RobotService", "CreateRobot", request).id
    world = service.message("WorldSpec", tool_position=service.message("ToolPositionWorld", unit="mm"))
    request = service.message("CreateWorldRequest", name="tool position", spec=world)
    world = service.call("WorldService", "CreateWorld", request).id

    log("4. execution")
    method = service.message("MethodSpec", sst=service.message("SteadyStateTournament", population=50, stagnation=3))
    execution = service.message(
        "Execution", action=action, robot=robot, world=world, seed=1,
        execution=service.message("ExecutionSpec", method=method),
    )
    request = service.message("CreateJobRequest", work=service.message("Work", execution=execution))
    job = watch(service, service.call("JobService", "CreateJob", request))
    run = service.call("RunService", "GetRun", service.message("GetRunRequest", id=job.result.runs[0]))

    log("5. trajectory")
    if not run.trajectory:
        sys.exit(run.trajectory_problem)
    head = service.call("TrajectoryService", "GetTrajectory", service.message("GetTrajectoryRequest", id=run.trajectory))
    log(f"  {head.point_count} points of {', '.join(head.joint_names)}, {head.duration_s:.2f} s")
    request = service.message("StreamTrajectoryRequest", id=run.trajectory, batch=64)
    for chunk in service.call("TrajectoryService", "StreamTrajectory", request):
        last = chunk.points[-1]
        positions = ", ".join(f"{value:.4f}" for value in last.positions)
        log(f"  points {chunk.first_index} to {chunk.first_index + len(chunk.points) - 1}: "
            f"at {last.t_s:.2f} s [{positions}] rad")
    print(run.digest)


if __name__ == "__main__":
    main()
