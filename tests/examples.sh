#!/usr/bin/env bash
# Runs the shipped client scripts against a real server and compares the digests: the same job and seed over REST and
# over gRPC must give the same bits. Then exported trajectories are replayed by kinematics of their own, and must paint
# what their runs claim. Usage: tests/examples.sh CGDA_BINARY PYTHON
set -euo pipefail
cd "$(dirname "$0")/.."
cgda=$1 python=$2
work=$(mktemp -d)
"$cgda" serve --data-dir "$work/data" --listen 127.0.0.1:0 >"$work/ready" 2>"$work/log" &
server=$!
trap 'kill $server 2>/dev/null; wait $server 2>/dev/null; rm -rf "$work"' EXIT
for _ in $(seq 200); do
  [ -s "$work/ready" ] && break
  sleep 0.1
done
address=$(grep -oE 'http=[^ ]+' "$work/ready" | cut -d= -f2)
token=$(grep -oE 'token=[^ ]+' "$work/ready" | cut -d= -f2)
rest=$(examples/rest_main_job.sh "$address" "$token" "$work" 2>"$work/rest.err" | tail -n 1) || { cat "$work/rest.err" "$work/log" >&2; exit 1; }
grpc=$("$python" examples/grpc_main_job.py "${address#http://}" "$token" 2>"$work/grpc.err" | tail -n 1) || { cat "$work/grpc.err" "$work/log" >&2; exit 1; }
if [ -z "$rest" ] || [ "$rest" != "$grpc" ]; then
  echo "REST gave digest '$rest', gRPC '$grpc'" >&2
  exit 1
fi
echo "examples over REST and gRPC: digest $rest"
arm=examples/robots/teo_right_arm.urdf wall=examples/worlds/paint_wall.toml
for method in particle sst; do
  "$cgda" run examples/demonstrations/paint/*.csv --robot $arm --world $wall --t-min 1 --free shoulder_pitch \
    --free shoulder_roll --free elbow_pitch --fixed wrist_yaw=-0.7853981633974483 --method $method --repetitions 3 \
    --out "$work/motions" --json 2>"$work/run.err" >"$work/runs.json" || { cat "$work/run.err" >&2; exit 1; }
  echo "replay of $method: $("$python" examples/replay.py $arm $wall "$work/runs.json" "$work/motions")"
done
