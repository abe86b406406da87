// Sends a program to the coordinator while it is made, a few parts at a time, each repeated until it is taken: the
// coordinator runs what it has, and the sender appends as much as there is room for. Pure: the caller gives the time.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/protocol/messages.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep {

class ProgramSender {
public:
    /// `number`: of this program among those that the client sends; it tells their replies apart.
    ProgramSender(Identity client, std::uint32_t number, std::uint64_t program, const ProgramHead& head,
                  const std::optional<gcode::ProgramValues>& values = {});

    std::uint64_t program() const { return program_; }

    // By whoever makes the program.
    /// How many blocks more it takes now; the coordinator's room, less what waits here and is under way. 0: later.
    std::size_t free_blocks() const;
    void append(const Block& block);
    /// Sends the appended blocks now, although the part has room for more.
    void flush();
    /// How much of the program has been appended, 0 to 1, where that is known.
    void note_share(double share) { share_ = share; }
    /// No more comes: the program's end, and the machine's values that it leaves.
    void end(const std::optional<gcode::KeptValues>& after = {});
    /// No more comes, although this is not the program's end: the machine runs what was sent, and rests.
    void cut(const std::string& why);

    // By whoever sends and receives.
    /// The chunks to send now: new ones as far as there is room, those whose reply is overdue, and a question from time
    /// to time, so that the coordinator receives this sender as long as it lives.
    std::vector<ProgramChunk> due(std::chrono::nanoseconds now);
    /// False: it answers something else.
    bool take_answer(const Reply& reply);

    std::uint32_t parts_taken() const { return taken_; }
    bool is_ended() const { return is_ended_; }
    /// The coordinator has taken all of it.
    bool is_done() const { return is_ended_ && parts_.empty(); }
    /// Blocks that the coordinator has not taken.
    bool has_unsent() const { return waiting_ > 0; }
    /// The coordinator has taken what was sent, and has no room for what comes next: it must run some of it first.
    bool lacks_room() const;
    /// The coordinator takes no more of it.
    const std::optional<Reply>& refusal() const { return refusal_; }

    static constexpr std::size_t kPartsInFlight = 16;  // well under what the topic keeps
    static constexpr std::size_t kPartsWaiting = 16;
    static constexpr std::chrono::milliseconds kRepeatAfter{300};
    static constexpr std::chrono::milliseconds kAskAfter{300};
    /// So many replies that count fewer parts than one before are not late ones: another coordinator has taken over,
    /// and lacks parts that are not kept here.
    static constexpr int kMostLacking = 2 * kPartsInFlight;

private:
    struct Part {
        std::vector<std::uint8_t> bytes;
        std::size_t blocks = 0;
        double share = 0;
        std::optional<std::chrono::nanoseconds> sent;
    };
    ProgramChunk chunk(std::uint32_t index, std::vector<std::uint8_t> bytes, double share) const;
    void give_up(const Reply& reply);

    Identity client_;
    std::uint64_t first_sequence_;
    std::uint64_t program_;
    ProgramPartWriter open_;                                          // the part that is being filled
    std::deque<Part> parts_;                                          // not taken yet
    std::uint32_t taken_ = 0;                                         // parts
    std::size_t waiting_ = 0;                                         // blocks in parts_ and open_
    std::uint64_t room_ = std::numeric_limits<std::uint64_t>::max();  // of the coordinator, behind the parts taken
    double share_ = 0;
    bool is_begun_ = false;  // the first part is in parts_, or was
    bool is_ended_ = false;
    int lacking_ = 0;  // replies in a row
    std::optional<Reply> refusal_;
    std::chrono::nanoseconds asked_{};  // or sent anything
};

}  // namespace lockstep
