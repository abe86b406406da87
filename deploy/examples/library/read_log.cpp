// Reads a log with LCM's own C++ types, and prints how many steps each axis made, and between which ticks.
//
//     read_log run.lcm
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <numeric>
#include <string>

#include "lockstep/step_batch_t.hpp"

struct Steps {
    long long count = 0;
    long long first_tick = 0;
    long long last_tick = 0;
};

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: read_log LOG\n");
        return 2;
    }
    lcm::LogFile log(argv[1], "r");
    if (!log.good()) {
        std::fprintf(stderr, "read_log: %s cannot be opened\n", argv[1]);
        return 1;
    }
    std::map<std::string, Steps> axes;
    while (const lcm::LogEvent* event = log.readNextEvent()) {
        lockstep::step_batch_t batch;
        if (!event->channel.ends_with("_STEPS") || batch.decode(event->data, 0, event->datalen) < 0) { continue; }
        Steps& axis = axes[batch.axis];
        if (batch.count == 0) { continue; }
        if (axis.count == 0) { axis.first_tick = batch.first_tick; }
        axis.count += batch.count;
        axis.last_tick = std::accumulate(batch.delta_ticks.begin(), batch.delta_ticks.end(), batch.first_tick);
    }
    for (const auto& [name, axis] : axes) {
        std::printf("%s: %lld steps, from tick %lld to %lld\n", name.c_str(), axis.count, axis.first_tick,
                    axis.last_tick);
    }
}
