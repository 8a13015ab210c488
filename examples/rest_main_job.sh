#!/usr/bin/env bash
# The whole main job over REST: upload demonstrations, generalize them, execute the action on a robot, follow it by
# server-sent events, keep the trajectory. Needs curl and jq.
#
#   examples/rest_main_job.sh [ADDRESS] [TOKEN] [OUT_DIR]
#   CGDA_ADDRESS=http://127.0.0.1:8080 CGDA_TOKEN=cgda_... examples/rest_main_job.sh
#
# The last line on stdout is the digest of the run.
set -euo pipefail

address=${1:-${CGDA_ADDRESS:-http://127.0.0.1:8080}}
token=${2:-${CGDA_TOKEN:?give the token that \`cgda serve\` printed as CGDA_TOKEN or as the second argument}}
out=${3:-.}
[[ $address == http* ]] || address=http://$address
api=${address%/}/api/v1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

# call METHOD PATH [CURL ARGUMENTS]: prints the answer, or the problem on stderr.
call() {
  local method=$1 path=$2 answer status
  shift 2
  answer=$(curl -sS -X "$method" -H "authorization: Bearer $token" -w '\n%{http_code}' "$@" "$api$path")
  status=${answer##*$'\n'}
  answer=${answer%$'\n'*}
  if ((status >= 400)); then
    echo "$method $path: $status" >&2
    jq . <<<"$answer" >&2 || echo "$answer" >&2
    return 1
  fi
  printf '%s' "$answer"
}

json() { call "$1" "$2" -H 'content-type: application/json' --data-binary @-; }

# follow JOB: prints each goal and run as it comes; returns when the job is final.
follow() {
  curl -sSN -H "authorization: Bearer $token" "$api/jobs/$1/events" |
    sed -un 's/^data: *//p' |
    jq --unbuffered -r '
      if .type == "state" then "  \(.state | ascii_downcase)\(if .reason then ": " + .reason else "" end)"
      elif .type == "goal" then "  goal \(.goal.index): \(.goal.evaluations) evaluations, discrepancy \(.goal.discrepancy)"
      elif .type == "run" then "  run with seed \(.seed): \(.evaluations) evaluations, discrepancy \(.discrepancy)"
      else empty end' >&2
}

succeeded() {
  local job
  job=$(call GET "/jobs/$1")
  if [[ $(jq -r .state <<<"$job") != SUCCEEDED ]]; then
    jq '{state, state_reason, failure}' <<<"$job" >&2
    return 1
  fi
  printf '%s' "$job"
}

echo "1. demonstrations" >&2
ids=()
for file in "$here"/demonstrations/wax/*.csv; do
  name=wax-$(basename "$file" .csv)
  view=$(call POST "/demonstrations?name=$name&file_name=$name.csv" -H 'content-type: text/csv' --data-binary "@$file")
  ids+=("$(jq -r .id <<<"$view")")
  jq -r '"  \(.name): \(.streams[0].samples) samples, \(.duration_s) s, \(.findings) findings"' <<<"$view" >&2
done

echo "2. action" >&2
job=$(jq -n '{name: "wax", demonstrations: $ARGS.positional, t_min_s: 1}' --args "${ids[@]}" | json POST /actions | jq -r .id)
follow "$job"
action=$(succeeded "$job" | jq -r .result.action)
call GET "/actions/$action/goals" | jq -r '"  \(.goals | length) goals of \([.features[] | "\(.name) [\(.unit)]"] | join(", "))"' >&2

echo "3. robot and world" >&2
robot=$(jq -n --rawfile urdf "$here/robots/teo_right_arm.urdf" '{name: "right arm", urdf: $urdf, spec: {
  fixed: {shoulder_yaw: 0, wrist_yaw: -0.7853981633974483, wrist_pitch: 0},
  acceleration: {shoulder_pitch: 2, shoulder_roll: 2, elbow_pitch: 2}}}' | json POST /robots | jq -r .id)
world=$(jq -n '{name: "tool position", spec: {kind: "tool_position", unit: "mm"}}' | json POST /worlds | jq -r .id)

echo "4. execution" >&2
job=$(jq -n --arg action "$action" --arg robot "$robot" --arg world "$world" '{kind: "execution", $action, $robot, $world,
  execution: {method: {name: "sst", population: 50, stagnation: 3}}, seed: 1}' | json POST /jobs | jq -r .id)
follow "$job"
run=$(succeeded "$job" | jq -r '.result.runs[0]')

echo "5. trajectory" >&2
view=$(call GET "/runs/$run")
trajectory=$(jq -r '.trajectory // empty' <<<"$view")
if [[ -z $trajectory ]]; then
  jq -r .trajectory_problem <<<"$view" >&2
  exit 1
fi
for format in csv json ros2; do
  extension=$format
  [[ $format == ros2 ]] && extension=ros2.yaml
  call GET "/trajectories/$trajectory:export?format=$format" >"$out/wax-trajectory.$extension"
  echo "  $out/wax-trajectory.$extension" >&2
done
jq -r .digest <<<"$view"
