#include <fmt/format.h>

#include <algorithm>

#include "core/kinematics/motors.hpp"
#include "core/protocol/frame_room.hpp"
#include "services/documents/machine_rules.hpp"
#include "services/documents/names.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {
namespace {

/// The motors whose devices are behind links.
std::vector<MotorConfig> linked_motors_of(const MachineSetup& machine) {
    std::vector<MotorConfig> motors = motors_of(machine);
    std::erase_if(motors, [](const MotorConfig& motor) { return motor.device.kind != DeviceName::Kind::Linked; });
    return motors;
}

/// The key `device` of a motor.
FieldPath device_of(const MachineSetup& machine, const MotorConfig& motor) {
    if (!motor.axis) { return {{}, "board"}; }
    const auto& blocks = machine.axes[*motor.axis].motors;
    const auto block = std::ranges::find(blocks, motor.name, &MotorBlock::name);
    return {motor.axis, block == blocks.end() ? "device" : fmt::format("motor[{}].device", block - blocks.begin())};
}

/// Why a motor cannot have its device; empty if it can. `before`: the motors before it.
std::string fault_of(const MachineSetup& machine, const MotorConfig& motor, const std::vector<MotorConfig>& before) {
    const std::string text = motor.device.text();
    const std::string& board = motor.device.place;
    if (std::ranges::find(machine.board_links, board, &BoardLinkConfig::name) == machine.board_links.end()) {
        return fmt::format(
            "device {} of motor {} is at a board that the machine does not have; add board {{ name: "
            "\"{}\" link: \"serial:/dev/...\" }}, or correct the name",
            text, motor.name, board);
    }
    for (const MotorConfig& other : before) {
        if (other.device == motor.device) {
            return fmt::format("device {} is that of motor {} already; give motor {} another number", text, other.name,
                               motor.name);
        }
        if (other.device.place == board && !same_name(other.host, motor.host)) {
            return fmt::format(
                "motors {} and {} have devices of board {}, but run on host \"{}\" and on host \"{}\"; "
                "place both on the host to which the board is connected",
                other.name, motor.name, board, other.host, motor.host);
        }
    }
    return {};
}

/// The bits a second that a motor's words take on an SPI (sim_fpga/rtl/motors/motors_spi.v): each step's tick, the
/// pieces of full frames, and in each slot a look at what the device shows and some orders. A frame of homing is
/// shorter (core/axis/own_moves): a header, a piece and a tail, the ring's head and the order that arms it, each 5 ms.
double spi_bits_per_s(const MachineSetup& machine, const MotorConfig& motor) {
    constexpr double kWordBits = 80;
    constexpr double kPieceBits = 4 * kWordBits;
    constexpr double kHomingBits = 200 * (3 * kPieceBits + 2 * kWordBits);
    constexpr double kSlotBits = 24 * kWordBits + 6 * 4 * kWordBits;
    const double slots_per_s = 1e6 / static_cast<double>(machine.timing.slot_us);
    const double steps_per_s = motor.max_velocity_mm_s * motor.steps_per_mm;
    const double pieces_per_s = frame_pieces(machine.timing) * slots_per_s / machine.timing.frame_slots;
    const double homing = motor.homing.way == HomingWay::InPlace ? 0 : kHomingBits;
    return steps_per_s * kWordBits + std::max(pieces_per_s * kPieceBits, homing) + slots_per_s * kSlotBits;
}

/// Checks one board, whose block has the number `number` among those with a link.
class BoardLinkRules {
public:
    BoardLinkRules(const MachineSetup& machine, std::size_t number)
        : machine_(machine), board_(machine.board_links[number]), number_(number) {}

    std::vector<Problem> check() {
        // Blocks without a link are counted apart. With both kinds, the text names the block.
        const std::string at = machine_.boards.empty() ? fmt::format("board[{}].", number_) : "board.";
        const std::string& name = board_.name;
        problems_.require(is_axis_name(name), at + "name",
                          fmt::format("the board's name is \"{}\"; it must be a letter, then letters, digits and _, "
                                      "at most {} characters",
                                      name, kMaxAxisName));
        problems_.require(
            !is_taken(), at + "name",
            fmt::format("{} names an axis, a motor or another board already; give this board another name", name));
        if (const auto* other = with_same_link()) {
            problems_.require(false, at + "link",
                              fmt::format("link {} of board {} is that of board {} already; a link leads to one board",
                                          board_.link.text(), name, other->name));
        }
        problems_.require(is_used(), at + "name",
                          fmt::format("no motor has a device of board {0}; write device: \"board:{0}/0\" in the block "
                                      "of one that it drives, or remove the board",
                                      name));
        if (board_.link.kind == LinkName::Kind::Spi) { check_spi(at); }
        return problems_.take();
    }

private:
    void check_spi(const std::string& at) {
        constexpr double kPart = 0.75;
        double bits = 0;
        for (const MotorConfig& motor : linked_motors_of(machine_)) {
            bits += motor.device.place == board_.name ? spi_bits_per_s(machine_, motor) : 0;
        }
        const double most = kPart * board_.link.speed_hz;
        problems_.require(bits <= most, at + "link",
                          fmt::format("the motors of board {} need {:.0f} bit/s of link {}, which has {:.0f} for them; "
                                      "write a higher speed, such as spi:{}@{:.0f}, if the board bears it, lower "
                                      "max_velocity_mm_s, or connect some motors to another board",
                                      board_.name, bits, board_.link.text(), most, board_.link.place, bits / kPart));
    }
    bool is_taken() const {
        std::vector<std::string> names = motor_names(machine_);
        for (const AxisConfig& axis : machine_.axes) { names.push_back(axis.name); }
        for (std::size_t k = 0; k < number_; ++k) { names.push_back(machine_.board_links[k].name); }
        return std::ranges::any_of(names, [&](const std::string& other) { return same_name(other, board_.name); });
    }
    const BoardLinkConfig* with_same_link() const {
        for (std::size_t k = 0; k < number_; ++k) {
            if (machine_.board_links[k].link == board_.link) { return &machine_.board_links[k]; }
        }
        return nullptr;
    }
    bool is_used() const {
        const auto has_it = [&](const MotorConfig& motor) { return motor.device.place == board_.name; };
        return std::ranges::any_of(linked_motors_of(machine_), has_it);
    }

    const MachineSetup& machine_;
    const BoardLinkConfig& board_;
    std::size_t number_;
    ProblemList problems_;
};

}  // namespace

std::vector<Problem> board_link_problems(const MachineSetup& machine) {
    std::vector<Problem> problems;
    std::vector<MotorConfig> before;
    for (const MotorConfig& motor : linked_motors_of(machine)) {
        std::string fault = fault_of(machine, motor, before);
        if (!fault.empty()) { problems.push_back({device_of(machine, motor), std::move(fault)}); }
        before.push_back(motor);
    }
    for (std::size_t k = 0; k < machine.board_links.size(); ++k) {
        std::ranges::move(BoardLinkRules(machine, k).check(), std::back_inserter(problems));
    }
    return problems;
}

}  // namespace lockstep
