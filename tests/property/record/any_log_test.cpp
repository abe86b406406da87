// No damage to a log makes its reader or a decoder fail. Every byte belongs to an event or is reported as damaged.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Random = std::mt19937_64;

constexpr int kRounds = 2000;

step_batch_t steps() {
    step_batch_t message{};
    message.machine = "mill";
    message.axis = "X";
    message.count = 20;
    message.delta_ticks.assign(20, 100);
    message.direction.assign(20, 1);
    return message;
}

run_t run() {
    run_t message{};
    message.machine = "mill";
    message.axis = "Y";
    message.pieces = 3;
    message.ticks.assign(3, 1000);
    message.velocity.assign(3, 1 << 20);
    message.acceleration.assign(3, -7);
    return message;
}

axis_position_t position() {
    axis_position_t message{};
    message.machine = "mill";
    message.axis = "Z";
    message.state = "Cruise";
    return message;
}

job_t job() {
    job_t message{};
    message.machine = "mill";
    message.kind = "run";
    message.event = "begun";
    message.config = std::string(300, 'c');
    message.axes = 2;
    message.start_count.assign(2, 5);
    return message;
}

program_event_t event() {
    program_event_t message{};
    message.machine = "mill";
    message.kind = "spindle-forward";
    return message;
}

/// A log written by the program's own writer, read back as bytes.
Bytes whole_log(const std::filesystem::path& path) {
    {
        auto writer = LogWriter::open(path).value();
        for (int i = 0; i < 4; ++i) {
            writer.write_message("LOCKSTEP_MILL_JOB", i, job());
            writer.write_message("LOCKSTEP_MILL_EVENTS", i, event());
            writer.write_message("LOCKSTEP_MILL_X_STEPS", i, steps());
            writer.write_message("LOCKSTEP_MILL_Y_RUN", i, run());
            writer.write_message("LOCKSTEP_MILL_Z_POSITION", i, position());
            writer.write_message("LOCKSTEP_MILL_Z_HEALTH", i, axis_health_t{});
            writer.write_message("LOCKSTEP_MILL_Z_CHANNELS", i, channel_event_t{});
        }
        EXPECT_TRUE(writer.flush());
    }
    std::ifstream file(path, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(file), {});
}

/// Overwrites, removes, inserts or doubles bytes, or cuts them off, in a few places.
Bytes mutated(Bytes bytes, Random& random) {
    const auto place = [&] { return bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size()); };
    for (auto left = 1 + random() % 6; left > 0 && bytes.size() > 64; --left) {
        const auto at = place();
        const auto end = at + std::min<std::ptrdiff_t>(bytes.end() - at, static_cast<std::ptrdiff_t>(random() % 64));
        switch (random() % 6) {
            case 0: *at = static_cast<std::uint8_t>(random()); break;
            case 1: *at ^= static_cast<std::uint8_t>(1U << random() % 8); break;
            case 2: bytes.erase(at, end); break;
            case 3: bytes.insert(at, random() % 64, static_cast<std::uint8_t>(random())); break;
            case 4: {
                const Bytes piece(at, end);
                bytes.insert(place(), piece.begin(), piece.end());
                break;
            }
            default: bytes.erase(random() % 8 == 0 ? at : bytes.end() - 1, bytes.end()); break;
        }
    }
    return bytes;
}

template <typename Message>
bool is_decoded_or_refused(std::span<const std::uint8_t> data) {
    const auto message = decode_lcm<Message>(data);
    return message.has_value() || !message.error().empty();
}

void decode_as_everything(std::span<const std::uint8_t> data) {
    EXPECT_TRUE(is_decoded_or_refused<step_batch_t>(data));
    EXPECT_TRUE(is_decoded_or_refused<run_t>(data));
    EXPECT_TRUE(is_decoded_or_refused<axis_position_t>(data));
    EXPECT_TRUE(is_decoded_or_refused<job_t>(data));
    EXPECT_TRUE(is_decoded_or_refused<axis_health_t>(data));
    EXPECT_TRUE(is_decoded_or_refused<program_event_t>(data));
    EXPECT_TRUE(is_decoded_or_refused<channel_event_t>(data));
}

/// Reads everything and returns the number of bytes in events.
std::uint64_t read_events(LogReader& reader) {
    std::uint64_t bytes = 0;
    std::uint64_t end = 0;
    while (const auto event = reader.next().value()) {
        EXPECT_GE(event->offset, end) << "events do not overlap";
        end = event->offset + event->bytes;
        bytes += event->bytes;
        decode_as_everything(event->data);
    }
    return bytes;
}

TEST(AnyLog, IsReadToItsEndAndEveryByteIsCounted) {
    const auto path = std::filesystem::temp_directory_path() / ("lockstep_any_log_" + std::to_string(getpid()));
    const Bytes whole = whole_log(path);
    Random random(20);
    for (int round = 0; round < kRounds; ++round) {
        const Bytes bytes = mutated(whole, random);
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        auto reader = LogReader::open(path);
        ASSERT_TRUE(reader) << reader.error();
        const std::uint64_t of_events = read_events(*reader);
        ASSERT_EQ(of_events + reader->damaged_bytes(), bytes.size()) << "round " << round;
    }
    std::filesystem::remove(path);
}

/// Messages without a log, as a network may deliver them.
TEST(AnyMessage, IsDecodedOrRefused) {
    Random random(21);
    const auto encoded = [](const auto& message) {
        Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
        message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
        return bytes;
    };
    const std::vector<Bytes> messages = {encoded(steps()), encoded(run()), encoded(position()), encoded(job()),
                                         encoded(axis_health_t{})};
    for (int round = 0; round < 10 * kRounds; ++round) {
        decode_as_everything(mutated(messages[random() % messages.size()], random));
    }
}

}  // namespace
}  // namespace lockstep
