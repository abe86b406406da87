#include "sim_fpga/firmware/rp2040/usb_line.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"

namespace lockstep::firmware {

using namespace chip;
using namespace usb_buffer;

namespace {

constexpr unsigned kControlIn = 1, kControlOut = 2;  // bits of both ends of the control endpoint

// The controller's memory: the control endpoint's packet, then those of the others, each at a multiple of 64.
constexpr std::uint32_t kControlPacket = usb_memory::kBegin + 0x100;
constexpr std::uint32_t kNoticePacket = 0x180, kInPackets = 0x200, kOutPackets = 0x280;

volatile std::uint8_t* control_packet() {
    return reinterpret_cast<volatile std::uint8_t*>(static_cast<std::uintptr_t>(kControlPacket));
}

usb::SetupPacket setup_packet() {
    const std::uint32_t first = at(usb_memory::kBegin);
    const std::uint32_t second = at(usb_memory::kBegin + 4);
    return {.type = static_cast<std::uint8_t>(first),
            .request = static_cast<std::uint8_t>(first >> 8),
            .value = static_cast<std::uint16_t>(first >> 16),
            .index = static_cast<std::uint16_t>(second),
            .length = static_cast<std::uint16_t>(second >> 16)};
}

void set_up_endpoints() {
    using namespace usb_memory;
    at(in_end(usb::kNoticeEndpoint)) = kEnabled | kInterrupt | kNoticePacket;
    at(in_end(usb::kLineEndpoint)) = kEnabled | kTwoBuffers | kEachBuffer | kBulk | kInPackets;
    at(out_end(usb::kLineEndpoint)) = kEnabled | kTwoBuffers | kEachBuffer | kBulk | kOutPackets;
}

}  // namespace

UsbLine::UsbLine(std::uint64_t serial)
    : requests_(serial),
      in_(usb_memory::in_buffers(usb::kLineEndpoint), usb_memory::kBegin + kInPackets),
      out_(usb_memory::out_buffers(usb::kLineEndpoint), usb_memory::kBegin + kOutPackets) {}

/// The plug's power is taken as there: the chip does not see it.
void UsbLine::start() {
    for (std::uint32_t n = 0; n < usb_memory::kBytes; n += 4) { at(usb_memory::kBegin + n) = 0; }
    at(usb_controller::kMuxing) = usb_controller::kToTransceiver | usb_controller::kConnected;
    at(usb_controller::kPower) = usb_controller::kHasPower | usb_controller::kOverridesPower;
    at(usb_controller::kMainControl) = 1;
    set_up_endpoints();
    at(usb_controller::kControl) = usb_controller::kEachControlBuffer | usb_controller::kPullUp;
}

/// What a request before has left is void when the next one has come.
void UsbLine::serve() {
    if (const std::uint32_t done = at(usb_controller::kBuffersDone); done != 0) {
        at(usb_controller::kBuffersDone) = done;
        if ((done & kControlIn) != 0) { sent_packet(); }
        if ((done & kControlOut) != 0) { received_packet(); }
    }
    const std::uint32_t status = at(usb_controller::kStatus);
    if ((status & usb_controller::kBusReset) != 0) { reset(); }
    if ((status & usb_controller::kHasSetup) != 0) { take_setup(); }
}

void UsbLine::reset() {
    at(usb_controller::kStatus) = usb_controller::kBusReset;
    at(usb_controller::kAddress) = 0;
    requests_.reset();
    restart(usb::kRestartsIn | usb::kRestartsOut);
    stage_ = Stage::Idle;
}

/// The line's OUT end waits for packets from the beginning.
void UsbLine::restart(unsigned ends) {
    if ((ends & usb::kRestartsIn) != 0) { in_.restart(); }
    if ((ends & usb::kRestartsOut) == 0) { return; }
    out_.restart();
    taken_ = 0;
    while (requests_.is_configured() && out_.has_free()) { out_.give(usb::kPacketBytes); }
}

void UsbLine::take_setup() {
    give_buffer(usb_memory::in_buffers(0), 0);
    give_buffer(usb_memory::out_buffers(0), 0);
    at(usb_controller::kBuffersDone) = kControlIn | kControlOut;
    at(usb_controller::kStatus) = usb_controller::kHasSetup;
    kind_ = kSecondKind;
    answer(requests_.take(setup_packet()));
}

void UsbLine::answer(const usb::Reply& reply) {
    restart(reply.restarts);
    switch (reply.kind) {
        case usb::Reply::Kind::Refused:
            stage_ = Stage::Idle;
            at(usb_controller::kRefusesControl) = kControlIn | kControlOut;
            give_buffer(usb_memory::in_buffers(0), kRefused);
            give_buffer(usb_memory::out_buffers(0), kRefused);
            return;
        case usb::Reply::Kind::Data:
            stage_ = Stage::Sending;
            left_ = reply.data;
            return send_data();
        case usb::Reply::Kind::AwaitsData:
            stage_ = Stage::Receiving;
            return give_buffer(usb_memory::out_buffers(0), usb::kPacketBytes | kind_ | kAvailable);
        case usb::Reply::Kind::Done: return end_request();
    }
}

void UsbLine::send_data() {
    const std::size_t size = left_.size < usb::kPacketBytes ? left_.size : usb::kPacketBytes;
    for (std::size_t n = 0; n < size; ++n) { control_packet()[n] = left_.at[n]; }
    left_ = {left_.at + size, left_.size - size};
    give_buffer(usb_memory::in_buffers(0), static_cast<std::uint32_t>(size) | kFull | kind_ | kAvailable);
    kind_ ^= kSecondKind;
}

/// An empty packet says that the request is done.
void UsbLine::end_request() {
    stage_ = Stage::Ending;
    give_buffer(usb_memory::in_buffers(0), kFull | kSecondKind | kAvailable);
}

void UsbLine::sent_packet() {
    if (stage_ == Stage::Ending) {
        stage_ = Stage::Idle;
        at(usb_controller::kAddress) = requests_.address();
    } else if (stage_ == Stage::Sending && left_.size > 0) {
        send_data();
    } else if (stage_ == Stage::Sending) {
        stage_ = Stage::Idle;  // the host's empty packet ends the request
        give_buffer(usb_memory::out_buffers(0), kSecondKind | kAvailable);
    }
}

void UsbLine::received_packet() {
    if (stage_ != Stage::Receiving) { return; }
    std::uint8_t bytes[usb::kPacketBytes];
    const std::size_t size = look_at_buffer(usb_memory::out_buffers(0)) & kLength;
    for (std::size_t n = 0; n < size; ++n) { bytes[n] = control_packet()[n]; }
    answer(requests_.take_data(bytes, size));
}

/// A packet stays in its buffer until its last byte was received: the host waits meanwhile, and no byte is lost.
bool UsbLine::receive(std::uint8_t& byte) {
    while (requests_.is_configured() && out_.has_done()) {
        if (taken_ < out_.done_bytes()) {
            byte = out_.done()[taken_++];
            return true;
        }
        taken_ = 0;
        out_.release();
        out_.give(usb::kPacketBytes);
    }
    return false;
}

/// A frame ends with a packet that is not full: a host collects full packets, and waits for more.
std::size_t UsbLine::send(const std::uint8_t* bytes, std::size_t size) {
    if (!requests_.is_open()) { return size; }
    while (in_.has_done()) { in_.release(); }
    std::size_t sent = 0;
    while (sent < size && in_.has_free()) {
        const std::size_t left = size - sent;
        const std::size_t packet = left < usb::kPacketBytes    ? left
                                   : left == usb::kPacketBytes ? usb::kPacketBytes - 1
                                                               : usb::kPacketBytes;
        for (std::size_t n = 0; n < packet; ++n) { in_.next()[n] = bytes[sent + n]; }
        in_.give(static_cast<std::uint32_t>(packet) | kFull);
        sent += packet;
    }
    return sent;
}

}  // namespace lockstep::firmware
