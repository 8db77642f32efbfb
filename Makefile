# make demo   sets up and runs the main job on Resources/cad/hammer
# make test   sets up and passes the tests
# make bench  times the engine beside libccd and FCL
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
	cmake -S external-c -B build/external-c/bench -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMB_TESTS=OFF -DCMB_BENCH=ON -DCMB_FUZZ=OFF > .deps/bench.log
	cmake --build build/external-c/bench --target bench_convex >> .deps/bench.log
	find build/external-c/bench -name bench_convex -type f -exec {} \;
