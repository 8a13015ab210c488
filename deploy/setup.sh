#!/usr/bin/env bash
# Installs what a bare Debian or Ubuntu machine lacks: `setup.sh run` to build and run, `setup.sh test` for the tests too.
# System packages are installed only by root; everyone else is told what is missing.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=${1:-run}
# An own CARGO_HOME or the usual one; behind the caller's PATH, so that a cargo chosen there stays chosen.
export PATH="$PATH:${CARGO_HOME:-$HOME/.cargo}/bin:$HOME/.cargo/bin"

has() { command -v "$1" >/dev/null 2>&1; }

fail() {
  echo "setup: $*" >&2
  exit 1
}

# quietly REMEDY COMMAND...: shows what the command said only if it fails, and the remedy.
quietly() {
  local remedy=$1 said
  shift
  if ! said=$("$@" 2>&1); then
    printf '%s\n' "$said" >&2
    fail "\`$*\` failed (its words are above): $remedy, then run this again"
  fi
}

# The browser of the tests, as web/e2e/browser.mjs looks for it.
has_browser() { [ -n "${CHROMIUM:-}" ] || [ -x /usr/bin/chromium ]; }

packages=()
has cc || packages+=(build-essential)
has curl || packages+=(curl ca-certificates)
has node || packages+=(nodejs)
has npm || packages+=(npm)
if [ "$mode" = test ]; then
  has_browser || packages+=(chromium)
  has jq || packages+=(jq)
  python3 -c 'import ensurepip, venv' 2>/dev/null || packages+=(python3 python3-venv)
fi

if [ ${#packages[@]} -gt 0 ]; then
  if [ "$(id -u)" != 0 ] || ! has apt-get; then
    fail "missing: ${packages[*]}; install them (on Debian or Ubuntu: sudo apt-get install ${packages[*]}), then run this again"
  fi
  echo "installing ${packages[*]}" >&2
  quietly "see that the package mirrors in /etc/apt can be reached" apt-get update -qq
  quietly "install these packages by hand" \
    env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}"
  # Ubuntu's chromium package is a stub that wants snap.
  if [ "$mode" = test ] && ! has_browser; then
    fail "no /usr/bin/chromium after installing it: install Chromium or Chrome and name it, CHROMIUM=/path/to/chrome make test"
  fi
fi

# Debian 13 and Ubuntu 24.04 package rustup; elsewhere its own installer is used.
if ! has cargo && ! has rustup; then
  if [ "$(id -u)" = 0 ] && has apt-get && apt-cache show rustup >/dev/null 2>&1; then
    echo "installing rustup" >&2
    quietly "install rustup by hand (https://rustup.rs)" \
      env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends rustup
  else
    echo "installing Rust from https://sh.rustup.rs" >&2
    quietly "install Rust by hand (https://rustup.rs)" \
      bash -c 'set -o pipefail; curl --proto =https --tlsv1.2 -sSf https://sh.rustup.rs | sh -s -- -y --profile minimal'
  fi
fi

# A rustup without a toolchain gets the current stable one.
if has rustup && ! cargo --version >/dev/null 2>&1; then
  quietly "see that static.rust-lang.org can be reached" rustup default stable
fi
oldest=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
version=$(cargo --version 2>/dev/null | cut -d ' ' -f 2 || true)
[ -n "$version" ] || fail "cargo does not run: install Rust $oldest or newer (https://rustup.rs), then run this again"
if [ "$(printf '%s\n' "$oldest" "$version" | sort -V | head -n 1)" != "$oldest" ]; then
  fail "Rust $version is older than $oldest: update it (rustup update stable), then run this again"
fi
if [ "$mode" = test ] && ! { cargo clippy --version && cargo fmt --version; } >/dev/null 2>&1; then
  has rustup || fail "cargo clippy and cargo fmt are missing: install them beside cargo, then run this again"
  quietly "see that static.rust-lang.org can be reached" rustup component add clippy rustfmt
fi

# The dashboard's build tool needs node 20.19 or newer; the npm registry carries one where Debian's is older.
if ! node -e 'const [a, b] = process.versions.node.split(".").map(Number); process.exit(a > 20 || (a === 20 && b >= 19) ? 0 : 1)'; then
  if [ "$(id -u)" != 0 ]; then
    fail "node $(node --version) is older than 20.19: install a newer one (npm install --global node@22), then run this again"
  fi
  echo "installing node 22, as $(node --version) is older than 20.19" >&2
  quietly "see that registry.npmjs.org can be reached" npm install --global --silent node@22
fi

if [ "$mode" = test ]; then
  stamp=target/tools/requirements.txt
  wanted=$(cat .ci/requirements.txt examples/requirements.txt)
  if [ "$wanted" != "$(cat "$stamp" 2>/dev/null)" ]; then
    echo "installing the checkers of .ci/requirements.txt into target/tools" >&2
    quietly "remove target/tools" python3 -m venv target/tools
    quietly "see that pypi.org can be reached" \
      target/tools/bin/pip install --quiet --disable-pip-version-check -r .ci/requirements.txt
    printf '%s\n' "$wanted" >"$stamp"
  fi
  stamp=target/tools/npm/installed.json
  if ! cmp -s .ci/package-lock.json "$stamp"; then
    echo "installing the checkers of .ci/package.json into target/tools" >&2
    mkdir -p target/tools/npm
    cp .ci/package.json .ci/package-lock.json target/tools/npm/
    # The binary comes as a package of its own: no script has to run.
    quietly "see that registry.npmjs.org can be reached" \
      npm --prefix target/tools/npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
    cp .ci/package-lock.json "$stamp"
  fi
fi
