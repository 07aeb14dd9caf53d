# make demo    install what is missing, build, run the margination demo on 2 ranks
# make check   install what is missing, build, run every quick test
# make build   only build
# make ranks   run the parallel tests on the rank counts of 1, 2, 4 and 8 that make check leaves out
# make validate  compare with theory
# make tidy    clang-tidy over src/ (Debian: clang-tidy-14), nothing to be said is the pass
# make sanitize  build with address and undefined-behaviour sanitizers into build-sanitize, run every quick test
BUILD ?= build
TYPE  ?= Release
RANKS ?= 2

# Open MPI refuses root and more ranks than cores unless told otherwise.
ifeq ($(shell id -u),0)
export OMPI_ALLOW_RUN_AS_ROOT = 1
export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM = 1
endif
demo: MPI_OPTIONS = $(shell [ "$$(nproc)" -ge $(RANKS) ] || echo --oversubscribe)
check ranks sanitize: export OMPI_MCA_rmaps_base_oversubscribe = 1
check ranks sanitize: export OMPI_MCA_hwloc_base_binding_policy = none
check ranks sanitize: export OMPI_MCA_mpi_yield_when_idle = 1

.PHONY: all bootstrap build demo check ranks validate sanitize tidy clean
all: build

bootstrap:
	@tools/bootstrap

build: bootstrap
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=$(TYPE) >$(BUILD).log 2>&1 || { cat $(BUILD).log; exit 1; }
	@rm -f $(BUILD).log
	@cmake --build $(BUILD)

demo: build
	mpirun $(MPI_OPTIONS) -np $(RANKS) $(BUILD)/bin/hemomag run examples/margination_demo.toml --force

check: build
	ctest --test-dir $(BUILD) -L quick --output-on-failure --no-tests=error -j $$(nproc)

ranks: build
	ctest --test-dir $(BUILD) -L ranks --output-on-failure --no-tests=error

validate: build
	$(BUILD)/bin/hemomag validate

sanitize: bootstrap
	cmake --preset dev
	cmake --build --preset dev
	ctest --preset dev -L quick --no-tests=error -j $$(nproc)

tidy: bootstrap
	cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=$(TYPE)
	run-clang-tidy-14 -p $(BUILD) -quiet -j $$(nproc) '$(CURDIR)/src/'

clean:
	rm -rf $(BUILD)
