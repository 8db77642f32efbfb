# make demo   sets up and runs the main job on Resources/cad/hammer
# make test   sets up and passes the tests
# make test-full   passes the long tests, which make test leaves out
# make bench  times the engine beside libccd, FCL and coal
# make bench-fmu  how building and simulating FMUs grows with the size of the model
# make release   packs the Modelica library: out/ContactMultiBody-<version>.zip
# make coverage  prints the branch coverage of the engine's own code by its tests
# make fuzz      fuzzes the engine (needs clang): make fuzz SECONDS=60
# make stress    ten million random and adversarial poses of all pairs of bodies (POSES=...)
# make contact-quality  work, jumps and frames of the contact forces of all pairs of bodies, as tables (PATHS=40)
# make promises  measures what the library promises into docs/promises.md
# make response measures contact response at all tolerances into docs/response.md
# make study    what accuracy costs, scene by scene, into docs/accuracy; half an hour, resumes
# make bench-peers   the same scenes in MuJoCo, Drake and Bullet, from PyPI, into docs/peers.md; half an hour, resumes
# make soak     200 random scenes at all tolerances, modes and importers into out/soak, and as many machines with joints
#               and moving grounds into out/soak-machines; hours, resumes (SCENES=...)
# make large     lets a thousand spheres fill a box: builds and runs regression/cases/large, some minutes
# make test-msl  passes the tests with the Standard Library's examples (MODELICAPATH; about fifteen minutes)
# make test-omc  runs the examples through OpenModelica where it is installed
# make test-omc-fmu  exports examples as FMUs by OpenModelica and compares them with their references
# make pictures  draws the pages in docs/images anew; some minutes
# make video     bytes a second of poses and of rendered video, for one eye and for two; some minutes
# make bench-page  from an input to the picture that shows it, in a real browser (Chromium); two minutes
# make icons     draws the icons and diagrams of the library into docs/images
.PHONY: bench-page contact-quality test-msl coverage fuzz stress bench-fmu contact-paths demo test test-full setup setup-test lint bench clean release study promises response soak large test-omc test-omc-fmu icons pictures video bench-peers

demo: setup
	.venv/bin/cmb run Resources/cad/hammer --output out/hammer

test: setup-test
	scripts/test

test-full: setup-test
	scripts/test full

setup:
	scripts/setup

setup-test:
	scripts/setup test

release: setup
	.venv/bin/python scripts/release

study: setup
	.venv/bin/python scripts/study

bench-peers: setup
	.venv/bin/python scripts/bench-peers --docs

promises: setup
	.venv/bin/python scripts/promises

response: setup
	.venv/bin/python scripts/response

soak: setup
	.venv/bin/python scripts/soak --scenes $(or $(SCENES),200)
	.venv/bin/python scripts/soak --machines --scenes $(or $(SCENES),200)

large: setup
	.venv/bin/cmb regress regression/cases/large

test-msl: setup-test
	MSL_EXAMPLES=all .venv/bin/python -m pytest -n 2 generator/tests/modelica2fmu/test_msl_examples.py

test-omc: setup
	.venv/bin/python scripts/test-omc

test-omc-fmu: setup
	.venv/bin/python scripts/test-omc-fmu

video: setup
	.venv/bin/python -m pip install -q --disable-pip-version-check av==18.1.0
	.venv/bin/python scripts/bench-video

bench-page: setup-test
	.venv/bin/python scripts/bench-page

pictures: setup
	.venv/bin/python scripts/pictures

icons: setup
	.venv/bin/python scripts/render-icons

lint: setup-test
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/mypy

clean:
	rm -rf out build .deps .venv ContactMultiBody/Resources/Include ContactMultiBody/Resources/Library

bench: setup
	scripts/bench

coverage: setup-test
	scripts/coverage

fuzz:
	scripts/fuzz $(SECONDS)

stress:
	scripts/stress $(POSES)

contact-quality:
	scripts/contact-quality

bench-fmu: setup
	.venv/bin/python regression/bench/fmu_size.py

contact-paths: bench
	.venv/bin/python -m pip install -q --disable-pip-version-check matplotlib==3.11.2
	build/external-c/bench/bench/sample_paths | .venv/bin/python scripts/plot_contact_paths
