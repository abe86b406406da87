// Sends a program to a machine in virtual time while the machine runs it: part by part, as far as the coordinator has
// room, as clients/session/program_sender.hpp does live. The virtual network loses nothing, so one part at a time is
// under way and none is repeated.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "clients/planning/program_text.hpp"
#include "services/virtual/virtual_machine.hpp"

namespace lockstep {

class ProgramFeed {
public:
    /// `make_room`: the coordinator keeps so many blocks more from now on. The text and the machine outlive this
    /// object.
    ProgramFeed(VirtualMachine& vm, std::uint64_t program, ProgramText& text,
                std::function<void(std::size_t blocks)> make_room);

    /// Call it often: it sends the next part if the one before was taken and there is room, else asks for the room now
    /// and then.
    void tend();

    /// The coordinator has answered the first part.
    bool has_begun() const { return index_ > 0 || refusal_; }
    /// Why the machine does not get all of the program; empty: it does.
    std::string trouble() const;

    static constexpr std::size_t kBlocks = 1000;  // of a part

private:
    ProgramPart next_part();
    void send(ProgramPart part);
    void take_answer(const Reply& reply);
    bool has_room() const { return part_->blocks.size() <= room_; }

    VirtualMachine& vm_;
    std::uint64_t program_;
    ProgramText& text_;
    std::function<void(std::size_t)> make_room_;
    Ticks ask_after_;
    std::uint32_t index_ = 0;                                         // of the next part: so many were taken
    std::uint32_t next_ = 0;                                          // the block to be read
    std::optional<ProgramPart> part_;                                 // not taken yet
    std::uint64_t room_ = std::numeric_limits<std::uint64_t>::max();  // of the coordinator, behind the parts taken
    std::optional<std::uint64_t> unanswered_;                         // a part's or question's sequence number
    bool is_question_ = false;                                        // the one that was sent last
    Tick sent_;                                                       // likewise
    bool is_over_ = false;                                            // the last part was read
    std::string cut_;                                                 // what is wrong with the text, with its place
    std::optional<Reply> refusal_;
};

}  // namespace lockstep
