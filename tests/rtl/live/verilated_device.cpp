#include "tests/rtl/live/verilated_device.hpp"

#include <algorithm>

namespace lockstep::rtl {

using namespace registers;

namespace {

constexpr std::size_t kWord = sizeof(std::uint64_t);
/// A device that has fallen behind shows its state after so many ticks.
constexpr Ticks kMostTicks{1000};

RegisterRing ring_of(VerilogDevice<Vaxis_of_machine>& device, std::size_t ring, std::size_t entries,
                     std::size_t entry_bytes) {
    return {ring, device.read(entries), entry_bytes};
}

}  // namespace

VerilatedDevice::VerilatedDevice(const PowerUp& up)
    : window_(up.window),
      plant_(up.plant),
      tick_ns_(static_cast<std::uint64_t>(up.tick_ns)),
      now_(up.now),
      device_(up.now, up.number),
      segments_(ring_of(device_, kSegmentRing, kSegmentEntries, kSegmentRingEntryBytes)),
      changes_(ring_of(device_, kOutputRing, kOutputEntries, kOutputRingEntryBytes)),
      captures_(ring_of(device_, kCaptureRing, kCaptureEntries, kCaptureRingEntryBytes)),
      events_(ring_of(device_, kEventRing, kEventEntries, kEventRingEntryBytes)),
      taken_(kSegmentRing / kWord) {
    window_.store(kMagic, 0);
    for (std::size_t word = kRunRequest; word < kSegmentRing; word += kWord) { window_.store(word, 0); }
    for (std::size_t word = kVersion; word <= kPinTicks; word += kWord) { window_.store(word, device_.read(word)); }
    window_.store(kTickNs, tick_ns_);  // the design is the same for every tick
    publish();
    window_.store(kMagic, device_.read(kMagic));
}

void VerilatedDevice::advance(Tick until) {
    do {
        take_orders();
        execute(std::min(until, now_ + kMostTicks));
        publish();
    } while (now_ < until);
}

bool VerilatedDevice::is_intact() const {
    const bool is_own = window_.load(kMagic) == kMagicValue && window_.load(kVersion) == kVersionValue &&
                        window_.load(kMapChecksum) == kMapChecksumValue && window_.load(kTickNs) == tick_ns_;
    const std::uint64_t loaded = window_.load(kSegmentHead) - window_.load(kSegmentTail);
    const std::uint64_t captured = window_.load(kCaptureHead) - window_.load(kCaptureTail);
    return is_own && loaded <= segments_.entries() && captured <= captures_.entries();
}

/// Words that make others count are read before them. The words of a run are taken only if the run has not changed
/// meanwhile.
void VerilatedDevice::take_orders() {
    take_setup();
    take_direct();
    const std::uint64_t run = window_.load(kRunRequest);
    const std::uint64_t veto = window_.load(kVeto);
    const std::uint64_t armed = window_.load(kArmed);
    const std::uint64_t trigger = window_.load(kTrigger);
    const std::uint64_t stop = window_.load(kStop);
    take_frames();
    for (const std::size_t word : {kCaptureTail, kEventTail, kBeat, kEnable}) { take(word); }
    if (window_.load(kRunRequest) != run) { return; }
    take(kVeto, veto);
    take(kArmed, armed);
    take(kTrigger, trigger);
    take(kStop, stop);
    take(kRunRequest, run);
}

void VerilatedDevice::take_setup() {
    const std::uint64_t request = window_.load(kSetupRequest);
    if (request == taken_[kSetupRequest / kWord]) { return; }
    for (std::size_t word = kSetupRequest + kWord; word <= kCompareTicks; word += kWord) { take(word); }
    for (std::size_t word = kAnalogTable; word < kInputTable + 32 * kInputTableEntryBytes; word += kWord) {
        take(word);
    }
    take(kSetupRequest, request);
}

void VerilatedDevice::take_direct() {
    const std::uint64_t request = window_.load(kDirectRequest);
    if (request == taken_[kDirectRequest / kWord]) { return; }
    take(kDirectOutputs);
    for (std::size_t word = kAnalogTable; word < kInputTable; word += kWord) { take(word); }
    take(kDirectRequest, request);
}

/// The outputs of a frame are in their ring before the frame is in its own.
void VerilatedDevice::take_frames() {
    const std::uint64_t frames = window_.load(kSegmentHead);
    take_ring(changes_, kOutputRingEntryBytes, window_.load(kOutputHead), changed_);
    take(kOutputHead, changed_);
    take_ring(segments_, kSegmentRingEntryBytes, frames, loaded_);
    take(kSegmentHead, loaded_);
}

/// Gives the device the new entries of a ring that the host writes.
void VerilatedDevice::take_ring(const RegisterRing& ring, std::size_t entry_bytes, std::uint64_t head,
                                std::uint64_t& taken) {
    if (head - taken > ring.entries()) { return; }  // impossible: is_intact() will tell
    for (; taken != head; ++taken) {
        const std::size_t entry = ring.entry(taken);
        for (std::size_t word = entry; word < entry + entry_bytes; word += kWord) {
            device_.write(word, window_.load(word));
        }
    }
}

void VerilatedDevice::take(std::size_t offset, std::uint64_t word) {
    std::uint64_t& own = taken_[offset / kWord];
    if (own == word) { return; }
    own = word;
    device_.write(offset, word);
}

/// The device shows its words after the last tick only.
void VerilatedDevice::execute(Tick until) {
    while (now_ < until) {
        device_.hold_words(now_ + Ticks{1} < until);
        tick();
    }
}

void VerilatedDevice::tick() {
    now_ += Ticks{1};
    (void)device_.tick(plant_.pins(), [this](int direction) {
        plant_.step({now_, static_cast<std::int8_t>(direction)});
        return plant_.pins();
    });
}

void VerilatedDevice::publish() {
    pass(captures_, 1, kCaptureHead, captured_);
    pass(events_, kEventRingEntryBytes / kWord, kEventHead, noted_);
    window_.store(kSequence, ++sequence_);
    for (std::size_t word = kTick; word <= kAnalogUpper; word += kWord) { window_.store(word, device_.read(word)); }
    window_.store(kSequence, ++sequence_);
}

/// Copies the new entries of a ring that the device writes.
void VerilatedDevice::pass(const RegisterRing& ring, std::size_t words, std::size_t head, std::uint64_t& passed) {
    for (const std::uint64_t end = device_.read(head); passed != end; ++passed) {
        const std::size_t entry = ring.entry(passed);
        for (std::size_t word = entry; word < entry + words * kWord; word += kWord) {
            window_.store(word, device_.read(word));
        }
    }
}

}  // namespace lockstep::rtl
