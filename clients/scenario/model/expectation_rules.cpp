#include "clients/scenario/model/expectation_rules.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "clients/incident/cause.hpp"
#include "clients/scenario/model/name_rules.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep::scenario {
namespace {

using incident::CauseKind;

/// Causes that are of no single process.
constexpr std::array kOfNoProcess{CauseKind::HostStalled, CauseKind::EmergencyStop, CauseKind::Asked,
                                  CauseKind::Unknown};

bool is_above_0(double value) { return value > 0 && std::isfinite(value); }

class ExpectationRules {
public:
    ExpectationRules(const Asked::Expect& expect, const MachineConfig& machine, Problems& problems)
        : expect_(expect), machine_(machine), problems_(problems) {}

    void check() {
        for (int i = 0; i < expect_.final_size(); ++i) { check_final(i, nth("expect.final", i)); }
        problems_.require(
            !expect_.has_path_within_mm() || is_above_0(expect_.path_within_mm()), "expect.path_within_mm",
            "path_within_mm is " + number_text(expect_.path_within_mm()) +
                "; it must be above 0; the smallest distance that can be kept is a step, 1 / steps_per_mm");
        problems_.require(expect_.interruptions() >= 0, "expect.interruptions",
                          fmt::format("interruptions is {}; it must be at least 0", expect_.interruptions()));
        problems_.require(expect_.together_size() != 1, "expect.together[0]", "this compares axes; name at least two");
        check_motors("expect.together", expect_.together());
        check_motors("expect.vetoes.by", expect_.vetoes().by());
        if (expect_.has_cause()) { check_cause(expect_.cause()); }
        for (int i = 0; i < expect_.axis_size(); ++i) { check_axis(i, nth("expect.axis", i)); }
    }

private:
    /// Each name is a motor, and none is given twice.
    void check_motors(const std::string& key, const auto& names) {
        for (int i = 0; i < names.size(); ++i) {
            require_motor(problems_, machine_, nth(key, i), names[i]);
            const bool is_first = std::find(names.begin(), names.begin() + i, names[i]) == names.begin() + i;
            problems_.require(is_first, nth(key, i),
                              word_for_motors(machine_) + (" " + names[i]) + " is already named; remove one of them");
        }
    }

    void check_final(int index, const std::string& path) {
        const Asked::Final& end = expect_.final(index);
        Asked::Target target;
        target.set_axis(end.axis());
        if (end.has_mm()) { target.set_mm(end.mm()); }
        require_place(problems_, machine_, path, target);
        problems_.require(!end.has_within_mm() || is_above_0(end.within_mm()), path + ".within_mm",
                          "within_mm is " + number_text(end.within_mm()) +
                              "; it must be above 0; remove it to require the exact step");
        for (int i = 0; i < index; ++i) {
            const Asked::Final& other = expect_.final(i);
            if (other.axis() != end.axis()) { continue; }
            return problems_.add(
                path, fmt::format("axis {} already has a final position, {} mm; an axis has one; remove one of them",
                                  end.axis(), number_text(other.mm())));
        }
    }

    void check_cause(const Asked::Cause& cause) {
        std::vector<std::string> kinds;
        for (int i = 0; i <= static_cast<int>(CauseKind::Unknown); ++i) {
            kinds.emplace_back(name_of(static_cast<CauseKind>(i)));
        }
        problems_.require_one_of("expect.cause.kind", cause.kind(), kinds, "cause");
        if (!cause.has_process()) { return; }
        std::vector<std::string> noted{"coordinator"};  // the processes that keep notes; a standby is a coordinator
        for (const std::string& motor : motor_names(machine_)) { noted.push_back("axis-" + motor); }
        problems_.require_one_of("expect.cause.process", cause.process(), noted, "process that a cause can name");
        const auto is_kind = [&](CauseKind kind) { return name_of(kind) == cause.kind(); };
        problems_.require(std::ranges::none_of(kOfNoProcess, is_kind), "expect.cause.process",
                          "the cause " + cause.kind() + " is of no single process; remove process");
    }

    void check_axis(int index, const std::string& path) {
        const Asked::AxisEnd& end = expect_.axis(index);
        require_axis_or_motor(problems_, machine_, path + ".name", end.name());
        problems_.require(end.has_heard() || end.has_homed() || end.has_fault() || end.has_corrected_steps(), path,
                          "this checks nothing; set heard, homed, fault or corrected_steps");
        problems_.require(end.corrected_steps() >= 0, path + ".corrected_steps",
                          fmt::format("corrected_steps is {}; it is a count, 0 at least", end.corrected_steps()));
        if (end.has_fault()) { require_fault(problems_, path + ".fault", end.fault(), true); }
        const bool is_absent = end.has_heard() && !end.heard();
        problems_.require(!is_absent || !end.homed(), path + ".homed",
                          "homed contradicts heard: false; the state of an axis that is not received is not known");
        problems_.require(!is_absent || !end.has_fault(), path + ".fault",
                          "fault contradicts heard: false; the state of an axis that is not received is not known");
        const auto& all = expect_.axis();
        const auto is_same = [&](const Asked::AxisEnd& other) { return other.name() == end.name(); };
        problems_.require(std::find_if(all.begin(), all.begin() + index, is_same) == all.begin() + index, path,
                          (motor_named(machine_, end.name()) ? word_for_motors(machine_) : "axis") +
                              (" " + end.name()) + " already has such a block; combine both");
    }

    const Asked::Expect& expect_;
    const MachineConfig& machine_;
    Problems& problems_;
};

}  // namespace

void check_expectations(const Asked::Expect& expect, const MachineConfig& machine, Problems& problems) {
    ExpectationRules(expect, machine, problems).check();
}

}  // namespace lockstep::scenario
