// The board at a USB host, in the emulator: enumeration, the link and the motors, and what a plug may do to them.
#include <gtest/gtest.h>

#include <array>

#include "tests/simulation/board/board_fixture.hpp"

namespace lockstep::testing {
namespace {

class UsbBoard : public Board {
protected:
    void SetUp() override {
        bench.let_speak(HostLine::Uart, false);
        bench.let_speak(HostLine::Usb, true);
        bench.plug(BoardBench::Plug::In);
        connect(HostLine::Usb);
    }
};

TEST_F(UsbBoard, MakesEachPinEdgeOfItsFramesByUsb) {
    const Tick start = soon();
    const std::array courses{course(1, start, kFrames), course(2, start, kFrames), course(3, start, kFrames)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) { order(motor, courses[motor]); }
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
    EXPECT_LE(bench.busiest(), 0.88) << "sim_fpga/firmware/README.md states it";
    EXPECT_GE(bench.busiest_usb(), 4e5) << "the same";
}

/// Each motor may run two frames of four.
TEST_F(UsbBoard, RunsWhatIsArmedAndItsTailIfTheCableIsUnplugged) {
    const Tick start = soon();
    const std::array courses{course(1, start, 2), course(2, start, 2), course(3, start, 2)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) { order(motor, courses[motor]); }
    run(start.value + 5000);
    bench.plug(BoardBench::Plug::Out);
    for (const Course& course : courses) { run(course.end.value + 10'000); }
    EXPECT_FALSE(bench.is_usb_open());
    bench.plug(BoardBench::Plug::In);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 20'000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
}

TEST_F(UsbBoard, MovesOnThroughAResetOfTheBus) {
    const Tick start = soon();
    const std::array courses{course(4, start, kFrames), course(5, start, kFrames), course(6, start, kFrames)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) { order(motor, courses[motor]); }
    run(start.value + 5000);
    bench.plug(BoardBench::Plug::Reset);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 20'000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
    EXPECT_TRUE(bench.is_usb_open());
}

/// A thousandth of the bytes is damaged too.
TEST_F(UsbBoard, MovesAsPlannedAmongAnyOtherBytes) {
    bench.damage();
    bench.babble();
    const Tick start = soon() + Ticks{300'000};
    const std::array courses{course(7, start, kFrames), course(8, start, 2), course(9, start, kFrames)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) { order(motor, courses[motor]); }
    run(start.value);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
}

TEST_F(UsbBoard, KeepsItsHostUntilItIsSilentAndThenServesTheOtherLine) {
    BoardHost& usb = bench.host(HostLine::Usb);
    BoardHost& uart = bench.host(HostLine::Uart);
    bench.let_speak(HostLine::Uart, true);
    const std::uint64_t before = usb.tick();
    bench.run(bench.now_us() + 100'000);
    EXPECT_FALSE(uart.is_connected());
    EXPECT_GE(usb.tick(), before + 90'000);

    bench.let_speak(HostLine::Usb, false);
    await_answer(HostLine::Uart);
    bench.let_speak(HostLine::Usb, true);
    bench.run(bench.now_us() + 50'000);
    const std::uint64_t at_return = usb.tick();
    EXPECT_LT(at_return + 100'000, uart.tick()) << "the board serves the other line";

    bench.let_speak(HostLine::Uart, false);
    bench.run(bench.now_us() + 150'000);
    EXPECT_GE(usb.tick(), at_return + 200'000) << "the board serves the first host again";
}

TEST_F(UsbBoard, EntersItsBootModeIfTheLineIsClosedAt1200Baud) {
    bench.plug(BoardBench::Plug::CloseAt1200);
    bench.run(bench.now_us() + 20'000);
    EXPECT_TRUE(bench.is_in_boot_mode());
}

/// A motor that waits for its frames, and then one that holds its place.
TEST_F(UsbBoard, StaysAwayFromItsBootModeWhileAMotorMovesOrIsEnabled) {
    order(0, course(1, soon(), kFrames));
    run(bench.now_us() + 60'000);
    bench.plug(BoardBench::Plug::CloseAt1200);
    run(bench.now_us() + 200'000);
    EXPECT_FALSE(bench.is_in_boot_mode());
    EXPECT_FALSE(bench.steps(0).empty());
    bench.plug(BoardBench::Plug::Reset);
    run_to_end(0);
    bench.plug(BoardBench::Plug::CloseAt1200);
    run(bench.now_us() + 20'000);
    EXPECT_FALSE(bench.is_in_boot_mode());
}

}  // namespace
}  // namespace lockstep::testing
