// fuzz_log_seeds FILE: writes a small valid log, a seed for the fuzzer.
#include <cstdio>

#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/lcm_log.hpp"

int main(int argc, char** argv) {
    using namespace lockstep;
    auto log = argc == 2 ? LogWriter::open(argv[1]) : std::unexpected(std::string("usage: fuzz_log_seeds FILE"));
    if (!log) {
        std::fprintf(stderr, "%s\n", log.error().c_str());
        return 2;
    }
    step_batch_t steps{};
    steps.machine = "mill";
    steps.count = 3;
    steps.delta_ticks = {100, 100, 90};
    steps.direction = {1, 1, -1};
    log->write_message("LOCKSTEP_MILL_X_STEPS", 1, steps);
    run_t run{};
    run.pieces = 2;
    run.ticks = {1000, 2000};
    run.velocity = {1 << 20, -5};
    run.acceleration = {7, 0};
    log->write_message("LOCKSTEP_MILL_X_RUN", 2, run);
    log->write_message("LOCKSTEP_MILL_JOB", 3, job_t{});
    log->write_message("LOCKSTEP_MILL_X_POSITION", 4, axis_position_t{});
    log->write_message("LOCKSTEP_MILL_X_HEALTH", 5, axis_health_t{});
    return log->flush() ? 0 : 1;
}
