#include "clients/scenario/model/act_rules.hpp"

#include "clients/scenario/model/name_rules.hpp"
#include "core/overrides.hpp"

namespace lockstep::scenario {
namespace {

constexpr double kMostActSeconds = 60;
constexpr double kMostPush_mm = 1000;

class ActRules {
    using Act = Asked::Act;

public:
    ActRules(const std::string& path, const Asked& asked, const MachineConfig& machine,
             const std::vector<std::string>& processes, Problems& problems)
        : path_(path), asked_(asked), machine_(machine), processes_(processes), problems_(problems) {}

    void check(const Act& act) {
        check_what(act);
        const bool can_be_undone = act.has_pause() || act.has_cut() || act.has_lose();
        problems_.require(can_be_undone || !act.has_for_s(), path_ + ".for_s",
                          "for_s is only for pause, cut and lose; other acts are not undone automatically");
        if (act.has_for_s()) { problems_.require_range(path_, "for_s", act.for_s(), 0, kMostActSeconds); }
    }

private:
    void check_what(const Act& act) {
        switch (act.what_case()) {
            case Act::kKill: return require_process("kill", act.kill(), processes_);
            case Act::kRestart: return require_process("restart", act.restart(), processes_);
            case Act::kPause: return require_process("pause", act.pause(), processes_);
            case Act::kUnpause: return require_process("unpause", act.unpause(), processes_);
            case Act::kCut: return check_cut(act.cut());
            case Act::kLose: return check_loss(act.lose());
            case Act::kHeal: return check_heal(act.heal());
            case Act::kCommand:
                return problems_.require(act.command() != Asked::NONE, path_ + ".command",
                                         "NONE is not a command; use HOLD, RESUME, STOP, EMERGENCY_STOP or RESET");
            case Act::kOverride: return check_override(act.override());
            case Act::kCloseInput: return require_devices("close_input");
            case Act::kOpenInput: return require_devices("open_input");
            case Act::kPush: return check_push(act.push());
            case Act::WHAT_NOT_SET: break;
        }
        problems_.add(path_,
                      "this act is empty; use one of: kill, restart, pause, unpause, cut, lose, heal, command, "
                      "override, close_input, open_input or push");
    }

    void require_process(const std::string& key, const std::string& name, const std::vector<std::string>& names) {
        problems_.require_one_of(path_ + "." + key, name, names, "process");
    }

    void require_links(const std::string& key) {
        problems_.require(has_links(asked_.place()), path_ + "." + key,
                          key + " needs links between the processes; set place: NAMESPACE or CONTAINER");
    }

    void require_devices(const std::string& key) {
        problems_.require(asked_.separate_devices() && asked_.place() != Asked::CONTAINER, path_ + "." + key,
                          key +
                              " reaches a device that is a process of this host; set separate_devices: true, and not "
                              "place: CONTAINER");
    }

    void check_push(const Asked::Push& push) {
        require_devices("push");
        require_motor(problems_, machine_, path_ + ".push.motor", push.motor());
        problems_.require(push.has_mm(), path_ + ".push.mm",
                          "mm is missing; it is how far the slide is pushed, signed");
        problems_.require_range(path_ + ".push", "mm", push.mm(), -kMostPush_mm, kMostPush_mm);
    }

    /// A device has no link: its axis reaches it through memory.
    std::vector<std::string> linked() const {
        std::vector<std::string> names;
        for (const std::string& name : processes_) {
            if (!name.starts_with("fpga-")) { names.push_back(name); }
        }
        return names;
    }

    void check_cut(const Asked::Cut& cut) {
        require_links("cut");
        require_process("cut.process", cut.process(), linked());
    }

    void check_loss(const Asked::Loss& loss) {
        require_links("lose");
        for (int i = 0; i < loss.process_size(); ++i) {
            require_process(nth("lose.process", i), loss.process(i), linked());
        }
        problems_.require(loss.percent() > 0 && loss.percent() <= 100, path_ + ".lose.percent",
                          "percent is " + number_text(loss.percent()) + "; it must be above 0 and at most 100");
    }

    void check_heal(const std::string& name) {
        require_links("heal");
        std::vector<std::string> names = linked();
        names.emplace_back("all");
        require_process("heal", name, names);
    }

    void check_override(const Asked::Override& turn) {
        problems_.require(turn.has_feed() || turn.has_rapid(), path_ + ".override",
                          "override changes nothing; set feed, rapid or both, in percent");
        const std::string block = path_ + ".override";
        if (turn.has_feed()) {
            problems_.require_range(block, "feed", turn.feed(), Overrides::kLeast, Overrides::kMost);
        }
        if (turn.has_rapid()) {
            problems_.require_range(block, "rapid", turn.rapid(), Overrides::kLeast, Overrides::kMost);
        }
    }

    const std::string& path_;
    const Asked& asked_;
    const MachineConfig& machine_;
    const std::vector<std::string>& processes_;
    Problems& problems_;
};

}  // namespace

void check_act(const Asked::Act& act, const std::string& path, const Asked& asked, const MachineConfig& machine,
               const std::vector<std::string>& processes, Problems& problems) {
    ActRules(path, asked, machine, processes, problems).check(act);
}

}  // namespace lockstep::scenario
