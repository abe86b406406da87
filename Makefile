# make demo | make check | make test | make test-long | make build | make live | make package: each first does what it
# needs, and can be run again.
# ARCH=arm64 builds for boards of 64-bit ARM on another machine.
HERE := $(shell dpkg --print-architecture)
ARCH  = $(HERE)
JOBS ?= $(shell nproc)
ifeq ($(ARCH),$(HERE))
BUILD ?= build
UNTESTED := -DBUILD_TESTING=OFF -DLOCKSTEP_SPY=OFF
# The demonstration uses the programs of an existing build, otherwise it builds only these, which takes less time with
# -O1, and with -O0 for code that is not time-critical. It needs no compiler's cache, so one package less.
QUICK := $(UNTESTED) -DCCACHE= -DSOON=-O0 -DLOCKSTEP_WERROR=OFF "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG"
DEMO  ?= $(if $(wildcard $(BUILD)/CMakeCache.txt),$(BUILD),build-demo)
FIRST   = $(BUILD)/CMakeCache.txt
OPTIONS = -DBUILD_TESTING=ON -DLOCKSTEP_SPY=ON -DLOCKSTEP_RTL=ON
PRODUCT = core/all sim_fpga/all services/all clients/all
# All programs, and what tests of live machines need. While these tests run, tests/run builds all other tests.
LIVE    = $(PRODUCT) tests/integration/all tests/benchmarks/all package_files
TEST    = tests/run $(BUILD) $(JOBS)
else
BUILD ?= build-$(ARCH)
NEEDS  := $(ARCH) $(BUILD)/root
OPTIONS = --toolchain deploy/$(ARCH).cmake -DCMAKE_SYSROOT=$(abspath $(BUILD))/root
LIVE    = all
TEST    = tests/integration/package/emulated_machine $(BUILD) build
endif

.PHONY: configured build live check test test-long demo bench package clean

# $(call configure,DIRECTORY,OPTIONS): prints nothing unless it fails.
configure = cmake -S . -B $(1) -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON $(2) >$(1).configure.log 2>&1 || \
  { cat $(1).configure.log; rm -f $(1).configure.log; exit 1; }; rm -f $(1).configure.log

configured: $(FIRST)
	@deploy/install-dependencies $(NEEDS)
	@$(call configure,$(BUILD),$(OPTIONS))

# On a fresh machine the packages that only tests need are installed while the compiler works on the product.
$(FIRST):
	@deploy/install-dependencies build
	@$(call configure,$(BUILD),$(UNTESTED))
	@deploy/install-dependencies & installing=$$!; cmake --build $(BUILD) -j $(JOBS) --target $(PRODUCT); \
	  built=$$?; wait $$installing && exit $$built

build: configured
	@cmake --build $(BUILD) -j $(JOBS)

live: configured
	@cmake --build $(BUILD) -j $(JOBS) --target $(LIVE)

# A contributor's gate, which prints its times, for the processors of this machine only. It needs neither Java, Node, containers nor emulators.
check:
	@deploy/install-dependencies check
	@$(call configure,$(BUILD),-DBUILD_TESTING=ON $(if $(wildcard $(FIRST)),,-DLOCKSTEP_SPY=OFF))
	@tests/timed cmake --build $(BUILD) -j $(JOBS) --target checked_tests $(PRODUCT)
	@tests/timed tests/check $(BUILD) $(JOBS)

test: live
	@$(TEST)

# The random machines and programs that make test leaves out.
test-long: configured
	@cmake --build $(BUILD) -j $(JOBS) --target long_tests
	@ctest --test-dir $(BUILD) -C Long -L long --output-on-failure --timeout 3600 -j $(JOBS)

demo:
	@echo "== packages: a compiler, Cyclone DDS, LCM, Protobuf; none of those that only tests need"
	@deploy/install-dependencies demo
	@echo "== build: the command, the coordinator, the axis and the page, in $(DEMO)"
	@[ -e $(DEMO)/CMakeCache.txt ] || { $(call configure,$(DEMO),$(QUICK)); }
	@cmake --build $(DEMO) -j $(JOBS) --target lockstep lockstep-coordinator lockstep-axis lockstep-web
	@deploy/demo $(DEMO)

# Makes lockstep_*.deb and lockstep-dev_*.deb in the build directory.
package: build
	@cd $(BUILD) && cpack --config CPackConfig.cmake

bench: build
	@$(BUILD)/bin/lockstep-bench

clean:
	@rm -rf $(BUILD) build-demo out
