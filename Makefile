# cgda: `make run` and `make test` are all a newcomer needs; both install what they lack.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help

LISTEN ?= 127.0.0.1:8080
DATA_DIR ?= data
TOOLS := target/tools/bin
BUF := target/tools/npm/node_modules/.bin/buf
PROTO_BASELINE := tests/fixtures/cgda.v1.binpb
export PATH := $(HOME)/.cargo/bin:$(PATH)
export CARGO_TERM_COLOR ?= never

.PHONY: help setup setup-test web run test check check-rust check-web check-proto check-docs test-rust test-web test-e2e test-examples torture bench openapi proto-baseline audit image-lint fmt clean

help: ## this list
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | sort | expand -t 16

setup: ## install what building and running need
	@deploy/setup.sh run

setup-test: ## install what the tests and checks need
	@deploy/setup.sh test

web/node_modules/.package-lock.json: web/package-lock.json
	cd web && npm ci --no-audit --no-fund --loglevel=error
	@touch $@

WEB_SOURCES := $(shell find web -path web/node_modules -prune -o -path web/dist -prune -o -name schema.d.ts -o -type f -print)

web/dist/index.html: web/node_modules/.package-lock.json $(WEB_SOURCES)
	cd web && npm run --silent build
	@touch $@

web: web/dist/index.html ## build the dashboard into web/dist

run: setup ## from a fresh machine to a served demo; address and token are printed
	@$(MAKE) --no-print-directory web
	cargo build --release --locked --features embed-web
	target/release/cgda serve --demo --data-dir $(DATA_DIR) --listen $(LISTEN)

test: setup-test ## every gate and every test
	@$(MAKE) --no-print-directory web
	@$(MAKE) --no-print-directory check
	@$(MAKE) --no-print-directory test-web
	@$(MAKE) --no-print-directory test-rust
	@$(MAKE) --no-print-directory test-examples
	@$(MAKE) --no-print-directory test-e2e

check: check-rust check-web check-proto image-lint ## formatting, lints, documentation, dependencies

check-rust:
	cargo fmt --all --check
	cargo clippy --locked --workspace --all-targets --quiet -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --locked --workspace --no-deps --document-private-items --quiet
	$(TOOLS)/cargo-deny --offline check --hide-inclusion-graph bans licenses sources 2>&1 | tail -n 1
	$(TOOLS)/cargo-shear

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
	cargo test --locked --workspace --quiet

test-web: web/node_modules/.package-lock.json ## unit tests of the dashboard
	cd web && npm run --silent test

test-e2e: web/dist/index.html ## the dashboard in a real browser against a real server
	cargo test --locked --quiet --no-run
	cd web && npm run --silent test:e2e

test-examples: ## the client scripts of examples/ over REST and gRPC
	cargo test --locked --quiet --no-run
	tests/examples.sh target/debug/cgda $(TOOLS)/python

torture: setup-test ## the slow suites: repeated kills, long runs
	cargo test --locked --workspace --release -- --ignored

bench: ## ratios of the hot paths
	cargo bench --locked

openapi: ## renew web/openapi.json from the code
	cargo run --quiet -- openapi > web/openapi.json

audit: setup-test ## known vulnerabilities (needs the advisory database on the network)
	$(TOOLS)/cargo-deny check advisories

fmt: ## format everything
	cargo fmt --all

clean: ## remove what was built
	cargo clean
	rm -rf web/dist web/node_modules
