# make demo   sets up and runs the main job on Resources/cad/hammer
# make test   sets up and passes the tests
# make bench  times the engine beside libccd, FCL and coal
.PHONY: demo test setup setup-test lint bench clean

demo: setup
	.venv/bin/cmb run Resources/cad/hammer --output out/hammer

test: setup-test
	scripts/test

setup:
	scripts/setup

setup-test:
	scripts/setup test

lint: setup-test
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/mypy

clean:
	rm -rf out build .deps .venv ContactMultiBody/Resources/Include ContactMultiBody/Resources/Library

bench: setup
	scripts/bench
