// Measures half the time of a frame's way to another process and back, through DDS, translation and checks:
//   dds_round_trip pong DOMAIN [KEYS]             returns each frame, until SIGTERM
//   dds_round_trip ping DOMAIN AXES COUNT [KEYS]  prints the median of COUNT half round trips in us; AXES is 3 or 32
//   dds_round_trip match DOMAIN COUNT [KEYS]      prints how many milliseconds it takes to find COUNT pongs
//   dds_round_trip profile                        prints the DDS profile of these commands, for ddsperf
//   dds_round_trip keys DOMAIN KEYS               makes keys in a new directory; each side may send what both send
// KEYS turns on DDS Security.
#include <algorithm>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"
#include "services/wire/bus/bus.hpp"
#include "services/wire/dds/dds_log.hpp"
#include "tests/benchmarks/wire/benchmark_keys.hpp"
#include "tests/benchmarks/wire/frame_sizes.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr const char* kMachine = "benchmark";

/// Answers on a DDS thread, as soon as a frame arrives.
int pong(const NetworkConfig& network, const Membership& membership) {
    auto participant = Participant::open(network, kMachine, membership);
    if (!participant) { return 1; }
    Writer<Frame> answers(*participant);
    Reader<Frame>* self = nullptr;
    Reader<Frame> frames(*participant, [&] {
        if (self != nullptr) {
            self->take([&](Frame&& frame) { answers.write(frame); });
        }
    });
    self = &frames;
    const StopSignal stop;
    while (!stop.requested()) { std::this_thread::sleep_for(10ms); }
    return 0;
}

class Ping {
public:
    Ping(Participant& participant, Frame frame)
        : frame_(std::move(frame)), writer_(participant), reader_(participant, [this] { answered(); }) {}

    /// Half round trips in microseconds. Empty: no answer.
    std::vector<double> measure(std::size_t count) {
        while (writer_.matched() == 0 || reader_.matched() == 0) { std::this_thread::sleep_for(10ms); }
        std::this_thread::sleep_for(300ms);  // the other side has matched too
        wanted_ = count;
        send();
        return done_.wait_for(60s) ? halves_ : std::vector<double>{};
    }

private:
    void send() {
        sent_ = monotonic_now();
        writer_.write(frame_);
    }
    /// On a DDS thread: sends the next frame.
    void answered() {
        if (wanted_ == 0 || reader_.take([](Frame&&) {}) == 0) { return; }
        halves_.push_back(std::chrono::duration<double, std::micro>(monotonic_now() - sent_).count() / 2);
        if (halves_.size() < wanted_) {
            send();
        } else {
            done_.notify();
        }
    }

    Frame frame_;
    std::size_t wanted_ = 0;
    std::chrono::nanoseconds sent_{};
    std::vector<double> halves_;
    Arrivals done_;
    Writer<Frame> writer_;
    Reader<Frame> reader_;
};

int match(const NetworkConfig& network, std::size_t count, const Membership& membership) {
    const auto begun = monotonic_now();
    auto participant = Participant::open(network, kMachine, membership);
    if (!participant) { return 1; }
    const Writer<Frame> writer(*participant);
    const Reader<Frame> reader(*participant);
    while (writer.matched() < count || reader.matched() < count) { std::this_thread::sleep_for(1ms); }
    std::printf("%.0f\n", std::chrono::duration<double, std::milli>(monotonic_now() - begun).count());
    return 0;
}

int ping(const NetworkConfig& network, bool many_axes, std::size_t count, const Membership& membership) {
    auto participant = Participant::open(network, kMachine, membership);
    if (!participant) { return 1; }
    auto halves = Ping(*participant, many_axes ? frame_of_32_axes() : frame_of_3_axes()).measure(count);
    if (halves.empty()) { return 1; }
    const auto middle = halves.begin() + static_cast<std::ptrdiff_t>(halves.size() / 2);
    std::nth_element(halves.begin(), middle, halves.end());
    std::printf("%.2f\n", *middle);
    return 0;
}

}  // namespace
}  // namespace lockstep

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    lockstep::forward_dds_log([](const std::string&) {});  // the script reads standard error
    lockstep::NetworkConfig network;
    if (words == std::vector<std::string>{"profile"}) { return std::puts(lockstep::dds_profile(network)->c_str()) < 0; }
    if (words.size() < 2) { return 2; }
    network.domain = static_cast<std::uint32_t>(std::stoul(words[1]));
    if (words[0] == "keys" && words.size() == 3) { return lockstep::make_benchmark_keys(network, words[2]) ? 0 : 1; }
    const std::size_t without_keys = words[0] == "ping" ? 4 : words[0] == "match" ? 3 : 2;
    lockstep::Membership membership;
    if (words.size() > without_keys) { membership.credentials = lockstep::benchmark_credentials(words[without_keys]); }
    if (words[0] == "pong") { return lockstep::pong(network, membership); }
    if (words.size() < without_keys) { return 2; }
    if (words[0] == "match") { return lockstep::match(network, std::stoul(words[2]), membership); }
    return lockstep::ping(network, words[2] == "32", std::stoul(words[3]), membership);
}
