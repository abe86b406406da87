// The board's end: it sends what its devices publish, and takes what the host writes.
//
// For each motor in turn it takes a consistent look at the registers, sends the steps and events up to this look, and
// then its words that have changed, in one message.
//
// A host that begins while the board is switched on gets the host's words too: it goes on where the one before it
// ended.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/words.hpp"
#include "sim_fpga/firmware/link/link.hpp"
#include "sim_fpga/firmware/link/look_word.hpp"

namespace lockstep::firmware {

/// The words of one motor, as far as the host has received them.
class MotorLook {
public:
    void begin();
    /// Whether the next words to send are those of a new look.
    bool needs_look() const { return is_known_ && !is_looking_; }
    void look(const Words& words, LookTime time);
    /// Puts words. Returns false if there is nothing more to send of this look.
    bool fill(const Words& words, unsigned motor, ItemWriter& items);

private:
    static constexpr std::size_t kFirst = registers::kSequence;
    static constexpr std::size_t kWords = (kDeviceWordsEnd - kFirst) / kWordBytes;

    void fill_constants(const Words& words, unsigned motor, ItemWriter& items);
    /// Returns false if there was no room for all.
    bool fill_orders(const Words& words, unsigned motor, ItemWriter& items);
    bool fill_ring(const Words& words, const Ring& ring, unsigned motor, std::uint64_t head, std::uint64_t& sent,
                   ItemWriter& items) const;
    void fill_registers(unsigned motor, ItemWriter& items);
    std::uint64_t seen(std::size_t offset) const { return seen_[(offset - kFirst) / kWordBytes]; }

    std::uint64_t seen_[kWords]{};
    std::uint64_t sent_[kWords]{};
    std::uint64_t steps_ = 0;   // entries of the capture ring that were sent
    std::uint64_t events_ = 0;  // entries of the event ring that were sent
    LookTime time_{};           // of the look
    std::size_t orders_ = 0;    // the word of the host that it gets next, by its offset; 0: none of the board's yet
    bool is_known_ = false;     // the host has the words that never change, and its own
    bool is_whole_ = false;     // the host has all registers of some look
    bool is_looking_ = false;   // this look is not yet sent
};

/// Keeps the execution of ticks out while words are exchanged with the devices, and has the devices follow.
class Exchange {
public:
    /// Ticks are not executed until leave().
    virtual void enter() = 0;
    virtual void leave() = 0;
    /// Before enter(): what takes long.
    virtual void prepare_orders() = 0;
    /// Within enter() and leave(): the devices take the host's words; a device publishes its words.
    virtual void take_orders() = 0;
    /// Returns the ticks that the board's clock has counted beyond the published TICK.
    virtual std::uint32_t publish(std::size_t motor) = 0;

protected:
    ~Exchange() = default;
};

class BoardWords final : public LinkWords {
public:
    static constexpr std::size_t kMostMotors = 4;

    /// words: of each motor. All must outlive this object.
    BoardWords(Words* const* words, std::size_t motors, Exchange& exchange)
        : words_(words), motors_(motors), exchange_(exchange) {}

    void begin() override;
    void fill(ItemWriter& items, std::uint32_t heard) override;
    void take(unsigned motor, std::size_t offset, std::uint64_t value) override;
    void open() override { orders_ = 0; }
    void close() override;
    /// How often a host has asked for the board's light.
    std::uint32_t light_requests() const { return light_requests_; }

private:
    Words* const* words_;
    std::size_t motors_;
    Exchange& exchange_;
    /// Words that the execution of ticks reads. Those of a message take effect together.
    struct Order {
        unsigned motor;
        std::size_t offset;
        std::uint64_t value;
    };
    static constexpr std::size_t kMostOrders = kMostMessageBytes / kWordBytes;

    Order order_[kMostOrders];
    std::size_t orders_ = 0;
    MotorLook looks_[kMostMotors];
    std::size_t turn_ = 0;
    std::uint32_t light_requests_ = 0;
};

}  // namespace lockstep::firmware
