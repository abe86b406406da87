// The plant behind the simulated device's pulses: a motor that can lose steps, a slide, its switches and an encoder.
//
// The motor moves one step a pulse, and the slide with it, behind its backlash. The encoder is the motor's. The
// switches follow the slide's true position, so they change at steps only.
//
// The model of the motor uses the times of the pulses alone: every kWindow ticks or the next pulse after that, it takes
// the mean speed since the last evaluation. The rotor's speed follows it with at most A = max_torque_accel_mm_s2. While
// the two then differ by more than max_jump_mm_s + sqrt(2 A), plus the effect of rounding pulses to ticks, the rotor
// slips: every pulse is a step lost. sqrt(2 A), in steps and ticks, is the speed gained in the first step from a rest
// just after a pulse, which pulses cannot distinguish from a jump. So jumps of up to max_jump, accelerations of up to
// A, and both together lose no steps. At a speed within a jump the motor stops or reverses at once, any number of
// times. A greater jump loses steps at once. A greater acceleration a loses steps from about the speed
// (max_jump + sqrt(2 A)) * a / (a - A) on, where the rotor lags by that much. A sudden stop loses nothing, because no
// pulse follows it.
#pragma once

#include <cstdint>
#include <optional>

#include "core/kinematics/motors.hpp"
#include "core/step/segment.hpp"
#include "sim_fpga/wiring/wiring.hpp"

namespace lockstep {

struct PlantInputs {
    bool limit_min = false;
    bool limit_max = false;
    bool home = false;
    constexpr bool operator==(const PlantInputs&) const = default;
};

/// One of the switches.
using PlantContact = bool PlantInputs::*;

class Plant {
public:
    /// The slide starts at plant.start_position_mm. plant.max_jump_mm_s and max_torque_accel_mm_s2 are the motor's
    /// capability: at 0 it loses every step.
    Plant(const MotorConfig& motor, std::int64_t tick_ns);

    /// One pulse. Ticks must rise from call to call.
    void step(StepEdge edge) {
        pulses_ += edge.direction;
        if (edge.tick - evaluated_ >= kWindow) { evaluate(edge); }
        if (!slips_) { turn(edge.direction); }
    }
    /// Moves the slide without pulses, as if by hand.
    void push(std::int64_t steps) { slide_ += steps, motor_ += steps; }
    /// Puts something for a probe at a place, in steps since power-up: at and beyond it the pin of input `input` is
    /// high, or low. Inputs put there before stay, but all at this place.
    void put_probe(unsigned input, std::int64_t at, bool toward_min, bool low = false) {
        (low ? probe_.wires.low : probe_.wires.high) |= std::uint32_t{1} << input;
        probe_.at = at;
        probe_.toward_min = toward_min;
    }
    /// The switch also sets the pin of input `input`: high while it is closed, or low.
    void wire(PlantContact contact, unsigned input, bool low = false) {
        const std::uint32_t bit = std::uint32_t{1} << input;
        Wires& wires = wires_of(contact);
        wires.high = low ? wires.high & ~bit : wires.high | bit;
        wires.low = low ? wires.low | bit : wires.low & ~bit;
    }
    /// The switch sets no pin from now on.
    void unwire(PlantContact contact) { wires_of(contact) = {}; }
    /// Sets the pin of an input, as a device beside the axis does. A closed switch overrides it.
    void set_pin(unsigned input, bool high) {
        const std::uint32_t bit = std::uint32_t{1} << input;
        others_ = high ? others_ | bit : others_ & ~bit;
    }
    /// Closes or opens a contact at the pin of an input, beside whatever else closes it. `low`: closed is low.
    void set_contact(unsigned input, bool closed, bool low) {
        std::uint32_t& contacts = low ? contacts_.low : contacts_.high;
        const std::uint32_t bit = std::uint32_t{1} << input;
        contacts = closed ? contacts | bit : contacts & ~bit;
    }
    /// Makes a switch stick: it has this reading for any position. With nullopt it works again.
    void stick(PlantContact contact, std::optional<bool> reads) {
        stuck_closed_.*contact = reads == true;
        stuck_open_.*contact = reads == false;
    }

    /// The pins of the switches are free: this is no motor's plant.
    void remove_switches() { has_switches_ = false; }

    /// From now on the encoder counts the wrong way, as with exchanged channels.
    void reverse_encoder() {
        encoder_zero_ += encoder_sign_ * 2 * motor_;
        encoder_sign_ = -encoder_sign_;
    }
    /// The true position of the motor, in whole steps since power-up, unless the encoder was reversed.
    std::int64_t encoder() const { return encoder_zero_ + encoder_sign_ * motor_; }
    /// That of the slide.
    std::int64_t slide() const { return slide_; }
    double position_mm() const;
    PlantInputs inputs() const {
        const PlantInputs closed{.limit_min = slide_ <= limit_min_at_,
                                 .limit_max = slide_ >= limit_max_at_,
                                 .home = home_toward_min_ ? slide_ <= home_at_ : slide_ >= home_at_};
        const auto read = [&](PlantContact one) {
            return has_switches_ && (closed.*one || stuck_closed_.*one) && !(stuck_open_.*one);
        };
        return {read(&PlantInputs::limit_min), read(&PlantInputs::limit_max), read(&PlantInputs::home)};
    }
    /// The bouncing contacts and the spindles at the device's pins.
    Wiring& wiring() { return wiring_; }
    const Wiring& wiring() const { return wiring_; }

    /// The levels of the device's input pins, without wiring(); pin n is bit n. The switches are at 0, 1 and 2, and
    /// high when closed, unless they are wired otherwise.
    std::uint32_t pins() const {
        const PlantInputs switches = inputs();
        std::uint32_t pins = others_;
        if (switches.limit_min) { pins = limit_min_.close(pins); }
        if (switches.limit_max) { pins = limit_max_.close(pins); }
        if (switches.home) { pins = home_.close(pins); }
        const bool touches = probe_.toward_min ? slide_ <= probe_.at : slide_ >= probe_.at;
        return contacts_.close(touches ? probe_.wires.close(pins) : pins);
    }

private:
    static constexpr Ticks kWindow{256};

    void evaluate(StepEdge edge);
    /// The motor turns by a step. The slide follows when the play is used up.
    void turn(std::int64_t step) {
        motor_ += step;
        const std::int64_t before = play_.steps();
        play_.follow(step);
        slide_ += step - (play_.steps() - before);
    }

    double steps_per_mm_;
    double start_mm_;
    std::int64_t limit_min_at_;  // closed at and below, in steps since power-up
    std::int64_t limit_max_at_;  // closed at and above
    std::int64_t home_at_;       // closed at and beyond
    bool home_toward_min_;
    bool has_switches_ = true;
    PlantInputs stuck_closed_;
    PlantInputs stuck_open_;
    /// The pins that a contact sets when it closes.
    struct Wires {
        std::uint32_t high = 0;
        std::uint32_t low = 0;
        std::uint32_t close(std::uint32_t pins) const { return (pins | high) & ~low; }
    };
    Wires& wires_of(PlantContact contact) {
        if (contact == &PlantInputs::home) { return home_; }
        return contact == &PlantInputs::limit_min ? limit_min_ : limit_max_;
    }
    Wires limit_min_{.high = 1};
    Wires limit_max_{.high = 2};
    Wires home_{.high = 4};
    struct Probe {
        Wires wires;
        std::int64_t at = 0;
        bool toward_min = false;
    };
    Probe probe_;
    Wires contacts_;  // of contacts that are closed now
    std::uint32_t others_ = 0;
    Wiring wiring_;

    double max_acceleration_;  // A, steps per tick^2
    double max_gap_;           // max_jump + sqrt(2 A), steps per tick
    double speed_ = 0;         // the rotor's, signed, steps per tick
    bool slips_ = false;
    Tick evaluated_{-(std::int64_t{1} << 62)};  // at rest since long ago
    double evaluated_place_ = 0;                // the position of the pulses then, in steps
    std::int64_t pulses_ = 0;                   // forward minus backward
    std::int64_t motor_ = 0;
    std::int64_t encoder_sign_ = 1;
    std::int64_t encoder_zero_ = 0;
    std::int64_t slide_ = 0;
    Play play_;
};

/// The plant of a motor of the machine. Nobody touches its inputs: all are open, except those of probes at and beyond
/// plant.probe_at_mm and those of home and limit switches. A limit switch that an input of the machine's file has, by
/// the axis, is not one of the motor's.
Plant plant_of(const MachineConfig& machine, const MotorConfig& motor);
/// Closes or opens an input of the machine whose pin is at this plant.
inline void set_input(Plant& plant, const InputConfig& input, bool closed) {
    plant.set_pin(static_cast<unsigned>(input.channel), closed != input.active_low);
}
/// The same for the contact of a probe with what it touches.
inline void set_contact(Plant& plant, const InputConfig& input, bool closed) {
    plant.set_contact(static_cast<unsigned>(input.channel), closed, input.active_low);
}

}  // namespace lockstep
