// A host that does at random what a host may do with a device, and sometimes what none should.
#pragma once

#include <cstdint>
#include <random>

#include "core/step/segment.hpp"
#include "tests/property/firmware/twin_devices.hpp"

namespace lockstep::testing {

class RandomHost {
public:
    explicit RandomHost(std::uint64_t seed);

    /// Writes words, lets time pass, and returns the first difference between the devices.
    std::optional<std::string> turn();
    /// How many pieces the host has loaded.
    std::uint64_t pieces() const { return pieces_; }
    std::uint64_t steps() const {
        return devices_.load(registers::kCaptureHead) + devices_.load(registers::kCaptureLost);
    }
    /// The bits of STATUS that were ever set.
    std::uint64_t seen() const { return seen_; }

private:
    std::int64_t below(std::int64_t bound) {
        return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(bound));
    }
    bool one_in(std::int64_t n) { return below(n) == 0; }
    std::uint64_t bits(unsigned count) { return random_() >> (64 - count); }

    void set_up();
    void act();
    void begin_run();
    void load_frame();
    void load_outputs(std::int64_t ticks, bool is_tail);
    void put_change(std::uint64_t tag, std::uint64_t at);
    std::uint64_t any_tag();
    Piece any_piece();
    void put_piece(const Piece& piece);
    void put_entry(std::uint64_t tag, std::uint64_t second, std::uint64_t third, std::uint64_t fourth);
    void arm();
    void veto();
    void write_anything();
    void disturb_plant();
    void request_outputs();
    void take_records();
    bool is_running() const;

    std::mt19937_64 random_;
    TwinDevices devices_;
    Tick now_;
    std::uint64_t pieces_ = 0;
    std::uint64_t seen_ = 0;
    bool is_lazy_ = false;  // leaves steps in the capture ring
    std::uint64_t run_ = 0;
    std::uint64_t frame_ = 0;  // the newest that was loaded
    std::uint64_t head_ = 0;   // of the segment ring
    std::uint64_t output_head_ = 0;
    std::uint64_t requests_ = 0;
    Tick end_;     // of the newest frame's body
    Position at_;  // at this tick
};

}  // namespace lockstep::testing
