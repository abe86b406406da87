// The host's end: it keeps a register window for each motor of a board, as if the device wrote it, and sends what the
// host writes there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim_fpga/firmware/link/link.hpp"
#include "sim_fpga/firmware/link/look_word.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep::firmware {

/// The words that the host writes for one motor, as far as the board has received them.
class MotorOrders {
public:
    explicit MotorOrders(RegisterWindow window) : window_(std::move(window)) {}

    /// The board has powered up, which resets the words of both sides.
    void begin();
    void fill(unsigned motor, ItemWriter& items);
    void take(std::size_t offset, std::uint64_t value);
    /// Shows the registers that were taken: their SEQUENCE is odd until then. now_ns: of CLOCK_MONOTONIC.
    void show(std::int64_t now_ns);
    /// Whether the board answers. While it does not, there is no MAGIC, so that no driver takes the window for a
    /// device.
    void show_link(bool answers);

private:
    struct Ring;

    /// Returns false if there was no room, or a run began meanwhile: then nothing may follow.
    bool fill_orders(unsigned motor, ItemWriter& items);
    void fill_identify(unsigned motor, ItemWriter& items);
    void fill_setup(unsigned motor, ItemWriter& items);
    void fill_ring(const Ring& ring, unsigned motor, std::uint64_t head, std::uint64_t& sent, ItemWriter& items);
    std::uint64_t end_of_whole_frames(const Ring& segments, std::uint64_t frames) const;
    /// Returns false if there is no room.
    bool put_changed(unsigned motor, std::size_t offset, std::uint64_t value, ItemWriter& items);
    void take_own(std::size_t offset, std::uint64_t value);

    RegisterWindow window_;
    std::vector<std::uint64_t> sent_ = std::vector<std::uint64_t>(kWords);
    std::uint64_t segments_ = 0;  // entries of the segment ring that were sent
    std::uint64_t whole_ = 0;     // those of them whose frames were sent whole
    std::uint64_t changes_ = 0;   // entries of the output ring that were sent
    std::uint64_t sequence_ = 0;
    std::uint64_t identify_ = 0;  // the number that was sent last
    LookTime look_{};
    bool is_new_ = false;      // registers were taken that are not shown
    std::uint64_t magic_ = 0;  // as the board has sent it
    bool answers_ = true;

    static constexpr std::size_t kFirst = registers::kRunRequest;
    static constexpr std::size_t kWords =
        (registers::kInputTable + 32 * registers::kInputTableEntryBytes - kFirst) / sizeof(std::uint64_t);
};

class HostWords final : public LinkWords {
public:
    /// A window for each motor, of zeros.
    explicit HostWords(std::vector<RegisterWindow> windows);

    void begin() override;
    void fill(ItemWriter& items, std::uint32_t heard) override;
    void take(unsigned motor, std::size_t offset, std::uint64_t value) override;
    void open() override {}
    void close() override;
    /// Call it before the link takes bytes: when they arrived, by CLOCK_MONOTONIC. The link's own times are its
    /// microseconds.
    void receive_at(std::int64_t now_ns) { now_ns_ = now_ns; }
    void show_link(bool answers);

private:
    std::vector<MotorOrders> motors_;
    std::size_t turn_ = 0;
    std::int64_t now_ns_ = 0;
};

}  // namespace lockstep::firmware
