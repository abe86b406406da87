#include "clients/session/program_stream.hpp"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "services/documents/program_file.hpp"

namespace lockstep {

namespace {

GcodeSetup awaiting_touches(GcodeSetup setup) {
    setup.awaits_touches = true;
    return setup;
}

}  // namespace

ProgramStream::ProgramStream(LineReader lines, const GcodeSetup& setup, std::uint64_t revision)
    : lines_(std::move(lines)),
      gcode_(awaiting_touches(setup)),
      head_(gcode_.head()),
      before_(setup.values),
      revision_(revision) {}

std::expected<void, Diagnostics> ProgramStream::read_first() {
    for (std::size_t n = 0; n < kLinesFirst && read_line() == Reading::Goes; ++n) {}
    if (trouble_) { return std::unexpected(Diagnostics{*trouble_}); }
    return {};
}

std::expected<ProgramStream::Beginning, Diagnostics> ProgramStream::skip_before(int line) {
    Program program{.name = head_.name, .axes = head_.axes, .start_mm = head_.start_mm, .blocks = {}};
    std::optional<Block> feed;  // the last move with a feed
    std::optional<Block> last;
    while (line_ + 1 < line && read_line() == Reading::Goes) {
        for (Block& block : blocks_) {
            const auto* move = std::get_if<ProgramMove>(&block.action);
            if (move != nullptr && !move->rapid) { feed = block; }
            if (move != nullptr) { last = std::move(block); }
        }
        blocks_.clear();
    }
    const ModalState modal = gcode_.modal();
    if (gcode_.awaits_touch()) { refuse_restart_behind_touch(line); }
    if (!trouble_) { (void)read_first(); }
    if (trouble_) { return std::unexpected(Diagnostics{*trouble_}); }
    if (feed) { program.blocks.push_back(*std::move(feed)); }
    if (last) { program.blocks.push_back(*std::move(last)); }
    program.blocks.insert(program.blocks.end(), blocks_.begin(), blocks_.end());
    return Beginning{std::move(program), modal};
}

void ProgramStream::refuse_restart_behind_touch(int line) {
    trouble_ = Diagnostic{.line = line_,
                          .column = 1,
                          .message = fmt::format("line {} depends on where this probing move touches; continue from "
                                                 "this line or one before it",
                                                 line)};
}

std::expected<void, Diagnostics> ProgramStream::touched(const ProbeTouch& touch, std::uint64_t revision) {
    before_ = gcode_.values();
    revision_ = revision;
    is_over_ = false;
    is_settled_ = true;
    if (const auto done = gcode_.touched(touch); !done) {
        trouble_ = to_diagnostics({done.error()}).front();
        is_over_ = true;
    }
    head_ = gcode_.head();
    take_blocks();
    return read_first();
}

void ProgramStream::cannot_go_on(std::string why) {
    trouble_ = Diagnostic{.line = line_, .column = 1, .message = std::move(why)};
    is_over_ = true;
}

void ProgramStream::replace_first(const Program& program) {
    head_ = program.head();
    blocks_ = program.blocks;
    next_ = 0;
}

ProgramStream::Reading ProgramStream::read_line() {
    is_over_ = is_over_ || awaits_touch() || gcode_.is_ended();
    if (is_over_) { return Reading::Ends; }
    const auto next = lines_.next();
    if (!next) {
        trouble_ = Diagnostic{.line = line_ + 1, .column = 1, .message = next.error()};
    } else if (next->state == LineReader::State::Waits) {
        return Reading::Waits;
    } else if (next->state == LineReader::State::Line) {
        take_line(next->line);
    } else if (const auto done = gcode_.finish(); !done) {
        trouble_ = to_diagnostics({done.error()}).front();
    }
    is_over_ = trouble_ || awaits_touch() || gcode_.is_ended() || next->state == LineReader::State::Ends;
    return is_over_ ? Reading::Ends : Reading::Goes;
}

void ProgramStream::take_line(std::string_view line) {
    const auto done = gcode_.take(line, ++line_);
    if (!done) {
        trouble_ = to_diagnostics({done.error()}).front();
        return;  // the line's blocks before its error are dropped
    }
    take_blocks();
}

void ProgramStream::take_blocks() {
    std::vector<Block> blocks = gcode_.take_blocks();
    blocks_.insert(blocks_.end(), std::make_move_iterator(blocks.begin()), std::make_move_iterator(blocks.end()));
}

void ProgramStream::append(ProgramSender& sender) {
    for (std::size_t room = sender.free_blocks(); room > 0 && next_ < blocks_.size(); --room) {
        sender.append(blocks_[next_++]);
        is_settled_ = false;
    }
    if (next_ < blocks_.size()) { return; }
    blocks_.clear();
    next_ = 0;
}

void ProgramStream::feed(ProgramSender& sender, std::chrono::nanoseconds now) {
    sender.note_share(lines_.share_read());
    for (std::size_t n = 0; n < kLinesAtOnce; ++n) {
        append(sender);
        if (!blocks_.empty()) { return; }
        const Reading reading = read_line();
        if (reading == Reading::Waits) { return settle(sender, now); }
        waits_since_.reset();
        if (reading == Reading::Ends && blocks_.empty()) { return finish(sender); }
    }
}

void ProgramStream::finish(ProgramSender& sender) {
    if (trouble_) { return sender.cut(fmt::format("line {}: {}", trouble_->line, trouble_->message)); }
    const gcode::KeptValues after = gcode_.values();
    sender.end(after == before_ ? std::nullopt : std::optional(after));
}

/// Sends the received blocks at once. If nothing more comes for a while, the machine runs to their end and rests.
void ProgramStream::settle(ProgramSender& sender, std::chrono::nanoseconds now) {
    sender.flush();
    if (!waits_since_) { waits_since_ = now; }
    if (is_settled_ || now - *waits_since_ < kSettleAfter) { return; }
    sender.append({line_, Settle{}});
    sender.flush();
    is_settled_ = true;
}

}  // namespace lockstep
