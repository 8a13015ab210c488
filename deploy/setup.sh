#!/usr/bin/env bash
# Installs missing tools on a bare Debian or Ubuntu machine: `setup.sh run` to build and run, `setup.sh test` for the tests
# too. Packages are installed only when run as root; other users get a list of what is missing.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=${1:-run}
export PATH="$HOME/.cargo/bin:$PATH"

has() { command -v "$1" >/dev/null 2>&1; }

packages=()
has cc || packages+=(build-essential)
has curl || packages+=(curl ca-certificates)
has cargo || packages+=(rustup)
has node || packages+=(nodejs)
has npm || packages+=(npm)
if [ "$mode" = test ]; then
  has chromium || packages+=(chromium)
  has jq || packages+=(jq)
  python3 -c 'import ensurepip, venv' 2>/dev/null || packages+=(python3 python3-venv)
fi

if [ ${#packages[@]} -gt 0 ]; then
  if [ "$(id -u)" != 0 ] || ! has apt-get; then
    echo "missing: ${packages[*]}; install them (on Debian or Ubuntu: sudo apt-get install ${packages[*]}) and run this again" >&2
    exit 1
  fi
  echo "installing ${packages[*]}" >&2
  apt-get update -qq
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}" >/dev/null
fi

# A rustup without a toolchain gets the current stable one; an older cargo is named by cargo itself (rust-version).
if has rustup && ! cargo --version >/dev/null 2>&1; then
  rustup default stable >&2
fi
if ! cargo --version >/dev/null 2>&1; then
  echo "cargo does not run: install Rust 1.95 or newer (https://rustup.rs), then run this again" >&2
  exit 1
fi

# The dashboard's build tool needs node 20.19 or newer; the npm registry carries one where Debian's is older.
if ! node -e 'const [a, b] = process.versions.node.split(".").map(Number); process.exit(a > 20 || (a === 20 && b >= 19) ? 0 : 1)'; then
  if [ "$(id -u)" != 0 ]; then
    echo "node $(node --version) is older than 20.19: install a newer one (npm install --global node@22) and run this again" >&2
    exit 1
  fi
  npm install --global --silent node@22
fi

if [ "$mode" = test ]; then
  stamp=target/tools/requirements.txt
  if ! cmp -s .ci/requirements.txt "$stamp"; then
    echo "installing the checkers of .ci/requirements.txt into target/tools" >&2
    python3 -m venv target/tools
    target/tools/bin/pip install --quiet --disable-pip-version-check -r .ci/requirements.txt
    cp .ci/requirements.txt "$stamp"
  fi
  stamp=target/tools/npm/installed.json
  if ! cmp -s .ci/package-lock.json "$stamp"; then
    echo "installing the checkers of .ci/package.json into target/tools" >&2
    mkdir -p target/tools/npm
    cp .ci/package.json .ci/package-lock.json target/tools/npm/
    # The binary comes as a package of its own: no script has to run.
    (cd target/tools/npm && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
    cp .ci/package-lock.json "$stamp"
  fi
fi
