#include "sim_fpga/firmware/link/board_words.hpp"

#include "sim_fpga/firmware/link/identify_word.hpp"

namespace lockstep::firmware {

using namespace registers;

namespace {

constexpr Ring kStepsRing{kCaptureRing, kCaptureRoom, kCaptureRingEntryBytes};
constexpr Ring kEventsRing{kEventRing, kEventRoom, kEventRingEntryBytes};

}  // namespace

/// Entries that the host has taken, or has been sent, are not needed again by a host that begins.
void MotorLook::begin() {
    is_known_ = is_whole_ = is_looking_ = false;
    orders_ = 0;
}

bool MotorLook::fill(const Words& words, unsigned motor, ItemWriter& items) {
    if (!is_known_) {
        if (orders_ == 0) {
            fill_constants(words, motor, items);
        } else if (fill_orders(words, motor, items)) {
            items.put(motor, kMagic, words.load(kMagic));
            is_known_ = true;
        }
        return true;
    }
    if (!fill_ring(words, kStepsRing, motor, seen(kCaptureHead), steps_, items)) { return true; }
    if (!fill_ring(words, kEventsRing, motor, seen(kEventHead), events_, items)) { return true; }
    if (!items.has_room_for_run(kWords + 2)) { return true; }
    fill_registers(motor, items);
    is_looking_ = false;
    return false;
}

void MotorLook::fill_constants(const Words& words, unsigned motor, ItemWriter& items) {
    for (std::size_t word = kVersion; word <= kPinTicks; word += kWordBytes) {
        items.put(motor, word, words.load(word));
    }
    steps_ = words.load(kCaptureTail);
    events_ = words.load(kEventTail);
    orders_ = kRunRequest;
}

/// MAGIC comes behind them: the other words are valid when it is there. Words of 0 need not be sent.
bool MotorLook::fill_orders(const Words& words, unsigned motor, ItemWriter& items) {
    constexpr std::size_t kEnd = kInputTable + kMostInputs * kInputTableEntryBytes;
    for (; orders_ < kEnd; orders_ += kWordBytes) {
        const std::uint64_t value = words.load(orders_);
        if (value == 0) { continue; }
        if (!items.has_room(2)) { return false; }
        items.put(motor, orders_, value);
    }
    return items.has_room(1);
}

void MotorLook::look(const Words& words, LookTime time) {
    time_ = time;
    for (std::size_t n = 0; n < kWords; ++n) { seen_[n] = words.load(kFirst + n * kWordBytes); }
    is_looking_ = true;
}

/// Returns true if the host then has all entries up to `head`.
bool MotorLook::fill_ring(const Words& words, const Ring& ring, unsigned motor, std::uint64_t head, std::uint64_t& sent,
                          ItemWriter& items) const {
    for (; sent != head; ++sent) {
        if (!items.has_room(ring.entry_bytes / kWordBytes)) { return false; }
        if (ring.entry_bytes == kWordBytes) {  // a step: its tick is above that of the step before
            items.put_rising(motor, ring.entry(sent), words.load(ring.entry(sent)));
            continue;
        }
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
    items.put(motor, kLookWord, time_.word());
    is_whole_ = true;
}

void BoardWords::begin() {
    for (MotorLook& look : looks_) { look.begin(); }
    turn_ = 0;
}

void BoardWords::fill(ItemWriter& items, std::uint32_t heard) {
    if (looks_[turn_].needs_look()) {
        exchange_.enter();
        const std::uint32_t behind = exchange_.publish(turn_);
        looks_[turn_].look(*words_[turn_], {.heard = heard, .behind = behind});
        exchange_.leave();
    }
    if (looks_[turn_].fill(*words_[turn_], static_cast<unsigned>(turn_), items)) { return; }
    turn_ = turn_ + 1 < motors_ ? turn_ + 1 : 0;
}

/// Entries of rings are not read before their head has moved, and words of a setup not before prepare_orders().
void BoardWords::take(unsigned motor, std::size_t offset, std::uint64_t value) {
    if (offset == kIdentifyWord) { ++light_requests_; }
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
