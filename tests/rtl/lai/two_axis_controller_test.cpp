// sim_fpga/rtl/lai beside Lai's planner and DDA in core/methods: the pulses of every clock of the DDAs, for the lines
// of the paper's figures and for drawn ones, downloaded by the serial line.
#include <gtest/gtest.h>

#include <random>

#include "Vuart_receiver.h"
#include "tests/rtl/lai/machine.hpp"

namespace lockstep::rtl {
namespace {

using methods::kUncompensated;
using methods::LaiRounding;
using methods::PeriodPulses;

PeriodPulses end_of(const std::vector<DdaClock>& clocks) { return methods::total(clocks); }

TEST(LaiHardware, OverInterpolatesAsInFigure8AndNotAsInFigure9) {
    const std::vector<PeriodPulses> line{{107, -93}};
    const LaiSettings bare{.max = 10, .rounding = LaiRounding::InEachPeriod, .compensation = kUncompensated};
    EXPECT_EQ(end_of(LaiMachine(bare).run(line)), (PeriodPulses{107, -94}));
    const LaiSettings compensated{.max = 10, .rounding = LaiRounding::InEachPeriod};
    EXPECT_EQ(end_of(LaiMachine(compensated).run(line)), (PeriodPulses{107, -93}));
}

TEST(LaiHardware, MakesTheSixLinesOfFigures12To15InTheClocksOfTheSoftware) {
    std::vector<PeriodPulses> lines;
    for (std::int64_t from = 0; from <= 5; ++from) { lines.push_back({(5 - from) * 100, 500}); }
    const auto made = LaiMachine({}).run(lines);
    EXPECT_EQ(made, lai_clocks(lines, {}));
    EXPECT_EQ(end_of(made), (PeriodPulses{1'500, 3'000}));
}

PeriodPulses drawn_line(std::mt19937_64& draw) {
    const auto length = [&] {
        const auto most = std::uint64_t{1} << (draw() % 11);
        const auto size = static_cast<std::int64_t>(draw() % (most + 1));
        return draw() % 2 == 0 ? size : -size;
    };
    PeriodPulses line{length(), length()};
    if (line == PeriodPulses{}) { line.x = 1; }
    return line;
}

TEST(LaiHardware, EqualsTheSoftwareInEveryClockOfDrawnLinesWithEachRoundingAndCompensation) {
    std::mt19937_64 draw(6);
    for (int round = 0; round < 64; ++round) {
        const LaiSettings settings{
            .max = 1 + static_cast<std::int64_t>(draw() % (round % 2 == 0 ? 12 : 120)),
            .rounding = (round & 1) != 0 ? LaiRounding::InEachPeriod : LaiRounding::FromTheStart,
            .compensation = {.derivative = (round & 2) != 0, .remaining = (round & 4) != 0},
        };
        std::vector<PeriodPulses> lines;
        for (int i = 0; i < 8; ++i) { lines.push_back(drawn_line(draw)); }
        ASSERT_EQ(LaiMachine(settings).run(lines), lai_clocks(lines, settings)) << "round " << round;
    }
}

TEST(LaiHardware, TurnsEachMotorByAPhasePerPulse) {
    const std::vector<PeriodPulses> line{{50, -20}};
    int x = 0;
    int y = 0;
    unsigned x_before = 0b0011;
    unsigned y_before = 0b0011;
    (void)LaiMachine({}).run(line, [&](const auto& pins) {
        const auto turn = [](unsigned before, unsigned after) {
            if (before == after) { return 0; }
            return after == ((before << 1 | before >> 3) & 15)   ? 1
                   : after == ((before >> 1 | before << 3) & 15) ? -1
                                                                 : 99;
        };
        x += turn(x_before, pins.x_phases);
        y += turn(y_before, pins.y_phases);
        x_before = pins.x_phases;
        y_before = pins.y_phases;
    });
    EXPECT_EQ(x, 50);
    EXPECT_EQ(y, -20);
}

std::vector<int> received(Serial& serial) {
    Clocked<Vuart_receiver> receiver;
    receiver.pins.line = 1;
    receiver.reset();
    std::vector<int> bytes;
    for (int rest = 0; rest < 1'000; rest += serial.idle() ? 1 : 0) {
        receiver.pins.line = serial.clock();
        receiver.clock();
        if (receiver.pins.valid != 0) { bytes.push_back(receiver.pins.byte_out); }
    }
    return bytes;
}

TEST(UartReceiver, ReceivesEveryByteAlsoIfTheSendersClockDiffersBy4PerCent) {
    for (const double clocks_per_bit : {625 * 0.96, 625.0, 625 * 1.04}) {
        Serial serial(clocks_per_bit);
        std::vector<int> sent;
        for (int byte = 0; byte < 256; ++byte) {
            sent.push_back(byte);
            serial.send(static_cast<std::uint8_t>(byte));
        }
        EXPECT_EQ(received(serial), sent) << clocks_per_bit;
    }
}

TEST(UartReceiver, DropsAByteWithoutAStopBit) {
    Serial serial(625);
    serial.send(0x55);
    serial.send(0xff, false);
    for (int i = 0; i < 2; ++i) { serial.send(0xff); }
    EXPECT_EQ(received(serial), (std::vector<int>{0x55, 0xff, 0xff}));
}

TEST(LineDownload, DropsALineWithAWrongSumAndTakesTheNextOne) {
    Clocked<Vtwo_axis_controller> hardware;
    hardware.pins.serial = 1;
    hardware.pins.v_max = 4;
    hardware.reset();
    const auto lines_after = [&](std::span<const std::uint8_t> bytes) {
        Serial serial;
        for (const std::uint8_t byte : bytes) { serial.send(byte); }
        int lines = 0;
        for (int rest = 0; rest < 100; rest += serial.idle() ? 1 : 0) {
            hardware.pins.serial = serial.clock();
            const bool waited = hardware.pins.line_waits != 0;
            hardware.clock();
            lines += !waited && hardware.pins.line_waits != 0 ? 1 : 0;
        }
        return lines;
    };
    auto bytes = bytes_of({107, -93});
    bytes[2] ^= 4;
    EXPECT_EQ(lines_after(bytes), 0);
    bytes[2] ^= 4;
    EXPECT_EQ(lines_after(bytes), 1);
    EXPECT_EQ(lines_after(std::span(bytes).subspan(1)), 0);  // without its head
}

}  // namespace
}  // namespace lockstep::rtl
