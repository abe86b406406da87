// A Raspberry Pi Pico with the firmware, in an emulator that is a process of its own, in virtual time.
#pragma once

#include <cstdint>
#include <memory>
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

class EmulatorProcess;

/// A board that has just been powered up. The emulator of an earlier board, if it is free, runs this one too, because
/// Node has compiled the code there.
class EmulatedBoard {
public:
    /// emulator: the script. firmware: a .uf2 file. Both are the same for all boards.
    EmulatedBoard(const std::string& emulator, const std::string& firmware);
    ~EmulatedBoard();
    EmulatedBoard(const EmulatedBoard&) = delete;
    EmulatedBoard& operator=(const EmulatedBoard&) = delete;

    /// Reset: the USB host begins anew. CloseAt1200: it closes the line at 1200 Bd.
    enum class Plug : std::uint32_t { AsItIs, In, Out, Reset, CloseAt1200 };
    struct Request {
        std::uint32_t until_us;    // since power-up
        std::uint32_t levels = 0;  // of the pins; pin n is bit n
        Plug plug = Plug::AsItIs;  // at the beginning
        std::vector<std::uint8_t> by_uart{};
        std::vector<std::uint8_t> by_usb{};  // lost if no program has the line open
    };
    struct Answer {
        std::vector<std::uint8_t> by_uart;
        std::vector<std::uint8_t> by_usb;
        std::vector<PinEdge> edges;
        std::uint32_t interrupted = 0;  // for how many cycles the processor was in interrupts
        bool is_usb_open = false;       // a program on the USB host has the line open
        bool is_in_boot_mode = false;   // the firmware has ended
    };
    /// Runs the board. Bytes arrive by its UART every 10 us, and by USB as soon as the bus can. Throws if the emulator
    /// ends, which it does if the firmware stops, or does what a USB host does not accept.
    Answer run(const Request& request);

private:
    std::unique_ptr<EmulatorProcess> process_;  // none after it has ended
};

}  // namespace lockstep::testing
