#include "sim_fpga/firmware/link/board_words.hpp"

namespace lockstep::firmware {

using namespace registers;

namespace {

constexpr Ring kStepsRing{kCaptureRing, kCaptureRoom, kCaptureRingEntryBytes};
constexpr Ring kEventsRing{kEventRing, kEventRoom, kEventRingEntryBytes};

}  // namespace

/// Entries that the host has taken, or has been sent, are not needed again by a host that begins.
void MotorLook::begin() { is_known_ = is_whole_ = is_looking_ = false; }

bool MotorLook::fill(const Words& words, unsigned motor, ItemWriter& items) {
    if (!is_known_) { return fill_constants(words, motor, items); }
    if (!fill_ring(words, kStepsRing, motor, seen(kCaptureHead), steps_, items)) { return true; }
    if (!fill_ring(words, kEventsRing, motor, seen(kEventHead), events_, items)) { return true; }
    if (!items.has_room_for_run(kWords)) { return true; }
    fill_registers(motor, items);
    is_looking_ = false;
    return false;
}

/// MAGIC comes last: the other words are valid when it is there.
bool MotorLook::fill_constants(const Words& words, unsigned motor, ItemWriter& items) {
    for (std::size_t word = kVersion; word <= kPinTicks; word += kWordBytes) {
        items.put(motor, word, words.load(word));
    }
    items.put(motor, kMagic, words.load(kMagic));
    steps_ = words.load(kCaptureTail);
    events_ = words.load(kEventTail);
    is_known_ = true;
    return true;
}

void MotorLook::look(const Words& words) {
    for (std::size_t n = 0; n < kWords; ++n) { seen_[n] = words.load(kFirst + n * kWordBytes); }
    is_looking_ = true;
}

/// Returns true if the host then has all entries up to `head`.
bool MotorLook::fill_ring(const Words& words, const Ring& ring, unsigned motor, std::uint64_t head, std::uint64_t& sent,
                          ItemWriter& items) const {
    for (; sent != head; ++sent) {
        if (!items.has_room(ring.entry_bytes / kWordBytes)) { return false; }
        for (std::size_t at = 0; at < ring.entry_bytes; at += kWordBytes) {
            items.put(motor, ring.entry(sent) + at, words.load(ring.entry(sent) + at));
        }
    }
    return true;
}

void MotorLook::fill_registers(unsigned motor, ItemWriter& items) {
    for (std::size_t n = 0; n < kWords; ++n) {
        if (is_whole_ && sent_[n] == seen_[n]) { continue; }
        items.put(motor, kFirst + n * kWordBytes, seen_[n]);
        sent_[n] = seen_[n];
    }
    is_whole_ = true;
}

void BoardWords::begin() {
    for (MotorLook& look : looks_) { look.begin(); }
    turn_ = 0;
}

void BoardWords::fill(ItemWriter& items) {
    if (looks_[turn_].needs_look()) {
        exchange_.enter();
        exchange_.publish(turn_);
        looks_[turn_].look(*words_[turn_]);
        exchange_.leave();
    }
    if (looks_[turn_].fill(*words_[turn_], static_cast<unsigned>(turn_), items)) { return; }
    turn_ = turn_ + 1 < motors_ ? turn_ + 1 : 0;
}

/// Entries of rings are not read before their head has moved, and words of a setup not before prepare_orders().
void BoardWords::take(unsigned motor, std::size_t offset, std::uint64_t value) {
    if (motor >= motors_ || !Words::is_of_host(offset)) { return; }
    if (offset >= kRunRequest && offset < kDirectRequest) {
        order_[orders_++] = {motor, offset, value};
    } else {
        words_[motor]->store(offset, value);
    }
}

void BoardWords::close() {
    exchange_.prepare_orders();
    exchange_.enter();
    for (std::size_t n = 0; n < orders_; ++n) { words_[order_[n].motor]->store(order_[n].offset, order_[n].value); }
    exchange_.take_orders();
    exchange_.leave();
}

}  // namespace lockstep::firmware
