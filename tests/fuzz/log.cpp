// Reads any bytes as a log: every byte belongs to an event or counts as damaged, and each event's data is decoded or
// refused.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <string>

#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/lcm_log.hpp"
#include "tests/fuzz/require.hpp"

namespace lockstep {
namespace {

template <typename... Messages>
void decode_as(std::span<const std::uint8_t> data) {
    const auto decode = [&]<typename Message>(std::type_identity<Message>) {
        const auto message = decode_lcm<Message>(data);
        require(message.has_value() || !message.error().empty(), "data is decoded, or refused with a text");
    };
    (decode(std::type_identity<Messages>{}), ...);
}

void decode(std::span<const std::uint8_t> data) {
    decode_as<axis_health_t, axis_position_t, channel_event_t, flight_event_t, flight_head_t, flight_note_t, job_t,
              program_event_t, program_part_t, record_loss_t, record_mark2_t, record_mark_t, run_t, step_batch_t>(data);
}

}  // namespace
}  // namespace lockstep

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace lockstep;
    decode({data, size});
    const int file = memfd_create("log", 0);
    require(write(file, data, size) == static_cast<ssize_t>(size), "memory takes the log");
    auto reader = LogReader::open("/proc/self/fd/" + std::to_string(file));
    require(reader.has_value(), "a log of any bytes can be opened");
    std::uint64_t bytes = 0;
    while (const auto event = reader->next().value()) {
        bytes += event->bytes;
        decode(event->data);
    }
    require(bytes + reader->damaged_bytes() == size, "every byte is of an event or counted as damaged");
    close(file);
    return 0;
}
