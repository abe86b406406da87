#include "tests/simulation/simtest/run/coverage.hpp"

#include "core/coordinator/state/machine_phases.hpp"
#include "tests/simulation/simtest/record/explain.hpp"
#include "tests/simulation/simtest/run/names.hpp"

namespace lockstep::simtest {
namespace {

constexpr std::string_view kTransitions = "axis transitions";
constexpr std::string_view kChecks = "checks";
constexpr std::string_view kFaults = "fault codes";
constexpr std::string_view kMachineChanges = "machine transitions";
constexpr std::string_view kEnds = "epoch ends";
constexpr std::string_view kIntents = "intents";
constexpr std::string_view kInjected = "injected";
constexpr std::string_view kOwnership = "ownership";
constexpr std::string_view kAltered = "altered messages";

constexpr std::array kCheckNames{"armed when due",        "armed late",
                                 "vetoed when due",       "vetoed late",
                                 "too late, next vetoed", "vetoed early, for its own reasons"};
constexpr std::array kOwnershipNames{"claimed", "stood down", "job cut short by a takeover",
                                     "job continued after a takeover"};
constexpr std::array kInjectedNames{"freeze of an axis that must not stop the machine",
                                    "freeze of the coordinator that must not stop the machine",
                                    "longer freeze of an axis",
                                    "longer freeze of the coordinator",
                                    "crash of an axis",
                                    "crash of the coordinator",
                                    "link cut both ways",
                                    "link cut one way",
                                    "axis cut off both ways",
                                    "axis cut off one way",
                                    "coordinator cut off both ways",
                                    "coordinator cut off one way",
                                    "stall in a loop of an axis",
                                    "stall in a loop of the coordinator",
                                    "clock set forward",
                                    "clock set back",
                                    "limit switch stuck",
                                    "home switch stuck closed",
                                    "home switch stuck open",
                                    "slide pushed",
                                    "frame damaged in a device",
                                    "device lost"};

template <typename Row>
std::string row_name(const Row& row) {
    return std::string(name_of(row.from)) + " on " + std::string(name_of(row.event));
}

std::string_view injected_name(const VirtualFault& fault, const MachineConfig& machine) {
    const std::size_t coordinator = fault.process >= motor_count(machine) ? 1 : 0;
    if (fault.in_loop) { return kInjectedNames[12 + coordinator]; }
    const bool home = fault.contact == &PlantInputs::home;
    switch (fault.kind) {
        case VirtualFault::Kind::SetClock: return kInjectedNames[fault.set_by > Ticks{} ? 14 : 15];
        case VirtualFault::Kind::Freeze: return kInjectedNames[coordinator + (is_tolerable(fault, machine) ? 0 : 2)];
        case VirtualFault::Kind::Crash: return kInjectedNames[4 + coordinator];
        case VirtualFault::Kind::Stick: return kInjectedNames[!home ? 16 : (fault.closed ? 17 : 18)];
        case VirtualFault::Kind::Push: return kInjectedNames[19];
        case VirtualFault::Kind::DamageFrame: return kInjectedNames[20];
        case VirtualFault::Kind::StopDevice:
        case VirtualFault::Kind::KillDevice:
        case VirtualFault::Kind::Overwrite: return kInjectedNames[21];
        case VirtualFault::Kind::Cut: break;
    }
    const std::size_t one_way = fault.outgoing && fault.incoming ? 0 : 1;
    return kInjectedNames[(fault.peer ? 6 : 8 + 2 * coordinator) + one_way];
}

}  // namespace

Coverage::Coverage() {
    for (const AxisTransition& row : kAxisTransitions) { hit(kTransitions, row_name(row), 0); }
    for (const std::string_view name : kCheckNames) { hit(kChecks, name, 0); }
    for (const MachineTransition& row : kMachineTransitions) { hit(kMachineChanges, row_name(row), 0); }
    for (const std::string_view name : kEpochEndNames) { hit(kEnds, name, 0); }
    for (const std::string_view name : kIntentNames) { hit(kIntents, name, 0); }
    for (const std::string_view name : kOwnershipNames) { hit(kOwnership, name, 0); }
    for (const std::string_view name : kInjectedNames) { hit(kInjected, name, 0); }
    for (std::size_t way = 1; way < kAlterations; ++way) { hit(kAltered, name_of(static_cast<Alteration>(way)), 0); }
#define LOCKSTEP_DECLARE(name, number, text, cause, by_hand, remedies) hit(kFaults, text, 0);
    LOCKSTEP_FAULTS(LOCKSTEP_DECLARE)
#undef LOCKSTEP_DECLARE
}

void Coverage::hit(std::string_view group, std::string_view name, std::uint64_t times) {
    auto g = groups_.find(group);
    if (g == groups_.end()) { g = groups_.emplace(group, Counts{}).first; }
    auto n = g->second.find(name);
    if (n == g->second.end()) { n = g->second.emplace(name, 0).first; }
    n->second += times;
}

void Coverage::add(const Coverage& other) {
    for (const auto& [group, counts] : other.groups_) {
        for (const auto& [name, times] : counts) { hit(group, name, times); }
    }
}

void Coverage::take(const AlterationCounts& alterations) {
    for (std::size_t way = 1; way < kAlterations; ++way) {
        hit(kAltered, name_of(static_cast<Alteration>(way)), alterations[way]);
    }
}

CoverageWatch::CoverageWatch(const MachineConfig& machine, Coverage& coverage)
    : machine_(machine), coverage_(coverage), transitions_(motor_count(machine)), epoch_(motor_count(machine), 0) {}

CoverageWatch::~CoverageWatch() {
    for (std::size_t i = 0; i < transitions_.size(); ++i) { take_transitions(i); }
}

void CoverageWatch::take_transitions(std::size_t axis) {
    for (std::size_t row = 0; row < kAxisTransitions.size(); ++row) {
        const std::uint64_t times = transitions_[axis][row];
        if (times > 0) { coverage_.hit(kTransitions, row_name(kAxisTransitions[row]), times); }
    }
    transitions_[axis] = {};
}

void CoverageWatch::on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) {
    transitions_[axis] = node.controller().transitions();
    const Slot slot = rules::slot_of(now, machine_.slot_ticks());
    for (const AxisNotice& notice : out.notices) {
        if (notice.kind == AxisNotice::Kind::EpochBegun) { epoch_[axis] = notice.number; }
        if (notice.fault != FaultCode::None) { coverage_.hit(kFaults, name_of(notice.fault)); }
        if (notice.kind == AxisNotice::Kind::Vetoed) { take_check(axis, slot, notice.number, false); }
    }
    for (const DeviceOrder& order : out.orders) {
        const auto* arm = std::get_if<device::Arm>(&order);
        if (arm != nullptr && node.controller().phase() != AxisPhase::Initialize) {
            take_check(axis, slot, arm->number, true);
        }
    }
}

Slot CoverageWatch::start_slot(std::size_t axis, FrameNumber k) const {
    const auto start = starts_.find(epoch_[axis]);
    const Slot first = start == starts_.end() ? 0 : rules::slot_of(start->second, machine_.slot_ticks());
    return first + static_cast<Slot>(k - 1) * machine_.timing.frame_slots;
}

/// Computed from the slots alone: a veto of k while k can still be checked, or of the next frame if k no longer can.
void CoverageWatch::take_check(std::size_t axis, Slot now, FrameNumber k, bool armed) {
    const Slot due = start_slot(axis, k) - machine_.timing.check_slots();
    if (armed) { return coverage_.hit(kChecks, kCheckNames[now <= due ? 0 : 1]); }
    const bool follows_late = k > 1 && now > start_slot(axis, k - 1) - rules::kLastCheckSlots && now < due;
    if (follows_late) { return coverage_.hit(kChecks, kCheckNames[4]); }
    coverage_.hit(kChecks, kCheckNames[now < due ? 5 : (now == due ? 2 : 3)]);
}

void CoverageWatch::on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) {
    for (const JobEvent& job : out.jobs) {
        if (job.kind == JobEvent::Kind::EpochBegun) { starts_[job.epoch] = job.start; }
    }
    for (const std::size_t row : out.transitions) {
        coverage_.hit(kMachineChanges, row_name(kMachineTransitions[row]));
    }
    for (const CoordinatorNotice& notice : out.notices) {
        using Kind = CoordinatorNotice::Kind;
        if (notice.kind == Kind::Claimed) { coverage_.hit(kOwnership, kOwnershipNames[0]); }
        if (notice.kind == Kind::StoodDown) { coverage_.hit(kOwnership, kOwnershipNames[1]); }
        if (notice.kind == Kind::JobCutShort) { coverage_.hit(kOwnership, kOwnershipNames[2]); }
        if (notice.kind == Kind::JobContinued) { coverage_.hit(kOwnership, kOwnershipNames[3]); }
        if (notice.fault != FaultCode::None) { coverage_.hit(kFaults, name_of(notice.fault)); }
    }
    for (const Reply& reply : out.replies) {
        if (reply.fault != FaultCode::None) { coverage_.hit(kFaults, name_of(reply.fault)); }
    }
    if (!out.epoch_end) { return; }
    coverage_.hit(kEnds, kEpochEndNames[static_cast<std::size_t>(out.epoch_end->kind)]);
    coverage_.hit(kIntents, kIntentNames[static_cast<std::size_t>(out.epoch_end->intent)]);
}

void CoverageWatch::on_fault(Tick /*now*/, const VirtualFault& fault, bool begins) {
    if (!begins) { return; }
    coverage_.hit(kInjected, injected_name(fault, machine_));
    if (fault.kind == VirtualFault::Kind::Crash && fault.process < transitions_.size()) {
        take_transitions(fault.process);
    }
}

}  // namespace lockstep::simtest
