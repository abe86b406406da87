#include "sim_fpga/firmware/rp2040/uart.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"
#include "sim_fpga/firmware/rp2040/step_pins.hpp"

namespace lockstep::firmware {

using namespace chip;

namespace {

constexpr unsigned kInterrupt = 20;
constexpr std::uint32_t kRoom = 1024;

// Written by the interrupt alone, and by receive() alone.
volatile std::uint8_t received[kRoom];
volatile std::uint32_t received_head;
std::uint32_t received_tail;

}  // namespace

void UartLine::start() {
    at(uart0::kWholeDivider) = 12;  // 200 MHz / 16 / 12.5
    at(uart0::kFraction) = 32;
    at(uart0::kLine) = 0x70;      // 8 bits, queues
    at(uart0::kControl) = 0x301;  // both directions
    at(uart0::kInterrupts) = uart0::kReceive | uart0::kReceiveTimeout;
    at(io::control(kUartTransmitPin)) = io::kUart;
    at(io::control(kUartReceivePin)) = io::kUart;
    at(nvic::priority(kInterrupt)) = nvic::priority_bits(kInterrupt, 1);
    at(nvic::kEnable) = bit(kInterrupt);
}

/// Bytes are lost if the host sends faster than the board reads. The link sends their messages again.
extern "C" void on_uart() {
    while ((at(uart0::kFlags) & uart0::kReceiveEmpty) == 0) {
        const auto byte = static_cast<std::uint8_t>(at(uart0::kDataByte));
        received[received_head % kRoom] = byte;
        received_head = received_head + 1;
    }
    at(uart0::kClear) = uart0::kReceive | uart0::kReceiveTimeout;
}

bool UartLine::receive(std::uint8_t& byte) {
    if (received_head == received_tail) { return false; }
    byte = received[received_tail++ % kRoom];
    return true;
}

std::size_t UartLine::send(const std::uint8_t* bytes, std::size_t size) {
    std::size_t sent = 0;
    while (sent < size && (at(uart0::kFlags) & uart0::kTransmitFull) == 0) { at(uart0::kDataByte) = bytes[sent++]; }
    return sent;
}

}  // namespace lockstep::firmware
