#include "sim_fpga/firmware/link/link.hpp"

namespace lockstep::firmware {

/// from, to: sessions. number: of this message if it has words. expected: of the next message of the other end.
struct Link::Header {
    std::uint32_t from;
    std::uint32_t to;
    std::uint16_t number;
    std::uint16_t expected;
    std::uint32_t stamp;
    std::uint32_t echo;
};

Link::Header Link::header_of(const Message& message) {
    const std::uint8_t* const at = message.bytes;
    return {.from = static_cast<std::uint32_t>(load_bytes(at, 4)),
            .to = static_cast<std::uint32_t>(load_bytes(at + 4, 4)),
            .number = static_cast<std::uint16_t>(load_bytes(at + 8, 2)),
            .expected = static_cast<std::uint16_t>(load_bytes(at + 10, 2)),
            .stamp = static_cast<std::uint32_t>(load_bytes(at + 12, 4)),
            .echo = static_cast<std::uint32_t>(load_bytes(at + 16, 4))};
}

void Link::take(std::uint8_t byte, std::uint32_t now_us) {
    if (reader_.take(byte)) { take(reader_.message(), now_us); }
}

/// A terminal that is not yet set up sends this end's own frames back to it.
void Link::take(const Message& message, std::uint32_t now_us) {
    if (message.size < kHeaderBytes) { return; }
    const Header header = header_of(message);
    if (header.from == 0 || header.from == session_) { return; }
    if (header.from != peer_) { begin_with(header.from); }
    peer_stamp_ = header.stamp;
    if (header.to != session_) {  // it does not know this end yet
        owes_answer_ = true;
        return;
    }
    echoed_ = header.echo;
    take_acknowledgement(header.expected, now_us);
    if (message.size > kHeaderBytes) { take_words(message, header.number); }
}

void Link::restart(std::uint32_t session) {
    session_ = session;
    peer_ = 0;
}

void Link::begin_with(std::uint32_t peer) {
    peer_ = peer;
    acknowledged_ = sent_ = made_ = expected_ = 0;
    repeats_ = in_parts_ = 0;
    parts_.clear();
    words_.begin();
}

void Link::take_acknowledgement(std::uint16_t acknowledged, std::uint32_t now_us) {
    const auto news = static_cast<std::uint16_t>(acknowledged - acknowledged_);
    if (news == 0 || news > in_flight()) { return; }
    const auto again = static_cast<std::uint16_t>(sent_ - acknowledged_);
    acknowledged_ = acknowledged;
    if (again < news) { sent_ = acknowledged; }
    in_parts_ -= in_parts_ < news ? in_parts_ : news;
    repeats_ = 0;
    progress_us_ = now_us;
}

void Link::take_words(const Message& message, std::uint16_t number) {
    owes_answer_ = true;
    if (number != expected_) { return; }
    if (is_part(message) && !parts_.take(message)) { return; }
    ++expected_;
    words_.open();
    for_each_word(
        is_part(message) ? parts_.message() : message,
        [this](unsigned motor, std::size_t offset, std::uint64_t value) { words_.take(motor, offset, value); });
    words_.close();
    parts_.clear();
}

bool Link::next_frame(std::uint32_t now_us, Frame& frame) {
    repeat_if_late(now_us);
    if (in_parts_ > 0 && make_part(now_us, frame)) { return true; }
    if (sent_ != made_ || make_message()) {
        if (sent_ == acknowledged_) { progress_us_ = now_us; }
        const std::uint16_t number = sent_++;
        finish(stored(number), number, now_us, frame);
        return true;
    }
    if (!owes_answer_ && now_us - spoke_us_ < kIdle_us) { return false; }
    empty_.size = kHeaderBytes;
    finish(empty_, made_, now_us, frame);
    return true;
}

void Link::repeat_if_late(std::uint32_t now_us) {
    if (in_flight() == 0 || now_us - progress_us_ < kRepeat_us) { return; }
    sent_ = acknowledged_;
    if (in_parts_ > 0) { return; }
    progress_us_ = now_us;
    if (++repeats_ > kMostRepeats) { in_parts_ = kMessagesInParts; }
}

/// Returns false if there is nothing to send. The parts of the oldest message take turns, without a pause: the line is
/// poor, and nothing else can be sent before it has arrived.
bool Link::make_part(std::uint32_t now_us, Frame& frame) {
    if (in_flight() == 0 && !make_message()) { return false; }
    const Message& message = stored(acknowledged_);
    part_ = part_ + 1 < parts_of(message) ? part_ + 1 : 0;
    cut_part(message, part_, part_message_);
    if (sent_ == acknowledged_) { ++sent_; }
    finish(part_message_, acknowledged_, now_us, frame);
    return true;
}

/// Returns false if there is nothing to send, or no room to keep it.
bool Link::make_message() {
    if (peer_ == 0 || in_flight() == kMostInFlight) { return false; }
    ItemWriter items(stored(made_));
    words_.fill(items, peer_stamp_);
    if (items.is_empty()) { return false; }
    ++made_;
    return true;
}

void Link::finish(Message& message, std::uint16_t number, std::uint32_t now_us, Frame& frame) {
    std::uint8_t* const at = message.bytes;
    store_bytes(at, session_, 4);
    store_bytes(at + 4, peer_, 4);
    store_bytes(at + 8, number, 2);
    store_bytes(at + 10, expected_, 2);
    store_bytes(at + 12, now_us, 4);
    store_bytes(at + 16, peer_stamp_, 4);
    encode(message, frame);
    spoke_us_ = now_us;
    owes_answer_ = false;
}

}  // namespace lockstep::firmware
