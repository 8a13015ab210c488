# cgda: `make run` and `make test` are all a newcomer needs; both install what they lack.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help

LISTEN ?= 127.0.0.1:8080
DATA_DIR ?= data
TOOLS := target/tools/bin
BUF := target/tools/npm/node_modules/.bin/buf
PROTO_BASELINE := tests/fixtures/cgda.v1.binpb
# The toolchain of rustup's own installer; behind the caller's PATH, so that a cargo chosen there stays chosen.
export PATH := $(PATH):$(or $(CARGO_HOME),$(HOME)/.cargo)/bin:$(HOME)/.cargo/bin
export CARGO_TERM_COLOR ?= never
# Both packages at once, in every step: one set of features, so that each dependency is built once.
ALL := --locked --workspace

# Runs a command; all it said is shown if it fails, its last line if it does not.
quietly = @echo '$(1)'; said=$$($(1) 2>&1) || { printf '%s\n' "$$said" >&2; exit 1; }; tail -n 1 <<<"$$said"

.PHONY: help setup setup-test web run test check check-rust check-web check-proto check-clients check-core check-docs debug-binary fetch test-rust test-web test-e2e test-examples check-collisions torture bench openapi proto-baseline audit image-lint fmt clean

help: ## this list
	@grep -E '^[a-z0-9-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | sort | expand -t 16

setup: ## install what building and running need
	@deploy/setup.sh run

setup-test: ## install what the tests and checks need
	@deploy/setup.sh test

web/node_modules/.package-lock.json: web/package-lock.json
	cd web && npm ci --no-audit --no-fund --loglevel=error
	@touch $@

WEB_SOURCES := $(shell find web -path web/node_modules -prune -o -path web/dist -prune -o -name schema.d.ts -o -name bounds.ts -o -type f -print)

web/dist/index.html: web/node_modules/.package-lock.json $(WEB_SOURCES)
	cd web && npm run --silent build
	@touch $@

web: web/dist/index.html ## build the dashboard into web/dist

fetch: ## download every crate, those of other platforms too: cargo-deny reads them all
	cargo fetch --locked --quiet

run: setup ## from a fresh machine to a served demo; address and token are printed (LISTEN=127.0.0.1:9090 for another port)
	@$(MAKE) --no-print-directory -j 2 web fetch
	cargo build --release --locked --features embed-web
	target/release/cgda serve --demo --data-dir $(DATA_DIR) --listen $(LISTEN)

test: setup-test ## every gate and every test
	@$(MAKE) --no-print-directory web
	@$(MAKE) --no-print-directory check
	@$(MAKE) --no-print-directory test-web
	@$(MAKE) --no-print-directory test-rust
	@$(MAKE) --no-print-directory test-examples
	@$(MAKE) --no-print-directory test-e2e

check: check-rust check-web check-proto check-clients image-lint ## formatting, lints, documentation, dependencies

check-rust: fetch
	cargo fmt --all --check || { echo 'the code is not formatted: run `make fmt`' >&2; exit 1; }
	cargo clippy $(ALL) --all-targets --quiet -- -D warnings
	# --examples: with the features of the tests, so that what clippy has checked is not checked again.
	RUSTDOCFLAGS="-D warnings" cargo doc $(ALL) --lib --examples --no-deps --document-private-items --quiet
	$(call quietly,$(TOOLS)/cargo-deny --offline check --hide-inclusion-graph bans licenses sources)
	$(call quietly,$(TOOLS)/cargo-shear)

check-clients: ## a Python client from the API's description
	$(TOOLS)/python tests/python_client.py web/openapi.json

check-web: web/node_modules/.package-lock.json
	cd web && npm run --silent check:schema && npm run --silent typecheck && npm run --silent lint

check-proto:
	$(BUF) lint proto
	$(BUF) breaking proto --against $(PROTO_BASELINE)

proto-baseline: ## accept what proto/ is now as what clients rely on: later changes are checked against it
	$(BUF) build proto --exclude-source-info --output $(PROTO_BASELINE)

image-lint:
	$(TOOLS)/hadolint Dockerfile

test-rust: ## unit, property, golden and black-box tests
	cargo test $(ALL) --quiet

# --examples: with the features of the tests, so that what they have built is used.
debug-binary:
	cargo build $(ALL) --bins --examples --quiet

test-web: web/node_modules/.package-lock.json ## unit tests of the dashboard
	cd web && npm run --silent test

test-e2e: web/dist/index.html debug-binary ## the dashboard in a real browser against a real server
	cd web && npm run --silent test:e2e

test-examples: debug-binary ## the client scripts of examples/ over REST and gRPC
	tests/examples.sh target/debug/cgda $(TOOLS)/python

# Its library takes 480 MB and installed here only. JOBS: number of random jobs.
check-collisions: setup-test debug-binary ## trajectories of random jobs against another collision library
	$(TOOLS)/pip install --quiet --disable-pip-version-check pin==4.1.0
	$(TOOLS)/python tests/collisions.py runs target/debug/cgda $(or $(JOBS),30)

torture: setup-test check-core ## the slow suites: repeated kills, long runs
	cargo test $(ALL) --release -- --ignored

# A folder of its own: other features than those of the workspace, so that nothing there is built anew.
check-core: ## the core as its users build it: with each set of features, and as a package
	cargo clippy --locked -p cgda-core --all-targets --no-default-features --target-dir target/core --quiet -- -D warnings
	cargo clippy --locked -p cgda-core --all-targets --all-features --target-dir target/core --quiet -- -D warnings
	cargo publish --dry-run --locked -p cgda-core --target-dir target/core --quiet

bench: ## ratios of the hot paths
	cargo bench --locked

openapi: debug-binary ## renew web/openapi.json from the code
	target/debug/cgda openapi > target/openapi.json
	cp target/openapi.json web/openapi.json

audit: setup-test ## known vulnerabilities (needs the advisory database on the network)
	$(TOOLS)/cargo-deny check advisories

fmt: ## format everything
	cargo fmt --all

clean: ## remove what was built
	cargo clean
	rm -rf web/dist web/node_modules
