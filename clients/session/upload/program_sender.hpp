// Sends a program to the coordinator in parts while it is being made. It repeats each part until the coordinator has
// taken it. The coordinator runs the parts that it has, and the sender appends as much as there is room for. Pure: the
// caller passes the time.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/if_positive.hpp"
#include "core/protocol/messages.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep {

class ProgramSender {
public:
    /// `number` counts the programs that the client sends; it distinguishes their replies.
    ProgramSender(Identity client, std::uint32_t number, std::uint64_t program, const ProgramHead& head,
                  const std::optional<gcode::ProgramValues>& values = {});

    std::uint64_t program() const { return program_; }

    // For the code that makes the program.
    /// How many more blocks can be appended now: the coordinator's room less the blocks that wait here or are under
    /// way. 0 means later.
    std::size_t free_blocks() const;
    void append(const Block& block);
    /// Sends the appended blocks now, even if the part has room for more.
    void flush();
    /// Sets how much of the program has been appended, 0 to 1, where that is known.
    void note_share(double share) { share_ = if_positive(share); }
    /// Ends the program. `after`: the machine's values that it leaves.
    void end(const std::optional<gcode::KeptValues>& after = {});
    /// Ends the sending before the program's end: the machine runs what was sent, then rests.
    void cut(const std::string& why);

    // For the code that sends and receives.
    /// Returns the chunks to send now: new ones as far as there is room, those with an overdue reply, and a chunk
    /// without bytes from time to time, which asks for a reply and shows that this sender is alive.
    std::vector<ProgramChunk> due(std::chrono::nanoseconds now);
    /// Returns false if the reply answers something else.
    bool take_answer(const Reply& reply);

    std::uint32_t parts_taken() const { return taken_; }
    bool is_ended() const { return is_ended_; }
    /// The coordinator has taken all of it.
    bool is_done() const { return is_ended_ && parts_.empty(); }
    /// True if the coordinator has not taken all appended blocks.
    bool has_unsent() const { return waiting_ > 0; }
    /// The coordinator has taken everything sent and has no room for the next part until it has run some of the
    /// program.
    bool lacks_room() const;
    /// The reply that refuses the program; nullopt if none has come.
    const std::optional<Reply>& refusal() const { return refusal_; }

    static constexpr std::size_t kPartsInFlight = 16;  // well under what the topic keeps
    static constexpr std::size_t kPartsWaiting = 16;
    static constexpr std::chrono::milliseconds kRepeatAfter{300};
    static constexpr std::chrono::milliseconds kAskAfter{300};
    /// So many consecutive replies with fewer parts than an earlier one cannot all be late. They mean that another
    /// coordinator has taken over and lacks parts that are not kept here.
    static constexpr int kMostLacking = 2 * kPartsInFlight;

private:
    struct Part {
        std::vector<std::uint8_t> bytes;
        std::size_t blocks = 0;
        std::optional<double> share;
        std::optional<std::chrono::nanoseconds> sent;
    };
    ProgramChunk chunk(std::uint32_t index, std::vector<std::uint8_t> bytes, std::optional<double> share) const;
    void give_up(const Reply& reply);

    Identity client_;
    std::uint64_t first_sequence_;
    std::uint64_t program_;
    ProgramPartWriter open_;                                          // the part that is being filled
    std::deque<Part> parts_;                                          // not taken yet
    std::uint32_t taken_ = 0;                                         // parts
    std::size_t waiting_ = 0;                                         // blocks in parts_ and open_
    std::uint64_t room_ = std::numeric_limits<std::uint64_t>::max();  // the coordinator's room after the parts taken
    std::optional<double> share_;
    bool is_begun_ = false;  // the first part is in parts_, or was
    bool is_ended_ = false;
    int lacking_ = 0;  // consecutive replies with fewer parts than taken_
    std::optional<Reply> refusal_;
    std::chrono::nanoseconds asked_{};  // when a chunk was last sent
};

}  // namespace lockstep
