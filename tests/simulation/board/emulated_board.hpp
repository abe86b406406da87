// A Raspberry Pi Pico with the firmware, in an emulator that is a process of its own, in virtual time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lockstep::testing {

/// A change of a pin. kStartPin: the machines that time the pins have begun.
struct PinEdge {
    double cycle;  // of the processor, since power-up
    std::uint8_t pin;
    bool is_high;
};
inline constexpr std::uint8_t kStartPin = 255;

class EmulatedBoard {
public:
    /// emulator: the script. firmware: a .uf2 file.
    EmulatedBoard(const std::string& emulator, const std::string& firmware);
    ~EmulatedBoard();
    EmulatedBoard(const EmulatedBoard&) = delete;
    EmulatedBoard& operator=(const EmulatedBoard&) = delete;

    struct Answer {
        std::vector<std::uint8_t> sent;
        std::vector<PinEdge> edges;
        std::uint32_t interrupted = 0;  // for how many cycles the processor was in interrupts
    };
    /// Runs the board until this microsecond since power-up. `levels`: of the pins; pin n is bit n. `bytes` arrive at
    /// it, one every 10 us. Throws if the emulator ends, which it does if the firmware stops.
    Answer run(std::uint32_t until_us, std::uint32_t levels, const std::vector<std::uint8_t>& bytes);

private:
    void write(const void* bytes, std::size_t size);
    void read(void* bytes, std::size_t size);

    int process_ = 0;
    int requests_ = 0;
    int answers_ = 0;
};

}  // namespace lockstep::testing
