// An axis holds no frame whose changes of outputs its device cannot make.
#include "core/axis/following/output_check.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

class OutputsOfAFrame : public testing::Test {
protected:
    OutputsOfAFrame() {
        machine.axes.push_back({.name = "X"});
        machine.outputs = {{.name = "valve", .motor = "X", .channel = 2},
                           {.name = "laser", .motor = "X", .channel = 1, .pwm = PwmConfig{.hz = 1000}}};
    }
    FaultCode check(const std::vector<OutputChange>& body) const {
        OutputTrack track;
        for (const OutputChange& change : body) { track.body.append(change); }
        return OutputCheck(MotorIndex{0}, machine).check(track, Ticks{100}, Ticks{50});
    }
    MachineConfig machine;
};

TEST_F(OutputsOfAFrame, AreAcceptedIfTheyAreOfItsDeviceAndInOrder) {
    EXPECT_EQ(check({{{1}, SetDigital{4, 4}}, {{1}, RampAnalog{1, 0, 7}}, {{100}, RampAnalog{1, kFullScale, 0}}}),
              FaultCode::None);
}

TEST_F(OutputsOfAFrame, AreRefusedIfTheyAreNotOfItsDeviceOrOutOfOrder) {
    for (const std::vector<OutputChange>& body : std::vector<std::vector<OutputChange>>{
             {{{0}, SetDigital{4, 4}}},
             {{{101}, SetDigital{4, 4}}},
             {{{5}, SetDigital{4, 4}}, {{4}, SetDigital{0, 4}}},
             {{{1}, SetDigital{1, 1}}},
             {{{1}, SetDigital{8, 4}}},
             {{{1}, RampAnalog{0, 0, 0}}},
             {{{1}, RampAnalog{1, -1, 0}}},
             {{{1}, RampAnalog{1, kFullScale + 1, 0}}},
             {{{1}, ComparePosition{.next = 1, .every = 1, .pulses = 1}}},
         }) {
        EXPECT_EQ(check(body), FaultCode::OutputsImpossible);
    }
    EXPECT_EQ(check(std::vector<OutputChange>(OutputTrack::kMostInBody, {{1}, SetDigital{4, 4}})),
              FaultCode::OutputsImpossible)
        << "more than a frame has room for";
}

}  // namespace
}  // namespace lockstep
