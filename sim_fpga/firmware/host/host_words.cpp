#include "sim_fpga/firmware/host/host_words.hpp"

#include <utility>

#include "sim_fpga/firmware/host/link_words.hpp"
#include "sim_fpga/firmware/link/identify_word.hpp"

namespace lockstep::firmware {

using namespace registers;

/// A ring that the host writes, and how many entries the board has.
struct MotorOrders::Ring {
    std::size_t offset;
    std::size_t entry_bytes;
    std::size_t entries_word;
};

void MotorOrders::begin() {
    window_.store(kMagic, 0);
    for (std::size_t n = 0; n < kWords; ++n) { window_.store(kFirst + n * sizeof(std::uint64_t), 0); }
    sent_.assign(kWords, 0);
    segments_ = whole_ = changes_ = sequence_ = magic_ = 0;
    is_new_ = false;
    identify_ = window_.load(kIdentifyWord);
}

/// Orders come first: a veto does not wait behind frames. A number that makes other words take effect is read before
/// them and sent behind them.
void MotorOrders::fill(unsigned motor, ItemWriter& items) {
    if (magic_ != kMagicValue) { return; }
    const std::uint64_t frames = window_.load(kSegmentHead);
    const std::uint64_t outputs = window_.load(kOutputHead);
    if (!fill_orders(motor, items)) { return; }
    fill_identify(motor, items);
    fill_setup(motor, items);
    fill_ring({kOutputRing, kOutputRingEntryBytes, kOutputEntries}, motor, outputs, changes_, items);
    if (changes_ != outputs || !put_changed(motor, kOutputHead, outputs, items)) { return; }
    if (!put_changed(motor, kSegmentHead, whole_, items)) { return; }
    const Ring segments{kSegmentRing, kSegmentRingEntryBytes, kSegmentEntries};
    fill_ring(segments, motor, frames, segments_, items);
    whole_ = end_of_whole_frames(segments, frames);
    put_changed(motor, kSegmentHead, whole_, items);
}

/// A board takes all words of a message at the same instant. So they must be of one run: the words are read in the
/// order that a device reads them, and are sent only if the run did not change meanwhile. Where a device takes one word
/// after the other, a frame is vetoed before others are armed, and armed after its run has begun.
bool MotorOrders::fill_orders(unsigned motor, ItemWriter& items) {
    constexpr std::array kOrders{kTrigger, kStop, kBeat, kEnable, kCaptureTail, kEventTail};
    if (!items.has_room(kOrders.size() + 3)) { return false; }
    const std::uint64_t run = window_.load(kRunRequest);
    const std::uint64_t veto = window_.load(kVeto);
    const std::uint64_t armed = window_.load(kArmed);
    std::array<std::uint64_t, kOrders.size()> values{};
    for (std::size_t n = 0; n < kOrders.size(); ++n) { values[n] = window_.load(kOrders[n]); }
    if (window_.load(kRunRequest) != run) { return false; }
    for (std::size_t n = 0; n < kOrders.size(); ++n) { put_changed(motor, kOrders[n], values[n], items); }
    put_changed(motor, kVeto, veto, items);
    put_changed(motor, kRunRequest, run, items);
    return put_changed(motor, kArmed, armed, items);
}

void MotorOrders::fill_identify(unsigned motor, ItemWriter& items) {
    const std::uint64_t asked = window_.load(kIdentifyWord);
    if (asked == identify_ || !items.has_room(1)) { return; }
    items.put(motor, kIdentifyWord, asked);
    identify_ = asked;
}

void MotorOrders::fill_setup(unsigned motor, ItemWriter& items) {
    const std::uint64_t direct = window_.load(kDirectRequest);
    const std::uint64_t setup = window_.load(kSetupRequest);
    const auto put_range = [&](std::size_t first, std::size_t end) {
        for (std::size_t word = first; word < end; word += sizeof(std::uint64_t)) {
            if (!put_changed(motor, word, window_.load(word), items)) { return false; }
        }
        return true;
    };
    if (put_range(kAnalogTable, kInputTable) && put_range(kDirectOutputs, kDirectOutputs + 8) &&
        put_range(kStepWidth, kCompareTicks + 8) && put_range(kInputTable, kFirst + kWords * 8)) {
        put_changed(motor, kDirectRequest, direct, items);
        put_changed(motor, kSetupRequest, setup, items);
    }
}

/// Frames that were sent whole need not wait for those behind them. They end where another begins, or at `frames`.
std::uint64_t MotorOrders::end_of_whole_frames(const Ring& segments, std::uint64_t frames) const {
    const std::uint64_t entries = window_.load(segments.entries_word);
    for (std::uint64_t end = segments_; end != whole_; --end) {
        const std::size_t at = segments.offset + end % entries * segments.entry_bytes;
        const bool is_header = (window_.load(at + kSegmentRingHeaderTag) & kSegmentRingHeaderTagIsHeader) != 0;
        if (end == frames || is_header) { return end; }
    }
    return whole_;
}

void MotorOrders::fill_ring(const Ring& ring, unsigned motor, std::uint64_t head, std::uint64_t& sent,
                            ItemWriter& items) {
    const std::uint64_t entries = window_.load(ring.entries_word);
    for (; sent != head && items.has_room_for_run(ring.entry_bytes / 8); ++sent) {
        const std::size_t at = ring.offset + sent % entries * ring.entry_bytes;
        for (std::size_t n = 0; n < ring.entry_bytes; n += 8) { items.put(motor, at + n, window_.load(at + n)); }
    }
}

bool MotorOrders::put_changed(unsigned motor, std::size_t offset, std::uint64_t value, ItemWriter& items) {
    std::uint64_t& sent = sent_[(offset - kFirst) / sizeof(std::uint64_t)];
    if (sent == value) { return true; }
    if (!items.has_room(1)) { return false; }
    items.put(motor, offset, value);
    sent = value;
    return true;
}

void MotorOrders::take(std::size_t offset, std::uint64_t value) {
    if (offset >= kWindowBytes || offset % sizeof(std::uint64_t) != 0) { return; }
    if (offset >= kFirst && offset < kFirst + kWords * sizeof(std::uint64_t)) { return take_own(offset, value); }
    switch (offset) {
        case kMagic: magic_ = value; break;
        case kSequence:
            sequence_ = value;
            window_.store(kSequence, value - 1);
            break;
        case kLookWord:
            look_ = LookTime::of(value);
            is_new_ = true;
            break;
        default: window_.store(offset, value);
    }
}

/// A word of the host that the board has from the host before this one.
void MotorOrders::take_own(std::size_t offset, std::uint64_t value) {
    if (magic_ != 0) { return; }
    window_.store(offset, value);
    sent_[(offset - kFirst) / sizeof(std::uint64_t)] = value;
    if (offset == kSegmentHead) { segments_ = whole_ = value; }
    if (offset == kOutputHead) { changes_ = value; }
}

/// The board had received look_.heard of the host when it looked. MAGIC comes last: everything else is valid then.
void MotorOrders::show(std::int64_t now_ns) {
    if (!std::exchange(is_new_, false) || sequence_ == 0) { return; }
    const auto now_us = static_cast<std::uint64_t>(now_ns) / 1000;
    const std::uint32_t ago_us = static_cast<std::uint32_t>(now_us) - look_.heard;
    window_.store(kAskedWord, (now_us - ago_us) * 1000);
    window_.store(kAnsweredWord, static_cast<std::uint64_t>(now_ns));
    window_.store(kBehindWord, look_.behind);
    window_.store(kSequence, sequence_);
    if (answers_) { window_.store(kMagic, magic_); }
}

void MotorOrders::show_link(bool answers) {
    answers_ = answers;
    window_.store(kAnswersWord, answers ? 1 : 0);
    window_.store(kMagic, answers ? magic_ : 0);
}

HostWords::HostWords(std::vector<RegisterWindow> windows) {
    for (RegisterWindow& window : windows) { motors_.emplace_back(std::move(window)); }
}

void HostWords::begin() {
    for (MotorOrders& motor : motors_) { motor.begin(); }
}

/// Each motor in turn is the first: none waits behind another's frames.
void HostWords::fill(ItemWriter& items, std::uint32_t /*heard*/) {
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        const std::size_t motor = (turn_ + n) % motors_.size();
        motors_[motor].fill(static_cast<unsigned>(motor), items);
    }
    turn_ = (turn_ + 1) % motors_.size();
}

void HostWords::take(unsigned motor, std::size_t offset, std::uint64_t value) {
    if (motor < motors_.size()) { motors_[motor].take(offset, value); }
}

void HostWords::close() {
    for (MotorOrders& motor : motors_) { motor.show(now_ns_); }
}

void HostWords::show_link(bool answers) {
    for (MotorOrders& motor : motors_) { motor.show_link(answers); }
}

}  // namespace lockstep::firmware
