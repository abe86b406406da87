#include "sim_fpga/firmware/rp2040/board.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"

namespace lockstep::firmware {
namespace {

constexpr Abilities abilities_of(std::uint32_t power_up, std::size_t motor) {
    return {.tick_ns = 1000,
            .power_up = std::uint64_t{power_up} << 8 | motor,
            .least_step_ticks = kLeastStepTicks,
            .lead_ticks = kRenderTicks,
            .pin_ticks = kMostTicksAhead + kMostDelayTicks,
            .time_unit_ps = 1000,
            .longest_time = kMostTime_ns,
            .longest_pwm_period = motor < kPwmOutputs ? kMostPwmTicks * 1000 : 0,
            .inputs = 3,
            .digital_outputs = kOutputs[motor].count,
            .analog_outputs = motor < kPwmOutputs ? 1U : 0U,
            .has_encoder = false,
            .can_enable = true,
            .can_compare = kOutputs[motor].count > 0};
}

}  // namespace

Board::Board(std::uint32_t power_up, Line& first, Line& second)
    : pins_{{0, outputs_, pwm_}, {1, outputs_, pwm_}, {2, outputs_, pwm_}},
      devices_{{pins_[0], abilities_of(power_up, 0), 0},
               {pins_[1], abilities_of(power_up, 1), 0},
               {pins_[2], abilities_of(power_up, 2), 0}},
      words_{&devices_[0].words(), &devices_[1].words(), &devices_[2].words()},
      board_words_(words_, kMotors, *this),
      link_(board_words_, power_up),
      session_(power_up),
      lines_{&first, &second} {}

void Board::render() {
    while (have_room_for_block()) { render_block(); }
}

void Board::render_block() {
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        pins_[motor].begin_block(now_);
        pins_[motor].look();
        devices_[motor].execute(now_ + kRenderTicks);
    }
    for (const MotorPins& pins : pins_) { pins.queue_block(); }
    outputs_.queue_block(now_);
    pwm_.queue_block(now_);
    finish_block();
    now_ += kRenderTicks;
}

void Board::lose_ticks() {
    has_lost_ticks_ = true;
    for (Device& device : devices_) { device.lose_ticks(); }
}

bool Board::is_any_enabled() const {
    for (const Device& device : devices_) {
        if (device.is_enabled()) { return true; }
    }
    return false;
}

bool Board::serve_link() {
    const auto now_us = static_cast<std::uint32_t>(chip::at(chip::timer::kNow));
    bool is_busy = false;
    for (std::size_t line = 0; line < kLines; ++line) { is_busy = receive(line, now_us) || is_busy; }
    if (transmission_.is_done() && link_.next_frame(now_us, transmission_.frame())) {
        transmission_.begin();
        is_busy = true;
    }
    transmission_.advance(*lines_[choice_.line()]);
    return is_busy;
}

void Board::show_light() {
    const std::uint32_t now_us = chip::at(chip::timer::kNow);
    if (board_words_.light_requests() != light_requests_) {
        light_requests_ = board_words_.light_requests();
        light_.identify(now_us);
    }
    const auto state = has_lost_ticks_            ? BoardLight::State::LostTicks
                       : choice_.has_host(now_us) ? BoardLight::State::HasHost
                                                  : BoardLight::State::Alone;
    chip::at(light_.is_on(state, now_us) ? chip::sio::kSet : chip::sio::kClear) = chip::bit(kLightPin);
}

bool Board::receive(std::size_t line, std::uint32_t now_us) {
    std::uint8_t byte = 0;
    bool has_come = false;
    for (; lines_[line]->receive(byte); has_come = true) {
        if (readers_[line].take(byte)) { take(readers_[line].message(), line, now_us); }
    }
    return has_come;
}

/// A host that comes by another line gets all words: it may have been the host before the one that has gone.
void Board::take(const Message& message, std::size_t line, std::uint32_t now_us) {
    const LineChoice::Verdict verdict = choice_.take(line, now_us);
    if (verdict == LineChoice::Verdict::Ignored) { return; }
    if (verdict == LineChoice::Verdict::Changed) {
        transmission_.drop();
        session_ += 2;  // odd, so never 0
        link_.restart(session_);
    }
    link_.take(message, now_us);
}

void Board::enter() { asm volatile("cpsid i" ::: "memory"); }

void Board::leave() { asm volatile("cpsie i" ::: "memory"); }

void Board::prepare_orders() {
    for (Device& device : devices_) { device.prepare_orders(); }
}

void Board::begin_clock() { began_us_ = chip::at(chip::timer::kNow); }

/// The board's clock is the pins', ahead by the greatest number of ticks that may wait: TICK never passes it. The timer
/// counts the same crystal, and 32 bits of it suffice for a difference of a few blocks.
std::uint32_t Board::publish(std::size_t motor) {
    devices_[motor].publish();
    const std::uint32_t at_pins = chip::at(chip::timer::kNow) - began_us_;
    const std::uint32_t behind = at_pins + kMostTicksAhead - static_cast<std::uint32_t>(now_);
    return static_cast<std::int32_t>(behind) > 0 ? behind : 0;
}

void Board::take_orders() {
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        devices_[motor].take_orders();
        pins_[motor].show_enabled(devices_[motor].is_enabled());
        const Setup& setup = devices_[motor].channels().setup();
        pins_[motor].invert(setup.inverted);
        invert_outputs(motor, setup.outputs_inverted);
        if (motor < kPwmOutputs) { pwm_.set_period(motor, setup.pwm_period[0]); }
        pins_[motor].time(static_cast<std::uint32_t>(setup.step_width),
                          static_cast<std::uint32_t>(setup.direction_setup));
    }
}

}  // namespace lockstep::firmware
