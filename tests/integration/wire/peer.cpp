// The other process of a test: integration_wire_peer ROLE DOMAIN [PROCESSES]. Exits with 0 when it received all it
// waits for.
#include <map>
#include <string>

#include "services/wire/bus/bus.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

/// An axis that reports that it holds every frame it receives, until the last.
bool hold_frames(AxisBus& bus) {
    AxisState state;
    bool ended = false;
    return eventually([&] {
        bus.frames.take([&](Frame&& frame) {
            if (frame.number == state.held + 1) { state.held = frame.number; }
            ended = frame.last;
        });
        bus.state.write(state);
        return ended;
    });
}

/// Answers every chunk until all of one program were received.
bool answer_chunks(CoordinatorBus& bus) {
    std::map<std::uint32_t, std::size_t> chunks;
    const bool in_time = eventually([&] {
        bool all = false;
        bus.chunks.take([&](ProgramChunk&& chunk) {
            chunks[chunk.index] = chunk.bytes.size();
            all = chunks.size() == chunk.count;
            bus.replies.write({.client = chunk.client,
                               .sequence = chunk.sequence,
                               .parts = static_cast<std::uint32_t>(chunks.size()),
                               .free_blocks = 1'000'000});
        });
        return all;
    });
    std::this_thread::sleep_for(300ms);  // the last reply may need to be sent again
    return in_time;
}

/// An axis that publishes its state until it is killed.
bool publish_states(AxisBus& bus) {
    for (;;) {
        bus.state.write({});
        std::this_thread::sleep_for(10ms);
    }
}

template <typename Bus>
int play(bool (*role)(Bus&), const NetworkConfig& network) {
    auto bus = open_bus<Bus>(network, "mill", {.axis = 0, .credentials = {}});
    return bus && role(*bus) ? 0 : 1;
}

}  // namespace
}  // namespace lockstep

int main(int argc, char** argv) {
    if (argc < 3) { return 2; }
    lockstep::NetworkConfig network{.domain = static_cast<std::uint32_t>(std::stoul(argv[2]))};
    if (argc > 3) { network.processes = std::stoul(argv[3]); }
    const std::string role = argv[1];
    if (role == "publisher") { return lockstep::play(lockstep::publish_states, network); }
    return role == "axis" ? lockstep::play(lockstep::hold_frames, network)
                          : lockstep::play(lockstep::answer_chunks, network);
}
