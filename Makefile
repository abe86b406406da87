# make demo | make test | make build | make package: each does what it needs before, and can be run again.
# With ARCH=arm64: for boards of 64-bit ARM, on another machine.
HERE := $(shell dpkg --print-architecture)
ARCH  = $(HERE)
JOBS ?= $(shell nproc)
ifeq ($(ARCH),$(HERE))
BUILD ?= build
TEST   = ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS)
else
BUILD ?= build-$(ARCH)
CROSS := --toolchain deploy/$(ARCH).cmake -DCMAKE_SYSROOT=$(abspath $(BUILD))/root
NEEDS := $(ARCH) $(BUILD)/root
TEST   = tests/integration/package/emulated_machine $(BUILD) build
endif

.PHONY: build test demo bench package clean

build:
	@deploy/install-dependencies $(NEEDS)
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Release $(CROSS) >$(BUILD).configure.log 2>&1 || \
	  { cat $(BUILD).configure.log; rm -f $(BUILD).configure.log; exit 1; }
	@rm -f $(BUILD).configure.log
	@cmake --build $(BUILD) -j $(JOBS)

test: build
	@$(TEST)

demo: build
	@deploy/demo $(BUILD)

# lockstep_*.deb and lockstep-dev_*.deb, in the build directory.
package: build
	@cd $(BUILD) && cpack --config CPackConfig.cmake

bench: build
	@$(BUILD)/bin/lockstep-bench

clean:
	@rm -rf $(BUILD) out
