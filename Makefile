# make demo | make test | make build | make package: each does what it needs before, and can be run again.
BUILD ?= build
JOBS  ?= $(shell nproc)

.PHONY: build test demo bench package clean

build:
	@deploy/install-dependencies
	@cmake -S . -B $(BUILD) -G Ninja -DCMAKE_BUILD_TYPE=Release >$(BUILD).configure.log 2>&1 || \
	  { cat $(BUILD).configure.log; rm -f $(BUILD).configure.log; exit 1; }
	@rm -f $(BUILD).configure.log
	@cmake --build $(BUILD) -j $(JOBS)

test: build
	@ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS)

demo: build
	@deploy/demo $(BUILD)

# lockstep_*.deb and lockstep-dev_*.deb, in the build directory.
package: build
	@cd $(BUILD) && cpack --config CPackConfig.cmake

bench: build
	@$(BUILD)/bin/lockstep-bench

clean:
	@rm -rf $(BUILD) out
