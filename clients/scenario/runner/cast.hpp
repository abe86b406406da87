// The processes of a machine on the stage: started, killed, stopped and woken as the scenario has it. Nobody starts one
// again by itself.
#pragma once

#include <sys/types.h>

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/scenario/model/facts.hpp"
#include "clients/supervisor/service_lines.hpp"

namespace lockstep::scenario {

class Cast {
public:
    /// `lines`: whole, with all that their command lines begin with. `numbers`: where what is started writes the number
    /// of the process that it starts itself and waits for, NAME.pid; empty: it is that process.
    Cast(const std::vector<ServiceLine>& lines, StateDirectory state, std::filesystem::path numbers = {});

    /// Errors: there is no such process on the stage now, or it runs already; it cannot be started.
    std::expected<void, std::string> start(const std::string& name);
    std::expected<void, std::string> kill(const std::string& name);
    std::expected<void, std::string> pause(const std::string& name);
    std::expected<void, std::string> unpause(const std::string& name);
    /// Ended as asked, or by force; then started.
    std::expected<void, std::string> restart(const std::string& name);

    /// Neither ended nor stopped.
    bool is_acting(const std::string& name);
    /// Wakes and ends all.
    void end_all();

    /// Whether processes ended that nobody had ended, and how.
    Check ends_check();

private:
    struct Part {
        ServiceLine line;
        pid_t pid = 0;  // what was started; 0: it does not run
        bool is_paused = false;
        bool is_killed = false;  // and about to end
        bool runs() const { return pid != 0 && !is_killed; }
    };

    Part* find(const std::string& name);
    std::expected<Part*, std::string> running(const std::string& name);
    void reap();
    /// Of the process that acts; it may take a moment to be there. Nothing: it has ended.
    pid_t acting(const Part& part) const;
    std::filesystem::path number_file(const Part& part) const;
    void tell(const Part& part, int signal) const;
    void tell_to_end(const Part& part, int signal) const;
    void wait_for_end(Part& part);
    /// False: it has not ended in time.
    bool end(Part& part, int signal);

    StateDirectory state_;
    std::filesystem::path numbers_;
    std::vector<Part> parts_;
    std::string ended_by_themselves_;  // and how
};

}  // namespace lockstep::scenario
