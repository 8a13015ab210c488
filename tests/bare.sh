#!/usr/bin/env bash
# Proves both commands of the README on a machine that has only its system packages and toolchains: a fresh clone of HEAD
# in an empty folder, with empty caches of cargo, npm and pip. Prints a table of times; exit code 0 only if `make test`
# passed, and `make run` served and its demo's jobs succeeded. It takes about half an hour on two idle cores, so it is not
# part of `make test`. LIMIT_S bounds each step, in seconds. Usage: tests/bare.sh [run] [test]   (both without arguments)
set -euo pipefail
cd "$(dirname "$0")/.."
source=$PWD
steps=("$@")
[ ${#steps[@]} -gt 0 ] || steps=(run test)
limit_s=${LIMIT_S:-7200}

work=$(mktemp -d)
# The toolchains stay: rustup keeps them outside of CARGO_HOME, and its cargo must stay on the PATH.
RUSTUP_HOME=${RUSTUP_HOME:-$HOME/.rustup}
cargo_bin=$(dirname "$(command -v cargo || echo "$HOME/.cargo/bin/cargo")")
export RUSTUP_HOME PATH="$cargo_bin:$PATH"
export CARGO_HOME=$work/cargo npm_config_cache=$work/npm PIP_CACHE_DIR=$work/pip TMPDIR=$work/tmp
unset CARGO_TARGET_DIR CARGO_NET_OFFLINE CGDA_BIN
mkdir -p "$TMPDIR"

server=
stop_server() {
  [ -z "$server" ] || { kill -TERM -- "-$server" 2>/dev/null && wait "$server" 2>/dev/null; } || true
  server=
}
trap 'stop_server; rm -rf "$work"' EXIT

table=()
# row WHAT SECONDS CPU_SECONDS: the processor time tells the work where other programs share the machine.
row() { table+=("$(printf '%-44s %6s s %8s s of processor time' "$1" "$2" "$3")"); }

# Processor time of the children this process has waited for, s.
children_s() { awk -v hz="$(getconf CLK_TCK)" '{ printf "%d\n", ($16 + $17) / hz }' "/proc/$1/stat"; }

# fail REASON LOG: the end of the log, then the reason.
fail() {
  tail -n 60 "$2" >&2
  [ ${#table[@]} -eq 0 ] || printf '%s\n' "${table[@]}" >&2
  echo "bare.sh: $1" >&2
  exit 1
}

# fresh_clone NAME: an empty folder with HEAD and nothing else.
fresh_clone() { git clone --quiet --no-hardlinks "$source" "$work/$1"; }

empty_caches() {
  rm -rf "$CARGO_HOME" "$npm_config_cache" "$PIP_CACHE_DIR"
  mkdir -p "$CARGO_HOME" "$npm_config_cache" "$PIP_CACHE_DIR"
}

# GET of the interface as JSON.
api() { curl -sSf -H "authorization: Bearer $token" "$address/api/v1$1"; }

prove_run() {
  empty_caches
  fresh_clone run
  local log=$work/run.log ready=$work/run.ready started=$SECONDS
  set -m
  make -C "$work/run" run LISTEN=127.0.0.1:0 >"$ready" 2>"$log" &
  server=$!
  set +m
  until grep -q '^cgda ready' "$ready"; do
    kill -0 "$server" 2>/dev/null || fail "make run ended before it served" "$log"
    [ $((SECONDS - started)) -lt "$limit_s" ] || fail "make run does not serve within $limit_s s" "$log"
    sleep 0.2
  done
  row "make run: until it serves" $((SECONDS - started)) "$(children_s "$server")"
  address=$(grep -oE 'http=[^ ]+' "$ready" | cut -d= -f2)
  token=$(grep -oE 'token=[^ ]+' "$ready" | cut -d= -f2)
  curl -sSf -o /dev/null -H "authorization: Bearer $token" "$address/jobs" || fail "the dashboard is not served" "$log"
  local jobs
  # Two generalizations and two executions.
  until jobs=$(api /jobs) && jq -e '[.items[].state] | length == 4 and all(. == "SUCCEEDED")' <<<"$jobs" >/dev/null; do
    if jq -e '[.items[].state] | any(. == "FAILED" or . == "CANCELLED")' <<<"$jobs" >/dev/null; then
      jq -r '.items[] | "\(.name): \(.state) \(.state_reason // "")"' <<<"$jobs" >&2
      fail "a job of the demo did not succeed" "$log"
    fi
    [ $((SECONDS - started)) -lt "$limit_s" ] || fail "the demo's jobs do not end within $limit_s s" "$log"
    sleep 0.5
  done
  row "make run: until the demo's 4 jobs succeeded" $((SECONDS - started)) "-"
  stop_server
  rm -rf "$work/run"
}

# timed WHAT LOG: `make test` in the clone.
timed() {
  local started=$SECONDS before
  before=$(children_s $$)
  timeout "$limit_s" make -C "$work/test" test >"$2" 2>&1 || fail "$1: make test failed or took longer than $limit_s s" "$2"
  row "$1" $((SECONDS - started)) $(($(children_s $$) - before))
}

prove_test() {
  empty_caches
  fresh_clone test
  timed "make test: from empty caches" "$work/test.log"
  timed "make test: again, all built" "$work/again.log"
  rm -rf "$work/test"
}

for step in "${steps[@]}"; do
  case $step in
    run) prove_run ;;
    test) prove_test ;;
    *)
      echo "bare.sh: no step $step: give run, test or nothing for both" >&2
      exit 2
      ;;
  esac
done
echo "$(git log -1 --format=%h), $(nproc) cores, load $(cut -d ' ' -f 1-3 /proc/loadavg) at the end:"
printf '%s\n' "${table[@]}"
