// One end of the link between a host and a board: it copies each side's words to the other, in the order of writing.
//
// Each word of the register map is written by one side alone, so the link needs nothing but copies. Messages with words
// are numbered. An end accepts only the next number, and tells the other which one that is, so that repeats, gaps and
// delays are harmless: what an end has is always what the other had at some instant. Unacknowledged messages are sent
// again after a while, all of them, in order. If that does not help, because the line spoils each long message, the
// oldest one is sent in parts.
//
// The number of an end's session is never 0, and differs after each start. If it changes, both ends send all words
// again.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/link/frame.hpp"
#include "sim_fpga/firmware/link/items.hpp"
#include "sim_fpga/firmware/link/parts.hpp"

namespace lockstep::firmware {

/// The words of one side.
class LinkWords {
public:
    /// The other end has begun: it has none of this side's words.
    virtual void begin() = 0;
    /// Puts words that the other end does not have, as many as fit, or none. heard: the newest of the other end's times
    /// that has arrived.
    virtual void fill(ItemWriter& items, std::uint32_t heard) = 0;
    /// The words of a message follow. They take effect together.
    virtual void open() = 0;
    /// A word of the other side.
    virtual void take(unsigned motor, std::size_t offset, std::uint64_t value) = 0;
    /// All words of the message have been taken.
    virtual void close() = 0;

protected:
    ~LinkWords() = default;
};

class Link {
public:
    /// session: not 0, and different each time. `words` must outlive this object.
    Link(LinkWords& words, std::uint32_t session) : words_(words), session_(session) {}
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;

    /// Takes a byte of the other end. Times are microseconds of any clock, which may wrap.
    void take(std::uint8_t byte, std::uint32_t now_us);
    /// The same for an owner that reads frames itself, because it has several lines.
    void take(const Message& message, std::uint32_t now_us);
    /// Begins a new session, with another number: another host follows, or one that has missed what others did.
    void restart(std::uint32_t session);
    /// Makes the next frame to send. Returns false if there is none now.
    [[nodiscard]] bool next_frame(std::uint32_t now_us, Frame& frame);

    bool is_connected() const { return peer_ != 0; }
    /// When the other end sent what was taken last; its own clock.
    std::uint32_t peer_stamp() const { return peer_stamp_; }
    /// The newest of this end's times that the other end had received when it sent what was taken last.
    std::uint32_t echoed_stamp() const { return echoed_; }
    std::uint32_t refused() const { return reader_.refused(); }

    /// After this time without an acknowledgement, messages are sent again.
    static constexpr std::uint32_t kRepeat_us = 20'000;
    /// An end with nothing to send still sends a message so often.
    static constexpr std::uint32_t kIdle_us = 5'000;
    /// Messages with words that are not yet acknowledged.
    static constexpr std::uint16_t kMostInFlight = 8;
    /// A message that was sent again so often without an acknowledgement is sent in parts, and so are as many behind it
    /// as kMessagesInParts says.
    static constexpr unsigned kMostRepeats = 10;
    static constexpr unsigned kMessagesInParts = 32;

private:
    struct Header;
    static Header header_of(const Message& message);

    void begin_with(std::uint32_t peer);
    void take_acknowledgement(std::uint16_t acknowledged, std::uint32_t now_us);
    void take_words(const Message& message, std::uint16_t number);
    void repeat_if_late(std::uint32_t now_us);
    bool make_message();
    bool make_part(std::uint32_t now_us, Frame& frame);
    void finish(Message& message, std::uint16_t number, std::uint32_t now_us, Frame& frame);
    Message& stored(std::uint16_t number) { return stored_[number % kMostInFlight]; }
    std::uint16_t in_flight() const { return static_cast<std::uint16_t>(made_ - acknowledged_); }

    LinkWords& words_;
    std::uint32_t session_;
    std::uint32_t peer_ = 0;  // its session; 0: unknown
    FrameReader reader_;
    Message stored_[kMostInFlight];
    Message empty_;
    Message part_message_;
    std::uint16_t acknowledged_ = 0;  // messages below this number have arrived
    std::uint16_t sent_ = 0;          // the next number to send, or to send again
    std::uint16_t made_ = 0;          // the number of the next new message
    std::uint16_t expected_ = 0;      // the number of the next message of the other end
    std::uint32_t progress_us_ = 0;   // when the other end last acknowledged something, or the first message was sent
    std::uint32_t spoke_us_ = 0;      // when this end last sent anything
    unsigned repeats_ = 0;            // since the other end last acknowledged something
    unsigned in_parts_ = 0;           // messages that are sent in parts from now on
    std::size_t part_ = 0;            // the part to send next
    PartCollector parts_;             // of message expected_
    bool owes_answer_ = true;
    std::uint32_t peer_stamp_ = 0;
    std::uint32_t echoed_ = 0;
};

}  // namespace lockstep::firmware
