// Lines of G-code that are given one by one, by all clients of this server together: it is one writer, so its lines
// have one set of modes and parameters. core/gcode/session defines what a line leaves behind. A program, a fault and a
// reset end what lines have left behind, as M2 does for modes.
#pragma once

#include <deque>
#include <expected>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/web/program/program_reading.hpp"
#include "core/gcode/session/gcode_session.hpp"

namespace lockstep::web {

/// May be used from any thread.
class MdiSession {
public:
    static constexpr std::size_t kMostLines = 100;  // that are kept

    explicit MdiSession(const MachineSetup& machine);

    /// Makes a line ready to run; nullopt if it leaves the machine as it is. Call answer() next. Fails with 422 for a
    /// wrong line, and with 409 until the line before is answered.
    std::expected<std::optional<ReadyProgram>, Problem> read(const std::string& line, const ProgramStart& start);
    /// The machine has accepted or refused the line. A refused line leaves nothing behind. `job`: that runs it.
    void answer(bool is_accepted, std::optional<std::uint64_t> job = {});
    /// Adds a line to the list of earlier ones.
    void note(const std::string& line, bool is_accepted);
    /// A fault resets; spindle and coolant are as the machine reports them. A line that probes leaves its touch behind.
    void see(const Snapshot& snapshot);
    /// Restores the modes with which a program begins.
    void end_program();
    void reset();

    /// With which the next line begins.
    LineModes modes() const;
    /// Earlier lines, the oldest first, and whether each was accepted.
    std::deque<std::pair<std::string, bool>> lines() const;

private:
    void take_touch(const Snapshot& snapshot);

    MachineSetup machine_;
    mutable std::mutex mutex_;
    GcodeSession session_;
    bool is_waiting_ = false;                   // a line waits for the machine's answer
    std::optional<SessionLine> waiting_;        // that line; nullopt after a reset
    std::optional<std::uint64_t> probing_job_;  // of the last line, which probes; its touch is not known yet
    std::deque<std::pair<std::string, bool>> lines_;
};

}  // namespace lockstep::web
